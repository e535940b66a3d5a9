#pragma once

#include <array>

#include "gvd/robust/ball.hpp"
#include "gvd/robust/double_double.hpp"
#include "gvd/robust/exact.hpp"
#include "gvd/robust/mpfr_float.hpp"

namespace gvd::predicates {

template <class NT>
struct PlanePoint {
  NT x, y;
};

/// A facet in the frame of its first side: corners (0,0), (1,0) and `apex` with apex.y > 0.
template <class NT>
struct FacetFrame {
  PlanePoint<NT> apex;
  NT length;  ///< of the first side, mesh units: one frame unit
};

/// A wave in the plane of a facet: p sees distance weight + |p - image| if p lies in the cone.
template <class NT>
struct Site {
  PlanePoint<NT> image;
  NT weight;  ///< frame units
  /// The two vertices that bound the cone, unfolded into the plane (windows only; 0 on the side of the origin of the entry side).
  /// A point p of the facet is in the closed cone iff orientation(image, cone[0], p) <= 0 and orientation(image, cone[1], p) >= 0.
  std::array<PlanePoint<NT>, 2> cone;
  bool has_cone = false;
};

}  // namespace gvd::predicates
