#pragma once

#include "gvd/predicates/plane.hpp"

namespace gvd::predicates {

/// The bisector weight_a + |p - A| = weight_b + |p - B|, cones aside.
enum class Bisector { line, hyperbola, ray, empty };

/// |A - B|^2 - (weight_a - weight_b)^2: positive iff the bisector is a line or a hyperbola branch, zero iff it is the ray behind the
/// focus of the larger weight, negative iff one wave is nearer everywhere. `weight_difference` = weight_a - weight_b; give an exact zero
/// for waves of one root.
template <class NT>
NT bisector_gap(const PlanePoint<NT>& a, const PlanePoint<NT>& b, const NT& weight_difference) {
  return squared_norm(a - b) - square(weight_difference);
}

/// The type of the bisector; empty optional if this number type cannot tell. A ray (gap zero) is known by identity as a rule: a relay
/// and the window whose cone it bounds.
template <class NT>
std::optional<Bisector> bisector_type(const PlanePoint<NT>& a, const PlanePoint<NT>& b, const NT& weight_difference) {
  const robust::MaybeSign gap = maybe_sign(bisector_gap(a, b, weight_difference));
  if (!gap) return std::nullopt;
  if (*gap == robust::Sign::negative) return Bisector::empty;
  if (*gap == robust::Sign::zero) return Bisector::ray;
  const robust::MaybeSign difference = maybe_sign(weight_difference);
  if (!difference) return std::nullopt;
  return *difference == robust::Sign::zero ? Bisector::line : Bisector::hyperbola;
}

}  // namespace gvd::predicates
