#pragma once

#include "gvd/predicates/site.hpp"

namespace gvd::predicates {

template <class NT>
PlanePoint<NT> operator+(const PlanePoint<NT>& a, const PlanePoint<NT>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <class NT>
PlanePoint<NT> operator-(const PlanePoint<NT>& a, const PlanePoint<NT>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class NT>
PlanePoint<NT> operator*(const NT& factor, const PlanePoint<NT>& a) {
  return {factor * a.x, factor * a.y};
}
template <class NT>
NT dot(const PlanePoint<NT>& a, const PlanePoint<NT>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class NT>
NT cross(const PlanePoint<NT>& a, const PlanePoint<NT>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class NT>
NT squared_norm(const PlanePoint<NT>& a) {
  return square(a.x) + square(a.y);
}
/// Twice the signed area of the triangle a, b, c: positive iff it is counter-clockwise.
template <class NT>
NT orientation(const PlanePoint<NT>& a, const PlanePoint<NT>& b, const PlanePoint<NT>& c) {
  return cross(b - a, c - a);
}

/// Corner k of a facet, in its frame.
template <class NT>
PlanePoint<NT> corner_point(const FacetFrame<NT>& frame, std::size_t k) {
  if (k == 0) return {NT(0.0), NT(0.0)};
  if (k == 1) return {NT(1.0), NT(0.0)};
  return frame.apex;
}

/// Whether a number is more likely positive than not: chooses between two formulas that are both right, never decides anything.
template <class NT>
bool likely_positive(const NT& a) {
  if constexpr (std::is_same_v<NT, robust::Exact>)
    return maybe_sign(a) == robust::Sign::positive;
  else
    return robust::Midpoint<typename NT::Mid>::nearest(a.mid()) > 0;
}

}  // namespace gvd::predicates
