#pragma once

#include <vector>

#include "gvd/kernel/distance_field.hpp"

namespace gvd::kernel {

/// The faces at v (by their half-edge that starts at v) that may lie in the shadow of an arrival at v: those that are not certainly within half a
/// turn of it on either side. `over`: the half-edge of the arrival's window, kNone if it came along the edge from arrival.via.
/// Too many faces are safe: what a relay sends outside the shadow is a path, only not the shortest. Error: docs/error-bounds.md#shadow.
void shadow_of(const Mesh& mesh, const std::vector<predicates::EdgeFrame<double>>& frames, VertexId v, HalfedgeId over,
               const Candidate& arrival, std::vector<HalfedgeId>& faces);

}  // namespace gvd::kernel
