#include <gtest/gtest.h>

#include "gvd/predicates/strip_window.hpp"
#include "gvd/robust/rational.hpp"
#include "support/planar_strips.hpp"

/// Windows of one plane that tie, or nearly do: each stage says what the exact numbers say, or nothing. Sources inside the last face itself, so that images can
/// be put anywhere, exactly.
namespace gvd::predicates {
namespace {

using robust::MaybeSign;
using robust::RootSum;
using robust::Sign;
using robust::Stage;
using test::PlanarPoint;
using test::Random;
using Kind = EdgeTies::Kind;

constexpr double kSide = 8;
constexpr SpacePoint kOrigin{0, 0, 0}, kRight{kSide, 0, 0}, kTop{0, kSide, 0};
const FaceCorners kFace{kOrigin, kRight, kTop};
const std::array<SpacePoint, 2> kEdge{kOrigin, kRight};

/// A source of the face, at (x, y), x + y <= 8.
Window at(const mpq_class& x, const mpq_class& y, const mpq_class& weight = 0) {
  return {FaceStrip(kFace, {{kSide - x - y, x, y}}), {weight, {}}, std::nullopt};
}
/// A source on the line of the edge, beyond its end: seen through the face beside.
Window beyond_end(const mpq_class& x, const mpq_class& weight) {
  FaceStrip strip(FaceCorners{kRight, SpacePoint{2 * kSide, 0, 0}, kTop}, {{2 * kSide - x, x - kSide, 0}});
  strip.cross(kFace);
  return {strip, {weight, {}}, std::nullopt};
}

/// What is certain at every rung agrees with the whole ladder's answer.
EdgeTies at_all_rungs(const Window& a, const Window& b) {
  const EdgeTies ties = ties_on_edge(a, b, kEdge);
  for (const Rung& rung : kRungs) {
    const auto known = ties_on_edge_at(rung, a, b, kEdge);
    if (!known) continue;
    EXPECT_EQ(known->kind, ties.kind) << static_cast<int>(rung.stage) << ", " << rung.bits;
    EXPECT_EQ(known->ties.size(), ties.ties.size());
    if (ties.kind == Kind::none) {
      EXPECT_EQ(known->a_is_nearer, ties.a_is_nearer);
    }
    for (std::size_t i = 0; i < std::min(known->ties.size(), ties.ties.size()); ++i) {
      EXPECT_EQ(known->ties[i].a_before, ties.ties[i].a_before);
      EXPECT_LE(known->ties[i].t.lower, ties.ties[i].t.upper);
      EXPECT_GE(known->ties[i].t.upper, ties.ties[i].t.lower);
    }
  }
  return ties;
}

/// The same whichever of the two comes first.
EdgeTies both_ways(const Window& a, const Window& b) {
  const EdgeTies ties = at_all_rungs(a, b), swapped = at_all_rungs(b, a);
  EXPECT_EQ(ties.kind, swapped.kind);
  EXPECT_EQ(ties.ties.size(), swapped.ties.size());
  if (ties.kind == Kind::none) {
    EXPECT_NE(ties.a_is_nearer, swapped.a_is_nearer);
  }
  for (std::size_t i = 0; i < std::min(ties.ties.size(), swapped.ties.size()); ++i) EXPECT_NE(ties.ties[i].a_before, swapped.ties[i].a_before);
  return ties;
}

void expect_contact(const EdgeTies& ties, const mpq_class& t) {
  EXPECT_EQ(ties.kind, Kind::points);
  ASSERT_EQ(ties.ties.size(), 1u);
  EXPECT_TRUE(ties.ties[0].is_contact);
  EXPECT_TRUE(ties.ties[0].a_before) << "the one that is on its way first";
  EXPECT_LE(mpq_class(ties.ties[0].t.lower), t);
  EXPECT_GE(mpq_class(ties.ties[0].t.upper), t);
}

/// The second wave starts on the first one's way, just when that comes by: they tie along one ray, behind the second.
TEST(NearTies, AWaveThatStartsOnAnothersWay) {
  const mpq_class q(1, 4);
  // From (1/4, 2) through (1, 1), 5/4 away, to (7/4, 0).
  expect_contact(both_ways(at(q, 2), at(1, 1, 5 * q)), mpq_class(7, 32));
  // To the edge's line before its begin, and beyond its end.
  EXPECT_EQ(both_ways(at(mpq_class(5, 4), 3), at(mpq_class(1, 2), 2, 5 * q)).kind, Kind::none);
  EXPECT_EQ(both_ways(at(4, mpq_class(15, 4)), at(5, 3, 5 * q)).kind, Kind::none);
  // Away from the edge, and along it.
  for (const EdgeTies& ties : {both_ways(at(1, 1), at(q, 2, 5 * q)), both_ways(at(1, 1), at(2, 1, 1))}) {
    EXPECT_EQ(ties.kind, Kind::none);
    EXPECT_TRUE(ties.a_is_nearer);
  }
  // The second one starts on the edge, at a corner of it.
  expect_contact(both_ways(at(2 - 3 * q, 1), at(2, 0, 5 * q)), q);
  expect_contact(both_ways(at(0, 1), at(0, 0, 1)), 0);
}

TEST(NearTies, WavesThatComeAlongTheEdge) {
  const EdgeTies forwards = both_ways(at(1, 0), at(2, 0, 1)), backwards = both_ways(at(3, 0), at(2, 0, 1));
  EXPECT_EQ(forwards.kind, Kind::ray);
  ASSERT_EQ(forwards.ties.size(), 1u);
  EXPECT_EQ(forwards.ties[0].t.upper, 1);
  EXPECT_NEAR(forwards.ties[0].t.lower, 0.25, 1e-15);
  EXPECT_EQ(backwards.kind, Kind::ray);
  ASSERT_EQ(backwards.ties.size(), 1u);
  EXPECT_EQ(backwards.ties[0].t.lower, 0);
  EXPECT_NEAR(backwards.ties[0].t.upper, 0.25, 1e-15);
  // What is left of the edge is its end, or nothing.
  expect_contact(both_ways(at(7, 0), at(8, 0, 1)), 1);
  expect_contact(both_ways(at(1, 0), at(0, 0, 1)), 0);
  EXPECT_EQ(both_ways(beyond_end(12, 0), beyond_end(13, 1)).kind, Kind::none);
  // From beyond the end all of the edge is left.
  const EdgeTies all = both_ways(beyond_end(13, 0), beyond_end(12, 1));
  EXPECT_EQ(all.kind, Kind::ray);
  ASSERT_EQ(all.ties.size(), 1u);
  EXPECT_EQ(all.ties[0].t.lower, 0);
  EXPECT_EQ(all.ties[0].t.upper, 1);
}

/// One weight described in two ways: with a leg of no length, or one that is given as a number.
TEST(NearTies, OneImageAndOneWeightUnderAnotherDescription) {
  const FacePoint corner = FacePoint::corner(0);
  const Leg none{FaceStrip(kFace, corner), corner}, three{FaceStrip(kFace, corner), {{5, 3, 0}}};
  for (const auto& [x, y] : {std::pair(mpq_class(0), mpq_class(0)), std::pair(mpq_class(2), mpq_class(0)), std::pair(mpq_class(1), mpq_class(3))}) {
    Window plain = at(x, y), longer = at(x, y), given = at(x, y, 3);
    longer.weight.legs = {none};
    EXPECT_EQ(at_all_rungs(plain, longer).kind, Kind::everywhere);
    EXPECT_EQ(at_all_rungs(longer, plain).kind, Kind::everywhere);
    longer.weight.legs = {three};
    EXPECT_EQ(at_all_rungs(given, longer).kind, Kind::everywhere);
    EXPECT_EQ(at_all_rungs(plain, longer).kind, Kind::none);
  }
}

/// By less and less: images above one another, beside one another, on one another's way, or just any.
TEST(NearTies, NeighboursByEveryPowerOfTwo) {
  Random random(21);
  std::array<int, robust::kStageCount> stages{};
  for (int round = 0; round < 1500; ++round) {
    const auto some = [&](std::uint32_t n) { return mpq_class(1 + random.below(n), 4); };
    const mpq_class x = some(12), y = some(12);
    const mpq_class step = robust::power_of_two(-static_cast<long>(8 + random.below(240))) * (random.below(2) == 0 ? 1 : -1);
    const mpq_class side = robust::power_of_two(-static_cast<long>(8 + random.below(240))) * (static_cast<int>(random.below(3)) - 1);
    Window a = at(x, y), b = a;
    switch (random.below(4)) {
      case 0: b = at(x + side, y + step); break;
      case 1: b = at(x + step, y + side, abs(side)); break;
      case 2: b = at(x + mpq_class(3, 4), y - (y > 1 ? mpq_class(1) : mpq_class(-1)), mpq_class(5, 4) + step); break;
      default: b = at(x + side, y, abs(step)); break;
    }
    const EdgeTies ties = at_all_rungs(a, b);
    ASSERT_NE(ties.kind, Kind::undecided);
    ++stages[static_cast<std::size_t>(ties.stage)];
    // At the ends of the edge by exact lengths.
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      const FacePoint corner = FacePoint::corner(end);
      Path to_a = a.weight, to_b = b.weight;
      to_a.legs.push_back({a.strip, corner});
      to_b.legs.push_back({b.strip, corner});
      const MaybeSign truth = compare_lengths(to_a, to_b).sign;  // positive if b is nearer
      ASSERT_TRUE(truth);
      if (ties.kind == Kind::none) {
        EXPECT_EQ(*truth, ties.a_is_nearer ? Sign::negative : Sign::positive) << round;
      }
      if (ties.kind != Kind::points || ties.ties[0].is_contact || *truth == Sign::zero) continue;
      const bool a_first = end == 0 ? ties.ties.front().a_before : !ties.ties.back().a_before;
      EXPECT_EQ(*truth, a_first ? Sign::negative : Sign::positive) << round << ", end " << end;
    }
    if (HasFailure()) FAIL() << round;
  }
  for (const Stage stage : {Stage::filter, Stage::double_double, Stage::mpfr, Stage::algebra}) EXPECT_GT(stages[static_cast<std::size_t>(stage)], 20);
}

/// A fourth window that is nearer or farther by less and less at the vertex of three, seen from the facet or just not; facets named from any corner.
TEST(NearTies, ConflictsByEveryPowerOfTwo) {
  Random random(22);
  std::array<int, 4> verdicts{};
  for (int round = 0; round < 400; ++round) {
    // On the circle of radius 5/4 about (2, 2), which the face contains.
    const std::array<PlanarPoint, 4> direction{{{1, 0}, {mpq_class(3, 5), mpq_class(4, 5)}, {mpq_class(-4, 5), mpq_class(3, 5)}, {0, -1}}};
    const mpq_class r(5, 4);
    const mpq_class step = round % 5 == 0 ? mpq_class(0) : robust::power_of_two(-static_cast<long>(4 + random.below(240))) * (random.below(2) == 0 ? 1 : -1);
    const std::size_t rival = random.below(4);
    std::array<Window, 4> w{at(0, 0), at(0, 0), at(0, 0), at(0, 0)};
    const bool by_weight = random.below(2) == 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const mpq_class reach = r + (i == rival && !by_weight ? step : mpq_class(0));
      w[i] = at(2 + reach * direction[i].x, 2 + reach * direction[i].y, i == rival && by_weight ? mpq_class(1 + step) : mpq_class(1));
    }
    std::array<const Window*, 3> ijk{&w[(rival + 1) % 4], &w[(rival + 2) % 4], &w[(rival + 3) % 4]};
    std::rotate(ijk.begin(), ijk.begin() + random.below(3), ijk.end());
    const bool clockwise = round % 7 == 3;
    if (clockwise) std::swap(ijk[0], ijk[1]);
    FaceCorners facet = kFace;
    std::rotate(facet.begin(), facet.begin() + random.below(3), facet.end());
    const Conflict expected = clockwise ? Conflict::no_vertex
                              : step == 0 ? Conflict::ties
                              : step > 0  ? Conflict::farther
                                          : Conflict::nearer;
    const ConflictDecision found = conflict(facet, ijk, w[rival]);
    ASSERT_EQ(found.verdict, expected) << round;
    ++verdicts[static_cast<std::size_t>(*found.verdict)];
    for (const Rung& rung : kRungs) {
      const auto known = conflict_at(rung, facet, ijk, w[rival]);
      EXPECT_TRUE(!known || *known == expected) << static_cast<int>(rung.stage);
    }
    EXPECT_EQ(conflict(facet, ijk, *ijk[1]).verdict, clockwise ? Conflict::no_vertex : Conflict::ties) << "the rival is one of the three";
  }
  for (const int count : verdicts) EXPECT_GT(count, 20);
}

