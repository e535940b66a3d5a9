#pragma once

#include <cmath>

#include "gvd/predicates/frame.hpp"

namespace gvd::predicates {

/// Where the ray from an image through a point p meets the side [0, 1] of a frame, in doubles: |at - truth| <= margin.
struct Landing {
  double at, margin;
};

/// `disc`: error radius of both points. If the ray may be parallel to the side, the margin exceeds the side (docs/error-bounds.md#landing).
inline Landing land(const Complex<double>& image, const Complex<double>& p, double disc) noexcept {
  const double rise = p.y - image.y;
  const double safe = rise - 4 * disc;
  if (!(safe > 0)) return {0.5, 2};
  const double run = p.x - image.x;
  const double at = image.x - run * image.y / rise;
  return {at, 4 * (disc + 0x1p-53 * std::fabs(at)) * (1 + (std::fabs(run) + std::fabs(at - image.x)) / safe)};
}

}  // namespace gvd::predicates
