#pragma once

/// What is done most often in double-double is compiled twice: for processors with fused multiply-add, and for those without, on which std::fma is a call.
/// Both are the same algorithms and correctly rounded, so they give the same numbers.
#if defined(__x86_64__) && !defined(__FMA__) && defined(__GNUC__)
#define GVD_CHOOSES_FMA 1
#define GVD_FMA __attribute__((target("fma"), flatten))

namespace gvd::predicates {

inline bool has_fma() {
  static const bool has = __builtin_cpu_supports("fma") != 0;
  return has;
}

}  // namespace gvd::predicates
#else
#define GVD_FMA

namespace gvd::predicates {

constexpr bool has_fma() { return false; }

}  // namespace gvd::predicates
#endif