/// Needles: a side far below the range of doubles' frames, where only longer numbers and algebra are asked.
TEST(NearTies, OutOfTheRangeOfDoubles) {
  const double e = 0x1p-300;
  for (const int corner : {1, 2, 3}) {
    FaceStrip strip(FaceCorners{SpacePoint{0, 0, 0}, SpacePoint{1, 0, 0}, SpacePoint{1, e, 0}}, FacePoint::corner(0));
    strip.cross(FaceCorners{SpacePoint{1, 0, 0}, SpacePoint{1, e, 0}, SpacePoint{2, corner * e, 0}});
    const Sign truth = corner == 1 ? Sign::negative : corner == 2 ? Sign::zero : Sign::positive;  // against the ray through (1, e)
    const Decision side = ray_side(strip, 2, 3);
    EXPECT_EQ(side.sign, MaybeSign(truth));
    EXPECT_TRUE(side.stage == Stage::mpfr || side.stage == Stage::algebra);
    for (const Stage stage : {Stage::filter, Stage::double_double}) EXPECT_FALSE(ray_side_at({stage}, strip, 2, 3));
    const Path path{0, {Leg(strip, FacePoint::corner(2))}}, two{2, {}};
    EXPECT_EQ(compare_lengths(path, two).sign, MaybeSign(Sign::positive)) << "longer than 2 by 2^-600 or so";
    EXPECT_EQ(compare_lengths_at({Stage::filter}, path, two), std::nullopt);
    const Enclosure length_of = length(path);
    EXPECT_LE(length_of.lower, 2);
    EXPECT_GE(length_of.upper, 2);
    EXPECT_LT(length_of.upper - length_of.lower, 1e-15);
    EXPECT_EQ(rounded_length(path).value, 2.0);
    const Window window{strip, {}, std::nullopt}, later{strip, {1, {}}, std::nullopt};
    const auto ties = ties_on_edge(window, later, {SpacePoint{1, 0, 0}, SpacePoint{2, corner * e, 0}});
    EXPECT_EQ(ties.kind, Kind::none);
    EXPECT_TRUE(ties.a_is_nearer);
  }
}

