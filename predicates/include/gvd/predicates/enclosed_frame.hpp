#pragma once

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

}  // namespace gvd::predicates
