#pragma once

#include <cstdint>
#include <vector>

#include "plan_view.hpp"

namespace gvd::io {

/// An image of 8-bit grey and alpha, rows from the top.
struct ShadeImage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
};

/// The surface seen from above, lit from the north-west, 45 degrees high; smooth over the vertices, with stretched contrast.
/// Transparent where there is no surface.
ShadeImage hill_shade(const kernel::Mesh& mesh, const PlanView& view);

}  // namespace gvd::io
