#pragma once

#include <array>
#include <utility>
#include <vector>

#include "gvd/robust/gmp.hpp"

namespace gvd::robust {

/// The number  last . L_n ... L_1 first / denominator,  where each layer L = constant + sqrt(r) factor is a 4 x 4 matrix over the root of a
/// positive integer, and all entries are whole. So an image carried through a strip of faces is given by one layer a face.
class RootProgram {
 public:
  static constexpr std::size_t kSize = 4;
  using Vector = std::array<mpz_class, kSize>;
  using Matrix = std::array<Vector, kSize>;
  struct Layer {
    mpz_class radicand;  ///< 1 for a layer without a root
    Matrix constant, factor;
  };

  explicit RootProgram(Vector first) : first_(std::move(first)) {}
  /// Layers over one radicand in a row are multiplied out.
  void append(Layer layer);
  /// Pre: denominator > 0.
  void finish(Vector last, mpz_class denominator);
  /// The same number, read from the other end.
  RootProgram reversed() const;

  const Vector& first() const noexcept { return first_; }
  const Vector& last() const noexcept { return last_; }
  const mpz_class& denominator() const noexcept { return denominator_; }
  const std::vector<Layer>& layers() const noexcept { return layers_; }

 private:
  Vector first_, last_;
  mpz_class denominator_ = 1;
  std::vector<Layer> layers_;
};

/// Whether a and b are proved to be equal; false says nothing.
///
/// The span test of Raz and Shpilka (Deterministic polynomial identity testing in non-commutative models, 2005): the difference is a polynomial in
/// the roots, taken as unknowns, and modulo a prime all its coefficients are zero if they are so for a basis of the vectors that the
/// coefficients of the state span, carried from layer to layer. They are zero if they are zero modulo primes whose product exceeds a bound of
/// them: a proof, not a sample. docs/exactness.md#span-test. Roots of one square class must be written over one radicand by the caller; a root
/// that occurs more often than once in a program, or at places of the two that do not align, doubles the cost while it is in use.
/// Cost: about quadratic in the number of layers; docs/exactness.md has figures.
bool are_proved_equal(const RootProgram& a, const RootProgram& b);

}  // namespace gvd::robust
