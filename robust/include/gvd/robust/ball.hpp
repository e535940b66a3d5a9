#pragma once

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "gvd/robust/gmp.hpp"
#include "gvd/robust/midpoint.hpp"
#include "gvd/robust/sign.hpp"

namespace gvd::robust {

/// A real number known up to a radius: |truth - mid| <= rad. T is double, DoubleDouble or Mpfr; the radius is a double.
///
/// Every operation encloses the exact result for all members of the operands, whatever underflows; derivations in
/// docs/error-bounds.md#balls. What overflows, and what is undefined for all or some members (division by a ball that contains
/// zero), has an infinite or not-a-number radius, which no later operation makes finite and no decision is taken from. The one
/// exception is the root of a ball that reaches below zero: it encloses the roots of its non-negative part (the truth is known to
/// be there: a squared length), and only the root of a certainly negative ball is undefined.
///
/// Structural zeros survive: 0 * x, 0 / x and x + 0 with an exact 0 add no error; a sum of exact doubles that is a double is exact.
/// Correct in round-to-nearest without contraction only (floating_point.hpp checks that).
/// Results do not depend on anything but the operands. Cost for double: about 10 simple operations a sum or product, and at
/// most one branch, which is predictable.
template <class T>
class Ball {
  using M = Midpoint<T>;

 public:
  using Mid = T;

  Ball() : mid_(0.0), rad_(0) {}
  /// Exactly x. Implicit: a finite double is an exact real number. Mpfr: of 53 bits, which widens with the other operand.
  /// Nothing is known if x is not finite.
  Ball(double x) : mid_(x), rad_(x - x) {}  // NOLINT
  /// The reals within `rad` of `mid`. Pre: rad >= 0 (or infinite, or not a number: nothing is known).
  Ball(T mid, double rad) : mid_(std::move(mid)), rad_(rad) {}
  static Ball exact(double x) { return Ball(x); }

  const T& mid() const noexcept { return mid_; }
  double rad() const noexcept { return rad_; }
  /// Whether anything is known at all.
  bool is_finite() const noexcept { return rad_ < std::numeric_limits<double>::infinity() && std::isfinite(M::nearest(mid_)); }
  /// Doubles around every member, rounded outward; infinite if nothing is known. lower() <= upper().
  double lower() const { return is_finite() ? -M::upper(M::negate(mid_), rad_) : -std::numeric_limits<double>::infinity(); }
  double upper() const { return is_finite() ? M::upper(mid_, rad_) : std::numeric_limits<double>::infinity(); }

  friend Ball operator-(const Ball& a) { return {M::negate(a.mid_), a.rad_}; }

  friend Ball operator+(const Ball& a, const Ball& b) {
    double error;
    T sum = M::add(a.mid_, b.mid_, error);
    return {std::move(sum), inflated(a.rad_ + b.rad_ + error)};
  }

  friend Ball operator-(const Ball& a, const Ball& b) {
    double error;
    T difference = M::subtract(a.mid_, b.mid_, error);
    return {std::move(difference), inflated(a.rad_ + b.rad_ + error)};
  }

  friend Ball operator*(const Ball& a, const Ball& b) {
    double error;
    T product = M::multiply(a.mid_, b.mid_, error);
    if constexpr (M::kDetectsExactness) {
      if (a.rad_ == 0 && b.rad_ == 0) return {std::move(product), error};
    }
    const double a_most = M::magnitude(a.mid_) + a.rad_;
    const double b_mid = M::magnitude(b.mid_);
    const double underflow = underflow_unless_zero(a_most, b_mid + b.rad_);
    return {std::move(product), inflated(a_most * b.rad_ + b_mid * a.rad_ + error + underflow)};
  }

  /// By an exact double: cheaper than by a ball.
  friend Ball operator*(const Ball& a, double b) {
    double error;
    T product = M::multiply(a.mid_, T(b), error);
    if constexpr (M::kDetectsExactness) {
      if (a.rad_ == 0) return {std::move(product), error};
    }
    const double b_most = std::fabs(b);
    const double underflow = underflow_unless_zero(M::magnitude(a.mid_) + a.rad_, b_most);
    return {std::move(product), inflated(b_most * a.rad_ + error + underflow)};
  }
  friend Ball operator*(double a, const Ball& b) { return b * a; }

  friend Ball operator/(const Ball& a, const Ball& b) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double error;
    T quotient = M::divide(a.mid_, b.mid_, error);
    const double b_least = M::least_magnitude(b.mid_) - b.rad_;
    if constexpr (M::kDetectsExactness) {
      if (a.rad_ == 0 && b.rad_ == 0) return {std::move(quotient), M::is_zero(b.mid_) ? kInfinity : error};
    }
    const double a_most = M::magnitude(a.mid_) + a.rad_;
    const double underflow = a_most > 0 ? M::kUnderflowOfBall : 0;
    const double inner_underflow = b.rad_ > 0 ? underflow : 0;
    const double numerator = a.rad_ + (M::magnitude(quotient) + error + inner_underflow) * b.rad_ + inner_underflow;
    const double rad = inflated(numerator / b_least + error + underflow);
    return {std::move(quotient), b_least > 0 ? rad : kInfinity};
  }

