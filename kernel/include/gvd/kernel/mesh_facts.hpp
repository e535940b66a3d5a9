#pragma once

#include "gvd/kernel/mesh.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::kernel {

/// Counts what `gvd info` prints. Vertices whose angle no stage decides are listed in `decisions` and counted among the saddles or
/// boundary relays. The bounding box is of all vertices, isolated ones too. Cost: linear; see classify_vertices.
MeshFacts facts(const Mesh& mesh, predicates::Decisions& decisions);

}  // namespace gvd::kernel
