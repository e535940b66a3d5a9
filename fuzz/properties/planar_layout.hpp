#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/source.hpp"

namespace gvd::fuzz {

/// A surface that unfolds, exactly, to a convex region of the plane: there geodesics are straight. Shares nothing with the kernel
/// but the mesh. All faces are of one square class, so that a point is (x, y sqrt(d)) with rational x and y.
struct PlanarLayout {
  using Place = std::array<mpq_class, 2>;

  mpq_class unit;                         ///< squared length of x = 1
  mpq_class stretch;                      ///< d
  std::vector<Place> vertex;              ///< per vertex of the mesh
  std::vector<kernel::VertexId> outline;  ///< the boundary, counter-clockwise

  mpq_class squared_distance(const Place& a, const Place& b) const {
    const mpq_class dx = a[0] - b[0], dy = a[1] - b[1];
    return unit * (dx * dx + stretch * dy * dy);
  }
  Place place(const kernel::Mesh& mesh, const kernel::SurfacePoint& at) const;
};

/// Empty unless the mesh is one such surface.
std::optional<PlanarLayout> planar_layout(const kernel::Mesh& mesh);

}  // namespace gvd::fuzz
