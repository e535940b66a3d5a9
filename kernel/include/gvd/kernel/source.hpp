#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gvd/kernel/ids.hpp"
#include "gvd/kernel/mesh.hpp"
#include "gvd/robust/gmp.hpp"

namespace gvd::kernel {

/// A point of the surface, exactly: barycentric coordinates (non-negative, sum exactly 1) in a face, corners in the order of `Mesh` (after
/// re-orientation). Where one of them is 1 it is a vertex, where one is 0 it lies on an edge: `locate` says which.
struct SurfacePoint {
  FaceId face = kNone;  ///< kNone: an isolated vertex
  VertexId vertex = kNone;  ///< set if the point is that vertex
  std::array<mpq_class, 3> bary;
};

/// A source: a surface point and its additive weight (>= 0, mesh units): the distance that its wave has when it starts.
struct Source {
  SurfacePoint at;
  double weight = 0;
};

/// Where the sources ended up in the refined mesh.
struct RefinedSources {
  std::vector<VertexId> vertex;          ///< per source
  std::vector<double> weight;            ///< per source
  std::vector<std::array<SourceId, 2>> duplicates;  ///< (source, the earlier source at the same point)
};

/// Inserts the sources as vertices of the mesh (exact position; 1-3 split inside a face, 2-4 split on an edge; several in one face or
/// edge are fine). Sources at the same point share a vertex and are reported in `duplicates`. Vertices of the input keep their ids.
/// Cost: O(number of sources) exact operations and one copy of the mesh.
Mesh refine(const Mesh& mesh, const std::vector<Source>& sources, RefinedSources& where);

}  // namespace gvd::kernel
