#include "gvd/io/vtp_writer.hpp"

#include <algorithm>

#include "drawn_source.hpp"
#include "gvd/io/polygon_triangulation.hpp"
#include "poly_data.hpp"
#include "sampled_outlines.hpp"

namespace gvd::io {

namespace {

enum class PointKind : std::int32_t { sample = 0, crossing = 1, break_point = 2, gvd_vertex = 3, boundary_meeting = 4, open_end = 5 };

/// The part of `SampledOutlines::points` that the GVD edges use, numbered anew.
class UsedPoints {
 public:
  UsedPoints(const SampledOutlines& outlines, PolyData& data) : outlines_(outlines), data_(data), id_(outlines.points().size(), -1) {}

  std::int64_t operator()(std::int64_t point) {
    auto& id = id_[static_cast<std::size_t>(point)];
    if (id < 0) {
      id = static_cast<std::int64_t>(data_.points.size());
      data_.points.push_back(outlines_.points()[static_cast<std::size_t>(point)]);
    }
    return id;
  }
  /// The new number, or -1 if the point has not been used.
  std::int64_t find(std::int64_t point) const { return id_[static_cast<std::size_t>(point)]; }

 private:
  const SampledOutlines& outlines_;
  PolyData& data_;
  std::vector<std::int64_t> id_;
};

std::vector<std::int64_t> edge_polyline(const kernel::GvdEdge& edge, const SampledOutlines& outlines) {
  std::vector<std::int64_t> line;
  for (const auto arc : edge.arcs) {
    const auto chain = outlines.arc(arc);
    line.insert(line.end(), chain.begin() + (line.empty() ? 0 : 1), chain.end());
  }
  return line;
}

void add_edges(const ResultView& view, const SampledOutlines& outlines, UsedPoints& used, PolyData& data) {
  PolyData::Array<std::int32_t> left{"left_source", {}}, right{"right_source", {}}, id{"edge", {}};
  for (std::size_t e = 0; e < view.diagram.edges.size(); ++e) {
    const auto& edge = view.diagram.edges[e];
    auto line = edge_polyline(edge, outlines);
    for (auto& point : line) point = used(point);
    data.lines.add(line);
    left.values.push_back(drawn_source(view.diagram, edge.labels[0]));
    right.values.push_back(drawn_source(view.diagram, edge.labels[1]));
    id.values.push_back(static_cast<std::int32_t>(e));
  }
  data.cell_ids = {left, right, id};
}

/// What is special about the points: kinds in increasing precedence.
void add_kinds(const ResultView& view, const SampledOutlines& outlines, UsedPoints& used, PolyData& data) {
  const auto& diagram = view.diagram;
  std::vector<std::int32_t> kinds(data.points.size(), static_cast<std::int32_t>(PointKind::sample));
  const auto mark = [&](std::uint32_t point, PointKind kind) {
    const auto id = static_cast<std::size_t>(used(outlines.index_of(point)));
    kinds.resize(data.points.size());
    kinds[id] = static_cast<std::int32_t>(kind);
  };
  for (const auto& arc : diagram.arcs)
    for (const auto node : arc.node) mark(node, PointKind::crossing);
  for (const auto& x : diagram.break_points) mark(x.point, PointKind::break_point);
  for (const auto& x : diagram.boundary_meetings) mark(x.point, PointKind::boundary_meeting);
  for (const auto& x : diagram.open_ends) mark(x.point, PointKind::open_end);
  for (const auto& x : diagram.vertices) mark(x.point, PointKind::gvd_vertex);
  data.point_ids = {{"kind", kinds}};
}

std::vector<PolyData::Array<double>> deviation_field(const ResultView& view, double deviation) {
  return {{"max_deviation_per_longest_side", {deviation}},
          {"max_deviation", {ArcSampler(view.mesh, view.diagram, deviation).largest_allowed_deviation()}}};
}

/// Adds triangles of one label set.
class CellTriangles {
 public:
  explicit CellTriangles(const kernel::Diagram& diagram) : diagram_(diagram) {}

