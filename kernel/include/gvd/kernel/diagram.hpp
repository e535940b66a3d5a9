#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gvd/kernel/ids.hpp"
#include "gvd/kernel/mesh.hpp"

namespace gvd::kernel {

/// A number with an enclosure: the true value lies in [low, high]; `value` is a double within 1 ulp of the truth.
struct Enclosed {
  double value = 0, low = 0, high = 0;
};

/// A constructed point of the diagram, on a face of the *input* mesh.
struct DiagramPoint {
  FaceId face = kNone;            ///< input face; for a point on an edge the face with the lower id
  std::array<Enclosed, 2> frame;  ///< in the frame of that face: corner 0 = (0,0), corner 1 = (length of the side, 0), mesh units
  Point position{};               ///< correctly rounded 3D coordinates
  VertexId vertex = kNone;        ///< set if the point is this vertex of the input mesh
  std::array<VertexId, 2> edge{kNone, kNone};  ///< set (low id first) if it lies inside this edge of the input mesh
};

/// One conic piece of the boundary between two label sets, in one face of the input.
/// Points p of the arc have weight[0] + |p - image[0]| = weight[1] + |p - image[1]|.
struct Arc {
  enum class Conic : std::uint8_t { line, hyperbola, ray };  ///< ray: behind the focus, |dw| = |I0 - I1|
  FaceId face = kNone;
  Conic conic = Conic::line;
  bool along_edge = false;  ///< the arc is a piece of a mesh edge (its images are then seen from `face`, or mirrored)
  std::array<std::uint32_t, 2> node{kNone, kNone};  ///< indices into Diagram::points, in the direction of the GVD edge
  std::array<std::array<Enclosed, 2>, 2> image;     ///< left and right image, frame of `face`
  std::array<Enclosed, 2> weight;                   ///< distances at the (pseudo-)sources
  std::array<LabelSetId, 2> labels{kNone, kNone};  ///< left and right of the arc, seen along its direction from outside the surface
  std::array<VertexId, 2> root{kNone, kNone};      ///< relaying vertex (or the source's own vertex in the refined mesh)
};

/// A maximal chain of arcs between the same two label sets. It ends in GVD vertices or on the boundary of the mesh, or is closed
/// (then it starts in its lexicographically smallest break point, or smallest crossing of a mesh edge if it has none).
struct GvdEdge {
  std::array<LabelSetId, 2> labels{kNone, kNone};  ///< left and right, seen along its direction from outside the surface
  std::vector<std::uint32_t> arcs;                 ///< in order
  std::array<std::uint32_t, 2> end{kNone, kNone};  ///< indices into Diagram::points; equal and a break point or crossing if closed
  bool closed = false;
};

struct BreakPoint {
  std::uint32_t point = kNone;
  std::uint32_t edge = kNone;  ///< the GVD edge on which the conic changes here
};

/// A point with three or more label sets around it, or one that has more nearest sources than the edges which meet there.
struct GvdVertex {
  std::uint32_t point = kNone;
  std::vector<SourceId> sources;     ///< all nearest sources, sorted
  std::vector<std::uint32_t> edges;  ///< GVD edges that end here, once per end
  bool on_boundary = false;
};

/// The boundary of the mesh (or a facet that is undecided) met by a GVD edge: an end of an edge that is not a GVD vertex.
struct BoundaryMeeting {
  std::uint32_t point = kNone;
  std::uint32_t edge = kNone;
};

/// A connected piece of one input face that belongs to one label set; its outline consists of arcs and pieces of the face's sides.
struct CellPiece {
  FaceId face = kNone;
  LabelSetId labels = kNone;
  /// A closed outline, the piece on its left. A piece of a side has arc == kNone (unless a GVD edge runs along it). `from` indexes
  /// Diagram::points, or names a corner of the face: kCorner | (0, 1, 2). A closed arc has the same point at both ends.
  struct Side {
    std::uint32_t from = kNone;
    std::uint32_t arc = kNone;
    bool reversed = false;  ///< the outline runs against the direction of the arc
  };
  std::vector<Side> outline;             ///< the outer one, counter-clockwise
  std::vector<std::vector<Side>> holes;  ///< clockwise; they occur only where a source lies in the face
  static constexpr std::uint32_t kCorner = 0x80000000u;
};

/// The points with s among their nearest sources. Where a vertex relays the waves of several sources at once, a whole region has
/// several: it belongs to all of their cells.
struct Cell {
  SourceId source = kNone;
  bool hidden = false;               ///< another source reaches this one with less than its own weight: the cell is empty
  std::vector<SourceId> neighbours;  ///< sources with which it shares a GVD edge, sorted
  double area = 0;                   ///< for information
  std::int64_t euler = 0;            ///< Euler characteristic of the closed cell
};

struct DualEdge {
  std::array<SourceId, 2> sources{kNone, kNone};  ///< low id first
  std::vector<std::uint32_t> edges;               ///< the GVD edges between the two
};

/// All faces and pieces of faces whose label set is one set of two or more sources.
struct SharedRegion {
  LabelSetId labels = kNone;
  double area = 0;  ///< for information
};

/// The geodesic Voronoi diagram. Plain data; nothing in it depends on the order of computation.
struct Diagram {
  std::vector<std::vector<SourceId>> label_sets;  ///< LabelSetId -> sorted sources
  std::vector<DiagramPoint> points;
  std::vector<Arc> arcs;
  std::vector<GvdEdge> edges;
  std::vector<GvdVertex> vertices;
  std::vector<BreakPoint> break_points;
  std::vector<BoundaryMeeting> boundary_meetings;
  std::vector<BoundaryMeeting> open_ends;  ///< edges that end because a facet is undecided
  std::vector<FaceId> undecided_faces;     ///< input faces with an undecided facet or side, sorted; the diagram has no pieces there
  std::vector<Cell> cells;                 ///< per source
  std::vector<DualEdge> dual;
  std::vector<SharedRegion> shared;    ///< sorted by label set
  std::vector<LabelSetId> face_label;  ///< per input face: its only label set; kNone for boundary, undecided and unreachable faces
  std::vector<CellPiece> pieces;       ///< of boundary facets, sorted by face
  std::uint32_t boundary_facets = 0;
};

}  // namespace gvd::kernel
