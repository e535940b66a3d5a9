#include "gvd/robust/root_sum.hpp"

#include <CGAL/CORE_Expr.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "gvd/robust/rational.hpp"
#include "robust/random_numbers.hpp"

namespace gvd::robust::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RootSum root(const mpq_class& r) { return RootSum(1, r); }

// All 64 symbols agree, and yet the classes differ.
TEST(RootSum, EqualSymbolsAreNoProof) {
  mpz_class product = 8;
  for (const std::uint64_t p : signature_primes()) product *= mpz_class(p);
  const mpz_class n = product + 1;
  ASSERT_EQ(square_class_signature(mpq_class(2 * n)), square_class_signature(2));
  ASSERT_FALSE(same_square_class(mpq_class(2 * n), 2));
  const RootSum sum = root(mpq_class(2 * n)) - root(2) * mpq_class(sqrt(n));
  EXPECT_EQ(sum.terms().size(), 2u);
  EXPECT_EQ(sum.sign(), Sign::positive);
}

TEST(RootSum, KnownZeros) {
  EXPECT_EQ(RootSum().sign(), Sign::zero);
  EXPECT_EQ(((root(2) + root(3)) - (root(2) + root(3))).sign(), Sign::zero);
  EXPECT_EQ((root(8) - 2 * root(2)).sign(), Sign::zero);
  EXPECT_EQ((root(2) + root(8) - root(18)).sign(), Sign::zero);
  EXPECT_EQ((root(mpq_class(1, 2)) - mpq_class(1, 2) * root(2)).sign(), Sign::zero);
  EXPECT_EQ((root(mpq_class(9, 4)) - RootSum(mpq_class(3, 2))).sign(), Sign::zero);
  EXPECT_EQ((root(12) + root(27) - root(75)).sign(), Sign::zero);
  EXPECT_EQ((root(0) * 5).sign(), Sign::zero);
  RootSum twice = root(5) + root(7);
  twice += twice;
  EXPECT_EQ(compare(twice, root(20) + root(28)), Sign::zero);
  twice -= twice;
  EXPECT_TRUE(twice.is_zero());
}

TEST(RootSum, NearZerosAreNotZeros) {
  // sqrt(n) + sqrt(n + 2) against 2 sqrt(n + 1): a difference of about n^(-3/2) / 4.
  for (unsigned digits = 1; digits <= 300; digits += 13) {
    mpz_class n;
    mpz_ui_pow_ui(n.get_mpz_t(), 10, digits);
    EXPECT_EQ((root(mpq_class(n)) + root(mpq_class(n + 2)) - 2 * root(mpq_class(n + 1))).sign(), Sign::negative) << digits;
  }
  // 8.9281987 against 8.9282032
  EXPECT_EQ(compare(root(5) + root(6) + root(18), root(4) + root(12) + root(12)), Sign::negative);
  // Beyond the range of double.
  const mpq_class tiny = power_of_two(-3000);
  EXPECT_EQ((root(2 + tiny) - root(2)).sign(), Sign::positive);
  EXPECT_EQ((root(2 - tiny) - root(2)).sign(), Sign::negative);
}

TEST(RootSum, NegativeRadicandsAreRefused) {
  EXPECT_THROW(root(-1), std::domain_error);
  EXPECT_THROW(RootSum(0, -1), std::domain_error);
}

TEST(RootSum, HasOneTermAClass) {
  const RootSum x = root(2) + root(3) + root(8) + root(12) + root(4) + root(6);
  EXPECT_EQ(x.terms().size(), 3u);
  EXPECT_EQ(x.constant(), 2);
}

TEST(RootSum, SignsAgreeWithCore) {
  RandomNumbers random(41);
  int zeros = 0;
  for (int i = 0; i < 400; ++i) {
    RootSum sum;
    CORE::Expr reference = 0;
    for (int terms = 0; terms < 5; ++terms) {
      const long c = static_cast<long>(random.below(5)) - 2, r = 2 << random.below(4);
      sum.add(c, mpq_class(r, 1 + terms % 2 * 8));
      reference += CORE::Expr(c) * sqrt(CORE::Expr(r) / CORE::Expr(1 + terms % 2 * 8));
    }
    ASSERT_EQ(static_cast<int>(sum.sign()), static_cast<int>(reference.sign())) << i;
    zeros += sum.is_zero();
  }
  EXPECT_GT(zeros, 5);
}

