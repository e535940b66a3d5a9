#pragma once

#include <cfloat>
#include <cmath>
#include <limits>

#ifdef __FAST_MATH__
#error "the error bounds do not hold under -ffast-math"
#endif

namespace gvd::robust {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53,
              "double must be IEEE 754 binary64");
static_assert(FLT_EVAL_METHOD == 0, "doubles must be evaluated in double: compile with SSE2 (-mfpmath=sse), not with the x87 unit");

/// An unevaluated sum hi + lo of two doubles with hi = the double nearest to hi + lo: about 106 bits.
/// Algorithms: Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic",
/// ACM TOMS 44(2), 2017, and Lefevre et al. 2023 for the root. The bounds that the code relies on are derived, underflow
/// included, in docs/error-bounds.md#double-double. Not a number or infinite as soon as a part overflows.
struct DoubleDouble {
  double hi = 0;
  double lo = 0;

  constexpr DoubleDouble() noexcept = default;
  constexpr DoubleDouble(double x) noexcept : hi(x) {}  // NOLINT: a double is exactly a DoubleDouble
  /// Pre: high is the double nearest to high + low.
  constexpr DoubleDouble(double high, double low) noexcept : hi(high), lo(low) {}

  /// The nearest double.
  constexpr explicit operator double() const noexcept { return hi; }
};

/// Relative error bounds (in the absence of underflow; docs/error-bounds.md#double-double).
inline constexpr double kDoubleDoubleAddError = 0x1p-104;       ///< 4 u^2, u = 2^-53; also holds with underflow
inline constexpr double kDoubleDoubleProductError = 0x1p-103;   ///< 8 u^2
inline constexpr double kDoubleDoubleQuotientError = 0x1p-101;  ///< 32 u^2
inline constexpr double kDoubleDoubleRootError = 0x1p-103;      ///< 8 u^2

/// s + e = a + b exactly, s the nearest double. Any a, b; wrong only by overflow (then e is not a number).
constexpr DoubleDouble two_sum(double a, double b) noexcept {
  const double s = a + b;
  const double b_part = s - a;
  const double a_part = s - b_part;
  return {s, (a - a_part) + (b - b_part)};
}

/// As two_sum, for |a| >= |b| or a = 0.
constexpr DoubleDouble fast_two_sum(double a, double b) noexcept {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// p + e = a * b exactly if |a b| >= 2^-969 (or a b = 0); otherwise e is off by at most 2^-1075.
inline DoubleDouble two_prod(double a, double b) noexcept {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

constexpr DoubleDouble operator-(const DoubleDouble& x) noexcept { return {-x.hi, -x.lo}; }

constexpr DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) noexcept {
  const DoubleDouble s = two_sum(x.hi, y.hi);
  const DoubleDouble t = two_sum(x.lo, y.lo);
  const DoubleDouble v = fast_two_sum(s.hi, s.lo + t.hi);
  return fast_two_sum(v.hi, t.lo + v.lo);
}

constexpr DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) noexcept { return x + -y; }

inline DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) noexcept {
  const DoubleDouble c = two_prod(x.hi, y.hi);
  const double cross = std::fma(x.lo, y.hi, std::fma(x.hi, y.lo, x.lo * y.lo));
  return fast_two_sum(c.hi, c.lo + cross);
}

inline DoubleDouble operator/(const DoubleDouble& x, const DoubleDouble& y) noexcept {
  const double q = x.hi / y.hi;
  const DoubleDouble c = two_prod(y.hi, q);
  const DoubleDouble r = fast_two_sum(c.hi, std::fma(y.lo, q, c.lo));  // y * q
  const double rest = (x.hi - r.hi) + (x.lo - r.lo);
  return fast_two_sum(q, rest / y.hi);
}

/// Pre: x >= 0.
inline DoubleDouble sqrt(const DoubleDouble& x) noexcept {
  if (x.hi == 0) return {};
  if (x.hi < 0x1p-900) {  // the residual below would underflow
    const DoubleDouble s = sqrt(DoubleDouble(x.hi * 0x1p200, x.lo * 0x1p200));
    return {s.hi * 0x1p-100, s.lo * 0x1p-100};
  }
  const double s = std::sqrt(x.hi);
  const double rest = std::fma(-s, s, x.hi) + x.lo;
  return fast_two_sum(s, rest / (2 * s));
}

constexpr DoubleDouble abs(const DoubleDouble& x) noexcept { return x.hi < 0 ? -x : x; }

constexpr bool operator==(const DoubleDouble& x, const DoubleDouble& y) noexcept { return x.hi == y.hi && x.lo == y.lo; }
constexpr bool operator<(const DoubleDouble& x, const DoubleDouble& y) noexcept {
  return x.hi < y.hi || (x.hi == y.hi && x.lo < y.lo);
}
constexpr bool operator>(const DoubleDouble& x, const DoubleDouble& y) noexcept { return y < x; }
constexpr bool operator<=(const DoubleDouble& x, const DoubleDouble& y) noexcept { return x < y || x == y; }
constexpr bool operator>=(const DoubleDouble& x, const DoubleDouble& y) noexcept { return y <= x; }

}  // namespace gvd::robust
