#include "gvd/io/diagram_json_writer.hpp"

#include <fmt/format.h>

#include <ostream>
#include <set>

#include "gvd/io/version.hpp"
#include "json_values.hpp"

namespace gvd::io {

namespace {

using kernel::Enclosed;

constexpr int kFormatVersion = 1;

Json enclosed_json(const Enclosed& x) { return Json::array({x.value, x.low, x.high}); }

template <class Pair>
Json enclosed_pair(const Pair& pair) {
  return Json::array({enclosed_json(pair[0]), enclosed_json(pair[1])});
}

Json id_pair(const std::array<std::uint32_t, 2>& ids) { return Json::array({id_json(ids[0]), id_json(ids[1])}); }

Json source_json(const kernel::Source& source, std::size_t id) {
  Json json;
  json["id"] = id;
  json["vertex"] = id_json(source.at.vertex);
  json["face"] = id_json(source.at.face);
  json["bary"] = Json::array();
  for (const auto& b : source.at.bary) json["bary"].push_back(b.get_str());
  json["weight"] = source.weight;
  return json;
}

Json frame_json(const kernel::Mesh& mesh, kernel::FaceId face) {
  Json json;
  json["face"] = face;
  const auto h = 3 * face;
  json["corners"] = {mesh.origin(h), mesh.target(h), mesh.apex(h)};
  json["flipped"] = mesh.flipped(face);
  return json;
}

Json point_json(const kernel::DiagramPoint& point) {
  Json json;
  json["face"] = id_json(point.face);
  json["vertex"] = id_json(point.vertex);
  json["edge"] = point.edge[0] == kernel::kNone ? Json() : id_pair(point.edge);
  json["position"] = point.position;
  json["frame"] = enclosed_pair(point.frame);
  return json;
}

const char* conic_name(kernel::Arc::Conic conic) {
  switch (conic) {
    case kernel::Arc::Conic::line: return "line";
    case kernel::Arc::Conic::hyperbola: return "hyperbola";
    case kernel::Arc::Conic::ray: break;
  }
  return "ray";
}

/// Vertices made at sources by refinement have no id in the input: null.
Json root_json(kernel::VertexId root, const kernel::Mesh& mesh) { return root < mesh.vertex_count() ? Json(root) : Json(); }

Json arc_json(const kernel::Arc& arc, const kernel::Mesh& mesh) {
  Json json;
  json["face"] = arc.face;
  json["conic"] = conic_name(arc.conic);
  json["along_edge"] = arc.along_edge;
  json["points"] = id_pair(arc.node);
  json["labels"] = id_pair(arc.labels);
  json["images"] = Json::array({enclosed_pair(arc.image[0]), enclosed_pair(arc.image[1])});
  json["weights"] = enclosed_pair(arc.weight);
  json["roots"] = Json::array({root_json(arc.root[0], mesh), root_json(arc.root[1], mesh)});
  return json;
}

Json edge_json(const kernel::GvdEdge& edge) {
  Json json;
  json["labels"] = id_pair(edge.labels);
  json["ends"] = id_pair(edge.end);
  json["closed"] = edge.closed;
  json["arcs"] = edge.arcs;
  return json;
}

Json vertex_json(const kernel::GvdVertex& vertex) {
  Json json;
  json["point"] = vertex.point;
  json["sources"] = vertex.sources;
  json["edges"] = vertex.edges;
  json["on_boundary"] = vertex.on_boundary;
  return json;
}

template <class PointOnEdge>
Json point_on_edge_json(const PointOnEdge& x) {
  Json json;
  json["point"] = x.point;
  json["edge"] = x.edge;
  return json;
}

Json cell_json(const kernel::Cell& cell) {
  Json json;
  json["source"] = cell.source;
  json["hidden"] = cell.hidden;
  json["neighbours"] = cell.neighbours;
  json["area"] = cell.area;
  json["euler"] = cell.euler;
  return json;
}

Json dual_json(const kernel::DualEdge& dual) {
  Json json;
  json["sources"] = dual.sources;
  json["edges"] = dual.edges;
  return json;
}

Json side_json(const kernel::CellPiece::Side& side) {
  Json json;
  const bool corner = side.from != kernel::kNone && (side.from & kernel::CellPiece::kCorner) != 0;
  json[corner ? "corner" : "point"] = corner ? side.from & ~kernel::CellPiece::kCorner : side.from;
  json["arc"] = id_json(side.arc);
  json["reversed"] = side.reversed;
  return json;
}

Json ring_json(const std::vector<kernel::CellPiece::Side>& ring) {
  Json json = Json::array();
  for (const auto& side : ring) json.push_back(side_json(side));
  return json;
}

Json piece_json(const kernel::CellPiece& piece) {
  Json json;
  json["face"] = piece.face;
  json["labels"] = id_json(piece.labels);
  json["outline"] = ring_json(piece.outline);
  json["holes"] = Json::array();
  for (const auto& hole : piece.holes) json["holes"].push_back(ring_json(hole));
  return json;
}

Json shared_json(const kernel::SharedRegion& region) {
  Json json;
  json["labels"] = region.labels;
  json["area"] = region.area;
  return json;
}

Json summary_object(const ResultView& view) {
  Json json = counts_json(view.summary, view.decisions);
  if (view.summary.status != kernel::Status::certified) json["undecided"] = view.decisions.undecided_list();
  return json;
}

Json face_labels_json(const kernel::Diagram& diagram) {
  Json json = Json::array();
  for (const auto label : diagram.face_label) json.push_back(id_json(label));
  return json;
}

/// The faces in whose frames something is given.
std::set<kernel::FaceId> framed_faces(const kernel::Diagram& diagram) {
  std::set<kernel::FaceId> faces;
  for (const auto& point : diagram.points) faces.insert(point.face);
  for (const auto& arc : diagram.arcs) faces.insert(arc.face);
  for (const auto& piece : diagram.pieces) faces.insert(piece.face);
  faces.erase(kernel::kNone);
  return faces;
}

/// Streams a JSON object member by member, so that no tree of the whole diagram is built.
class ObjectStream {
 public:
  explicit ObjectStream(std::ostream& out) : out_(out) { out_ << '{'; }

