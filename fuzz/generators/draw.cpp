#include "fuzz/generators/draw.hpp"

#include <cmath>
#include <limits>

namespace gvd::fuzz {

std::uint64_t Draw::significand() {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 52) - 1;
  switch (below(5)) {
    case 0:
      return 0;
    case 1:
      return bits() & kMask & ~(kMask >> (1 + below(12)));  // few leading bits
    case 2:
      return below(4);  // just above a power of two
    case 3:
      return kMask - below(4);  // just below the next one
    default:
      return bits() & kMask;
  }
}

double Draw::bit_double(int low_exponent, int high_exponent) {
  const double magnitude =
      std::ldexp(1 + std::ldexp(static_cast<double>(significand()), -52), between(low_exponent, high_exponent));
  return one_in(2) ? -magnitude : magnitude;
}

double Draw::nudged(double x, int ulps) {
  const int steps = between(-ulps, ulps);
  const double to = steps < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::abs(steps); ++i) x = std::nextafter(x, to);
  return x;
}

std::uint64_t mixed_seed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t state = a;
  state = kernel::splitmix64(state) ^ (b * 0x9e3779b97f4a7c15u);
  return kernel::splitmix64(state);
}

}  // namespace gvd::fuzz
