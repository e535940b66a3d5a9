#pragma once

#include "gvd/predicates/frame.hpp"
#include "gvd/robust/double_double.hpp"

/// Crossing a face in double-double: what a complex product of double-doubles needs, and one normalisation a coordinate instead of one an operation.
namespace gvd::predicates {

/// One turn, as a disc, relative to (|z|_1 + 1) |q| + |z'|: docs/error-bounds.md#turns-in-double-double.
inline constexpr double kDoubleDoubleTurnError = 0x1p-101;  ///< 32 u^2

/// high + low, in which low may have more than half an ulp of high.
struct UnevenSum {
  double high, low;
};

/// a b + c d.
inline UnevenSum sum_of_products(const UnevenSum& a, const robust::DoubleDouble& b, const UnevenSum& c, const robust::DoubleDouble& d) noexcept {
  const robust::DoubleDouble p = robust::two_prod(a.high, b.hi), q = robust::two_prod(c.high, d.hi), s = robust::two_sum(p.hi, q.hi);
  const double of_p = std::fma(a.low, b.hi, std::fma(a.high, b.lo, p.lo));
  const double of_q = std::fma(c.low, d.hi, std::fma(c.high, d.lo, q.lo));
  return {s.hi, s.lo + (of_p + of_q)};
}

/// base + sign z, for a base of 0 or 1 and a sign of 1 or -1.
inline UnevenSum shifted(const UnevenSum& z, double base, double sign) noexcept {
  const robust::DoubleDouble d = robust::two_sum(base, sign * z.high);
  return {d.hi, d.lo + sign * z.low};
}

/// z to the left over a side with (v, y) = (along, across), base 0, or to the right over one with (u, y), base 1: without a branch, as nobody can foresee
/// which way a strip turns.
inline Complex<robust::DoubleDouble> turned(const Complex<robust::DoubleDouble>& z, const robust::DoubleDouble& along, const robust::DoubleDouble& across,
                                            double base) noexcept {
  const double sign = 1 - 2 * base;
  const UnevenSum x = shifted({z.x.hi, z.x.lo}, base, sign), y{z.y.hi, z.y.lo};
  const UnevenSum to_x = shifted(sum_of_products(x, along, y, across), base, sign), to_y = sum_of_products(y, along, {-x.high, -x.low}, across);
  return {robust::two_sum(to_x.high, to_x.low), robust::two_sum(to_y.high, to_y.low)};
}

}  // namespace gvd::predicates
