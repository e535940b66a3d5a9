#include "gvd/predicates/angle_sum.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/meshes.hpp"

namespace gvd::predicates {
namespace {

using robust::MaybeSign;
using robust::Sign;
using robust::Stage;
using Vector = std::array<double, 3>;

/// A fan by its spokes, corner i between spokes i and i + 1 (the last with the first if `closed`).
struct Fan {
  std::vector<Vector> spokes;
  bool closed = true;
  std::size_t corners() const { return closed ? spokes.size() : spokes.size() - 1; }
  const Vector& spoke(std::size_t i) const { return spokes[i % spokes.size()]; }
  int quarter_turns() const { return closed ? 4 : 2; }
};

std::array<mpq_class, 3> exact(const Vector& d) { return {mpq_class(d[0]), mpq_class(d[1]), mpq_class(d[2])}; }

std::vector<ExactCorner> exact_corners(const Fan& fan) {
  std::vector<ExactCorner> corners;
  for (std::size_t i = 0; i < fan.corners(); ++i) corners.push_back(exact_corner(exact(fan.spoke(i)), exact(fan.spoke(i + 1))));
  return corners;
}

AngleSumFilter filter(const Fan& fan) {
  AngleSumFilter sum;
  for (std::size_t i = 0; i < fan.corners(); ++i) sum.add(fan.spoke(i), fan.spoke(i + 1));
  return sum;
}

/// Independent truth: the sum of arc tangents minus the turns, with 1000 bits; anything below 2^-900 is taken for zero.
class Truth {
 public:
  Truth(const std::vector<ExactCorner>& corners, int quarter_turns) {
    mpfr_inits2(kBits, sum_, a_, b_, nullptr);
    mpfr_set_zero(sum_, 1);
    for (const ExactCorner& corner : corners) {
      mpfr_set_q(a_, corner.cross_square.get_mpq_t(), MPFR_RNDN);
      mpfr_sqrt(a_, a_, MPFR_RNDN);
      mpfr_set_q(b_, corner.dot.get_mpq_t(), MPFR_RNDN);
      mpfr_atan2(a_, a_, b_, MPFR_RNDN);
      mpfr_add(sum_, sum_, a_, MPFR_RNDN);
    }
    mpfr_const_pi(a_, MPFR_RNDN);
    mpfr_mul_si(a_, a_, quarter_turns, MPFR_RNDN);
    mpfr_div_ui(a_, a_, 2, MPFR_RNDN);
    mpfr_sub(sum_, sum_, a_, MPFR_RNDN);
  }
  ~Truth() { mpfr_clears(sum_, a_, b_, nullptr); }
  Truth(const Truth&) = delete;
  Truth& operator=(const Truth&) = delete;

  Sign sign() const {
    if (mpfr_zero_p(sum_) || mpfr_get_exp(sum_) < -900) return Sign::zero;
    return mpfr_sgn(sum_) > 0 ? Sign::positive : Sign::negative;
  }
  /// |sum - turns - argument of x + i y|, to double.
  double distance_to_argument(double x, double y) {
    mpfr_set_d(a_, y, MPFR_RNDN);
    mpfr_set_d(b_, x, MPFR_RNDN);
    mpfr_atan2(a_, a_, b_, MPFR_RNDN);
    mpfr_sub(a_, a_, sum_, MPFR_RNDN);
    return std::abs(mpfr_get_d(a_, MPFR_RNDA));
  }

