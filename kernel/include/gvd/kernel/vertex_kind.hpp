#pragma once

#include <cstdint>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::kernel {

/// What a vertex does to shortest paths, by its total angle: 2 pi (interior) or pi (boundary) exactly is flat, more relays, less
/// is convex.
enum class VertexKind : std::uint8_t { flat, relay, convex };

/// The kind of each vertex, exactly. Vertices inserted at sources are flat by identity, isolated ones count as convex.
/// A vertex that no stage decides counts as a relay (which is always harmless: a relay that is none costs time only) and is listed
/// as undecided, predicate `saddle`. Laws: renumbering, rotating or turning faces round, permuting axes and scaling by powers of
/// two change nothing. Cost: a few nanoseconds a corner; exact arithmetic only for vertices that are flat or nearly so.
std::vector<VertexKind> classify_vertices(const Mesh& mesh, predicates::Decisions& decisions);

/// The kinds, and the decisions that it took to find them.
struct VertexKinds {
  std::vector<VertexKind> of;
  predicates::Decisions decisions;
};
/// Those of the mesh, found by the first caller and kept with the mesh. May be called from several threads at once.
const VertexKinds& kept_vertex_kinds(const Mesh& mesh);

}  // namespace gvd::kernel
