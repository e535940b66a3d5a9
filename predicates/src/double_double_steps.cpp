// What is done most often in double-double, twice: for processors with fused multiply-add, and for those without, on which std::fma is a call.
// Both are the same algorithms and correctly rounded, so they give the same numbers.
#include "gvd/predicates/face_frames.hpp"
#include "gvd/predicates/strip.hpp"

#if defined(__x86_64__) && !defined(__FMA__) && defined(__GNUC__)
#define GVD_CHOOSES_FMA 1
#define GVD_FMA __attribute__((target("fma"), flatten))
#endif

namespace gvd::predicates {
namespace {

using robust::DoubleDouble;
using Side = Vector<DoubleDouble>;
using Frame = EdgeFrame<DoubleDouble>;

#ifdef GVD_CHOOSES_FMA
bool has_fma() {
  static const bool has = __builtin_cpu_supports("fma") != 0;
  return has;
}
GVD_FMA Disc<DoubleDouble> cross_by_fma(const Disc<DoubleDouble>& z, const Frame& side, bool left, double unit_of_t) {
  return cross<DoubleDouble>(z, side, left, unit_of_t);
}
GVD_FMA std::array<Frame, 3> face_frames_by_fma(const Side& ab, const Side& bc, const Side& ca) {
  return face_frames<DoubleDouble>(ab, bc, ca);
}
#endif

}  // namespace

Disc<DoubleDouble> cross(const Disc<DoubleDouble>& z, const Frame& side, bool left, double unit_of_t) {
#ifdef GVD_CHOOSES_FMA
  if (has_fma()) return cross_by_fma(z, side, left, unit_of_t);
#endif
  return cross<DoubleDouble>(z, side, left, unit_of_t);
}

std::array<Frame, 3> face_frames(const Side& ab, const Side& bc, const Side& ca) {
#ifdef GVD_CHOOSES_FMA
  if (has_fma()) return face_frames_by_fma(ab, bc, ca);
#endif
  return face_frames<DoubleDouble>(ab, bc, ca);
}

}  // namespace gvd::predicates