/// Strips that cross nothing: all corners are vertices, and a source at one of them is that vertex.
TEST(NearTies, RaysWithinOneFace) {
  for (const FacePoint& source : {FacePoint{{1, 1, 1}}, FacePoint{{1, 2, 5}}, FacePoint{{1, 1, 0}}, FacePoint::corner(1)}) {
    const FaceStrip strip(kFace, source);
    for (std::size_t through = 0; through < 3; ++through)
      for (std::size_t v = 0; v < 3; ++v) {
        const auto corner = [&](std::size_t k) { return PlanarPoint{mpq_class(kFace[k][0]), mpq_class(kFace[k][1])}; };
        const mpq_class sum = source.weight[0] + source.weight[1] + source.weight[2];
        const PlanarPoint image{mpq_class(kSide * source.weight[1] / sum), mpq_class(kSide * source.weight[2] / sum)};
        const auto truth = static_cast<Sign>(test::turn(image, corner(through), corner(v)));
        EXPECT_EQ(ray_side(strip, through, v).sign, MaybeSign(truth));
        for (const Rung& rung : kRungs) {
          const MaybeSign known = ray_side_at(rung, strip, through, v);
          EXPECT_TRUE(!known || *known == truth);
          if (rung.stage == Stage::algebra) {
            EXPECT_TRUE(known);
          }
        }
      }
    EXPECT_FALSE(ray_side_at({Stage::undecided}, strip, 0, 1));
  }
}

