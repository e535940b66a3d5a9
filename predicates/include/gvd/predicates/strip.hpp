#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "gvd/predicates/double_double_turn.hpp"
#include "gvd/predicates/frame.hpp"
#include "gvd/robust/ball.hpp"

namespace gvd::predicates {

/// One face of a strip: the side by which the strip leaves it, and whether its apex bounds the cone from then on.
struct StripStep {
  std::uint32_t side;  ///< half-edge of the face that is left
  bool left;           ///< over `prev` (towards the origin's side), otherwise over `next`
  bool bounds;         ///< the apex was in the cone
};

/// A root, its first face with the side opposite the root, and the faces crossed from there on.
struct Strip {
  std::uint32_t opposite;  ///< half-edge of the root's face
  std::vector<StripStep> steps;
};

/// A point of a frame with an error disc: |truth - mid| <= radius, in units of the frame.
template <class T>
struct Disc {
  Complex<T> mid;
  double radius = 0;
};

/// Error of one step of an unfolding, relative to the sizes involved (docs/error-bounds.md#unfolding). `unit<T>(bits)` bounds the relative
/// error of one operation of T.
template <class T>
double unit(int bits);
template <>
inline double unit<double>(int) {
  return 0x1p-53;
}
template <>
inline double unit<robust::DoubleDouble>(int) {
  return robust::kDoubleDoubleQuotientError;
}
template <>
inline double unit<robust::Mpfr>(int bits) {
  return std::ldexp(1.0, -bits);
}
inline constexpr double kUnfoldingStep = 32;

inline double rough(double x) { return x; }
inline double rough(const robust::DoubleDouble& x) { return x.hi; }
inline double rough(const robust::Mpfr& x) { return x.to_double(); }
template <class T>
double rough_size(const Complex<T>& z) {
  return std::fabs(rough(z.x)) + std::fabs(rough(z.y));
}

/// An upper bound of sqrt(x^2 + y^2): the second summand is above what underflows.
inline double length_bound(double x, double y) { return std::sqrt(x * x + y * y) * (1 + 0x1p-40) + 0x1p-500; }

/// The radius of z's disc after a turn by a factor of length at most `turn` that leads to `to`: relative error of the frame and of the product, both below
/// kUnfoldingStep / 2 units of the sizes added here. What waits for the former radius is one product and one sum.
template <class T>
double radius_after(const Disc<T>& z, const Complex<T>& to, double turn, double unit_of_t) {
  const double size = (rough_size(z.mid) + 1) * turn + rough_size(to) + 1;
  return z.radius * (turn * (1 + 0x1p-40)) + (kUnfoldingStep * (1 + 0x1p-40) * unit_of_t * size + 0x1p-1000);
}

template <class T>
Disc<T> cross(const Disc<T>& z, const EdgeFrame<T>& side, bool left, double unit_of_t) {
  Disc<T> result{left ? cross_left(z.mid, side) : cross_right(z.mid, side), 0};
  result.radius = radius_after(z, result.mid, length_bound(rough(left ? side.v : side.u), rough(side.y)), unit_of_t);
  return result;
}

/// In double-double, by the processor's own fused multiply-add where it has one.
Disc<robust::DoubleDouble> cross(const Disc<robust::DoubleDouble>& z, const EdgeFrame<robust::DoubleDouble>& side, bool left, double unit_of_t);

template <class T>
robust::Ball<T> ball_x(const Disc<T>& z) {
  return {z.mid.x, z.radius};
}
template <class T>
robust::Ball<T> ball_y(const Disc<T>& z) {
  return {z.mid.y, z.radius};
}

/// The image of the root and the two vertices that bound the cone, in the frame of the last half-edge.
template <class T>
struct Unfolding {
  Disc<T> image, cone0, cone1;
};

/// The root of a strip behind its first half-edge, whose twin's frame this is.
template <class T>
Unfolding<T> unfold_first(const EdgeFrame<T>& opposite, double unit_of_t) {
  Unfolding<T> at;
  at.image.mid = apex_from_behind(opposite);
  at.image.radius = kUnfoldingStep * unit_of_t * (rough_size(at.image.mid) + 1) + 0x1p-1000;
  at.cone0.mid = {T(0.0), T(0.0)};
  at.cone1.mid = {T(1.0), T(0.0)};
  return at;
}

/// One face further, for a way to cross it; `bounds` as in StripStep.
template <bool kCone, class T, class Cross>
void unfold_step_by(Unfolding<T>& at, bool left, bool bounds, const Cross& cross) {
  at.image = cross(at.image);
  if constexpr (kCone) {
    at.cone0 = bounds && !left ? Disc<T>{{T(0.0), T(0.0)}, 0} : cross(at.cone0);
    at.cone1 = bounds && left ? Disc<T>{{T(1.0), T(0.0)}, 0} : cross(at.cone1);
  }
}
template <class T, bool kCone = true>
void unfold_step(Unfolding<T>& at, const EdgeFrame<T>& side, bool left, bool bounds, double unit_of_t) {
  unfold_step_by<kCone>(at, left, bounds, [&](const Disc<T>& z) { return cross(z, side, left, unit_of_t); });
}

/// A step with its numbers at hand: those that `turned` takes.
struct DoubleDoubleStep {
  const robust::DoubleDouble *along, *across;
  double base;
  bool left, bounds;
};
inline DoubleDoubleStep step_over(const EdgeFrame<robust::DoubleDouble>& side, bool left, bool bounds) {
  return {left ? &side.v : &side.u, &side.y, static_cast<double>(!left), left, bounds};
}
/// The same numbers as by `unfold_step` for each, by the processor's own fused multiply-add where it has one.
template <bool kCone>
void unfold_steps(Unfolding<robust::DoubleDouble>& at, std::span<const DoubleDoubleStep> steps);
extern template void unfold_steps<false>(Unfolding<robust::DoubleDouble>& at, std::span<const DoubleDoubleStep> steps);
extern template void unfold_steps<true>(Unfolding<robust::DoubleDouble>& at, std::span<const DoubleDoubleStep> steps);

/// Unfolds a strip; `frame(h)` gives EdgeFrame<T>, for double-double by a reference that stays. With `kCone` false the cone is not computed.
/// Cost: one complex product a face and point.
template <class T, bool kCone = true, class FrameOf>
Unfolding<T> unfold(const Strip& strip, FrameOf&& frame, int bits = 0) {
  const double u = unit<T>(bits);
  Unfolding<T> at = unfold_first<T>(frame(strip.opposite), u);
  if constexpr (std::is_same_v<T, robust::DoubleDouble>) {
    static_assert(std::is_lvalue_reference_v<decltype(frame(strip.opposite))>);
    std::array<DoubleDoubleStep, 32> next;
    std::size_t n = 0;
    for (const StripStep& step : strip.steps) {
      next[n++] = step_over(frame(step.side), step.left, step.bounds);
      if (n == next.size()) unfold_steps<kCone>(at, next), n = 0;
    }
    unfold_steps<kCone>(at, std::span(next).first(n));
  } else {
    for (const StripStep& step : strip.steps) unfold_step<T, kCone>(at, frame(step.side), step.left, step.bounds, u);
  }
  return at;
}

}  // namespace gvd::predicates
