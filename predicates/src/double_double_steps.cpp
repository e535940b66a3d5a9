#include "double_double_steps.hpp"

#include "fused_multiply_add.hpp"
#include "gvd/predicates/enclosed_frame.hpp"

namespace gvd::predicates {

using robust::DoubleDouble;

namespace {

using Frame = EdgeFrame<DoubleDouble>;

inline Disc<DoubleDouble> cross_here(const Disc<DoubleDouble>& z, const DoubleDoubleStep& step) {
  Disc<DoubleDouble> result{turned(z.mid, *step.along, *step.across, step.base), 0};
  result.radius = radius_after(z, result.mid, length_bound(step.along->hi, step.across->hi), unit<DoubleDouble>(0));
  return result;
}
template <bool kCone>
inline void unfold_steps_here(Unfolding<DoubleDouble>& at, std::span<const DoubleDoubleStep> steps) {
  Unfolding<DoubleDouble> here = at;
  for (const DoubleDoubleStep& step : steps)
    unfold_step_by<kCone>(here, step.left, step.bounds, [&](const Disc<DoubleDouble>& z) { return cross_here(z, step); });
  at = here;
}

GVD_FMA Disc<DoubleDouble> cross_by_fma(const Disc<DoubleDouble>& z, const DoubleDoubleStep& step) { return cross_here(z, step); }
template <bool kCone>
GVD_FMA void unfold_steps_by_fma(Unfolding<DoubleDouble>& at, std::span<const DoubleDoubleStep> steps) {
  unfold_steps_here<kCone>(at, steps);
}
GVD_FMA robust::Ball<DoubleDouble> last_leg_by_fma(const Disc<DoubleDouble>& image, const Frame& frame, double unit) {
  return last_leg<DoubleDouble>(image, frame, unit);
}

}  // namespace

namespace without_fma {

Disc<DoubleDouble> cross(const Disc<DoubleDouble>& z, const DoubleDoubleStep& step) { return cross_here(z, step); }
template <bool kCone>
void unfold_steps(Unfolding<DoubleDouble>& at, std::span<const DoubleDoubleStep> steps) {
  unfold_steps_here<kCone>(at, steps);
}
template void unfold_steps<false>(Unfolding<DoubleDouble>& at, std::span<const DoubleDoubleStep> steps);
template void unfold_steps<true>(Unfolding<DoubleDouble>& at, std::span<const DoubleDoubleStep> steps);

}  // namespace without_fma

Disc<DoubleDouble> cross(const Disc<DoubleDouble>& z, const Frame& side, bool left, double) {
  const DoubleDoubleStep step = step_over(side, left, false);
  return has_fma() ? cross_by_fma(z, step) : without_fma::cross(z, step);
}

robust::Ball<DoubleDouble> last_leg(const Disc<DoubleDouble>& image, const Frame& frame, double unit) {
  return has_fma() ? last_leg_by_fma(image, frame, unit) : last_leg<DoubleDouble>(image, frame, unit);
}

template <bool kCone>
void unfold_steps(Unfolding<DoubleDouble>& at, std::span<const DoubleDoubleStep> steps) {
  has_fma() ? unfold_steps_by_fma<kCone>(at, steps) : without_fma::unfold_steps<kCone>(at, steps);
}
template void unfold_steps<false>(Unfolding<DoubleDouble>& at, std::span<const DoubleDoubleStep> steps);
template void unfold_steps<true>(Unfolding<DoubleDouble>& at, std::span<const DoubleDoubleStep> steps);

}  // namespace gvd::predicates
