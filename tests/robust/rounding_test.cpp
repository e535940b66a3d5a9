#include "gvd/robust/rounding.hpp"
#include "gvd/robust/exact.hpp"

#include <gtest/gtest.h>

#include "gvd/robust/rational.hpp"
#include "robust/random_numbers.hpp"

namespace gvd::robust::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = std::numeric_limits<double>::max();

/// An independent reference: compares q exactly with the midpoints beside a candidate.
double nearest(const mpq_class& q) {
  if (sgn(q) < 0) return -nearest(-q);
  if (q >= power_of_two(1024) - power_of_two(970)) return kInfinity;
  double x = q.get_d();  // truncated
  const auto is_odd = [](double value) { return (std::bit_cast<std::uint64_t>(value) & 1) != 0; };
  const mpq_class gap = (x == kLargest ? power_of_two(1024) : mpq_class(std::nextafter(x, kInfinity))) - mpq_class(x);
  const int beyond = cmp(q - mpq_class(x), gap / 2);
  return beyond > 0 || (beyond == 0 && is_odd(x)) ? std::nextafter(x, kInfinity) : x;
}

template <class T>
class RoundingOf : public testing::Test {};
using Numbers = testing::Types<double, DoubleDouble, Mpfr>;
TYPED_TEST_SUITE(RoundingOf, Numbers);

TYPED_TEST(RoundingOf, RoundsOnlyIfBothEndsRoundAlike) {
  RandomNumbers random(31);
  int answered = 0, refused = 0;
  for (int i = 0; i < 20000; ++i) {
    Ball<TypeParam> x = random.template ball<TypeParam>();
    const double mid = Midpoint<TypeParam>::nearest(x.mid());
    if (random.chance(60))
      x = Ball<TypeParam>(x.mid(), std::fmin(std::ldexp(std::fabs(mid), -45 - static_cast<int>(random.below(80))), 0x1p900));
    const mpq_class low = to_mpq(x.mid()) - to_mpq(x.rad()), high = to_mpq(x.mid()) + to_mpq(x.rad());
    const std::optional<double> result = rounded(x);
    const bool alike = nearest(low) == nearest(high);
    if (result) {
      ++answered;
      ASSERT_TRUE(alike) << i;
      ASSERT_EQ(*result, nearest(low)) << i;
      ASSERT_FALSE(*result == 0 && std::signbit(*result));
    } else {
      ++refused;
      // It may refuse only a ball whose ends come close to a midpoint (or the ball is wide).
      const mpq_class slack =
          (abs(high) + abs(low)) * power_of_two(-100) + 2 * to_mpq(x.rad()) * power_of_two(-49) + power_of_two(-1073);
      ASSERT_TRUE(nearest(low - slack) != nearest(high + slack)) << i;
    }
  }
  EXPECT_GT(answered, 2000);
  EXPECT_GT(refused, 2000);
}

TYPED_TEST(RoundingOf, NothingKnownRoundsToNothing) {
  using B = Ball<TypeParam>;
  EXPECT_FALSE(rounded(B(TypeParam(1.0), kInfinity)));
  EXPECT_FALSE(rounded(B(TypeParam(1.0), std::numeric_limits<double>::quiet_NaN())));
  EXPECT_FALSE(rounded(B(1.0) / B(0.0)));
  EXPECT_FALSE(rounded(B(TypeParam(kInfinity), 0)));
  EXPECT_EQ(rounded(B(0.0)), 0.0);
  EXPECT_EQ(rounded(B(TypeParam(-0.0), 0x1p-1074)), std::nullopt);
}

TEST(Rounding, Midpoints) {
  const double half_ulp = 0x1p-53;
  EXPECT_EQ(rounded(Ball<DoubleDouble>({1, half_ulp}, 0)), 1.0) << "an exact tie goes to the even neighbour";
  EXPECT_EQ(rounded(Ball<DoubleDouble>(two_sum(1 + 2 * half_ulp, half_ulp), 0)), 1 + 4 * half_ulp);
  EXPECT_EQ(rounded(Ball<DoubleDouble>({1, half_ulp}, 0x1p-200)), std::nullopt);
  EXPECT_EQ(rounded(Ball<DoubleDouble>({1, half_ulp * (1 - 0x1p-40)}, 0x1p-100)), 1.0);
  EXPECT_EQ(rounded(Ball<DoubleDouble>({1, -half_ulp / 2 * (1 - 0x1p-40)}, 0x1p-100)), 1.0) << "the gap below 1 is half as wide";
  EXPECT_EQ(rounded(Ball<DoubleDouble>({1, -half_ulp / 2}, 0x1p-100)), std::nullopt);
  EXPECT_EQ(rounded(Ball<Mpfr>(Mpfr(1 + power_of_two(-53), 128), 0)), 1.0);
  EXPECT_EQ(rounded(Ball<Mpfr>(Mpfr(1 + power_of_two(-53), 128), 0x1p-300)), std::nullopt);
  EXPECT_EQ(rounded(Ball<Mpfr>(Mpfr(1 + power_of_two(-53) + power_of_two(-200), 256), 0x1p-300)), 1 + 0x1p-52);
}

TEST(Rounding, SubnormalsAndOverflow) {
  EXPECT_EQ(rounded(Ball<Mpfr>(Mpfr(power_of_two(-1075), 64), 0)), 0.0);
  EXPECT_EQ(rounded(Ball<Mpfr>(Mpfr(mpq_class(3) * power_of_two(-1076), 64), 0)), 0x1p-1074);
  const mpq_class last_tie = power_of_two(1024) - power_of_two(970);
  EXPECT_EQ(rounded(Ball<Mpfr>(Mpfr(last_tie, 128), 0)), kInfinity);
  EXPECT_EQ(rounded(Ball<Mpfr>(Mpfr(last_tie - power_of_two(900), 128), 1.0)), kLargest);
  EXPECT_EQ(rounding_midpoint_above(kLargest), last_tie);
  EXPECT_EQ(rounding_midpoint_above(0.0), power_of_two(-1075));
  EXPECT_EQ(rounding_midpoint_above(-0x1p-1074), -power_of_two(-1075));
  EXPECT_EQ(rounding_midpoint_above(1.0), 1 + power_of_two(-53));
}

// A midpoint that no enclosure shows to be one: the roots cancel.
TEST(Rounding, TiesOfNestedRootsGoToTheEvenDouble) {
  const Exact two = sqrt(Exact(2.0)), nested = sqrt(Exact(1.0) + two), half_ulp(0x1p-53);
  for (const Exact& one : {sqrt(Exact(3.0) + two.scaled(1)) - two, (nested + Exact(2.0)) * (nested - Exact(2.0)) - two + Exact(4.0)}) {
    EXPECT_EQ(rounded(one + half_ulp), 1.0);
    EXPECT_EQ(rounded(one + half_ulp * Exact(3.0)), 1 + 0x1p-51);
    EXPECT_EQ(rounded(-one - half_ulp), -1.0);
  }
}

}  // namespace
}  // namespace gvd::robust::test
