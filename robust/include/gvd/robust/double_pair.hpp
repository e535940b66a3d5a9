#pragma once

#include <cmath>
#include <cstdint>

namespace gvd::robust {

/// Two doubles at once, for what is alike at both ends of something. Every operation is that of IEEE in each lane, so the numbers are those of two doubles
/// one after the other.
using DoublePair = double __attribute__((vector_size(16)));
/// All bits set, or none, a lane: what a comparison gives.
using PairMask = std::int64_t __attribute__((vector_size(16)));

inline DoublePair choose(PairMask which, DoublePair yes, DoublePair no) noexcept { return which ? yes : no; }

inline DoublePair abs(DoublePair x) noexcept {
  return reinterpret_cast<DoublePair>(reinterpret_cast<PairMask>(x) & PairMask{INT64_MAX, INT64_MAX});
}

/// Lane k as bit k.
inline unsigned bits(PairMask mask) noexcept {
#ifdef __SSE2__
  return static_cast<unsigned>(__builtin_ia32_movmskpd(reinterpret_cast<DoublePair>(mask)));
#else
  return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2));
#endif
}
/// Pre: bits < 4.
inline PairMask mask_of(unsigned bits) noexcept {
  static const PairMask kMasks[] = {{0, 0}, {-1, 0}, {0, -1}, {-1, -1}};
  return kMasks[bits];
}

inline bool any(PairMask mask) noexcept { return bits(mask) != 0; }

}  // namespace gvd::robust
