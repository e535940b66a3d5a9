#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "gvd/robust/double_double.hpp"
#include "gvd/robust/mpfr_float.hpp"

namespace gvd::robust {

/// Half an ulp of 1 in double.
inline constexpr double kUnitRoundoff = 0x1p-53;
/// Added wherever a product or quotient of non-zero doubles may have underflowed: each such rounding is off by at most 2^-1075.
/// A normal number, because subnormal operands are slow on many processors.
inline constexpr double kUnderflow = 0x1p-1020;
/// Radii are computed in round-to-nearest by formulas with at most 12 roundings in a row and then multiplied by 1 + 16 u, a 13th:
/// (1 - u)^13 (1 + 16 u) > 1.
inline constexpr double kRadiusInflation = 1 + 16 * kUnitRoundoff;

/// A double not below a + b + c: the nearest one or a neighbour. Pre: |b| is at most half an ulp of a; c >= 0.
inline double sum_rounded_up(double a, double b, double c) noexcept {
  const DoubleDouble head = two_sum(a, c);
  const DoubleDouble tail = two_sum(head.lo, b);
  const DoubleDouble sum = two_sum(head.hi, tail.hi);
  // a + b + c = sum.hi + sum.lo + tail.lo, the last two less than an ulp of the first.
  return sum.lo + tail.lo > 0 ? std::nextafter(sum.hi, std::numeric_limits<double>::infinity()) : sum.hi;
}

/// a 2^k, rounded once: std::ldexp without its price.
inline double times_power_of_two(double a, int k) noexcept {
  if (k < -1022 || k > 1023) return std::ldexp(a, k);
  return a * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + k) << 52);
}

/// Rounded arithmetic on the midpoints of balls. Every operation hands back, beside the rounded result, a bound of its error,
/// except for what underflow in a product, quotient or scaling adds to it (kUnderflowOfBall, which the ball adds where it cannot
/// be excluded). The bound is infinite or not a number when the result is not finite; zero says that the result is exact.
/// docs/error-bounds.md#midpoints.
template <class T>
struct Midpoint;

template <>
struct Midpoint<double> {
  /// Whether exact products, quotients and roots are recognised (error zero).
  static constexpr bool kDetectsExactness = false;
  static constexpr double kUnderflowOfBall = kUnderflow;

  static double add(double a, double b, double& error) noexcept {
    const DoubleDouble s = two_sum(a, b);
    error = std::fabs(s.lo);  // the error itself, also in the subnormal range
    return s.hi;
  }
  static double subtract(double a, double b, double& error) noexcept { return add(a, -b, error); }
  static double multiply(double a, double b, double& error) noexcept {
    const double p = a * b;
    error = kUnitRoundoff * std::fabs(p);
    return p;
  }
  static double divide(double a, double b, double& error) noexcept {
    const double q = a / b;
    error = kUnitRoundoff * std::fabs(q);
    return q;
  }
  static double square_root(double a, double& error) noexcept {
    const double s = std::sqrt(a);
    error = kUnitRoundoff * s;
    return s;
  }
  static double negate(double a) noexcept { return -a; }
  static double scale(double a, int k) noexcept { return times_power_of_two(a, k); }
  /// Doubles that are at least and at most |a|.
  static double magnitude(double a) noexcept { return std::fabs(a); }
  static double least_magnitude(double a) noexcept { return std::fabs(a); }
  static bool is_zero(double a) noexcept { return a == 0; }
  static bool is_negative(double a) noexcept { return a < 0; }
  static bool magnitude_exceeds(double a, double bound) noexcept { return std::fabs(a) > bound; }
  static double nearest(double a) noexcept { return a; }
  /// At least |a - nearest(a)|.
  static double rest(double) noexcept { return 0; }
  /// A double not below a + rad.
  static double upper(double a, double rad) noexcept { return sum_rounded_up(a, 0, rad); }
};

template <>
struct Midpoint<DoubleDouble> {
  static constexpr bool kDetectsExactness = false;
  static constexpr double kUnderflowOfBall = kUnderflow;

