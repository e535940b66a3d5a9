#pragma once

#include <optional>

#include "mpfr_interval.hpp"

namespace gvd::robust {

/// The double that all members of the interval round to, if there is one.
std::optional<double> rounded(const MpfrInterval& x);

/// The correctly rounded double of an exact number, given `enclosure(bits)` (an interval of relative width about 2^-bits) and
/// `sign_of_difference(q)`, the exact sign of the number minus a rational. At most one exact comparison is made, with the midpoint of
/// two doubles which the enclosure does not tell apart.
template <class Enclosure, class SignOfDifference>
double correctly_rounded(const Enclosure& enclosure, const SignOfDifference& sign_of_difference);

}  // namespace gvd::robust

#include "gvd/robust/rounding.hpp"

namespace gvd::robust {

template <class Enclosure, class SignOfDifference>
double correctly_rounded(const Enclosure& enclosure, const SignOfDifference& sign_of_difference) {
  constexpr int kFirstBits = 128, kLastBits = 256;
  for (int bits = kFirstBits; bits <= kLastBits; bits *= 2)
    if (const auto value = rounded(enclosure(bits))) return *value;
  // The interval is much narrower than the gap between two doubles, so it contains exactly one midpoint.
  double below = enclosure(kLastBits).low().to_double() + 0.0;
  if (below == -std::numeric_limits<double>::infinity()) {
    const double largest = std::numeric_limits<double>::max();
    const Sign sign = sign_of_difference(-rounding_midpoint_above(largest));
    return sign == Sign::positive ? -largest : below;
  }
  const Sign sign = sign_of_difference(rounding_midpoint_above(below));
  const double above = std::nextafter(below, std::numeric_limits<double>::infinity());
  if (sign == Sign::zero) return std::fma(0.5, above - below, below);
  return sign == Sign::negative ? below : above;
}

}  // namespace gvd::robust