 private:
  static constexpr mpfr_prec_t kBits = 1000;
  mpfr_t sum_, a_, b_;
};

void expect_if_decided(MaybeSign sign, Sign truth, const char* stage) {
  if (sign) {
    EXPECT_EQ(*sign, truth) << stage;
  }
}

/// All stages that decide agree with the truth, the filter too.
void expect_truth(const Fan& fan) {
  const auto corners = exact_corners(fan);
  const int turns = fan.quarter_turns();
  const Sign truth = Truth(corners, turns).sign();
  expect_if_decided(filter(fan).compare(turns), truth, "filter");
  expect_if_decided(double_double_compare_angle_sum(corners, turns), truth, "double_double");
  expect_if_decided(exact_compare_angle_sum(corners, turns), truth, "exact");
  expect_if_decided(multiprecision_compare_angle_sum(corners, turns, 256), truth, "multiprecision");
  EXPECT_EQ(compare_angle_sum(corners, turns).sign, MaybeSign(truth));
}

Fan random_fan(test::Random& random, std::size_t spokes, double relief, bool closed) {
  Fan fan{{}, closed};
  for (std::size_t i = 0; i < spokes; ++i) {
    const double angle = (i + random.uniform(0.05, 0.95)) * 6.283185307179586 / static_cast<double>(spokes) / (closed ? 1 : 2);
    const double length = std::exp2(random.uniform(-4, 4));
    fan.spokes.push_back({length * std::cos(angle), length * std::sin(angle), relief * random.uniform(-1, 1)});
  }
  return fan;
}

/// All comparisons with whole numbers of quarter turns, also those that no mesh asks for.
TEST(AngleSum, AgainstAnyNumberOfQuarterTurns) {
  test::Random random(9);
  int zeros = 0;
  for (int round = 0; round < 400; ++round) {
    Fan fan{{}, false};  // whole vectors of a few directions, in one plane or not
    const std::size_t spokes = 2 + random.below(8);
    const double slope = random.below(3);
    while (fan.spokes.size() < spokes) {
      const double x = static_cast<int>(random.below(5)) - 2, y = static_cast<int>(random.below(5)) - 2;
      const Vector next{x, y, slope * x};
      const auto in_line = [&](const Vector& d) { return d[0] * y == d[1] * x; };
      if ((x == 0 && y == 0) || (!fan.spokes.empty() && in_line(fan.spokes.back()))) continue;
      fan.spokes.push_back(next);
    }
    const auto corners = exact_corners(fan);
    for (int turns = 0; turns <= 10; ++turns) {
      const Sign truth = Truth(corners, turns).sign();
      zeros += truth == Sign::zero;
      expect_if_decided(double_double_compare_angle_sum(corners, turns), truth, "double_double");
      expect_if_decided(multiprecision_compare_angle_sum(corners, turns, 256), truth, "multiprecision");
      expect_if_decided(exact_compare_angle_sum(corners, turns), truth, "exact");
      EXPECT_EQ(compare_angle_sum(corners, turns).sign, MaybeSign(truth)) << round << ", " << turns;
    }
  }
  EXPECT_GT(zeros, 50);
}

/// Thousands of corners, whose product no double could hold.
TEST(AngleSum, OfThousandsOfCorners) {
  for (const double length : {1.75, 1.25}) {  // the size of each corner is not a power of two
    Fan fan;
    for (int i = 0; i < 4000; ++i) {  // full turn after full turn: right angles in the plane across (1, 1, -2)
      const double s = i % 4 < 2 ? length : -length;
      fan.spokes.push_back(i % 2 == 0 ? Vector{s, s, s} : Vector{s, -s, 0});
    }
    const auto corners = exact_corners(fan);
    for (const int off : {-1, 0, 1}) {
      const Sign truth = off < 0 ? Sign::positive : off > 0 ? Sign::negative : Sign::zero;
      EXPECT_EQ(compare_angle_sum(corners, 4000 + off).sign, MaybeSign(truth));
      expect_if_decided(double_double_compare_angle_sum(corners, 4000 + off), truth, "double_double");
      expect_if_decided(multiprecision_compare_angle_sum(corners, 4000 + off, 128), truth, "multiprecision");
    }
  }
}

// Hundreds of turns: errors of both coordinates add up at each corner, until few bits do not know any more how often the product has turned. Then they say nothing, more bits do.
TEST(AngleSum, OfHundredsOfTurns) {
  std::vector<ExactCorner> fan(600, ExactCorner{1, 3});              // each a sixth of a turn
  fan.insert(fan.end(), 20, ExactCorner{0, 1});                      // each a quarter
  const int turns = 600 * 2 / 3 + 20;
  for (const int quarter_turns : {4, turns - 1, turns, turns + 1}) {
    SCOPED_TRACE(quarter_turns);
    const Sign truth = quarter_turns < turns ? Sign::positive : quarter_turns > turns ? Sign::negative : Sign::zero;
    EXPECT_EQ(double_double_compare_angle_sum(fan, quarter_turns), std::nullopt);
    EXPECT_EQ(exact_compare_angle_sum(fan, quarter_turns), std::nullopt);
    EXPECT_EQ(multiprecision_compare_angle_sum(fan, quarter_turns, 128), std::nullopt);
    const MaybeSign known = truth == Sign::zero ? std::nullopt : MaybeSign(truth);
    EXPECT_EQ(multiprecision_compare_angle_sum(fan, quarter_turns, 1024), known);
    EXPECT_EQ(compare_angle_sum(fan, quarter_turns).sign, known);
  }
}

TEST(AngleSum, RandomFansAtAllScales) {
  test::Random random(1);
  for (int round = 0; round < 600; ++round) {
    const double relief = std::exp2(random.uniform(-40, 4));
    Fan fan = random_fan(random, 3 + random.below(9), relief, round % 3 != 0);
    const int shift = static_cast<int>(random.below(400)) - 200;
    for (Vector& d : fan.spokes) {
      for (double& x : d) x = std::ldexp(x, shift);
    }
    expect_truth(fan);
  }
}

/// The filter's product is never further from the truth than promised, and the promise is not idle.
TEST(AngleSum, FilterErrorIsBoundedAndTheBoundIsNotIdle) {
  test::Random random(2);
  double worst = 0;
  for (int round = 0; round < 2000; ++round) {
    Fan fan = random_fan(random, 3 + random.below(6), std::exp2(random.uniform(-20, 5)), true);
    if (round % 2 == 0) {  // needles: spokes nearly along one line
      for (Vector& d : fan.spokes) d = {d[0] * 1e6, d[1], d[2] + d[0] * 1e5};
    }
    const AngleSumFilter sum = filter(fan);
    ASSERT_TRUE(sum.nearest_quarter_turns());
    Truth truth(exact_corners(fan), *sum.nearest_quarter_turns());
    const auto [x, y] = sum.product();
    const double ratio = truth.distance_to_argument(x, y) / sum.error_bound();
    worst = std::max(worst, ratio);
  }
  RecordProperty("worst_ratio_percent", static_cast<int>(100 * worst));
  EXPECT_LE(worst, 1.0);
  EXPECT_GE(worst, 0.02);
}

/// Differences of rounded coordinates: the errors of d and e that the filter allows for.
TEST(AngleSum, FilterCoversRoundedDifferences) {
  test::Random random(3);
  int decided = 0;
  for (int round = 0; round < 500; ++round) {
    const Vector at = {562000.1 + random.uniform(), 5116000.7 + random.uniform(), 2000.3};
    const Fan shape = random_fan(random, 6, std::exp2(random.uniform(-30, 2)), true);
    std::vector<Vector> points;
    for (const Vector& d : shape.spokes) points.push_back({at[0] + d[0], at[1] + d[1], at[2] + d[2]});
    AngleSumFilter sum;
    std::vector<ExactCorner> corners;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vector d, e;
      std::array<mpq_class, 3> exact_d, exact_e;
      for (std::size_t k = 0; k < 3; ++k) {
        const double p = points[i][k], q = points[(i + 1) % points.size()][k];
        d[k] = p - at[k];
        e[k] = q - at[k];
        exact_d[k] = mpq_class(p) - mpq_class(at[k]);
        exact_e[k] = mpq_class(q) - mpq_class(at[k]);
      }
      sum.add(d, e);
      corners.push_back(exact_corner(exact_d, exact_e));
    }
    if (const auto sign = sum.compare(4)) {
      ++decided;
      EXPECT_EQ(*sign, Truth(corners, 4).sign());
    }
  }
  EXPECT_GT(decided, 250);
}

/// An input error that is declared is believed: the true fan is another one.
TEST(AngleSum, FilterAllowsForTheErrorsOfThePoints) {
  test::Random random(4);
  int decided = 0;
  for (int round = 0; round < 2000; ++round) {
    const Fan truth = random_fan(random, 5, 0.3, true);
    Fan seen = truth;
    std::vector<double> errors;
    for (Vector& d : seen.spokes) {
      const double error = std::exp2(random.uniform(-20, -8)) * std::hypot(d[0], d[1], d[2]);
      const Vector before = d;
      for (double& x : d) x += error * random.uniform(-0.57, 0.57);
      errors.push_back(std::hypot(d[0] - before[0], d[1] - before[1], d[2] - before[2]) / std::hypot(d[0], d[1], d[2]) * 1.01);
    }
    AngleSumFilter sum;
    for (std::size_t i = 0; i < 5; ++i) sum.add(seen.spoke(i), seen.spoke(i + 1), errors[i] + errors[(i + 1) % 5]);
    if (const auto sign = sum.compare(4)) {
      ++decided;
      EXPECT_EQ(*sign, Truth(exact_corners(truth), 4).sign());
    }
  }
  EXPECT_GT(decided, 200);
}

TEST(AngleSum, FlatFansAreZeroAndOneUlpOffIsNot) {
  // A plane of rational slope through the origin, spokes of integers; the exact stage must say zero.
  const Fan plane{{{4, 0, 8}, {3, 5, 21}, {-2, 7, 17}, {-6, 1, -9}, {-1, -8, -26}, {5, -3, 1}}};
  const auto corners = exact_corners(plane);
  EXPECT_EQ(filter(plane).compare(4), std::nullopt);
  EXPECT_EQ(exact_compare_angle_sum(corners, 4), MaybeSign(Sign::zero));
  const Decision decision = compare_angle_sum(corners, 4);
  EXPECT_EQ(decision.sign, MaybeSign(Sign::zero));
  EXPECT_EQ(decision.stage, Stage::algebra);
  for (std::size_t i = 0; i < plane.spokes.size(); ++i) {
    for (const double to : {-100.0, 100.0}) {
      Fan off = plane;
      off.spokes[i][2] = std::nextafter(off.spokes[i][2], to);
      expect_truth(off);
      EXPECT_NE(compare_angle_sum(exact_corners(off), 4).sign, MaybeSign(Sign::zero));
    }
  }
}

TEST(AngleSum, FoldsAreFlat) {
  // Two half planes that meet along the y axis: two independent roots, or one, or none.
  for (const auto& [left, right] : {std::pair{0.75, -0.75}, {0.5, 3.0}, {1.0, 2.0}, {0.0, 7.0}}) {
    const Fan fold{{{0, 3, 0}, {-1, 2, left}, {-5, -1, 5 * left}, {0, -2, 0}, {1, -7, right}, {2, 1, 2 * right}}};
    const auto corners = exact_corners(fold);
    EXPECT_EQ(exact_compare_angle_sum(corners, 4), MaybeSign(Sign::zero)) << left << " " << right;
    EXPECT_EQ(compare_angle_sum(corners, 4).sign, MaybeSign(Sign::zero));
    // A boundary vertex on the fold's end: the half that ends there is half a turn.
    const Fan half{{fold.spokes.begin(), fold.spokes.begin() + 4}, false};
    EXPECT_EQ(compare_angle_sum(exact_corners(half), 2).sign, MaybeSign(Sign::zero));
  }
}

TEST(AngleSum, FourIndependentRoots) {
  // Pairs of corners p + i q sqrt(c) and q c + i p sqrt(c) add up to a right angle.
  const std::vector<ExactCorner> right = {{1, 2}, {2, 2}, {1, 3}, {3, 3}, {2, 5}, {mpq_class(5, 2), 5}, {1, 7}, {7, 7}};
  ASSERT_EQ(Truth(right, 4).sign(), Sign::zero);
  EXPECT_EQ(exact_compare_angle_sum(right, 4), MaybeSign(Sign::zero));
  EXPECT_EQ(compare_angle_sum(right, 4).sign, MaybeSign(Sign::zero));
  // 2, 3 and 6 are no three independent roots.
  const std::vector<ExactCorner> dependent = {{1, 2}, {2, 2}, {1, 3}, {3, 3}, {1, 6}, {6, 6}, {1, 30}, {30, 30}};
  EXPECT_EQ(exact_compare_angle_sum(dependent, 4), MaybeSign(Sign::zero));
}

TEST(AngleSum, NearlyFlatFansOfManyRootsReachMpfr) {
  // A hexagon in a plane, its centre lifted by 2^-k: always convex, by about 2^-2k.
  for (const int k : {30, 60, 120, 300}) {
    const mpq_class lift(mpz_class(1), mpz_class(1) << k);
    const int x[] = {5, 2, -3, -7, -1, 4}, y[] = {1, 6, 4, -2, -9, -3};
    std::vector<ExactCorner> corners;
    for (int i = 0; i < 6; ++i) corners.push_back(exact_corner({x[i], y[i], -lift}, {x[(i + 1) % 6], y[(i + 1) % 6], -lift}));
    const Decision decision = compare_angle_sum(corners, 4);
    EXPECT_EQ(decision.sign, MaybeSign(Sign::negative)) << k;
    EXPECT_EQ(decision.stage, k == 30 ? Stage::double_double : Stage::mpfr) << k;
    if (k == 120) {
      EXPECT_EQ(multiprecision_compare_angle_sum(corners, 4, 128), std::nullopt);
      EXPECT_EQ(multiprecision_compare_angle_sum(corners, 4, 512), MaybeSign(Sign::negative));
    }
  }
}

TEST(AngleSum, TurnsAreCountedBeyondOneAndUnderOne) {
  // Fans that go round several times, and narrow ones.
  for (const std::size_t rounds : {1u, 2u, 3u}) {
    Fan fan;
    for (std::size_t i = 0; i < 4 * rounds; ++i) {
      const double x[] = {1, 0, -1, 0}, y[] = {0, 1, 0, -1};
      fan.spokes.push_back({x[i % 4], y[i % 4], 0});
    }
    EXPECT_EQ(filter(fan).nearest_quarter_turns(), static_cast<int>(4 * rounds));
    EXPECT_EQ(compare_angle_sum(exact_corners(fan), 4).sign, MaybeSign(rounds == 1 ? Sign::zero : Sign::positive));
  }
  const Fan narrow{{{1, 0, 0}, {1, 1e-9, 0}, {1, 2e-9, 1e-9}}, false};
  EXPECT_EQ(filter(narrow).compare(2), MaybeSign(Sign::negative));
  const Fan wide{{{1, 0, 0}, {-1, 1e-9, 0}, {1, 2e-9, 1e-9}, {-1, 0, 1e-9}}, false};
  EXPECT_EQ(filter(wide).compare(2), MaybeSign(Sign::positive));
  EXPECT_EQ(filter(wide).nearest_quarter_turns(), 6);
}

/// Out of the range in which the bound holds the filter says nothing; later stages do.
TEST(AngleSum, FilterRefusesExtremeScales) {
  const Fan cone{{{1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}}};
  for (const int shift : {-500, -250, 300, 1000}) {
    Fan scaled = cone;
    for (Vector& d : scaled.spokes) {
      for (double& x : d) x = std::ldexp(x, shift);
    }
    EXPECT_EQ(filter(scaled).compare(4), std::nullopt) << shift;
    const Decision decision = compare_angle_sum(exact_corners(scaled), 4);
    EXPECT_EQ(decision.sign, MaybeSign(Sign::negative));
    EXPECT_EQ(decision.stage, Stage::double_double);
  }
  Fan infinite = cone;
  infinite.spokes[1][0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(filter(infinite).compare(4), std::nullopt);
}

/// A mirror image and another first corner change nothing.
TEST(AngleSum, Laws) {
  test::Random random(5);
  for (int round = 0; round < 300; ++round) {
    const Fan fan = random_fan(random, 5, std::exp2(random.uniform(-60, 0)), true);
    const auto sign = compare_angle_sum(exact_corners(fan), 4).sign;
    Fan turned = fan;
    std::rotate(turned.spokes.begin(), turned.spokes.begin() + 1 + random.below(4), turned.spokes.end());
    EXPECT_EQ(compare_angle_sum(exact_corners(turned), 4).sign, sign);
    std::reverse(turned.spokes.begin(), turned.spokes.end());
    EXPECT_EQ(compare_angle_sum(exact_corners(turned), 4).sign, sign);
  }
}

}  // namespace
}  // namespace gvd::predicates
