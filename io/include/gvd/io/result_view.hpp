#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gvd/kernel/diagram.hpp"
#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/solver.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::io {

/// Distances and nearest sources at the vertices of the input mesh.
struct VertexResults {
  std::vector<double> distance;  ///< correctly rounded; infinity if unreachable
  std::function<std::span<const kernel::SourceId>(kernel::VertexId)> nearest;  ///< sorted; empty if unreachable
};

/// Everything that the writers of a diagram need. References must outlive the view.
struct ResultView {
  const kernel::Mesh& mesh;  ///< the input mesh (not the one refined at the sources)
  const kernel::Diagram& diagram;
  const kernel::Summary& summary;
  const predicates::Decisions& decisions;
  std::span<const kernel::Source> sources;
  VertexResults vertices;
  std::vector<std::array<kernel::SourceId, 2>> duplicates;  ///< (source, the earlier source at the same point)
  std::string mesh_name;
  std::string units = "mesh units";
};

/// Takes the results of the vertices from a complete solution, which must outlive them. Cost: O(vertices).
VertexResults vertex_results(const kernel::Mesh& mesh, const kernel::Solution& solution);

}  // namespace gvd::io
