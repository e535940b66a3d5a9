#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

// Compiled twice, for AVX and for every processor, with the same numbers: no operation is fused or put in another order.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define GVD_ALSO_FOR_AVX __attribute__((target_clones("avx2", "default")))
#else
#define GVD_ALSO_FOR_AVX
#endif
#define GVD_IN_LANES [[gnu::always_inline]] inline

namespace gvd::predicates {

/// As many doubles as the widest registers in use hold; where they are narrower, the compiler takes two.
inline constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(32), aligned(8), may_alias));
using LaneMask = std::int64_t __attribute__((vector_size(32), aligned(8), may_alias));

inline std::size_t rounded_to_lanes(std::size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }

GVD_IN_LANES const Lanes& lanes(const double* from) { return *reinterpret_cast<const Lanes*>(from); }
GVD_IN_LANES Lanes& lanes(double* to) { return *reinterpret_cast<Lanes*>(to); }
GVD_IN_LANES LaneMask& lanes(std::int64_t* to) { return *reinterpret_cast<LaneMask*>(to); }
/// In place: vectors are not passed by value, since the two versions would do it differently.
GVD_IN_LANES Lanes& make_positive(Lanes& x) {
  reinterpret_cast<LaneMask&>(x) &= LaneMask{INT64_MAX, INT64_MAX, INT64_MAX, INT64_MAX};
  return x;
}

}  // namespace gvd::predicates
