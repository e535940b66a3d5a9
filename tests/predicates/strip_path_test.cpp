#include "gvd/predicates/strip_path.hpp"

#include <gtest/gtest.h>

#include <map>

#include "gvd/robust/rational.hpp"
#include "support/planar_strips.hpp"

namespace gvd::predicates {
namespace {

using robust::MaybeSign;
using robust::RootSum;
using robust::Sign;
using robust::Stage;
using test::FoldedStrip;
using test::PlanarPoint;
using test::Random;

/// A leg, the same way back, and the true length of both.
struct KnownLeg {
  Leg leg, back;
  RootSum length;
};
KnownLeg known_leg(Random& random, int scale = 0) {
  const FoldedStrip folded = test::random_strip(random.below(9), random);
  const FacePoint end = random.below(2) == 0 ? FacePoint::corner(2) : FacePoint{test::random_weights(random)};
  const PlanarPoint p = test::planar_point(folded.faces.back(), end.weight);
  const mpq_class squared = test::squared_distance(folded.image, p) * robust::power_of_two(2 * scale);
  FaceStrip back(test::in_space(folded.faces.back(), 0, scale), end);
  for (std::size_t i = folded.faces.size() - 1; i-- > 0;) back.cross(test::in_space(folded.faces[i], 0, scale));
  return {Leg(folded.described(0, scale), end), Leg(back, folded.source), RootSum(1, squared)};
}

struct KnownPath {
  Path path;
  RootSum length;
};
KnownPath known_path(Random& random, int scale = 0) {
  KnownPath known;
  if (random.below(2) == 0) known.path.given = mpq_class(static_cast<int>(random.below(16)), 4) * robust::power_of_two(scale);
  known.length = RootSum(known.path.given);
  for (std::uint32_t i = 0, n = 1 + random.below(2); i < n; ++i) {
    KnownLeg leg = known_leg(random, scale);
    known.path.legs.push_back(std::move(leg.leg));
    known.length += leg.length;
  }
  return known;
}

// A straight line is as long from its end as from its source, through the same faces the other way round.
TEST(CompareLengths, TheWayBackIsAsLong) {
  Random random(5);
  for (int round = 0; round < 200; ++round) {
    const KnownLeg leg = known_leg(random);
    const Decision tie = compare_lengths({0, {leg.leg}}, {0, {leg.back}});
    ASSERT_EQ(tie.sign, Sign::zero) << round;
    ASSERT_TRUE(tie.stage == Stage::algebra || tie.stage == Stage::identity);
    const mpq_class ulp = robust::power_of_two(-52 - static_cast<int>(random.below(1500)));
    ASSERT_EQ(compare_lengths({ulp, {leg.leg}}, {0, {leg.back}}).sign, Sign::positive) << round;
    ASSERT_EQ(compare_lengths({0, {leg.leg}}, {ulp, {leg.back}}).sign, Sign::negative) << round;
  }
}

TEST(CompareLengths, AgreesWithTheFlatPlaneAtEveryRung) {
  Random random(3);
  std::map<Stage, int> decided;
  for (int round = 0; round < 600; ++round) {
    const int scale = round % 5 == 0 ? 950 : round % 5 == 1 ? -990 : 0;
    const KnownPath a = known_path(random, scale), b = round % 7 == 0 ? a : known_path(random, scale);
    const Sign truth = compare(a.length, b.length);
    for (const Rung& rung : kRungs) {
      const MaybeSign sign = compare_lengths_at(rung, a.path, b.path);
      ASSERT_EQ(sign.value_or(truth), truth) << "round " << round << ", stage " << static_cast<int>(rung.stage);
      ASSERT_TRUE(sign.has_value() || rung.stage != Stage::algebra);
    }
    const Decision d = compare_lengths(a.path, b.path), swapped = compare_lengths(b.path, a.path);
    ASSERT_EQ(d.sign, truth);
    ASSERT_EQ(swapped.sign, -truth);
    ASSERT_EQ(swapped.stage, d.stage);
    ++decided[d.stage];
  }
  EXPECT_GT(decided[Stage::identity], 50);
  EXPECT_GT(decided[Stage::filter], 300);
}

// Two ways to the same corner of a flat square, and a tie but for a given part.
TEST(CompareLengths, DifferencesOfAnySizeAreFound) {
  const FaceCorners first{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}}, second{{{3, 0, 0}, {3, 3, 0}, {0, 3, 0}}};
  FaceStrip strip(first, FacePoint::corner(0));
  strip.cross(second);
  const Leg diagonal(strip, FacePoint::corner(1));                                           // 3 sqrt 2
  const Leg half(FaceStrip(first, FacePoint::corner(0)), FacePoint::on_side(1, mpq_class(1, 2)));  // 3/2 sqrt 2
  std::map<Stage, int> decided;
  for (int k = 0; k < 1200; k += 13) {
    const mpq_class step = robust::power_of_two(-k);
    const Decision d = compare_lengths({step, {diagonal}}, {0, {half, half}});
    EXPECT_EQ(d.sign, Sign::positive) << k;
    ++decided[d.stage];
  }
  for (const Stage stage : {Stage::filter, Stage::double_double, Stage::mpfr, Stage::algebra}) EXPECT_GT(decided[stage], 0);
  const Decision tie = compare_lengths({0, {diagonal}}, {0, {half, half}});
  EXPECT_EQ(tie.sign, Sign::zero);
  EXPECT_EQ(tie.stage, Stage::algebra);
  EXPECT_EQ(compare_lengths({1, {diagonal, half}}, {1, {half, diagonal}}).stage, Stage::identity);
}

// Lengths about the smallest doubles, far apart as numbers go, but by less than the radius of a ball could say in their own units.
TEST(CompareLengths, MpfrTellsTinyLengthsApart) {
  const double unit = 0x1p-950;
  const FaceCorners face{{{0, 0, 0}, {unit, 0, 0}, {0, unit, 0}}};
  const auto along = [&](const mpq_class& t) { return Path{0, {Leg(FaceStrip(face, FacePoint::corner(0)), FacePoint::on_side(0, t))}}; };
  const Path longer = along(mpq_class(2, 3)), shorter = along(mpq_class(2, 3) - robust::power_of_two(-300));
  EXPECT_EQ(compare_lengths_at({Stage::mpfr, 512}, longer, shorter), Sign::positive);
  EXPECT_EQ(compare_lengths_at({Stage::mpfr, 512}, shorter, longer), Sign::negative);
  EXPECT_EQ(compare_lengths_at({Stage::mpfr, 256}, longer, shorter), std::nullopt);
}

TEST(Length, EnclosesAndRoundsTheTruth) {
  Random random(4);
  std::map<Stage, int> decided;
  for (int round = 0; round < 400; ++round) {
    const KnownPath a = known_path(random, round % 3 == 0 ? 900 : 0);
    const Enclosure e = length(a.path);
    EXPECT_NE(compare(a.length, RootSum(robust::exact_rational(e.lower))), Sign::negative);
    EXPECT_NE(compare(a.length, RootSum(robust::exact_rational(e.upper))), Sign::positive);
    if (!a.length.is_zero()) {
      EXPECT_LE(e.upper, std::nextafter(std::nextafter(e.lower, HUGE_VAL), HUGE_VAL));
    }
    const RoundedLength rounded = rounded_length(a.path);
    EXPECT_EQ(rounded.value, a.length.rounded()) << round;
    ++decided[rounded.stage];
  }
  EXPECT_GT(decided[Stage::double_double], 100);
  // Exactly between two doubles: to the even one, by algebra.
  const Leg five(FaceStrip({{{0, 0, 0}, {3, 4, 0}, {0, 4, 0}}}, FacePoint::corner(0)), FacePoint::corner(1));
  const RoundedLength midpoint = rounded_length({robust::power_of_two(-51), {five}});
  EXPECT_EQ(midpoint.value, 5);
  EXPECT_EQ(midpoint.stage, Stage::algebra);
}

// A face too thin for doubles in either path: numbers of any length tell all the same.
TEST(CompareLengths, AFaceOutOfRangeInEitherPath) {
  const double thin = 0x1p-300;
  const Leg plain(FaceStrip({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, FacePoint::corner(0)), FacePoint::corner(1));
  const Leg sliver(FaceStrip({{{0, 0, 0}, {1, 0, 0}, {1, thin, 0}}}, FacePoint::corner(0)), FacePoint::corner(2));  // longer by 2^-601
  const Path one{0, {plain}}, other{0, {sliver}};
  EXPECT_EQ(compare_lengths_at({Stage::filter}, {1, {plain}}, {0, {sliver}}), std::nullopt);
  EXPECT_EQ(compare_lengths_at({Stage::double_double}, {0, {sliver}}, {1, {plain}}), std::nullopt);
  EXPECT_EQ(compare_lengths(one, other).sign, Sign::negative);
  EXPECT_EQ(compare_lengths(other, one).sign, Sign::positive);
  EXPECT_EQ(compare_lengths({1, {plain}}, other).sign, Sign::positive);
  EXPECT_EQ(compare_lengths({1, {plain}}, other).stage, Stage::mpfr);
}

TEST(Length, BeyondTheGreatestDouble) {
  const Enclosure e = length({robust::power_of_two(1100), {}});
  EXPECT_LE(e.lower, std::numeric_limits<double>::max());
  EXPECT_EQ(e.upper, HUGE_VAL);
}

TEST(CompareLengths, WithoutLegsOnOneSide) {
  const Leg five(FaceStrip({{{0, 0, 0}, {3, 4, 0}, {0, 4, 0}}}, FacePoint::corner(0)), FacePoint::corner(1));
  EXPECT_EQ(compare_lengths({5, {}}, {0, {five}}).sign, Sign::zero);
  EXPECT_EQ(compare_lengths({0, {five}}, {5, {}}).sign, Sign::zero);
  EXPECT_EQ(compare_lengths({6, {}}, {0, {five}}).sign, Sign::positive);
  EXPECT_EQ(compare_lengths({0, {five}}, {6, {}}).sign, Sign::negative);
  EXPECT_EQ(compare_lengths({6, {}}, {5, {}}).stage, Stage::identity);
}

}  // namespace
}  // namespace gvd::predicates
