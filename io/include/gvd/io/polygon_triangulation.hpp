#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gvd/io/arc_sampler.hpp"

namespace gvd::io {

/// Cuts a counter-clockwise polygon into n - 2 or fewer counter-clockwise triangles (indices into the polygon) by clipping ears. Always
/// ends: a polygon that touches itself by rounding loses the slivers of no area. For pictures. Cost: O(n^2), O(n^3) at worst.
std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(std::span<const PlanePoint> polygon);

}  // namespace gvd::io
