#pragma once

#include <cstdint>
#include <vector>

#include "gvd/robust/ball.hpp"
#include "gvd/robust/gmp.hpp"
#include "gvd/robust/sign.hpp"

namespace gvd::robust {

/// An exact number c_0 + c_1 sqrt(r_1) + ... + c_n sqrt(r_n) with rational c_i and whole r_i > 0.
///
/// Kept in normal form: no c_i is zero (i > 0), no r_i is a square, and no two r_i differ by a square. Square roots of rationals of
/// different square classes are linearly independent over the rationals, also of 1 (Besicovitch 1940). So the number is zero iff
/// no term is left and c_0 = 0, which needs no numerics at all; otherwise its sign is found by MPFR with rising precision, which
/// must end. Sums and products of such numbers are such numbers, of up to 2^k terms if the r_i span k square classes.
class RootSum {
 public:
  struct Term {
    mpq_class coefficient;
    mpz_class radicand;
    std::uint64_t signature;  ///< of the square class of the radicand
  };

  RootSum() = default;
  RootSum(const mpq_class& constant) : constant_(constant) {}  // NOLINT: a rational is a sum of roots
  /// coefficient * sqrt(radicand). Throws std::domain_error if the radicand is negative.
  RootSum(const mpq_class& coefficient, const mpq_class& radicand) { add(coefficient, radicand); }

  /// Adds coefficient * sqrt(radicand). Throws std::domain_error if the radicand is negative. Cost: linear in the number of
  /// classes.
  RootSum& add(const mpq_class& coefficient, const mpq_class& radicand);
  RootSum& operator+=(const RootSum& other);
  RootSum& operator-=(const RootSum& other);
  RootSum& operator*=(const mpq_class& factor);
  friend RootSum operator+(RootSum a, const RootSum& b) { return a += b; }
  friend RootSum operator-(RootSum a, const RootSum& b) { return a -= b; }
  friend RootSum operator*(RootSum a, const mpq_class& b) { return a *= b; }
  friend RootSum operator*(const mpq_class& a, RootSum b) { return b *= a; }
  friend RootSum operator-(RootSum a) { return a *= -1; }
  /// Cost: as many products as the numbers of terms multiply to, each merged into its class.
  friend RootSum operator*(const RootSum& a, const RootSum& b);
  friend RootSum square(const RootSum& a) { return a * a; }

  const mpq_class& constant() const noexcept { return constant_; }
  const std::vector<Term>& terms() const noexcept { return terms_; }
  bool is_zero() const { return terms_.empty() && sgn(constant_) == 0; }

  Sign sign() const;
  /// The correctly rounded double (ties to even, subnormals and overflow as IEEE 754).
  double rounded() const;
  /// An enclosure of relative radius at most 2^-bits where the radius is not limited by the range of double (zero is exact).
  Ball<Mpfr> enclosure(int bits) const;

 private:
  void add_class(const mpq_class& coefficient, const mpz_class& radicand, std::uint64_t signature);
  void add_product(const Term& x, const Term& y);

  mpq_class constant_;
  std::vector<Term> terms_;
};

/// The sign of a - b.
inline Sign compare(const RootSum& a, const RootSum& b) { return (a - b).sign(); }
inline MaybeSign maybe_sign(const RootSum& a) { return a.sign(); }

}  // namespace gvd::robust
