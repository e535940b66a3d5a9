#include <gtest/gtest.h>

#include "../../robust/src/prime_field.hpp"
#include "../../robust/src/root_basis.hpp"
#include "../../robust/src/span_test.hpp"
#include "gvd/robust/rational.hpp"
#include "gvd/robust/root_sum.hpp"
#include "gvd/robust/square_classes.hpp"

/// Symbols suggest which roots are multiples of one another; only a perfect square proves it.
namespace gvd::robust::test {
namespace {

/// 1 modulo all primes that symbols are taken of, so that no symbol tells it from a square; and no square.
mpz_class like_a_square(std::size_t count) {
  mpz_class product = 8;
  for (const std::uint64_t p : signature_primes()) product *= mpz_class(p);
  for (std::size_t i = 0; i < count; ++i) product *= mpz_class(large_prime(i));
  return product + 1;
}

mpq_class squared(const RootBasis& basis, const RootBasis::Product& product) {
  mpq_class result = product.factor * product.factor;
  for (const std::size_t member : product.members) result *= basis.radicand(member);
  return result;
}

TEST(RootBasis, WritesEachRootByThoseOfTheBasis) {
  const std::array<long, 9> radicands{2, 3, 6, 24, 10, 15, 1, 49, 5};
  const std::array<std::size_t, 9> members{1, 1, 2, 2, 1, 3, 0, 0, 2};  // 15 = 2 x 3 x 10 / 4, 5 = 2 x 10 / 4
  RootBasis basis(radicands.size());
  for (std::size_t i = 0; i < radicands.size(); ++i) {
    const auto product = basis.root(radicands[i]);
    EXPECT_EQ(squared(basis, product), radicands[i]);
    EXPECT_GT(product.factor, 0);
    EXPECT_EQ(product.members.size(), members[i]) << radicands[i];
  }
  EXPECT_EQ(basis.size(), 3u);
}

TEST(RootBasis, SymbolsThatAgreeByChanceProveNothing) {
  RootBasis basis(3);
  const mpz_class n = like_a_square(35);
  ASSERT_FALSE(is_square(mpq_class(n)));
  EXPECT_EQ(basis.root(2).members, std::vector<std::size_t>{0});
  for (const mpz_class& radicand : {mpz_class(2 * n), n}) {  // as 2, and as 1
    const auto product = basis.root(radicand);
    EXPECT_EQ(product.factor, 1);
    ASSERT_EQ(product.members.size(), 1u);
    EXPECT_EQ(basis.radicand(product.members[0]), radicand);
  }
  EXPECT_EQ(basis.size(), 3u);
}

TEST(SquareClasses, SymbolsThatAgreeByChanceProveNothing) {
  const mpz_class n = like_a_square(0);
  SquareClasses classes;
  const std::uint32_t two = classes(2);
  EXPECT_NE(classes(mpq_class(2 * n)), two);
  EXPECT_EQ(classes(8), two);
  EXPECT_EQ(classes(mpq_class(18 * n)), classes(mpq_class(2 * n)));
  EXPECT_EQ(compare(classes.root(mpq_class(18 * n)), RootSum(3, mpq_class(2 * n))), Sign::zero);
}

TEST(RootSum, ProductsWithEqualSymbolsKeepTheirRoot) {
  const mpz_class n = like_a_square(0);
  const RootSum product = RootSum(1, 2) * RootSum(1, mpq_class(2 * n));  // 2 sqrt n
  ASSERT_EQ(product.terms().size(), 1u);
  EXPECT_EQ(product.constant(), 0);
  EXPECT_TRUE((product * product - RootSum(mpq_class(4 * n))).is_zero());
}

/// Layers over roots of odd numbers from `first` on, or the same backwards; all are the identity.
RootProgram layers_from(std::uint32_t first, std::uint32_t count, bool backwards) {
  RootProgram program({0, 0, 0, 1});
  for (std::uint32_t i = 0; i < count; ++i) {
    RootProgram::Layer layer;
    layer.radicand = 2 * (first + (backwards ? count - 1 - i : i)) + 1;
    for (std::size_t k = 0; k < RootProgram::kSize; ++k) layer.constant[k][k] = 1;
    program.append(layer);
  }
  program.finish({0, 0, 0, 1}, 1);
  return program;
}

/// What an alignment promises: each layer once, in its order, and only layers over one root together.
void expect_aligned(const RootProgram& a, const RootProgram& b, const Alignment& alignment) {
  int next_a = 0, next_b = 0;
  std::size_t common = 0;
  for (const AlignedStep& step : alignment.steps) {
    if (step.a != AlignedStep::kNone) {
      ASSERT_EQ(step.a, next_a++);
    }
    if (step.b != AlignedStep::kNone) {
      ASSERT_EQ(step.b, next_b++);
    }
    if (step.a == AlignedStep::kNone || step.b == AlignedStep::kNone) continue;
    ++common;
    ASSERT_EQ(a.layers()[static_cast<std::size_t>(step.a)].radicand, b.layers()[static_cast<std::size_t>(step.b)].radicand);
  }
  EXPECT_EQ(next_a, static_cast<int>(a.layers().size()));
  EXPECT_EQ(next_b, static_cast<int>(b.layers().size()));
  EXPECT_EQ(common, alignment.common);
}

TEST(Alignment, OfProgramsWithoutACommonEnd) {
  const RootProgram forth = layers_from(1, 9, false), back = layers_from(1, 9, true), later = layers_from(4, 9, false);
  const Alignment of_both = aligned(forth, back), shifted = aligned(forth, later);
  expect_aligned(forth, back, of_both);
  EXPECT_EQ(of_both.common, 1u) << "backwards, one layer at most";
  expect_aligned(forth, later, shifted);
  EXPECT_EQ(shifted.common, 6u);
  expect_aligned(layers_from(1, 3, false), back, aligned(layers_from(1, 3, false), back));
}

/// The table of common layers would be too large: they are put side by side, as if nothing were common.
TEST(Alignment, OfProgramsTooLongToBeCompared) {
  constexpr std::uint32_t kMany = 1 << 13;
  const RootProgram forth = layers_from(1, kMany, false), back = layers_from(1, kMany, true);
  const Alignment alignment = aligned(forth, back);
  expect_aligned(forth, back, alignment);
  EXPECT_EQ(alignment.common, 0u);
  EXPECT_EQ(alignment.steps.size(), 2u * kMany);
  EXPECT_TRUE(are_proved_equal(layers_from(1, 40, false), layers_from(1, 40, true)));
}

/// Unknowns that are all in use at once are too many; taken one by one they are not.
TEST(SpanTest, MoreUnknownsInUseThanAreTriedProveNothing) {
  RootProgram twice({0, 0, 0, 1});
  for (int round = 0; round < 2; ++round)
    for (const long prime : {2, 3, 5, 7, 11, 13, 17, 19}) {
      RootProgram::Layer layer;
      layer.radicand = prime;
      for (std::size_t k = 0; k < RootProgram::kSize; ++k) layer.constant[k][k] = layer.factor[k][k] = 1;
      twice.append(layer);
    }
  twice.finish({0, 0, 0, 1}, 1);
  const Alignment alignment = aligned(twice, twice);
  EXPECT_TRUE(SpanTest(twice, twice, alignment, Unknowns::of_steps).proves_equal());
  EXPECT_FALSE(SpanTest(twice, twice, alignment, Unknowns::of_basis).proves_equal());
}

}  // namespace
}  // namespace gvd::robust::test