TEST(NearTies, StripsAreOneIfAllOfThemIs) {
  const SpacePoint beyond{9, 9, 0};
  const auto through = [&](std::size_t k, const FacePoint& source) {  // the side from corner k
    FaceStrip strip(kFace, source);
    strip.cross(FaceCorners{kFace[k], kFace[(k + 1) % 3], beyond});
    return strip;
  };
  const FacePoint middle{{1, 1, 1}};
  EXPECT_TRUE(through(1, middle) == through(1, {{2, 2, 2}}));
  EXPECT_FALSE(through(1, middle) == through(0, middle)) << "the same vertices, over another side";
  EXPECT_FALSE(through(1, middle) == through(1, {{1, 1, 2}}));
  EXPECT_FALSE(through(1, middle) == FaceStrip(kFace, middle));
  EXPECT_THROW(FaceStrip(FaceCorners{kTop, kTop, kTop}, middle), std::invalid_argument);
  EXPECT_THROW(ray_side(through(1, middle), 0, 1), std::invalid_argument) << "the corner that is left behind";
  EXPECT_EQ(ray_side(through(1, FacePoint::corner(0)), 0, 1).sign, MaybeSign(Sign::zero)) << "unless it is the source";
  for (const Rung& rung : kRungs) {
    const MaybeSign known = ray_side_at(rung, through(1, FacePoint::corner(0)), 1, 0);
    EXPECT_TRUE(!known || *known == Sign::zero);
  }
}

}  // namespace
}  // namespace gvd::predicates
