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

/// What is taken as an unknown: the root of each step by itself (which forgets that some are equal; enough for strips that are mirror images), or each
/// radicand.
enum class Unknowns { of_steps, of_radicands };

/// Whether the difference of two programs is zero as a polynomial.
class SpanTest {
 public:
  SpanTest(const RootProgram& a, const RootProgram& b, const Alignment& alignment, Unknowns unknowns);
  bool proves_equal() const;

 private:
  /// Both states side by side, one such block for each product of roots in use.
  static constexpr std::size_t kBlock = 2 * RootProgram::kSize;
  /// More roots in use at once are not tried.
  static constexpr std::size_t kMostOpen = 6;
  using Word = std::uint64_t;

  struct Entry {
    std::uint8_t row, column;
    bool factor;
    const mpz_class* value;
  };
  struct Step {
    std::size_t unknown;
    bool opens, closes;
    const mpz_class* radicand;  // of a root that is in use already, or stays
    bool in_a, in_b;
    std::vector<Entry> entries;
  };
  class Run;

  void add_entries(Step& step, const RootProgram::Layer& layer, std::size_t offset) const;
  long coefficient_bits() const;

  const RootProgram &a_, &b_;
  std::vector<Step> steps_;
  mpz_class a_denominator_, b_denominator_;  // without what they have in common
  bool feasible_ = true;
};

}  // namespace gvd::robust
