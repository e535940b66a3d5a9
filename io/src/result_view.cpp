#include "gvd/io/result_view.hpp"

namespace gvd::io {

VertexResults vertex_results(const kernel::Mesh& mesh, const kernel::Solution& solution) {
  VertexResults results;
  results.distance.resize(mesh.vertex_count());
  for (kernel::VertexId v = 0; v < mesh.vertex_count(); ++v) results.distance[v] = solution.distance(v);
  results.nearest = [&solution](kernel::VertexId v) { return solution.nearest(v); };
  return results;
}

}  // namespace gvd::io
