#pragma once

#include <optional>

#include "gvd/predicates/plane.hpp"

namespace gvd::predicates {

/// weight + |p - image|, frame units; it is the distance of p along the wave if p lies in the cone.
template <class NT>
NT distance(const Site<NT>& site, const PlanePoint<NT>& p) {
  return site.weight + sqrt(squared_norm(p - site.image));
}

/// On which side of a boundary ray of the cone p lies: positive strictly inside, zero on the ray, negative outside.
/// `end` is the cone vertex, 0 or 1. Pre: site.has_cone.
template <class NT>
NT cone_side(const Site<NT>& site, std::size_t end, const PlanePoint<NT>& p) {
  const NT turn = orientation(site.image, site.cone[end], p);
  return end == 0 ? -turn : turn;
}

/// Whether p lies in the closed cone; empty if this number type cannot tell. Sites without a cone see everything.
/// Pre: p lies in the closed facet. Where a boundary ray is known to pass through p, ask that by identity, not here.
template <class NT>
std::optional<bool> cone_contains(const Site<NT>& site, const PlanePoint<NT>& p) {
  if (!site.has_cone) return true;
  const robust::MaybeSign left = maybe_sign(cone_side(site, 0, p));
  if (left == robust::Sign::negative) return false;
  const robust::MaybeSign right = maybe_sign(cone_side(site, 1, p));
  if (right == robust::Sign::negative) return false;
  if (!left || !right) return std::nullopt;
  return true;
}

}  // namespace gvd::predicates
