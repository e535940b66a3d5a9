#pragma once

#include <cstdint>

#include "gvd/kernel/random_generator.hpp"

namespace gvd::fuzz {

/// Draws from a 64-bit seed; the same on every machine (kernel::RandomGenerator, IEEE + - * / and scaling by powers of two only).
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}

  std::uint64_t bits() { return generator_.next(); }
  /// In [0, n), n > 0.
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(generator_.below(n)); }
  /// In [low, high].
  int between(int low, int high) { return low + static_cast<int>(below(static_cast<std::uint32_t>(high - low + 1))); }
  bool one_in(std::uint32_t n) { return below(n) == 0; }
  /// A multiple of 2^-53 in [0, 1).
  double unit() { return static_cast<double>(generator_.bits(53)) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }

  /// A double put together from its bits: any sign, an exponent of [low, high], and a significand that is random, short, almost a
  /// power of two from above or below, or has long runs of equal bits.
  double bit_double(int low_exponent, int high_exponent);
  /// x moved by up to `ulps` units in the last place, to either side.
  double nudged(double x, int ulps);

 private:
  std::uint64_t significand();
  kernel::RandomGenerator generator_;
};

/// Mixes numbers to a seed; different arguments give independent streams.
std::uint64_t mixed_seed(std::uint64_t a, std::uint64_t b);

}  // namespace gvd::fuzz
