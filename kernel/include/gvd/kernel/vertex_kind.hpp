#pragma once

#include <cstdint>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::kernel {

/// The total angle at a vertex against 2 pi (interior) or pi (boundary): equal, more (a relay: geodesics bend round it), less.
enum class VertexKind : std::uint8_t { flat, relay, convex };

/// Decides the kind of every vertex. What cannot be decided counts as a relay, which is harmless, and is listed. Isolated vertices are convex.
std::vector<VertexKind> classify_vertices(const Mesh& mesh, predicates::Decisions& decisions);

}  // namespace gvd::kernel
