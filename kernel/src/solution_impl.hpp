#pragma once

#include <memory>
#include <vector>

#include "facet_waves.hpp"
#include "gvd/kernel/extract.hpp"
#include "gvd/kernel/frames.hpp"
#include "gvd/kernel/resolution.hpp"
#include "gvd/kernel/solver.hpp"
#include "gvd/kernel/tessellation.hpp"
#include "gvd/kernel/vertex_kind.hpp"
#include "refined_point.hpp"

namespace gvd::kernel {

/// Everything a solution keeps: the refined mesh, the distance field with its strips, and the diagram.
class Solution::Impl {
 public:
  explicit Impl(const Mesh& mesh) : input(mesh) {}

  const Mesh& input;
  Mesh refined;
  RefinedSources where;
  FaceParts parts;  ///< of the refined mesh
  std::unique_ptr<Frames> frames;
  std::vector<VertexKind> kinds;
  std::vector<SourceVertex> source_vertices;
  LabelSets label_sets;
  DistanceField field;
  std::unique_ptr<Resolution> resolution;
  std::vector<double> distance;  ///< per vertex of the input, mesh units, correctly rounded
  std::vector<SourceId> hidden;
  Diagram diagram;

  Status status = Status::cancelled;
  Summary summary;
  predicates::Decisions decisions;
};

}  // namespace gvd::kernel