  static DoubleDouble add(const DoubleDouble& a, const DoubleDouble& b, double& error) noexcept {
    const DoubleDouble s = a + b;
    // Adding zero is exact; so structural zeros cost nothing.
    error = a.hi == 0 || b.hi == 0 ? 0 * s.hi : kDoubleDoubleAddError * std::fabs(s.hi) + add_underflow(s.hi);
    return s;
  }
  static DoubleDouble subtract(const DoubleDouble& a, const DoubleDouble& b, double& error) noexcept { return add(a, -b, error); }
  static DoubleDouble multiply(const DoubleDouble& a, const DoubleDouble& b, double& error) noexcept {
    const DoubleDouble p = a * b;
    error = kDoubleDoubleProductError * std::fabs(p.hi);
    return p;
  }
  static DoubleDouble divide(const DoubleDouble& a, const DoubleDouble& b, double& error) noexcept {
    const DoubleDouble q = a / b;
    // What underflows inside the quotient of y q is divided by y.
    error = kDoubleDoubleQuotientError * std::fabs(q.hi) + (a.hi == 0 ? 0 : kUnderflow / std::fabs(b.hi));
    return q;
  }
  static DoubleDouble square_root(const DoubleDouble& a, double& error) noexcept {
    const DoubleDouble s = sqrt(a);
    error = kDoubleDoubleRootError * s.hi;
    return s;
  }
  static DoubleDouble negate(const DoubleDouble& a) noexcept { return -a; }
  static DoubleDouble scale(const DoubleDouble& a, int k) noexcept { return {times_power_of_two(a.hi, k), times_power_of_two(a.lo, k)}; }
  // |lo| <= u |hi|, and the factors are two roundings wide.
  static double magnitude(const DoubleDouble& a) noexcept { return std::fabs(a.hi) * (1 + 0x1p-52); }
  static double least_magnitude(const DoubleDouble& a) noexcept { return std::fabs(a.hi) * (1 - 0x1p-52); }
  static bool is_zero(const DoubleDouble& a) noexcept { return a.hi == 0; }
  static bool is_negative(const DoubleDouble& a) noexcept { return a.hi < 0; }
  static bool magnitude_exceeds(const DoubleDouble& a, double bound) noexcept { return abs(a) > DoubleDouble(bound); }
  static double nearest(const DoubleDouble& a) noexcept { return a.hi; }
  static double rest(const DoubleDouble& a) noexcept { return std::fabs(a.lo); }
  static double upper(const DoubleDouble& a, double rad) noexcept { return sum_rounded_up(a.hi, a.lo, rad); }

 private:
  /// The relative bound times a small sum underflows although the sum itself does not; a zero sum is exact.
  static double add_underflow(double sum) noexcept { return sum == 0 ? 0 : kUnderflow; }
};

template <>
struct Midpoint<Mpfr> {
  static constexpr bool kDetectsExactness = true;
  /// The midpoints do not underflow, only the radii do: a few times 2^-1075.
  static constexpr double kUnderflowOfBall = 0x1p-1070;

  static Mpfr add(const Mpfr& a, const Mpfr& b, double& error) { return with_error(&Mpfr::add, a, b, error); }
  static Mpfr subtract(const Mpfr& a, const Mpfr& b, double& error) { return with_error(&Mpfr::subtract, a, b, error); }
  static Mpfr multiply(const Mpfr& a, const Mpfr& b, double& error) { return with_error(&Mpfr::multiply, a, b, error); }
  static Mpfr divide(const Mpfr& a, const Mpfr& b, double& error) { return with_error(&Mpfr::divide, a, b, error); }
  static Mpfr square_root(const Mpfr& a, double& error) {
    int ternary;
    Mpfr s = Mpfr::square_root(a, ternary);
    error = s.rounding_error(ternary);
    return s;
  }
  static Mpfr negate(const Mpfr& a) { return -a; }
  static Mpfr scale(const Mpfr& a, int k) { return a.scaled(k); }
  static double magnitude(const Mpfr& a) { return std::fabs(a.to_double(MPFR_RNDA)); }
  static double least_magnitude(const Mpfr& a) { return std::fabs(a.to_double(MPFR_RNDZ)); }
  static bool is_zero(const Mpfr& a) noexcept { return a.is_zero(); }
  static bool is_negative(const Mpfr& a) noexcept { return a.sign() < 0; }
  static bool magnitude_exceeds(const Mpfr& a, double bound) noexcept { return a.magnitude_exceeds(bound); }
  static double nearest(const Mpfr& a) noexcept { return a.to_double(); }
  static double rest(const Mpfr& a) { return std::fabs((a - Mpfr(a.to_double())).to_double(MPFR_RNDA)); }
  static double upper(const Mpfr& a, double rad) {
    Mpfr sum(0.0);
    mpfr_add_d(sum.get(), a.get(), rad, MPFR_RNDU);
    return sum.to_double(MPFR_RNDU);
  }

 private:
  using Operation = Mpfr(const Mpfr&, const Mpfr&, int&);
  static Mpfr with_error(Operation* operation, const Mpfr& a, const Mpfr& b, double& error) {
    int ternary;
    Mpfr result = operation(a, b, ternary);
    error = result.rounding_error(ternary);
    return result;
  }
};

}  // namespace gvd::robust