  void add(PolyData& data, const std::vector<std::int64_t>& triangle, kernel::LabelSetId labels, kernel::FaceId face) {
    data.polys.add(triangle);
    source_.values.push_back(drawn_source(diagram_, labels));
    ties_.values.push_back(labels == kernel::kNone ? 0 : static_cast<std::int32_t>(diagram_.label_sets[labels].size()));
    face_.values.push_back(static_cast<std::int32_t>(face));
  }
  void finish(PolyData& data) { data.cell_ids = {source_, ties_, face_}; }

 private:
  const kernel::Diagram& diagram_;
  PolyData::Array<std::int32_t> source_{"source", {}}, ties_{"nearest_sources", {}}, face_{"face", {}};
};

void add_whole_face(const ResultView& view, kernel::FaceId face, CellTriangles& triangles, PolyData& data) {
  const auto h = 3 * face;
  const std::vector<std::int64_t> corners = {view.mesh.origin(h), view.mesh.target(h), view.mesh.apex(h)};
  triangles.add(data, corners, view.diagram.face_label[face], face);
}

void add_piece(const ResultView& view, const SampledOutlines& outlines, const kernel::CellPiece& piece, CellTriangles& triangles,
               PolyData& data) {
  const FacePlane plane(view.mesh, piece.face);
  std::vector<std::int64_t> ids;
  std::vector<std::vector<PlanePoint>> flat;
  for (const auto& ring : outlines.rings(piece)) {
    ids.insert(ids.end(), ring.begin(), ring.end());
    auto& points = flat.emplace_back();
    for (const auto point : ring) points.push_back(plane.to_plane(outlines.points()[static_cast<std::size_t>(point)]));
  }
  for (const auto& t : triangulate_polygon(flat)) triangles.add(data, {ids[t[0]], ids[t[1]], ids[t[2]]}, piece.labels, piece.face);
}

std::vector<double> all_distances(const ResultView& view, const SampledOutlines& outlines) {
  auto distance = outlines.distance();
  std::copy(view.vertices.distance.begin(), view.vertices.distance.end(), distance.begin());
  for (std::size_t i = 0; i < view.diagram.points.size(); ++i)
    if (const auto v = view.diagram.points[i].vertex; v != kernel::kNone) distance[view.mesh.vertex_count() + i] = distance[v];
  return distance;
}

}  // namespace

void write_diagram_vtp(std::ostream& out, const ResultView& view, double deviation) {
  const SampledOutlines outlines(view.mesh, view.diagram, deviation);
  PolyData data;
  UsedPoints used(outlines, data);
  add_edges(view, outlines, used, data);
  add_kinds(view, outlines, used, data);
  const auto distance = all_distances(view, outlines);
  std::vector<double> of_used(data.points.size());
  for (std::size_t p = 0; p < distance.size(); ++p)
    if (const auto id = used.find(static_cast<std::int64_t>(p)); id >= 0) of_used[static_cast<std::size_t>(id)] = distance[p];
  data.point_numbers = {{"distance", of_used}};
  data.field = deviation_field(view, deviation);
  write_poly_data(out, data);
}

void write_cells_vtp(std::ostream& out, const ResultView& view, double deviation) {
  const SampledOutlines outlines(view.mesh, view.diagram, deviation);
  PolyData data;
  CellTriangles triangles(view.diagram);
  std::vector<char> in_pieces(view.mesh.face_count(), 0);
  for (const auto& piece : view.diagram.pieces) in_pieces[piece.face] = 1;
  for (kernel::FaceId face = 0; face < view.mesh.face_count(); ++face)
    if (in_pieces[face] == 0) add_whole_face(view, face, triangles, data);
  for (const auto& piece : view.diagram.pieces) add_piece(view, outlines, piece, triangles, data);
  triangles.finish(data);
  data.points = outlines.points();
  data.point_numbers = {{"distance", all_distances(view, outlines)}};
  data.field = deviation_field(view, deviation);
  write_poly_data(out, data);
}

}  // namespace gvd::io
