#include "gvd/robust/ball.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "gvd/robust/rational.hpp"
#include "robust/random_numbers.hpp"

// Every enclosure is checked by containment of exact rational recomputations, at the ends of the operands and inside.

namespace gvd::robust::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class T>
class BallOf : public testing::Test {
 protected:
  static constexpr int kRounds = std::is_same_v<T, Mpfr> ? 6000 : 20000;
  RandomNumbers random{20230217};

  /// The ends, the midpoint and a random member of a finite ball.
  std::vector<mpq_class> members(const Ball<T>& ball) {
    const mpq_class mid = to_mpq(ball.mid()), rad = to_mpq(ball.rad());
    if (sgn(rad) == 0) return {mid};
    const mpq_class share(static_cast<unsigned long>(random.below(1u << 30)), 1u << 30);
    return {mid - rad, mid, mid + rad, mid + (2 * share - 1) * rad};
  }

  template <class Rounded, class Truth>
  void check_pairs(const Rounded& rounded, const Truth& truth) {
    int known = 0;
    for (int i = 0; i < kRounds; ++i) {
      const Ball<T> a = random.ball<T>(), b = related(a);
      const Ball<T> result = rounded(a, b);
      ASSERT_FALSE(result.rad() < 0);
      if (!result.is_finite()) continue;
      ++known;
      for (const auto& x : members(a))
        for (const auto& y : members(b)) {
          const auto value = truth(x, y);
          ASSERT_TRUE(value) << i << ": undefined for a member, yet the result is known";
          ASSERT_TRUE(contains(result, *value)) << i << ": " << Midpoint<T>::nearest(a.mid()) << " +- " << a.rad() << ", "
                                                << Midpoint<T>::nearest(b.mid()) << " +- " << b.rad();
        }
    }
    EXPECT_GT(known, kRounds / 2) << "the test must not pass by knowing nothing";
  }

  /// Unrelated, or nearly cancelling, or the same.
  Ball<T> related(const Ball<T>& a) {
    if (random.chance(70)) return random.ball<T>();
    const T factor = T(1 + std::ldexp(1.0, -static_cast<int>(random.below(60))));
    Ball<T> b(a.mid() * factor, a.rad());
    return random.chance(50) ? b : -b;
  }
};

using Numbers = testing::Types<double, DoubleDouble, Mpfr>;
TYPED_TEST_SUITE(BallOf, Numbers);

using Truth = std::optional<mpq_class>;

TYPED_TEST(BallOf, SumsContainTheTruth) {
  this->check_pairs([](const auto& a, const auto& b) { return a + b; },
                    [](const mpq_class& x, const mpq_class& y) { return Truth(x + y); });
}

TYPED_TEST(BallOf, DifferencesContainTheTruth) {
  this->check_pairs([](const auto& a, const auto& b) { return a - b; },
                    [](const mpq_class& x, const mpq_class& y) { return Truth(x - y); });
}

TYPED_TEST(BallOf, ProductsContainTheTruth) {
  this->check_pairs([](const auto& a, const auto& b) { return a * b; },
                    [](const mpq_class& x, const mpq_class& y) { return Truth(x * y); });
}

TYPED_TEST(BallOf, QuotientsContainTheTruth) {
  this->check_pairs([](const auto& a, const auto& b) { return a / b; },
                    [](const mpq_class& x, const mpq_class& y) { return sgn(y) == 0 ? Truth() : Truth(x / y); });
}

TYPED_TEST(BallOf, ProductsWithAnExactDoubleContainTheTruth) {
  for (int i = 0; i < this->kRounds; ++i) {
    const Ball<TypeParam> a = this->random.template ball<TypeParam>();
    const double factor = this->random.mixed();
    const auto left = factor * a, right = a * factor;
    for (const auto& x : this->members(a)) {
      ASSERT_TRUE(contains(left, x * mpq_class(factor))) << i;
      ASSERT_TRUE(contains(right, x * mpq_class(factor))) << i;
    }
    const int k = static_cast<int>(this->random.below(600)) - 300;
    const auto scaled = a.scaled(k);
    for (const auto& x : this->members(a)) ASSERT_TRUE(contains(scaled, x * power_of_two(k))) << i;
  }
}

/// Powers of two that no double is.
TYPED_TEST(BallOf, ScaledBeyondTheRangeOfDouble) {
  using B = Ball<TypeParam>;
  for (const int k : {1030, 1100, 2000}) {
    EXPECT_TRUE(contains(B(TypeParam(0x1p-1000), 0x1p-1040).scaled(k), power_of_two(k - 1000)) || !B(0x1p-1000).scaled(k).is_finite());
    EXPECT_TRUE(contains(B(TypeParam(0x1p1000), 0x1p960).scaled(-k), power_of_two(1000 - k)));
    EXPECT_EQ(maybe_sign(B(0.0).scaled(k)), Sign::zero);
    EXPECT_EQ(maybe_sign(B(0.0).scaled(-k)), Sign::zero);
  }
  EXPECT_TRUE(contains(B(TypeParam(0x1p-1000), 0).scaled(1030), power_of_two(30)));
}

