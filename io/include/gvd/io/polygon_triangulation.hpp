#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gvd/io/arc_sampler.hpp"

namespace gvd::io {

/// Cuts a polygon with holes into counter-clockwise triangles (indices into the points of all rings, one after the other). Ring 0 is the
/// outline, counter-clockwise; the others are holes, clockwise. A hole is joined to the ring around it by a bridge, then ears are clipped.
/// Always ends: rings that touch by rounding lose slivers of no area. For pictures. Cost: O(n^2) for n points, O(n^3) at worst.
std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(const std::vector<std::vector<PlanePoint>>& rings);

}  // namespace gvd::io
