#pragma once

#include <bit>
#include <cstdint>
#include <optional>

#include "gvd/robust/rounding.hpp"
#include "mpfr_interval.hpp"

namespace gvd::robust {

/// The double that all members of the interval round to, if there is one. Pre: the ends are finite.
std::optional<double> rounded(const MpfrInterval& x);

/// Whether the last bit of the significand is 0; infinity counts as even, as rounding to nearest has it.
inline bool is_even(double x) { return (std::bit_cast<std::uint64_t>(x) & 1) == 0; }

/// The correctly rounded double of an exact number, given `enclosure(bits)` (an interval of relative width at most 2^-bits, finite) and
/// `sign_of_difference(q)`, the sign of the number minus a rational. At most one exact comparison is made, with the midpoint of
/// two doubles that the enclosure does not tell apart; empty if that has no answer.
template <class Enclosure, class SignOfDifference>
std::optional<double> correctly_rounded(const Enclosure& enclosure, const SignOfDifference& sign_of_difference) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kLargest = std::numeric_limits<double>::max();
  constexpr int kFirstBits = 128, kLastBits = 256;
  for (int bits = kFirstBits; bits <= kLastBits; bits *= 2)
    if (const auto value = rounded(enclosure(bits))) return value;
  // The interval is much narrower than the gap between two doubles, so it contains exactly one midpoint.
  const double below = enclosure(kLastBits).low().to_double() + 0.0;
  const double above = below == -kInfinity ? -kLargest : std::nextafter(below, kInfinity);
  const mpq_class midpoint = below == -kInfinity ? mpq_class(-rounding_midpoint_above(kLargest)) : rounding_midpoint_above(below);
  const MaybeSign sign = sign_of_difference(midpoint);
  if (!sign) return std::nullopt;
  if (*sign == Sign::zero) return is_even(below) ? below : above;
  return *sign == Sign::negative ? below : above;
}

}  // namespace gvd::robust
