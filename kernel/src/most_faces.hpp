#pragma once

#include "gvd/kernel/distance_field.hpp"

namespace gvd::kernel {

/// Faces of a mesh: a window keeps three flags beside its half-edge, in 32 bits.
inline constexpr std::uint32_t kMostFaces = WindowRecord::kDominated / 3;

}  // namespace gvd::kernel
