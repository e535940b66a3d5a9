#pragma once

#include <array>
#include <vector>

#include "gvd/kernel/resolution.hpp"
#include "gvd/kernel/solver.hpp"
#include "gvd/robust/gmp.hpp"

namespace gvd::kernel {

/// Where a geodesic crosses a half-edge of the refined mesh.
struct Crossing {
  HalfedgeId halfedge = kNone;  ///< on the side of the end of the path: the strip comes in over it
  VertexId vertex = kNone;      ///< set if the path goes through this end of the half-edge
  /// On the input mesh; without meaning if `vertex` is set or the edge is artificial.
  std::array<VertexId, 2> edge{kNone, kNone};
  Enclosed t;
  Point position{};
};

struct StripCrossings {
  std::vector<Crossing> list;  ///< from the end of the path back to the root
  bool undecided = false;      ///< a crossing could not be told from a vertex, or not be enclosed sharply
};

/// The straight way from a point of the facet which the window enters (`bary`: in the order of the face's corners) back to the
/// window's root. A point on the half-edge of the window itself is no crossing.
StripCrossings cross_strip(const Mesh& input, const Resolution& resolution, WindowId window, const std::array<mpq_class, 3>& bary);

}  // namespace gvd::kernel
