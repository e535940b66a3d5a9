#pragma once

#include <cmath>

#include "gvd/predicates/frame.hpp"

namespace gvd::predicates {

/// Where the ray from an image through a point p meets the side [0, 1] of a frame, in doubles: |at - truth| <= margin.
struct Landing {
  double at, margin;
};

/// Nothing is known.
inline constexpr Landing kNoLanding{0.5, 4};

/// `disc`: error radius of both points, at least 16 u (1 + |image|_1). If the ray may be parallel to the side, the margin exceeds the side.
/// Rounding included; at least disc / 2 to spare (docs/error-bounds.md#landing).
inline Landing land(const Complex<double>& image, const Complex<double>& p, double disc) noexcept {
  const double rise = p.y - image.y;
  if (!(rise > 4 * disc)) return kNoLanding;
  const double run = p.x - image.x;
  const double lift = image.y / rise;
  return {image.x - run * lift, 4 * disc * (1 + std::fabs(lift)) * (1 + std::fabs(run) / rise)};
}

/// And where the rays through the points p + t along, |t| <= slack, land: within `reach` of `at`.
struct StretchedLanding {
  double at, margin, reach;
};

/// `size`: |along|, rounded. Pre: p is not above the side.
[[gnu::always_inline]] inline StretchedLanding land(const Complex<double>& image, const Complex<double>& p, double disc, double slack, const Complex<double>& along,
                             double size) noexcept {
  const double rise = p.y - image.y;
  if (!(rise > 4 * disc)) return {kNoLanding.at, kNoLanding.margin, kNoLanding.margin};
  const double run = p.x - image.x, per_rise = 1 / rise;
  const double lift = image.y * per_rise, tilt = run * per_rise;
  const double margin = 4 * disc * (1 + std::fabs(lift)) * (1 + std::fabs(tilt));
  const double stretch = slack * std::fabs(lift * (along.x - tilt * along.y));
  return {image.x - run * lift, margin, rise > 128 * slack * size ? 1.5 * margin + (1 + 0x1p-6) * stretch : kNoLanding.margin};
}

}  // namespace gvd::predicates
