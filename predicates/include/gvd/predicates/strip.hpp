#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

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

template <class T>
Disc<T> cross(const Disc<T>& z, const EdgeFrame<T>& side, bool left, double unit_of_t) {
  Disc<T> result{left ? cross_left(z.mid, side) : cross_right(z.mid, side), 0};
  // |q| of the turn: relative error of the frame and of the product, both below kUnfoldingStep / 2 units of the sizes added here.
  const double turn = length_bound(rough(left ? side.v : side.u), rough(side.y));
  const double size = (rough_size(z.mid) + 1 + z.radius) * turn + rough_size(result.mid) + 1;
  result.radius = (z.radius * turn + kUnfoldingStep * unit_of_t * size) * (1 + 0x1p-40) + 0x1p-1000;
  return result;
}

/// The same numbers, by the processor's own fused multiply-add where it has one.
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

/// One face further, over `side`; `bounds` as in StripStep.
template <class T, bool kCone = true>
void unfold_step(Unfolding<T>& at, const EdgeFrame<T>& side, bool left, bool bounds, double unit_of_t) {
  at.image = cross(at.image, side, left, unit_of_t);
  if constexpr (kCone) {
    if (bounds && !left)
      at.cone0 = {{T(0.0), T(0.0)}, 0};
    else
      at.cone0 = cross(at.cone0, side, left, unit_of_t);
    if (bounds && left)
      at.cone1 = {{T(1.0), T(0.0)}, 0};
    else
      at.cone1 = cross(at.cone1, side, left, unit_of_t);
  }
}

/// Unfolds a strip; `frame(h)` gives EdgeFrame<T>. With `kCone` false the cone is not computed. Cost: one complex product a face and point.
template <class T, bool kCone = true, class FrameOf>
Unfolding<T> unfold(const Strip& strip, FrameOf&& frame, int bits = 0) {
  const double u = unit<T>(bits);
  Unfolding<T> at = unfold_first<T>(frame(strip.opposite), u);
  for (const StripStep& step : strip.steps) unfold_step<T, kCone>(at, frame(step.side), step.left, step.bounds, u);
  return at;
}

}  // namespace gvd::predicates
