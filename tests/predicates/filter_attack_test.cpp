#include <gtest/gtest.h>

#include <boost/multiprecision/mpfr.hpp>
#include <map>

#include "../../predicates/src/path_numbers.hpp"
#include "gvd/predicates/angle_sum.hpp"
#include "gvd/predicates/filter_error.hpp"
#include "gvd/predicates/strip_window.hpp"
#include "support/planar_strips.hpp"
#include "support/zigzag.hpp"

/// Inputs that try to break the bounds of the filter and of double-double: long strips, slivers, offsets, all scales, neighbours of ties.
namespace gvd::predicates {
namespace {

using robust::Ball;
using robust::DoubleDouble;
using robust::MaybeSign;
using robust::Sign;
using robust::Stage;
using test::LaidOut;
using test::Random;
using test::random_layout;
/// 2000 bits.
using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<600>, boost::multiprecision::et_off>;

// ---- the literals ----

TEST(AngleBounds, LiteralsFollowFromTheirDerivations) {
  const double sqrt2 = std::sqrt(2.0);
  const double dot = 3 + 2, cross = 4 * sqrt2, height = cross + (1 + 2) / 2.0 + 1;
  const double corner = std::hypot(dot, height) + std::sqrt(5.0);
  EXPECT_LE(corner * 1.05 * kUnit, kAngleFactorError);
  EXPECT_LE(sqrt2 * 1.05, kAngleInputError);
  EXPECT_LE(1 + kMostAngleError, 1.05);
  // The range of z.
  const double up = std::ldexp(1.0, kAngleRescale), least = kLeastAngleFactor, most = kMostAngleFactor;
  EXPECT_LT(most / up, 1);
  EXPECT_GT(most / up, least);
  EXPECT_GT(least / sqrt2 * up, 2);
  EXPECT_LT(sqrt2 * most * most * 4, std::numeric_limits<double>::max());
  EXPECT_LT(std::sqrt(3.0) * 0x1p-537 / (least / sqrt2), 0.01 * kUnit);
  EXPECT_GT(least * least / sqrt2 * kUnit, 4 * 0x1p-1074);
}

// So many corners at either end of the range that any drift of the product would leave it.
TEST(AngleBounds, TheProductStaysInRange) {
  for (const double size : {0.9999 * kMostAngleFactor, 1.0001 * kLeastAngleFactor}) {
    for (const double angle : {1e-9, 0.25, 0.7853981633974483}) {
      AngleSumFilter sum;
      const int corners = 6000;
      for (int i = 0; i < corners; ++i) {
        const double x = size * std::cos(angle) / (std::cos(angle) + std::sin(angle)), y = x * std::tan(angle);
        sum.add({1, 0, 0}, {x, y, 0});
      }
      const auto turns = sum.nearest_quarter_turns();
      ASSERT_TRUE(turns.has_value()) << size << " " << angle;
      EXPECT_NEAR(*turns, corners * angle / (std::acos(-1.0) / 2), 1);
      const auto z = sum.product();
      EXPECT_GT(std::hypot(z[0], z[1]), 0.9 * kLeastAngleFactor);
      EXPECT_LT(std::hypot(z[0], z[1]), 1.5 * kMostAngleFactor);
    }
  }
}

TEST(Stretches, ZeroesAreBracketed) {
  Random random(1);
  const auto number = [&] {
    const int kind = static_cast<int>(random.below(3));
    const int exponent = kind == 0 ? 0 : kind == 1 ? -static_cast<int>(random.below(1073)) : -1070 + static_cast<int>(random.below(4));
    return std::ldexp(random.uniform(0.5, 1), exponent);
  };
  for (int i = 0; i < 20000; ++i) {
    const double sign = random.below(2) == 0 ? 1 : -1;
    const double a = sign * number(), b = -sign * (random.below(20) == 0 && sign < 0 ? 0 : number());
    const mpq_class zero = mpq_class(a) / (mpq_class(a) - mpq_class(b));
    ASSERT_LE(mpq_class(below_zero_of(a, b)), zero);
    ASSERT_GE(mpq_class(above_zero_of(a, b)), zero);
    ASSERT_LE(above_zero_of(a, b) - below_zero_of(a, b), 0x1p-46 * zero.get_d() + 0x1p-1060);
  }
}

// ---- strips ----

struct Tally {
  std::map<Stage, int> decided;
  int contained = 0;
};

/// Everything that the first two stages say must be so.
void attack(const LaidOut& layout, Random& random, Tally& tally) {
  const FaceStrip strip = layout.strip();
  const auto flat = layout.flat<Real>();
  const auto n = static_cast<std::uint32_t>(flat.size());
  // Of the first face as given, 0 is the source and 1, 2 the exit edge: the same numbers.
  for (int i = 0; i < 12; ++i) {
    const std::size_t a = 1 + random.below(n - 1), b = 1 + random.below(n - 1);
    const Real turn = (flat[a].x - flat[0].x) * (flat[b].y - flat[0].y) - (flat[a].y - flat[0].y) * (flat[b].x - flat[0].x);
    const Real size = abs(flat[a].x - flat[0].x) + abs(flat[a].y - flat[0].y), other = abs(flat[b].x - flat[0].x) + abs(flat[b].y - flat[0].y);
    const bool is_tie = abs(turn) < size * other * Real("1e-400");
    const Sign truth = is_tie ? Sign::zero : turn > 0 ? Sign::positive : Sign::negative;
    bool settled = false;
    for (const Rung& rung : kRungs) {
      if (rung.stage == Stage::algebra || rung.bits > 512) continue;
      const MaybeSign sign = ray_side_at(rung, strip, a, b);
      ASSERT_EQ(sign.value_or(truth), truth) << "stage " << static_cast<int>(rung.stage) << ", vertices " << a << " " << b;
      if (sign && !settled) ++tally.decided[rung.stage];
      settled = settled || sign;
    }
  }
  // The distance of the last corner, and that of a point of the last face.
  const std::size_t last = n - 1;
  const Leg leg(strip, FacePoint::corner(2));
  const Real dx = flat[last].x - flat[0].x, dy = flat[last].y - flat[0].y, truth = sqrt(dx * dx + dy * dy);
  const auto expect_inside = [&](const auto& ball, const Real& mid) {
    if (!ball.is_finite()) return;
    ASSERT_LE(abs(mid - truth), Real(ball.rad()) + truth * Real("1e-590"));
    ++tally.contained;
  };
  const StripAccess at(strip);
  if (!at.is_in_range()) return;
  const Ball<double> in_double = length_in<double>(leg, 0);
  expect_inside(in_double, Real(in_double.mid()));
  const Ball<DoubleDouble> in_double_double = length_in<DoubleDouble>(leg, 0);
  expect_inside(in_double_double, Real(in_double_double.mid().hi) + Real(in_double_double.mid().lo));
}

template <class Change>
Tally attack_family(std::uint64_t seed, int rounds, std::size_t most_faces, const Change& change) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < rounds; ++i) {
    attack(random_layout(1 + random.below(static_cast<std::uint32_t>(most_faces)), random, change), random, tally);
    if (testing::Test::HasFatalFailure()) break;
  }
  return tally;
}

