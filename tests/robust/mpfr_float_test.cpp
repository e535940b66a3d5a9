#include "gvd/robust/mpfr_float.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "gvd/robust/rational.hpp"
#include "robust/random_numbers.hpp"

namespace gvd::robust::test {
namespace {

void expect_at_most(const mpq_class& lost, double bound) {
  if (std::isfinite(bound)) {
    EXPECT_LE(lost, mpq_class(bound));
  }
}

TEST(Mpfr, ResultsHaveTheLargerPrecisionAndAreNearest) {
  RandomNumbers random(1);
  for (int i = 0; i < 5000; ++i) {
    const Mpfr a = random.mpfr(), b = random.mpfr();
    int ternary;
    const Mpfr sum = Mpfr::add(a, b, ternary);
    ASSERT_EQ(sum.bits(), std::max(a.bits(), b.bits()));
    const mpq_class lost = to_mpq(sum) - (to_mpq(a) + to_mpq(b));
    ASSERT_EQ(sgn(lost), ternary > 0 ? 1 : ternary < 0 ? -1 : 0);
    expect_at_most(abs(lost), sum.rounding_error(ternary));
    if (b.is_zero()) continue;
    const Mpfr quotient = Mpfr::divide(a, b, ternary);
    expect_at_most(abs(to_mpq(quotient) - to_mpq(a) / to_mpq(b)), quotient.rounding_error(ternary));
  }
}

TEST(Mpfr, RoundingErrorsBeyondTheRangeOfDoubleAreRoundedUp) {
  int ternary;
  const Mpfr small = Mpfr(mpq_class(mpq_class(1, 3) * power_of_two(-2000)), 64, &ternary);
  EXPECT_EQ(small.rounding_error(ternary), 0x1p-1074);
  EXPECT_EQ(small.rounding_error(0), 0);
  const Mpfr large = Mpfr(mpq_class(mpq_class(1, 3) * power_of_two(3000)), 64, &ternary);
  EXPECT_EQ(large.rounding_error(ternary), std::numeric_limits<double>::infinity());
  const Mpfr tiny = Mpfr(1.0).scaled(-1000000000);  // its square is below the range of MPFR
  const Mpfr square = Mpfr::multiply(tiny, tiny, ternary);
  EXPECT_TRUE(square.is_zero());
  EXPECT_NE(ternary, 0);
  EXPECT_EQ(square.rounding_error(ternary), 0x1p-1074);
}

TEST(Mpfr, ToDoubleIsNearestAlsoForSubnormals) {
  EXPECT_EQ(Mpfr(power_of_two(-1075), 64).to_double(), 0);
  EXPECT_EQ(Mpfr(power_of_two(-1075) * mpq_class(4097, 4096), 64).to_double(), 0x1p-1074);
  EXPECT_EQ(Mpfr(mpq_class(3) * power_of_two(-1075), 64).to_double(), 0x1p-1073);
  EXPECT_EQ(Mpfr(1 + power_of_two(-53), 64).to_double(), 1);
  EXPECT_EQ(Mpfr(1 + power_of_two(-53) + power_of_two(-100), 128).to_double(), 1 + 0x1p-52);
}

TEST(Mpfr, MovesCopiesAndAssignments) {
  Mpfr a(mpq_class(1, 3), 200);
  const Mpfr copy = a;
  Mpfr b = std::move(a);
  EXPECT_EQ(b, copy);
  EXPECT_EQ(b.bits(), 200);
  a = copy;  // a moved-from number may be assigned to
  EXPECT_EQ(a, b);
  Mpfr c;
  c = std::move(b);
  EXPECT_EQ(c, copy);
  c = *&c;
  EXPECT_EQ(c, copy);
  std::vector<Mpfr> many(3, copy);
  many.resize(100, Mpfr(2.0));
  EXPECT_EQ(many[2], copy);
  EXPECT_EQ(many[99].to_double(), 2.0);
}

TEST(Mpfr, MagnitudeAgainstADouble) {
  const double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();
  const Mpfr above(-(1 + power_of_two(-90)), 128);
  EXPECT_TRUE(above.magnitude_exceeds(1));
  EXPECT_FALSE(Mpfr(-1.0).magnitude_exceeds(1));
  EXPECT_FALSE(above.magnitude_exceeds(kInfinity));
  EXPECT_FALSE(above.magnitude_exceeds(kNaN));
  EXPECT_FALSE(Mpfr(kNaN).magnitude_exceeds(0));
  EXPECT_EQ(above.sign(), -1) << "asking must not change the number";
  EXPECT_EQ(Mpfr(kNaN).sign(), 0);
}

TEST(Mpfr, DistinctNumbersBelongToDistinctThreads) {
  const Mpfr two(2.0, 500);
  const Mpfr expected = sqrt(two);
  std::vector<std::thread> threads;
  std::vector<Mpfr> results(4);
  for (std::size_t t = 0; t < results.size(); ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 1000; ++i) results[t] = sqrt(two);
    });
  for (auto& thread : threads) thread.join();
  for (const Mpfr& result : results) EXPECT_EQ(result, expected);
}

}  // namespace
}  // namespace gvd::robust::test
