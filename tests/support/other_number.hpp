#pragma once

#include <CGAL/CORE_Expr.h>

#include "calcium.hpp"
#include "gvd/robust/rational.hpp"

/// Algebraic numbers of other people, for the kernel's templates.
namespace gvd::test {

inline robust::MaybeSign maybe_sign(const CORE::Expr& x) { return static_cast<robust::Sign>(x.sign()); }
inline CORE::Expr number_of(const mpq_class& q, const CORE::Expr*) {
  return CORE::Expr(CORE::BigRat(CORE::BigInt(q.get_num_mpz_t()), CORE::BigInt(q.get_den_mpz_t())));
}
inline Calcium number_of(const mpq_class& q, const Calcium*) { return Calcium(q); }

template <class X>
class OtherNumber {
 public:
  OtherNumber(double x = 0) : OtherNumber(mpq_class(x)) {}  // NOLINT: as the kernel's numbers
  explicit OtherNumber(const mpq_class& q) : x_(number_of(q, static_cast<const X*>(nullptr))) {}

  friend OtherNumber operator+(const OtherNumber& a, const OtherNumber& b) { return of(a.x_ + b.x_); }
  friend OtherNumber operator-(const OtherNumber& a, const OtherNumber& b) { return of(a.x_ - b.x_); }
  friend OtherNumber operator*(const OtherNumber& a, const OtherNumber& b) { return of(a.x_ * b.x_); }
  friend OtherNumber operator/(const OtherNumber& a, const OtherNumber& b) { return of(a.x_ / b.x_); }
  friend OtherNumber operator-(const OtherNumber& a) { return of(-a.x_); }
  friend OtherNumber square(const OtherNumber& a) { return a * a; }
  friend OtherNumber sqrt(const OtherNumber& a) { return of(sqrt(a.x_)); }
  OtherNumber scaled(int exponent) const { return *this * OtherNumber(robust::power_of_two(exponent)); }
  friend robust::MaybeSign maybe_sign(const OtherNumber& a) { return maybe_sign(a.x_); }
  friend bool likely_positive(const OtherNumber& a) { return maybe_sign(a) == robust::Sign::positive; }

 private:
  static OtherNumber of(X x) {
    OtherNumber result;
    result.x_ = std::move(x);
    return result;
  }
  X x_;
};

}  // namespace gvd::test
