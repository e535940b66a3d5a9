#include "window_interval.hpp"

#include <algorithm>
#include <cmath>

#include "gvd/predicates/filter_error.hpp"

namespace gvd::kernel {
namespace {

using predicates::kDistanceError;
using predicates::kUnit;

/// Distance and slope along the side of a wave at x.
struct Profile {
  double distance, slope, reach;
};
Profile profile(const WindowInterval& wave, double x, double length) {
  const double dx = x - wave.image.x;
  const double r = std::sqrt(dx * dx + wave.image.y * wave.image.y);
  return {wave.weight + length * r, dx / r, r};
}

}  // namespace

Trim trim(WindowInterval& first, WindowInterval& second, double length) {
  const double low = second.begin, high = std::min(first.end, second.end);
  if (!(low < high)) return Trim::none;
  const Profile a0 = profile(first, low, length), b0 = profile(second, low, length);
  const Profile a1 = profile(first, high, length), b1 = profile(second, high, length);
  const double error = (first.weight_error + first.image_error) + (second.weight_error + second.image_error) +
                       kDistanceError * (a0.distance + b0.distance + a1.distance + b1.distance);
  const double g0 = b0.distance - a0.distance, g1 = b1.distance - a1.distance;
  if (std::fabs(g0) <= error || std::fabs(g1) <= error) return Trim::none;
  const double disc = 4 * (first.image_error + second.image_error) / length;
  const bool first_seen = low >= first.begin + first.begin_slack && high <= first.end - first.end_slack;
  const bool second_seen = low >= second.begin + second.begin_slack && high <= second.end - second.end_slack;
  if ((g0 > 0) == (g1 > 0)) {
    // The difference has at most one critical point: it keeps its sign unless it dips in between.
    const double slope0 = b0.slope - a0.slope, slope1 = b1.slope - a1.slope;
    const double slope_error = disc * (1 / a0.reach + 1 / b0.reach + 1 / a1.reach + 1 / b1.reach) + 16 * kUnit;
    if (g0 > 0) {
      if (!(slope0 > slope_error || slope1 < -slope_error)) return Trim::none;
      const double seen = std::min(high, first.end - first.end_slack);
      if (low < first.begin + first.begin_slack) return Trim::none;
      if (second.end <= seen) return Trim::drop_second;
      if (seen > second.begin + second.begin_slack) {
        second.begin = seen;
        second.begin_slack = 0;
        second.begin_trimmed = true;
      }
      return Trim::none;
    }
    if (!(slope0 < -slope_error || slope1 > slope_error)) return Trim::none;
    if (first.end > second.end - second.end_slack) return Trim::none;
    const double seen = second.begin + second.begin_slack;
    if (first.begin >= seen) return Trim::drop_first;
    if (seen < first.end - first.end_slack) {
      first.end = seen;
      first.end_slack = 0;
      first.end_trimmed = true;
    }
    return Trim::none;
  }
  if (g0 < 0 || !first_seen || !second_seen) return Trim::none;
  // One root: first is shorter before it, second after it.
  double left = low, right = high, gl = g0, gr = g1;
  for (int i = 0; i < 3; ++i) {
    const double x = left + (right - left) * (gl / (gl - gr));
    if (!(x > left && x < right)) break;
    const double width = right - left;
    for (const double probe : {x - width * 0x1p-10, x + width * 0x1p-10}) {
      if (!(probe > left && probe < right)) continue;
      const double g = profile(second, probe, length).distance - profile(first, probe, length).distance;
      if (g > error) {
        left = probe;
        gl = g;
      } else if (g < -error) {
        right = probe;
        gr = g;
      }
    }
  }
  if (left > low) {
    second.begin = left;
    second.begin_slack = 0;
    second.begin_trimmed = true;
  }
  if (right < first.end && first.end <= second.end) {  // what lies beyond the second is not its to cut off
    first.end = right;
    first.end_slack = 0;
    first.end_trimmed = true;
  }
  return Trim::none;
}

}  // namespace gvd::kernel
