#pragma once

#include <vector>

#include "chains.hpp"
#include "precise_facets.hpp"

/// Points and arcs of the diagram as numbers.
namespace gvd::kernel::subdivision {

/// Constructs the points of the given places: correctly rounded in space, enclosed in a frame. Parallel over facets.
std::vector<DiagramPoint> construct_points(const DiagramInput& in, const Subdivision& s, PreciseWaves& waves,
                                           const std::vector<std::uint32_t>& places, predicates::Decisions& decisions);

/// Fills images, weights, roots and conic of the arcs; arc i runs along `links[i]` (the first of its links). Parallel over facets.
void construct_arcs(const DiagramInput& in, const Subdivision& s, PreciseWaves& waves, const std::vector<DirectedLink>& links,
                    std::vector<Arc>& arcs);

/// The ends of the edge of the input mesh on which a half-edge of the refined mesh lies, low id first. Pre: not artificial.
std::array<VertexId, 2> input_edge(const DiagramInput& in, HalfedgeId h);

}  // namespace gvd::kernel::subdivision
