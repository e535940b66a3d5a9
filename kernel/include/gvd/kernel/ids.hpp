#pragma once

#include <cstdint>

namespace gvd::kernel {

using VertexId = std::uint32_t;
using FaceId = std::uint32_t;
using HalfedgeId = std::uint32_t;  ///< 3 * face + k: from corner k to corner k + 1
using EdgeId = std::uint32_t;
using WindowId = std::uint32_t;
using SourceId = std::uint32_t;    ///< in the order in which the caller gave the sources
using LabelSetId = std::uint32_t;  ///< a sorted set of sources, interned

inline constexpr std::uint32_t kNone = 0xffffffffu;

}  // namespace gvd::kernel