TYPED_TEST(BallOf, RootsContainTheRootsOfTheNonNegativePart) {
  int known = 0;
  for (int i = 0; i < this->kRounds; ++i) {
    const Ball<TypeParam> a = this->random.template ball<TypeParam>();
    const auto root = sqrt(a);
    bool has_non_negative = false;
    if (root.is_finite()) {
      ++known;
      const mpq_class low = to_mpq(root.mid()) - to_mpq(root.rad()), high = to_mpq(root.mid()) + to_mpq(root.rad());
      for (const auto& x : this->members(a)) {
        if (sgn(x) < 0) continue;
        has_non_negative = true;
        ASSERT_TRUE(sgn(high) >= 0 && high * high >= x) << i;
        ASSERT_TRUE(sgn(low) <= 0 || low * low <= x)
            << i << ": " << std::hexfloat << Midpoint<TypeParam>::nearest(a.mid()) << " +- " << a.rad();
      }
      ASSERT_TRUE(has_non_negative) << i << ": the root of a negative ball is undefined";
    }
  }
  EXPECT_GT(known, this->kRounds / 3);
}

TYPED_TEST(BallOf, NegationAndAbsoluteValueLoseNothing) {
  for (int i = 0; i < 2000; ++i) {
    const Ball<TypeParam> a = this->random.template ball<TypeParam>();
    const auto negative = -a, magnitude = abs(a);
    EXPECT_EQ(negative.rad(), a.rad());
    EXPECT_EQ(magnitude.rad(), a.rad());
    for (const auto& x : this->members(a)) {
      ASSERT_TRUE(contains(negative, -x));
      ASSERT_TRUE(contains(magnitude, abs(x)));
    }
  }
}

TYPED_TEST(BallOf, EndsAreRoundedOutwardByAtMostAnUlp) {
  for (int i = 0; i < this->kRounds; ++i) {
    const Ball<TypeParam> a = this->random.template ball<TypeParam>();
    if (!a.is_finite()) continue;
    const mpq_class low = to_mpq(a.mid()) - to_mpq(a.rad()), high = to_mpq(a.mid()) + to_mpq(a.rad());
    ASSERT_LE(a.lower(), a.upper());
    if (std::isfinite(a.lower())) {
      ASSERT_LE(mpq_class(a.lower()), low) << i;
      const double inner = std::nextafter(std::nextafter(a.lower(), kInfinity), kInfinity);
      if (std::isfinite(inner)) {
        ASSERT_GE(mpq_class(inner), low) << i;
      }
    }
    if (std::isfinite(a.upper())) {
      ASSERT_GE(mpq_class(a.upper()), high) << i;
      const double inner = std::nextafter(std::nextafter(a.upper(), -kInfinity), -kInfinity);
      if (std::isfinite(inner)) {
        ASSERT_LE(mpq_class(inner), high) << i;
      }
    }
    const Ball<double> narrow = narrowed(a);
    ASSERT_TRUE(contains(narrow, low) && contains(narrow, high)) << i;
  }
}

TYPED_TEST(BallOf, SignsAreThoseOfEveryMember) {
  int decided = 0;
  for (int i = 0; i < this->kRounds; ++i) {
    const Ball<TypeParam> a = this->random.template ball<TypeParam>();
    const MaybeSign sign = maybe_sign(a);
    bool all_alike = true;
    for (const auto& x : this->members(a)) {
      if (sign) {
        ASSERT_EQ(static_cast<int>(*sign), sgn(x)) << i;
      }
      all_alike = all_alike && sgn(x) == sgn(this->members(a)[0]);
    }
    decided += sign.has_value();
    EXPECT_EQ(sign.has_value(), all_alike) << i;
  }
  EXPECT_GT(decided, this->kRounds / 2);
}

