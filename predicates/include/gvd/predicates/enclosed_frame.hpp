#pragma once

#include <cmath>

#include "gvd/predicates/plane.hpp"
#include "gvd/predicates/strip.hpp"

/// From the discs of an unfolding to balls, the numbers of the short formulas. `unit` is unit<T>(bits).
namespace gvd::predicates {

template <class T>
PlanePoint<robust::Ball<T>> balls(const Disc<T>& z) {
  return {ball_x(z), ball_y(z)};
}

/// The apex of a face over an edge.
template <class T>
PlanePoint<robust::Ball<T>> enclosed_apex(const EdgeFrame<T>& frame, double unit) {
  const double error = kUnfoldingStep * unit * rough_size(Complex<T>{frame.u, frame.y});
  return {robust::Ball<T>(frame.u, error), robust::Ball<T>(frame.y, error)};
}

template <class T>
robust::Ball<T> enclosed_length(const EdgeFrame<T>& frame, double unit) {
  return robust::Ball<T>(frame.length, kUnfoldingStep * unit * rough(frame.length));
}

/// |image - apex|, in the unit of the frame's length.
template <class T>
robust::Ball<T> last_leg(const Disc<T>& image, const EdgeFrame<T>& frame, double unit) {
  return enclosed_length(frame, unit) * sqrt(squared_norm(balls(image) - enclosed_apex(frame, unit)));
}
/// The same numbers, by the processor's own fused multiply-add where it has one.
robust::Ball<robust::DoubleDouble> last_leg(const Disc<robust::DoubleDouble>& image, const EdgeFrame<robust::DoubleDouble>& frame, double unit);

/// A point of the frame of side k of a facet in the frame of side 0, whose apex is w.
template <class NT>
PlanePoint<NT> to_first_side(const PlanePoint<NT>& z, unsigned k, const PlanePoint<NT>& w) {
  if (k == 0) return z;
  const NT one(1.0);
  if (k == 1) {  // 1 + z (w - 1)
    const NT turn = w.x - one;
    return {one + (z.x * turn - z.y * w.y), z.x * w.y + z.y * turn};
  }
  const NT x = one - z.x;  // w (1 - z)
  return {x * w.x + z.y * w.y, x * w.y - z.y * w.x};
}

/// The same for a disc.
template <class T>
PlanePoint<robust::Ball<T>> at_first_side(const Disc<T>& z, unsigned k, const PlanePoint<robust::Ball<T>>& w) {
  return to_first_side(balls(z), k, w);
}
/// In doubles, in one go: docs/error-bounds.md#unfolding.
template <>
inline PlanePoint<robust::Ball<double>> at_first_side(const Disc<double>& z, unsigned k, const PlanePoint<robust::Ball<double>>& w) {
  if (k == 0) return balls(z);
  const bool first = k == 1;
  const double ax = first ? z.mid.x : 1 - z.mid.x, ay = first ? z.mid.y : -z.mid.y;
  const double bx = first ? w.x.mid() - 1 : w.x.mid(), by = w.y.mid();
  const double x = (first ? 1 : 0) + (ax * bx - ay * by), y = ax * by + ay * bx;
  const double size_a = std::fabs(ax) + std::fabs(ay), size_b = std::fabs(bx) + std::fabs(by);
  const double of_apex = w.x.rad() + w.y.rad() + 6 * unit<double>(0) * size_b;
  const double radius = ((size_a + z.radius) * of_apex + size_b * z.radius + 2 * unit<double>(0) * std::fabs(x)) * (1 + 0x1p-40) + 0x1p-1000;
  return {robust::Ball<double>(x, radius), robust::Ball<double>(y, radius)};
}

}  // namespace gvd::predicates
