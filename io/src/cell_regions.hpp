#pragma once

#include <vector>

#include "gvd/kernel/diagram.hpp"
#include "gvd/kernel/mesh.hpp"
#include "plan_view.hpp"

namespace gvd::io {

/// Closed loops of mesh vertices round the faces that are seen and belong wholly to one drawn source, per source: counter-clockwise
/// round the faces, so that holes run clockwise.
std::vector<std::vector<std::vector<kernel::VertexId>>> whole_face_loops(const kernel::Mesh& mesh, const kernel::Diagram& diagram,
                                                                         const PlanView& view);

/// A colour number for each cell such that neighbours differ wherever `colours` allow it. Deterministic.
std::vector<unsigned> colour_cells(const kernel::Diagram& diagram, unsigned colours);

}  // namespace gvd::io
