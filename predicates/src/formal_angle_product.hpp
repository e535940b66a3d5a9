#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gvd/predicates/angle_sum.hpp"
#include "gvd/robust/sign.hpp"

namespace gvd::predicates {

/// The product of the corners of a fan in Q(sqrt c_1, ..., sqrt c_m), the c being independent modulo squares: every root |d x e|
/// of the fan is a rational times a product of some of the sqrt c. A number is then zero exactly if its 2^m rational coefficients
/// are.
class FormalAngleProduct {
 public:
  /// Empty if more than `most` roots are needed. Cost: 2^m rational operations a corner.
  static std::optional<FormalAngleProduct> of(std::span<const ExactCorner> fan, std::size_t most);

  /// The sign of the imaginary part after division by i^quarters: zero is decided always, another sign if one
  /// term is left (always so with one root).
  robust::MaybeSign imaginary_sign(int quarters) const;

 private:
  /// Coefficients: entry s belongs to the product of the sqrt c_k for the bits k of s.
  using Number = std::vector<mpq_class>;
  struct Root {
    mpq_class factor;
    std::size_t subset;
  };

  /// The root of a square as a rational multiple of known roots; a new root is added if `most` allows it.
  std::optional<Root> root_of(const mpq_class& square, std::size_t most);
  /// number * root
  Number times(const Number& number, const Root& root) const;
  void multiply(const mpq_class& dot, const Root& root);

  std::vector<mpq_class> radicands_;
  Number x_, y_;
};

}  // namespace gvd::predicates
