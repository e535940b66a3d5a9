#pragma once

#include <cstdint>

#include "gvd/predicates/frame.hpp"

namespace gvd::kernel {

/// The bits of the two ends of a window, beside the origin and beside the target of its half-edge.
enum WindowEnd : std::uint8_t { kAtBegin = 1, kAtEnd = 2 };

template <class T>
struct Ends {
  T begin, end;
};

/// The numbers of a window in the frame of its half-edge, with error bounds; lengths in scaled units.
struct WindowInterval {
  predicates::Complex<double> image;
  double begin, end;   ///< an interval of [0, 1] that contains what is seen and may be shortest
  double weight;       ///< D at the root
  double image_error;  ///< radius of a disc about the image (and the cone's vertices), as a length
  float weight_error;  ///< of the weight
  Ends<float> slack;   ///< [begin + slack.begin, end - slack.end] is certainly seen
  std::uint8_t trimmed;  ///< at these ends: beyond it another window is certainly shorter
  std::uint8_t bounded;  ///< at these ends: the cone is bounded by the end of the side itself
};

enum class Trim : std::uint8_t { none, drop_first, drop_second };

/// Cuts off what is certainly longer where two windows of one half-edge of that length overlap, or tells that one is longer everywhere.
/// Only the ends of the intervals of doubles move; the cones stay, so nothing that is decided exactly depends on it.
/// Made for first.begin <= second.begin; sound without. Error bounds: docs/error-bounds.md#trimming.
Trim trim(WindowInterval& first, WindowInterval& second, double length);

/// Overlaps shorter than this are left to both windows: that costs next to nothing, and most neighbours have been cut at their tie before.
inline constexpr double kShortOverlap = 0x1p-16;
/// Whether the second window goes on where the first ends, or all but.
inline bool is_only_touched(const WindowInterval& first, const WindowInterval& second) noexcept {
  return first.end - second.begin < kShortOverlap && first.begin < second.begin && first.end < second.end;
}

}  // namespace gvd::kernel
