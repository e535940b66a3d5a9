#pragma once

#include <cmath>

#include "gvd/predicates/frame.hpp"
#include "gvd/robust/double_pair.hpp"

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

/// And where the rays through the points p + t along, |t| <= slack, land: within `reach` of `at`. Nothing is known unless `known`.
template <class N, class Known>
struct StretchedLanding {
  N at, margin, reach;
  Known known;
};

/// `size`: |along|, rounded. N: double, or DoublePair for two points at once. Pre: p is not above the side.
template <class N>
[[gnu::always_inline]] inline auto land(const Complex<double>& image, const Complex<N>& p, double disc, const N& slack, const Complex<double>& along,
                                        double size) noexcept {
  using robust::abs;
  using std::abs;
  const N rise = p.y - image.y, run = p.x - image.x, per_rise = 1 / rise;
  const N lift = image.y * per_rise, tilt = run * per_rise;
  const N margin = 4 * disc * (1 + abs(lift)) * (1 + abs(tilt));
  const N stretch = slack * abs(lift * (along.x - tilt * along.y));
  const auto known = (rise > 4 * disc) & (rise > 128 * size * slack);
  return StretchedLanding<N, decltype(known)>{image.x - run * lift, margin, 1.5 * margin + (1 + 0x1p-6) * stretch, known};
}

}  // namespace gvd::predicates
