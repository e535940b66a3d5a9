#pragma once

namespace gvd::kernel {

struct PlanePosition {
  double x = 0, y = 0;
};

/// Half the integral of x dy - y dx along the segment.
double straight_area(PlanePosition from, PlanePosition to);

/// Half the integral of x dy - y dx along the conic weight + |p - focus| = other_weight + |p - other_focus| from one of its points
/// to another. Rounded; relative error about 1e-12 of the sector seen from the focus.
double conic_area(PlanePosition focus, double weight, PlanePosition other_focus, double other_weight, PlanePosition from,
                  PlanePosition to);

}  // namespace gvd::kernel