  void member(const char* key, const Json& value) {
    start(key);
    out_ << dump(value);
  }

  /// An array, one element a line.
  template <class Range, class Convert>
  void array(const char* key, const Range& range, Convert&& convert) {
    start(key);
    out_ << '[';
    const char* separator = "\n";
    for (const auto& element : range) {
      out_ << separator << dump(convert(element));
      separator = ",\n";
    }
    out_ << ']';
  }

  void end() { out_ << "\n}\n"; }

 private:
  void start(const char* key) {
    out_ << (first_ ? "\n\"" : ",\n\"") << key << "\": ";
    first_ = false;
  }

  std::ostream& out_;
  bool first_ = true;
};

Json mesh_json(const ResultView& view) {
  Json json;
  json["name"] = view.mesh_name;
  json["vertices"] = view.mesh.vertex_count();
  json["faces"] = view.mesh.face_count();
  return json;
}

}  // namespace

void write_diagram_json(std::ostream& out, const ResultView& view) {
  const auto& diagram = view.diagram;
  ObjectStream json(out);
  json.member("format", "exactgvd diagram");
  json.member("format_version", kFormatVersion);
  json.member("generator", fmt::format("gvd {}", version()));
  json.member("mesh", mesh_json(view));
  json.member("units", view.units);
  json.member("summary", summary_object(view));
  std::size_t id = 0;
  json.array("sources", view.sources, [&](const auto& source) { return source_json(source, id++); });
  json.member("duplicate_sources", view.duplicates);
  json.member("label_sets", diagram.label_sets);
  json.array("frames", framed_faces(diagram), [&](kernel::FaceId face) { return frame_json(view.mesh, face); });
  json.array("points", diagram.points, point_json);
  json.array("arcs", diagram.arcs, [&](const auto& arc) { return arc_json(arc, view.mesh); });
  json.array("edges", diagram.edges, edge_json);
  json.array("vertices", diagram.vertices, vertex_json);
  json.array("break_points", diagram.break_points, point_on_edge_json<kernel::BreakPoint>);
  json.array("boundary_meetings", diagram.boundary_meetings, point_on_edge_json<kernel::BoundaryMeeting>);
  json.array("open_ends", diagram.open_ends, point_on_edge_json<kernel::BoundaryMeeting>);
  json.array("cells", diagram.cells, cell_json);
  json.array("dual", diagram.dual, dual_json);
  json.array("shared_regions", diagram.shared, shared_json);
  json.member("undecided_faces", diagram.undecided_faces);
  json.member("face_labels", face_labels_json(diagram));
  json.array("pieces", diagram.pieces, piece_json);
  json.end();
}

}  // namespace gvd::io