TYPED_TEST(BallOf, StructuralZerosStayExact) {
  using B = Ball<TypeParam>;
  const auto is_exact_zero = [](const B& x) { return maybe_sign(x) == Sign::zero; };
  for (int i = 0; i < 2000; ++i) {
    const B a = this->random.template ball<TypeParam>(), zero = 0.0;
    if (!a.is_finite()) continue;
    EXPECT_TRUE(is_exact_zero(zero * a));
    EXPECT_TRUE(is_exact_zero(a * zero));
    EXPECT_TRUE(is_exact_zero(a * 0.0));
    EXPECT_TRUE(is_exact_zero(sqrt(zero)));
    EXPECT_TRUE(is_exact_zero(zero.scaled(-1000)));
    const bool certainly_not_zero = a.rad() < 0.5 * Midpoint<TypeParam>::least_magnitude(a.mid());
    if (certainly_not_zero) {
      EXPECT_TRUE(is_exact_zero(zero / a));
    }
    const B exact(a.mid(), 0);
    EXPECT_EQ((exact + zero).rad(), 0);
    EXPECT_EQ((zero + exact).rad(), 0);
    EXPECT_EQ((exact - zero).rad(), 0);
    EXPECT_TRUE(is_exact_zero(exact - exact));
    if (!Midpoint<TypeParam>::is_zero(a.mid())) {
      EXPECT_TRUE(is_exact_zero(zero / exact));
    }
  }
}

TYPED_TEST(BallOf, NothingIsDecidedFromTheUndefined) {
  using B = Ball<TypeParam>;
  const B straddling(TypeParam(1.0), 2.0), zero = 0.0, one = 1.0;
  const std::vector<B> undefined = {one / straddling,
                                    one / zero,
                                    zero / zero,
                                    zero / straddling,
                                    sqrt(B(-1.0)),
                                    sqrt(B(TypeParam(-4.0), 1)),
                                    B(kInfinity),
                                    B(kNaN),
                                    B(TypeParam(1.0), kNaN),
                                    B(TypeParam(1.0), kInfinity),
                                    one / B(kInfinity),
                                    B(1.0) * kInfinity,
                                    zero * kInfinity,
                                    B(0x1p1000).scaled(1000)};
  for (const B& x : undefined) {
    for (const B& y : {x, x + one, one - x, x * zero, zero * x, x * x, x * 2.0, x * 0.0, one / x, x / one, sqrt(x), abs(x), -x,
                       square(x), x - x, x.scaled(-30), zero / x, sqrt(square(x)), one / (one / x)}) {
      EXPECT_FALSE(maybe_sign(y)) << (&x - undefined.data());
      EXPECT_FALSE(y.is_finite()) << (&x - undefined.data());
      EXPECT_EQ(y.lower(), -kInfinity);
      EXPECT_EQ(y.upper(), kInfinity);
      EXPECT_FALSE(maybe_sign(narrowed(y)));
    }
  }
}

TYPED_TEST(BallOf, OverflowIsNotDecided) {
  if (std::is_same_v<TypeParam, Mpfr>) return;  // does not overflow
  using B = Ball<TypeParam>;
  const B huge = std::numeric_limits<double>::max();
  for (const B& x : {huge + huge, -huge - huge, huge * huge, huge / B(0x1p-1000), square(huge), huge * 2.0}) {
    EXPECT_FALSE(x.is_finite());
    EXPECT_FALSE(maybe_sign(x));
    EXPECT_FALSE(maybe_sign(x - huge));
  }
}

TYPED_TEST(BallOf, RadiiAreNotMuchLargerThanNeeded) {
  using B = Ball<TypeParam>;
  const double u = std::is_same_v<TypeParam, DoubleDouble> ? 0x1p-100 : 0x1p-53;  // the Mpfr numbers here have 53 bits
  for (int i = 0; i < this->kRounds / 10; ++i) {
    const TypeParam x(this->random.between(-40, 40)), y(this->random.between(-40, 40));
    const B a(x, 0), b(y, 0);
    for (const B& z : {a + b, a * b, a / b, sqrt(abs(a))}) EXPECT_LE(z.rad(), 2 * u * Midpoint<TypeParam>::magnitude(z.mid())) << i;
    const double r = 0x1p-30 * Midpoint<TypeParam>::magnitude(x), s = 0x1p-25 * Midpoint<TypeParam>::magnitude(y);
    const B c(x, r), d(y, s);
    EXPECT_LE((c + d).rad(), 1.001 * (r + s));
    EXPECT_LE((c * d).rad(), 1.001 * (0x1p-30 + 0x1p-25) * Midpoint<TypeParam>::magnitude((c * d).mid()));
    EXPECT_LE((c / d).rad(), 1.001 * (0x1p-30 + 0x1p-25) * Midpoint<TypeParam>::magnitude((c / d).mid()));
    EXPECT_LE(sqrt(abs(c)).rad(), 1.03 * 0x1p-31 * Midpoint<TypeParam>::magnitude(sqrt(abs(c)).mid()));
  }
}

