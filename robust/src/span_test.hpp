#pragma once

#include <cstdint>
#include <vector>

#include "gvd/robust/root_program.hpp"
#include "prime_field.hpp"

namespace gvd::robust {

/// One layer of either program or of both, over one root.
struct AlignedStep {
  static constexpr int kNone = -1;
  int a = kNone, b = kNone;
};
/// The layers of two programs in one order that keeps both, with as many common steps as there can be.
struct Alignment {
  std::vector<AlignedStep> steps;
  std::size_t common = 0;
};
Alignment aligned(const RootProgram& a, const RootProgram& b);

/// What is taken as an unknown: the root of each step by itself (which forgets that some are equal; enough for strips that are mirror images), or
/// the roots of a basis of the radicands (RootBasis), of which the others are products.
enum class Unknowns { of_steps, of_basis };

/// Whether the difference of two programs is zero as a polynomial.
class SpanTest {
 public:
  SpanTest(const RootProgram& a, const RootProgram& b, const Alignment& alignment, Unknowns unknowns);
  bool proves_equal() const;

 private:
  /// Both states side by side, one such block for each product of unknowns in use.
  static constexpr std::size_t kBlock = 2 * RootProgram::kSize;
  /// More unknowns in use between two steps are not tried.
  static constexpr std::size_t kMostOpen = 6;
  using Word = std::uint64_t;

  struct Entry {
    std::uint8_t row, column;
    bool factor;
    const mpz_class* value;
  };
  struct Step {
    mpq_class multiple;                        // the root is this multiple
    std::vector<std::size_t> unknowns;         // of the product of these
    std::vector<std::size_t> opens, closes;    // those not used before, or later
    bool in_a, in_b;
    std::vector<Entry> entries;
  };
  class Run;

  const mpz_class& radicand_of(const AlignedStep& aligned) const;
  Step step_of(const AlignedStep& aligned) const;
  static void add_entries(Step& step, const RootProgram::Layer& layer, std::size_t offset);
  void find_uses();
  long coefficient_bits() const;

  const RootProgram &a_, &b_;
  std::vector<Step> steps_;
  std::vector<mpz_class> squares_;           // of the unknowns
  mpz_class a_scale_ = 1, b_scale_ = 1;      // the denominators of the multiples are multiplied in
  mpz_class a_denominator_, b_denominator_;  // with these, without what they have in common
  bool feasible_ = true;
};

}  // namespace gvd::robust
