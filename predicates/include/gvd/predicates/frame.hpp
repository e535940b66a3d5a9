#pragma once

#include <cmath>

namespace gvd::predicates {

/// The frame of a directed edge a -> b of a face (a, b, c): a = 0, b = 1, apex c at u + i y with y > 0.
/// v = 1 - u is kept apart, because 1 - u loses its relative accuracy when c is nearly above b.
/// Errors of the double version: docs/error-bounds.md#frames.
template <class NT>
struct EdgeFrame {
  NT u, v, y;
  NT length;  ///< |b - a|, mesh units
};

/// A point of the plane of a frame.
template <class NT>
struct Complex {
  NT x, y;
};

/// From the frame of a -> b to that of a -> c, over the side c -> a (half-edge `prev`) of the face: z (1 - w_prev).
template <class NT>
inline Complex<NT> cross_left(const Complex<NT>& z, const EdgeFrame<NT>& prev) {
  return {z.x * prev.v + z.y * prev.y, z.y * prev.v - z.x * prev.y};
}

/// From the frame of a -> b to that of c -> b, over the side b -> c (half-edge `next`) of the face: 1 - (1 - z) w_next.
template <class NT>
inline Complex<NT> cross_right(const Complex<NT>& z, const EdgeFrame<NT>& next) {
  const NT x = NT(1.0) - z.x;
  return {NT(1.0) - (x * next.u + z.y * next.y), z.y * next.u - x * next.y};
}

/// The way back, into the frame of a -> b with apex w: from that of a -> c (left) z w, from that of c -> b 1 - (1 - z) (1 - w).
template <class NT>
inline Complex<NT> cross_back(const Complex<NT>& z, const EdgeFrame<NT>& frame, bool left) {
  if (left) return {z.x * frame.u - z.y * frame.y, z.x * frame.y + z.y * frame.u};
  const NT x = NT(1.0) - z.x;
  return {NT(1.0) - (x * frame.v - z.y * frame.y), x * frame.y + z.y * frame.v};
}

/// The apex of a -> b seen from the neighbour's frame b -> a: 1 - w.
template <class NT>
inline Complex<NT> apex_from_behind(const EdgeFrame<NT>& frame) {
  return {frame.v, -frame.y};
}

}  // namespace gvd::predicates
