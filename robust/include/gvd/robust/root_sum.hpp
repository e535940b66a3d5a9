#pragma once

#include <cstdint>
#include <vector>

#include "gvd/robust/ball.hpp"
#include "gvd/robust/gmp.hpp"
#include "gvd/robust/sign.hpp"

namespace gvd::robust {

/// An exact number (c_0 + c_1 sqrt(r_1) + ... + c_n sqrt(r_n)) / d with whole c_i, r_i > 0 and d > 0.
///
/// Kept in normal form: no c_i is zero (i > 0), no r_i is a square, no two r_i differ by a square, and d has no factor in common with all c_i. Square
/// roots of rationals of different square classes are linearly independent over the rationals, also of 1 (Besicovitch 1940). So the number is zero iff
/// no term is left and c_0 = 0, which needs no numerics at all; otherwise its sign is found by MPFR with rising precision, which
/// must end. Sums and products of such numbers are such numbers, of up to 2^k terms if the r_i span k square classes.
/// There is one denominator, so that common factors are looked for once an operation and not once a coefficient.
class RootSum {
 public:
  struct Term {
    mpz_class coefficient;
    mpz_class radicand;
    std::uint64_t signature;  ///< of the square class of the radicand
  };

  RootSum() = default;
  RootSum(const mpq_class& constant) : constant_(constant.get_num()), denominator_(constant.get_den()) {}  // NOLINT: a rational is a sum of roots
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
  friend RootSum operator-(RootSum a);
  /// Cost: over k classes, 3^k products of coefficients.
  friend RootSum operator*(const RootSum& a, const RootSum& b);
  friend RootSum square(const RootSum& a) { return a * a; }

  /// c_0 / d.
  mpq_class constant() const { return over_denominator(constant_); }
  /// c_i / d.
  mpq_class coefficient(const Term& term) const { return over_denominator(term.coefficient); }
  const std::vector<Term>& terms() const noexcept { return terms_; }
  const mpz_class& whole_constant() const noexcept { return constant_; }
  const mpz_class& denominator() const noexcept { return denominator_; }
  bool is_zero() const { return terms_.empty() && sgn(constant_) == 0; }

  Sign sign() const;
  /// The correctly rounded double (ties to even, subnormals and overflow as IEEE 754).
  double rounded() const;
  /// An enclosure of relative radius at most 2^-bits where the radius is not limited by the range of double (zero is exact).
  Ball<Mpfr> enclosure(int bits) const;

 private:
  friend class ProductOfRootSums;
  mpq_class over_denominator(const mpz_class& numerator) const;
  /// All numerators and the denominator times a factor.
  void expand(const mpz_class& factor);
  /// Numerators over the present denominator may be added for numbers over `denominator` times the result.
  mpz_class make_common(const mpz_class& denominator);
  void add_rational(const mpq_class& q);
  /// Adds coefficient / denominator_ * sqrt(radicand).
  void add_class(const mpz_class& coefficient, const mpz_class& radicand, std::uint64_t signature);
  void add_product(const Term& x, const Term& y);
  void reduce();

  mpz_class constant_, denominator_ = 1;
  std::vector<Term> terms_;
};

/// The sign of a - b.
inline Sign compare(const RootSum& a, const RootSum& b) { return (a - b).sign(); }
inline MaybeSign maybe_sign(const RootSum& a) { return a.sign(); }

}  // namespace gvd::robust
