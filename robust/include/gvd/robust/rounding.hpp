#pragma once

#include <cmath>
#include <optional>

#include "gvd/robust/ball.hpp"

namespace gvd::robust {

/// The double nearest to the truth (ties to even, subnormals and overflow to infinity as IEEE 754 has them, zero without a sign)
/// if all members of the ball round to the same one; otherwise nothing. A ball that contains a midpoint of two doubles rounds
/// only if it is that point alone. Cost: about ten operations.
inline std::optional<double> rounded(const Ball<DoubleDouble>& x) {
  const double hi = x.mid().hi, lo = x.mid().lo;
  if (!std::isfinite(hi)) return std::nullopt;
  if (x.rad() == 0) return hi + 0.0;
  // Rounding is monotone, and hi + below rounds the exact sum: so all of [hi + below, hi + above] rounds alike if its ends do.
  const double slack = (std::fabs(lo) + x.rad()) * 0x1p-51 + 0x1p-1074;
  const double below = hi + ((lo - x.rad()) - slack);
  const double above = hi + ((lo + x.rad()) + slack);
  if (below == above) return below + 0.0;
  return std::nullopt;
}

inline std::optional<double> rounded(const Ball<double>& x) { return rounded(Ball<DoubleDouble>(DoubleDouble(x.mid()), x.rad())); }

std::optional<double> rounded(const Ball<Mpfr>& x);

/// The midpoint of a finite double and the next one above, exactly; above the largest double, the least number that rounds to
/// infinity.
mpq_class rounding_midpoint_above(double x);

}  // namespace gvd::robust
