#include "../../robust/src/residue.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "../../robust/src/prime_field.hpp"

namespace gvd::robust::test {
namespace {

using Pair = std::pair<std::uint64_t, std::uint64_t>;

/// All of a small field, against the squares of all its elements.
TEST(ResidueField, RootsAndSquaresOfAllElements) {
  for (const std::uint64_t p : {3u, 7u, 11u, 19u, 23u, 31u}) {
    const ResidueField field(p);
    std::set<Pair> squares;
    for (std::uint64_t a = 0; a < p; ++a)
      for (std::uint64_t b = 0; b < p; ++b) {
        const auto square = field.multiply({a, b}, {a, b});
        squares.emplace(square.a, square.b);
      }
    EXPECT_EQ(squares.size(), (p * p + 1) / 2);
    for (std::uint64_t a = 0; a < p; ++a)
      for (std::uint64_t b = 0; b < p; ++b) {
        const ResidueField::Element x{a, b};
        ASSERT_EQ(field.is_square(x), squares.count({a, b}) == 1) << p << ": " << a << " + " << b << " i";
        const auto root = field.root(x);
        ASSERT_EQ(root.has_value(), field.is_square(x));
        if (!root) continue;
        const auto again = field.multiply(*root, *root);
        ASSERT_EQ(Pair(again.a, again.b), Pair(a, b));
      }
    EXPECT_TRUE(ResidueField::is_zero(field.of(mpz_class(-5 * static_cast<long>(p)))));
    EXPECT_EQ(field.of(mpz_class(-1)).a, p - 1);
  }
}

/// Montgomery's representation against GMP, for numbers of several words.
TEST(PrimeField, AgreesWithGmp) {
  gmp_randclass random(gmp_randinit_mt);
  random.seed(20230217);
  for (int i = 0; i < 300; ++i) {
    const std::uint64_t p = large_prime(static_cast<std::size_t>(i % 70));
    const PrimeField field(p);
    const mpz_class x = random.get_z_bits(1 + i) - (i % 3 == 0 ? random.get_z_bits(2 + i) : mpz_class(0)), y = random.get_z_bits(200);
    ASSERT_EQ(field.multiply(field.of(x), field.of(y)), field.of(x * y));
    ASSERT_EQ(field.add(field.of(x), field.of(y)), field.of(x + y));
    ASSERT_EQ(field.subtract(field.of(x), field.of(y)), field.of(x - y));
    ASSERT_EQ(field.of(x * mpz_class(p)), 0u);
    ASSERT_EQ(field.of(x) == 0, mpz_divisible_p(x.get_mpz_t(), mpz_class(p).get_mpz_t()) != 0);
  }
}

}  // namespace
}  // namespace gvd::robust::test
