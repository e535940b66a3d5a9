#include "gvd/robust/rational.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <limits>
#include <set>
#include <stdexcept>

namespace gvd::robust::test {
namespace {

class Rationals {
 public:
  Rationals() : random_(gmp_randinit_mt) { random_.seed(20230217); }
  mpz_class integer(mp_bitcnt_t bits) { return random_.get_z_bits(bits) + 1; }
  mpq_class positive(mp_bitcnt_t bits) {
    mpq_class q(integer(bits), integer(bits));
    q.canonicalize();
    return q;
  }

 private:
  gmp_randclass random_;
};

TEST(Rational, DoublesAreExact) {
  EXPECT_EQ(exact_rational(0.1), mpq_class(mpz_class("3602879701896397"), mpz_class("36028797018963968")));
  EXPECT_EQ(exact_rational(0x1p-1074), power_of_two(-1074));
  EXPECT_EQ(exact_rational(-0.0), 0);
  EXPECT_EQ(exact_rational(std::numeric_limits<double>::max()), power_of_two(1024) - power_of_two(971));
  EXPECT_THROW(exact_rational(std::numeric_limits<double>::infinity()), std::domain_error);
  EXPECT_THROW(exact_rational(std::numeric_limits<double>::quiet_NaN()), std::domain_error);
}

TEST(Rational, SquareRoots) {
  EXPECT_EQ(rational_square_root(mpq_class(9, 4)), mpq_class(3, 2));
  EXPECT_EQ(rational_square_root(mpq_class(0)), mpq_class(0));
  EXPECT_FALSE(rational_square_root(mpq_class(2)));
  EXPECT_FALSE(rational_square_root(mpq_class(4, 3)));
  EXPECT_FALSE(rational_square_root(mpq_class(-4)));
  EXPECT_FALSE(is_square(mpq_class(-1, 4)));
  Rationals random;
  for (int i = 0; i < 500; ++i) {
    const mpq_class q = random.positive(200);
    EXPECT_EQ(rational_square_root(q * q), q);
    const mpz_class n = random.integer(200);
    EXPECT_FALSE(is_square(mpq_class(n * n + 1))) << "between two neighbouring squares";
  }
}

TEST(Rational, OverOneDenominator) {
  const std::array<mpq_class, 4> all = {mpq_class(-5, 6), mpq_class(3, 4), mpq_class(0), mpq_class(7, 10)};
  CommonDenominator common;
  common.include(all);
  EXPECT_EQ(*common, 60);
  for (const mpq_class& q : all) EXPECT_EQ(ratio(common.numerator(q), *common), q);
  EXPECT_EQ(ratio(-6, 4).get_num(), -3);
  EXPECT_EQ(ratio(6, -4).get_den(), 2);
}

TEST(Rational, SquareClasses) {
  EXPECT_TRUE(same_square_class(2, 8));
  EXPECT_TRUE(same_square_class(mpq_class(1, 2), 2));
  EXPECT_TRUE(same_square_class(-3, mpq_class(-1, 3)));
  EXPECT_FALSE(same_square_class(2, 3));
  EXPECT_FALSE(same_square_class(2, -2));
}

TEST(Rational, SignaturesUseDistinctPrimes) {
  std::set<std::uint64_t> distinct;
  for (const std::uint64_t p : signature_primes()) {
    EXPECT_LT(p, std::uint64_t{1} << 62);
    EXPECT_NE(mpz_probab_prime_p(mpz_class(p).get_mpz_t(), 40), 0) << p;
    distinct.insert(p);
  }
  EXPECT_EQ(distinct.size(), 64u);
}

TEST(Rational, SignaturesAreAHomomorphismOfSquareClasses) {
  Rationals random;
  for (int i = 0; i < 300; ++i) {
    const mpq_class a = random.positive(120), b = random.positive(60) * (i % 3 ? 1 : -1);
    EXPECT_EQ(square_class_signature(a * b), square_class_signature(a) ^ square_class_signature(b));
    EXPECT_EQ(square_class_signature(a * b * b), square_class_signature(a));
  }
}

// Where a prime of the signature divides the number, its factors are taken out, so the laws hold without exception.
TEST(Rational, SignaturesOfMultiplesOfTheirPrimes) {
  const mpq_class p(signature_primes()[5]), q(signature_primes()[40]);
  for (const mpq_class& a : {mpq_class(p), mpq_class(p * p * 3), mpq_class(p * q / 7), mpq_class(q * q * q / p)})
    for (const mpq_class& b : {mpq_class(2), mpq_class(p * 5), mpq_class(q / p)}) {
      EXPECT_EQ(square_class_signature(a * b), square_class_signature(a) ^ square_class_signature(b));
      EXPECT_EQ(square_class_signature(a * b * b), square_class_signature(a));
    }
}

TEST(Rational, SignaturesTellSmallClassesApart) {
  std::set<std::uint64_t> signatures;
  int classes = 0;
  for (long n = -2000; n <= 2000; ++n) {
    bool square_free = n != 0;
    for (long d = 2; d * d <= std::labs(n); ++d) square_free = square_free && n % (d * d) != 0;
    if (!square_free) continue;
    ++classes;
    signatures.insert(square_class_signature(mpq_class(n)));
  }
  EXPECT_EQ(signatures.size(), static_cast<std::size_t>(classes));
}

}  // namespace
}  // namespace gvd::robust::test