  friend Ball sqrt(const Ball& a) {
    if (M::magnitude_exceeds(a.mid_, a.rad_)) {  // certainly not zero
      if (M::is_negative(a.mid_)) return unknown();
      double error;
      T root = M::square_root(a.mid_, error);
      if (a.rad_ == 0) return {std::move(root), inflated(error)};
      // r / (sqrt m + sqrt(m - r)) <= 0.51 r / sqrt m for r <= m / 16, and never more than r / sqrt m
      const double share = 16 * a.rad_ <= M::least_magnitude(a.mid_) ? 0.51 : 1.0;
      // The quotient first: a product that underflows must not be divided by a small root.
      const double rad = a.rad_ / M::least_magnitude(root) * share + error + M::kUnderflowOfBall;
      return {std::move(root), inflated(rad)};
    }
    return root_of_non_negative_part(a);
  }

  friend Ball abs(const Ball& a) { return M::is_negative(a.mid_) ? -a : a; }
  friend Ball square(const Ball& a) { return a * a; }

  /// 2^k times the ball.
  Ball scaled(int k) const {
    const bool may_underflow = k < 0 && !(rad_ == 0 && (M::kDetectsExactness || M::is_zero(mid_)));
    T mid = M::scale(mid_, k);
    const double overflow = 0 * std::fabs(M::nearest(mid));  // not a number if the midpoint became infinite
    return {std::move(mid), inflated(times_power_of_two(rad_, k) + (may_underflow ? M::kUnderflowOfBall : 0) + overflow)};
  }

  Ball& operator+=(const Ball& b) { return *this = *this + b; }
  Ball& operator-=(const Ball& b) { return *this = *this - b; }
  Ball& operator*=(const Ball& b) { return *this = *this * b; }
  Ball& operator/=(const Ball& b) { return *this = *this / b; }

  /// The sign of every member if that is one and the same. Zero only if the ball is exactly {0}, which proves the truth to be zero.
  friend MaybeSign maybe_sign(const Ball& a) {
    if (M::magnitude_exceeds(a.mid_, a.rad_)) return M::is_negative(a.mid_) ? Sign::negative : Sign::positive;
    if (M::is_zero(a.mid_) && a.rad_ == 0) return Sign::zero;
    return std::nullopt;
  }

 private:
  static double inflated(double radius) noexcept { return radius * kRadiusInflation; }
  static Ball unknown() { return {T(0.0), std::numeric_limits<double>::infinity()}; }
  /// An exact zero times anything is exact; everything else may underflow.
  static double underflow_unless_zero(double a_most, double b_most) noexcept {
    const double least = a_most < b_most ? a_most : b_most;
    return least > 0 ? M::kUnderflowOfBall : 0;
  }

  /// The ball reaches zero or below (or is not a number): the mid-point of the roots is not worth much, the enclosure is.
  static Ball root_of_non_negative_part(const Ball& a) {
    if (M::is_zero(a.mid_) && a.rad_ == 0) return Ball();
    if (!a.is_finite()) return unknown();
    // All roots lie in [0, sqrt(m + r)]; so does the root of m, or 0 if m is negative.
    const double most = M::is_negative(a.mid_) ? a.rad_ : M::magnitude(a.mid_) + a.rad_;
    const double rad = inflated(std::sqrt(inflated(most)));
    if (M::is_negative(a.mid_)) return {T(0.0), rad};
    double error;
    T root = M::square_root(a.mid_, error);
    return {std::move(root), inflated(rad + error)};
  }

  T mid_;
  double rad_;
};

/// The same real number in double: the midpoint rounded to nearest, the radius grown by what that lost.
template <class T>
Ball<double> narrowed(const Ball<T>& a) {
  using M = Midpoint<T>;
  return {M::nearest(a.mid()), (a.rad() + M::rest(a.mid())) * kRadiusInflation};
}

/// The same real number in double-double.
Ball<DoubleDouble> to_double_double(const Ball<Mpfr>& a);

/// A rational in the number type NT = Ball<double>, Ball<DoubleDouble>, Ball<Mpfr> (rounded to `bits` bits, which the others
/// ignore) or Exact. Exactly representable values get radius zero.
template <class NT>
NT from(const mpq_class& q, int bits = 0);
template <>
Ball<double> from<Ball<double>>(const mpq_class& q, int bits);
template <>
Ball<DoubleDouble> from<Ball<DoubleDouble>>(const mpq_class& q, int bits);
template <>
Ball<Mpfr> from<Ball<Mpfr>>(const mpq_class& q, int bits);

/// A double in the number type NT, exactly; Mpfr with `bits` bits, so that what is computed from it has at least these.
template <class NT>
NT from_double(double x, int bits = 0) {
  if constexpr (std::is_same_v<NT, Ball<Mpfr>>)
    return NT(Mpfr(x, bits), x - x);
  else
    return NT(x);
}

/// The sign of a - b; empty if it cannot be told.
template <class NT>
MaybeSign maybe_compare(const NT& a, const NT& b) {
  return maybe_sign(a - b);
}

}  // namespace gvd::robust
