#pragma once

#include "gvd/predicates/plane.hpp"

namespace gvd::predicates {

/// |A - B|^2 - (weight_a - weight_b)^2. Of the bisector weight_a + |p - A| = weight_b + |p - B|, cones aside: positive iff it is a line or a hyperbola
/// branch, zero iff it is the ray behind the focus of the larger weight, negative iff one wave is nearer everywhere.
/// `weight_difference` = weight_a - weight_b; give an exact zero for waves of one root.
template <class NT>
NT bisector_gap(const PlanePoint<NT>& a, const PlanePoint<NT>& b, const NT& weight_difference) {
  return squared_norm(a - b) - square(weight_difference);
}

}  // namespace gvd::predicates