TEST(RootSum, ProductsMergeSquareClasses) {
  EXPECT_EQ(compare(root(2) * root(3), root(6)), Sign::zero);
  EXPECT_EQ(compare(root(6) * root(10), 2 * root(15)), Sign::zero);
  EXPECT_EQ(compare(root(mpq_class(2, 3)) * root(6), RootSum(2)), Sign::zero);
  RandomNumbers random(43);
  const auto some = [&] {
    RootSum x(static_cast<long>(random.below(7)) - 3);
    for (int i = 0; i < 3; ++i) {
      mpq_class radicand(1 + random.below(30), 1 + random.below(3));
      radicand.canonicalize();
      x.add(static_cast<long>(random.below(7)) - 3, radicand);
    }
    return x;
  };
  for (int i = 0; i < 2000; ++i) {
    const RootSum a = some(), b = some(), c = some();
    ASSERT_TRUE((a * b - b * a).is_zero());
    ASSERT_TRUE(((a + b) * c - a * c - b * c).is_zero());
    ASSERT_TRUE((a * b * c - a * (b * c)).is_zero());
    ASSERT_EQ((a * b).sign(), a.sign() * b.sign());
    ASSERT_EQ((a * b).is_zero(), a.is_zero() || b.is_zero());
  }
}

TEST(RootSum, LawsOfAnOrderedVectorSpace) {
  RandomNumbers random(42);
  const auto some = [&] {
    RootSum x;
    for (int t = 0; t < 3; ++t) x.add(mpq_class(random.between(-3, 3)), abs(mpq_class(random.between(-3, 3))));
    return x;
  };
  for (int i = 0; i < 200; ++i) {
    const RootSum a = some(), b = some(), c = some();
    EXPECT_EQ(compare(a, b), -compare(b, a));
    EXPECT_EQ(compare(a + c, b + c), compare(a, b));
    EXPECT_EQ(compare(a * mpq_class(-3, 7), b * mpq_class(-3, 7)), -compare(a, b));
    EXPECT_EQ(compare((a + b) - b, a), Sign::zero);
    EXPECT_EQ((-a).sign(), -a.sign());
  }
}

TEST(RootSum, EnclosuresAreNarrowAndContainTheValue) {
  const RootSum x = root(2) + root(3) - RootSum(mpq_class(22, 7));
  for (const int bits : {64, 200, 900}) {
    const Ball<Mpfr> ball = x.enclosure(bits);
    EXPECT_LE(ball.rad(), std::ldexp(std::fabs(ball.mid().to_double()), 1 - bits));
    EXPECT_NE((x - RootSum(to_mpq(ball.mid()) - to_mpq(ball.rad()))).sign(), Sign::negative);
    EXPECT_NE((x - RootSum(to_mpq(ball.mid()) + to_mpq(ball.rad()))).sign(), Sign::positive);
  }
  EXPECT_EQ(maybe_sign(RootSum().enclosure(64)), Sign::zero);
}

TEST(RootSum, RoundsToTheNearestDouble) {
  EXPECT_EQ((root(2) + root(3)).rounded(), 3.1462643699419726);
  EXPECT_EQ((root(2) - root(3)).rounded(), -0.31783724519578227);
  EXPECT_EQ(RootSum(mpq_class(0.1)).rounded(), 0.1) << "exactly a double";
  EXPECT_EQ(root(mpq_class(0.3) * mpq_class(0.3)).rounded(), 0.3);
  EXPECT_EQ(RootSum().rounded(), 0.0);
}

TEST(RootSum, RoundsExactMidpointsToEven) {
  const mpq_class half_ulp = power_of_two(-53);
  EXPECT_EQ(RootSum(1 + half_ulp).rounded(), 1.0);
  EXPECT_EQ(RootSum(1 + 3 * half_ulp).rounded(), 1 + 0x1p-51);
  EXPECT_EQ(RootSum(-1 - half_ulp).rounded(), -1.0);
  EXPECT_EQ(RootSum(-1 - 3 * half_ulp).rounded(), -1 - 0x1p-51);
  EXPECT_EQ(root((1 + half_ulp) * (1 + half_ulp)).rounded(), 1.0) << "the root is a midpoint";
  EXPECT_EQ(RootSum(power_of_two(-1075)).rounded(), 0.0);
  EXPECT_EQ(RootSum(3 * power_of_two(-1075)).rounded(), 0x1p-1073);
  EXPECT_EQ(RootSum(power_of_two(1024) - power_of_two(970)).rounded(), kInfinity);
  EXPECT_EQ(RootSum(power_of_two(970) - power_of_two(1024)).rounded(), -kInfinity);
  // Irrational numbers that a few hundred bits do not tell from the midpoint.
  const RootSum speck = RootSum(power_of_two(-2000), 2);
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(((RootSum(1 + half_ulp) + speck) * mpq_class(sign)).rounded(), sign * (1 + 0x1p-52));
    EXPECT_EQ(((RootSum(1 + half_ulp) - speck) * mpq_class(sign)).rounded(), sign);
    EXPECT_EQ(((RootSum(power_of_two(1024) - power_of_two(970)) - speck) * mpq_class(sign)).rounded(),
              sign * std::numeric_limits<double>::max());
    EXPECT_EQ((RootSum(power_of_two(-1075)) + speck).rounded(), 0x1p-1074);
  }
  EXPECT_EQ(speck.rounded(), 0.0);
}

}  // namespace
}  // namespace gvd::robust::test
