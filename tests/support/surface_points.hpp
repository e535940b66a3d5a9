#pragma once

#include <cmath>

#include "gvd/kernel/solver.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "support/meshes.hpp"

/// Surface points and sources for tests.
namespace gvd::test {

/// The point of a face with weights w0, w1, w2 for its corners (those of the mesh as oriented).
inline kernel::SurfacePoint in_face(kernel::FaceId face, const mpq_class& w0, const mpq_class& w1, const mpq_class& w2) {
  kernel::SurfacePoint at;
  at.face = face;
  const mpq_class sum = w0 + w1 + w2;
  at.bary = {w0 / sum, w1 / sum, w2 / sum};
  return at;
}

/// Somewhere in a face, with small weights, so that edges and vertices occur now and then.
inline kernel::SurfacePoint random_point(const kernel::Mesh& mesh, Random& random) {
  for (;;) {
    const std::uint32_t a = random.below(8), b = random.below(8), c = random.below(8);
    if (a + b + c > 0) return in_face(random.below(mesh.face_count()), a, b, c);
  }
}

inline kernel::Source vertex_source(const kernel::Mesh& mesh, kernel::VertexId v, double weight = 0) {
  return {kernel::point_at_vertex(mesh, v), weight};
}

inline kernel::Solution solve_field(const kernel::Mesh& mesh, const std::vector<kernel::Source>& sources) {
  kernel::SolveOptions options;
  options.diagram = false;
  return kernel::solve(mesh, sources, options);
}

inline double straight_distance(const kernel::Point& a, const kernel::Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace gvd::test
