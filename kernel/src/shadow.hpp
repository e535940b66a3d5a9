#pragma once

#include <vector>

#include "gvd/kernel/distance_field.hpp"

namespace gvd::kernel {

/// A ray that bounds a shadow inside a face.
struct ShadowRay {
  HalfedgeId face = kNone;  ///< by its half-edge that starts at the relay; kNone: no such ray is known
  predicates::Complex<double> direction;  ///< in the frame of that half-edge, 1-norm one
  double error = 0;         ///< radius about the direction
};

/// The faces at a relay (by their half-edge that starts there) that may lie in the shadow of an arrival.
struct Shadow {
  std::vector<HalfedgeId> faces;
  ShadowRay first, last;  ///< the shadow lies counter-clockwise of the first ray, clockwise of the last
  std::vector<HalfedgeId> fan;  ///< all faces at the relay, counter-clockwise
};

/// The shadow of an arrival at v: all that is not certainly within half a turn of it on either side. `over`: the half-edge of the arrival's window,
/// kNone if it came along the edge from arrival.via. Too much is safe: what a relay sends outside the shadow is a path, only not the shortest.
/// Error: docs/error-bounds.md#shadow.
void shadow_of(const Mesh& mesh, const std::vector<predicates::EdgeFrame<double>>& frames, VertexId v, HalfedgeId over,
               const Candidate& arrival, Shadow& shadow);

}  // namespace gvd::kernel