// A long chain of dependent operations against rationals: what is lost in one step must be kept by all later ones.
TYPED_TEST(BallOf, ChainsContainTheTruth) {
  using B = Ball<TypeParam>;
  for (int round = 0; round < 300; ++round) {
    mpq_class truth(this->random.between(-5, 5));
    B x = from<B>(truth, 128);
    for (int step = 0; step < 20; ++step) {
      const double y = std::ldexp(std::round(this->random.between(0, 30)), -20);
      switch (this->random.below(5)) {
        case 0:
          x = x + y, truth += mpq_class(y);
          break;
        case 1:
          x = y - x, truth = mpq_class(y) - truth;
          break;
        case 2:
          x = x * y, truth *= mpq_class(y);
          break;
        case 3:
          x = x / y, truth /= mpq_class(y);
          break;
        default:
          if (sgn(truth) == 0 || !maybe_sign(x)) break;
          x = y / x, truth = mpq_class(y) / truth;
      }
      ASSERT_TRUE(contains(x, truth)) << round << ", " << step;
    }
  }
}

TYPED_TEST(BallOf, RationalsAreEnclosedAndExactWhereTheyFit) {
  using B = Ball<TypeParam>;
  EXPECT_EQ(from<B>(mpq_class(3, 8), 64).rad(), 0);
  EXPECT_EQ(maybe_sign(from<B>(mpq_class(0), 64)), Sign::zero);
  for (int i = 0; i < this->kRounds / 10; ++i) {
    const double numerator = this->random.any(), denominator = this->random.any();
    if (denominator == 0) continue;
    const mpq_class q = mpq_class(numerator) / mpq_class(denominator);
    ASSERT_TRUE(contains(from<B>(q, 100), q)) << i;
    ASSERT_TRUE(contains(from<B>(mpq_class(numerator), 53), mpq_class(numerator))) << i;
    if (!std::is_same_v<TypeParam, Mpfr>) {
      EXPECT_EQ(from<B>(mpq_class(numerator)).rad(), 0) << i;
    }
  }
}

TEST(Ball, SumsOfDoublesThatAreDoublesAreExact) {
  EXPECT_EQ(maybe_sign(Ball<double>(0.5) + 0.25 - 0.75), Sign::zero);
  EXPECT_GT((Ball<double>(1.0) + 0x1p-60).rad(), 0);
}

TEST(Ball, ExactResultsOfMpfrAreRecognised) {
  const auto three = from_double<Ball<Mpfr>>(3.0, 128);
  EXPECT_EQ(maybe_sign(sqrt(three * three) - 3.0), Sign::zero);
  EXPECT_EQ(maybe_sign(three / 2.0 - 1.5), Sign::zero);
  EXPECT_FALSE(maybe_sign(1.0 / three * 3.0 - 1.0));
}

TEST(Ball, MpfrTakesTheLargerPrecision) {
  const auto third = from<Ball<Mpfr>>(mpq_class(1, 3), 512);
  EXPECT_EQ((third * 2.0).mid().bits(), 512);
  EXPECT_EQ((1.0 + third).mid().bits(), 512);
  EXPECT_LT((third + 1.0).rad(), 0x1p-510);
}

TEST(Ball, MpfrNarrowsToDoubleDouble) {
  RandomNumbers random(7);
  for (int i = 0; i < 20000; ++i) {
    const Ball<Mpfr> a = random.ball<Mpfr>();
    const Ball<DoubleDouble> b = to_double_double(a);
    if (!a.is_finite() || !b.is_finite()) continue;
    ASSERT_EQ(b.mid().hi, b.mid().hi + b.mid().lo);
    ASSERT_TRUE(contains(b, to_mpq(a.mid()) + to_mpq(a.rad())) && contains(b, to_mpq(a.mid()) - to_mpq(a.rad())));
  }
}

// docs/error-bounds.md#radii: the inflation makes up for 13 roundings, and the literals of the root hold.
TEST(Ball, LiteralsFollowFromTheirDerivations) {
  const mpq_class u = power_of_two(-53);
  mpq_class shrunk = mpq_class(kRadiusInflation);
  for (int i = 0; i < 13; ++i) shrunk *= 1 - u;
  EXPECT_GT(shrunk, 1);
  // 1 / (1 + sqrt(15/16)) < 0.51, with one rounding of the product and one of the quotient to spare
  const mpq_class share = mpq_class(0.51) * (1 - 4 * u);
  const mpq_class other = 1 / share - 1;
  EXPECT_LT(other * other, mpq_class(15, 16));
}

TEST(Ball, MagnitudesOfDoubleDoublesAreBounds) {
  RandomNumbers random(11);
  for (int i = 0; i < 100000; ++i) {
    const DoubleDouble x = random.double_double();
    const mpq_class truth = abs(to_mpq(x));
    ASSERT_LE(mpq_class(Midpoint<DoubleDouble>::least_magnitude(x)), truth) << i;
    const double most = Midpoint<DoubleDouble>::magnitude(x);
    if (std::isfinite(most)) {
      ASSERT_GE(mpq_class(most), truth) << i;
    }
  }
}

}  // namespace
}  // namespace gvd::robust::test