TEST(FilterAttack, LongStrips) {
  const Tally t = attack_family(21, 6, 400, [](SpacePoint p) { return p; });
  EXPECT_GT(t.decided.at(Stage::filter), 30);
  EXPECT_EQ(t.contained, 12);
}

TEST(FilterAttack, Slivers) {
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    const Tally t = attack_family(22 + axis, 40, 40, [&](SpacePoint p) {
      p[axis] *= 1e-9;
      p[2] *= 1e-9;
      return p;
    });
    EXPECT_GT(t.decided.at(Stage::filter), 50) << axis;
    EXPECT_GT(t.contained, 60) << axis;
  }
}

TEST(FilterAttack, FarFromTheOrigin) {
  const Tally t = attack_family(25, 40, 40, [](SpacePoint p) {
    for (double& x : p) x += 1e7;
    return p;
  });
  EXPECT_GT(t.decided.at(Stage::filter), 300);
  EXPECT_EQ(t.contained, 80);
}

TEST(FilterAttack, AllScales) {
  for (const double scale : {1e-300, 1e-150, 1e150, 1e300}) {
    const Tally t = attack_family(26, 15, 30, [&](SpacePoint p) {
      for (double& x : p) x *= scale;
      return p;
    });
    EXPECT_GT(t.decided.at(Stage::filter), 100) << scale;
    EXPECT_EQ(t.contained, 30) << scale;
  }
  // Sizes that change along the strip by ten powers of ten a face.
  const Tally mixed = attack_family(27, 40, 12, [](SpacePoint p) {
    const double f = std::pow(10.0, -10 * p[0]);
    return SpacePoint{p[0] * f, p[1] * f, p[2] * f};
  });
  EXPECT_GT(mixed.decided.at(Stage::filter), 50);
}

