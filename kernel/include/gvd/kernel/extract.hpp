#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "gvd/kernel/diagram.hpp"
#include "gvd/kernel/facet.hpp"
#include "gvd/kernel/ids.hpp"
#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/tessellation.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::kernel {

/// A facet of the refined mesh that is met by more than one label set. `waves` and `tessellation` outlive the extraction; `waves`
/// is used by one thread at a time.
struct BoundaryFacet {
  FaceId face = kNone;
  FacetWaves* waves = nullptr;
  const FacetTessellation* tessellation = nullptr;
};

/// A source as the distance field sees it.
struct DiagramSource {
  VertexId vertex = kNone;  ///< of the refined mesh
  double weight = 0;
  bool hidden = false;  ///< another source reaches it with less than its own weight
};

/// One step of the strip of a window.
struct WindowOrigin {
  WindowId parent = kNone;      ///< the window of which it is a child; kNone if it starts at its root
  HalfedgeId halfedge = kNone;  ///< the half-edge over which it comes in
};

/// What the diagram is made of. The references outlive the call.
struct DiagramInput {
  const Mesh& input;
  const Mesh& refined;                                   ///< `input` with every source as a vertex; may be the same object
  const std::vector<DiagramSource>& sources;             ///< per source
  const std::vector<std::vector<SourceId>>& label_sets;  ///< LabelSetId -> sorted sources; no set occurs twice
  const std::vector<LabelSetId>& vertex_labels;          ///< per vertex of `refined`, exact; kNone where no source reaches
  const std::vector<LabelSetId>& face_labels;  ///< per face of `refined`; kNone: unreachable. Not read for boundary facets
  const std::vector<BoundaryFacet>& facets;    ///< sorted by face
  /// How each window of `FacetSite::window`, and each of their ancestors, came about.
  std::function<WindowOrigin(WindowId)> window;
  /// Whether a wave of the facet of a half-edge and one of the facet of its twin are as far all along the edge, by algebra: true is a proof. May be empty.
  std::function<bool(HalfedgeId, const FacetSite&, const FacetSite&)> as_far_along{};
  /// Called once before the waves are asked for their precise numbers, maybe beside other work. May be empty.
  std::function<void()> prepare_points{};
};

/// Joins the tessellated facets to the diagram of the input mesh (docs/diagram.md).
///
/// Every combinatorial statement is proved: by identity of waves over mesh edges, by enclosures, or by algebra. What cannot be
/// proved, and each facet whose tessellation is undecided, is listed in `decisions` and in `Diagram::undecided_faces`; GVD edges
/// that reach such a facet end there
/// (`Diagram::open_ends`).
/// The result does not depend on the number of threads. It uses TBB; limit it with tbb::task_arena or
/// tbb::global_control.
/// Throws InternalError if the result is not a subdivision of the surface (Euler's formula, ends of edges, dual edges): always
/// checked. Cost: linear in the size of the refined mesh, plus O(n log n) for the n points of the diagram, each evaluated in
/// double-double.
Diagram extract(const DiagramInput& in, predicates::Decisions& decisions);

/// Renamings for `canonical`: the name to print for each source. Empty: its own id.
struct CanonicalNames {
  std::vector<SourceId> source;
};

/// A text that is the same, byte for byte, for the same diagram whatever the numbering of vertices, faces and sources was, and
/// however the faces were turned round: cells with neighbours and Euler characteristic, GVD vertices and break points by their
/// correctly rounded coordinates, edges from end to end by coordinates, dual edges, shared regions. Coordinates are printed as
/// hexadecimal doubles. Crossings of mesh edges, frames, enclosures and areas do not occur in it.
std::string canonical(const Diagram& diagram, const CanonicalNames& names = {});

}  // namespace gvd::kernel