// Collinear triples of a plane, each coordinate one ulp off or not: signs that doubles must leave open, or get right.
TEST(FilterAttack, NeighboursOfTies) {
  Random random(28);
  Tally tally;
  for (int round = 0; round < 150; ++round) {
    const auto ulp = [&](double x) {
      const auto kind = random.below(4);
      return kind == 0 ? std::nextafter(x, HUGE_VAL) : kind == 1 ? std::nextafter(x, -HUGE_VAL) : x;
    };
    const double slope = random.uniform(-1, 1), offset = random.below(2) == 0 ? 1e7 : 0;
    const auto tilted = [&](double x, double y) { return SpacePoint{ulp(x + offset), ulp(y + offset), ulp(slope * x + 0.5 * y)}; };
    // From the origin through (0, 2), (0, 4), ...: all left banks lie on one ray.
    LaidOut layout;
    layout.corner = {tilted(0, 0), tilted(0, 2), tilted(3, 1)};
    std::size_t left = 1, right = 2;
    for (std::size_t v = 3; v < 10; ++v) {
      layout.edge.push_back({left, right});
      if (v % 2 == 1) {
        layout.corner.push_back(tilted(0, static_cast<double>(v) + 1));
        left = v;
      } else {
        layout.corner.push_back(tilted(3, static_cast<double>(v)));
        right = v;
      }
    }
    attack(layout, random, tally);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(tally.decided[Stage::filter], 300);
  EXPECT_GT(tally.decided[Stage::double_double], 50);
}

// Windows with nearly equal weights: what the first two stages say about their ties is what 512 bits say.
TEST(FilterAttack, TiesOnAnEdge) {
  Random random(29);
  std::map<Stage, int> decided;
  for (int round = 0; round < 200; ++round) {
    const double scale = round % 3 == 0 ? 1e-9 : 1;
    const auto change = [&](SpacePoint p) {
      p[0] *= scale;
      return p;
    };
    const LaidOut layout = random_layout(2 + random.below(20), random, change);
    Window a{layout.strip(), {}, std::nullopt};
    FaceStrip short_one({layout.corner[0], layout.corner[1], layout.corner[2]}, {{1, 1 + random.below(3), 1}});
    for (std::size_t v = 3; v < layout.corner.size(); ++v)
      short_one.cross({layout.corner[layout.edge[v - 3][1]], layout.corner[layout.edge[v - 3][0]], layout.corner[v]});
    Window b{short_one, {}, std::nullopt};
    // A tie near the first end of the edge.
    const auto& face = a.strip.last_face();
    const Enclosure at_a = length({0, {Leg(a.strip, FacePoint::corner(0))}}), at_b = length({0, {Leg(b.strip, FacePoint::corner(0))}});
    b.weight.given = mpq_class(at_a.lower) - mpq_class(at_b.upper);
    if (random.below(2) == 0) b.weight.given += mpq_class(std::ldexp(at_a.lower, -40));
    const std::array<SpacePoint, 2> edge{face[0], face[1]};
    const auto truth = ties_on_edge_at({Stage::mpfr, 512}, a, b, edge);
    ASSERT_TRUE(truth.has_value()) << round;
    bool settled = false;
    for (const Stage stage : {Stage::filter, Stage::double_double}) {
      const auto ties = ties_on_edge_at({stage}, a, b, edge);
      if (!ties) continue;
      if (!settled) ++decided[stage];
      settled = true;
      ASSERT_EQ(ties->kind, truth->kind) << round;
      ASSERT_EQ(ties->a_is_nearer, truth->a_is_nearer) << round;
      ASSERT_EQ(ties->ties.size(), truth->ties.size()) << round;
      for (std::size_t i = 0; i < truth->ties.size(); ++i) {
        ASSERT_EQ(ties->ties[i].a_before, truth->ties[i].a_before);
        ASSERT_LE(ties->ties[i].t.lower, truth->ties[i].t.upper) << round;
        ASSERT_GE(ties->ties[i].t.upper, truth->ties[i].t.lower) << round;
      }
    }
  }
  EXPECT_GT(decided[Stage::filter], 20);
  EXPECT_GT(decided[Stage::double_double], 20);
}

}  // namespace
}  // namespace gvd::predicates
