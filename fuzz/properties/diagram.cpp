#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "fuzz/properties/property.hpp"
#include "fuzz/properties/surface_points.hpp"
#include "gvd/robust/ball.hpp"

namespace gvd::fuzz {
namespace {

using kernel::Arc;
using kernel::CellPiece;
using kernel::Diagram;
using kernel::Enclosed;
using kernel::FaceId;
using kernel::kNone;
using kernel::Mesh;
using kernel::SourceId;
using kernel::VertexId;
using Ball = robust::Ball<double>;

/// A point of a diagram or a vertex of the mesh, named once: vertices first, then points that are no vertex.
class Nodes {
 public:
  Nodes(const Mesh& mesh, const Diagram& d) : mesh_(mesh), diagram_(d) {}
  std::size_t count() const { return mesh_.vertex_count() + diagram_.points.size(); }
  std::size_t of_point(std::uint32_t point) const {
    const VertexId v = diagram_.points[point].vertex;
    return v != kNone ? v : mesh_.vertex_count() + point;
  }
  std::size_t of(FaceId face, std::uint32_t from) const {
    if ((from & CellPiece::kCorner) != 0) return mesh_.origin(3 * face + (from & ~CellPiece::kCorner));
    return of_point(from);
  }

 private:
  const Mesh& mesh_;
  const Diagram& diagram_;
};

bool on_outline(const Diagram& d, const CellPiece::Side& side) { return side.arc == kNone || d.arcs[side.arc].along_edge; }

/// The pieces of one face: their outlines use each arc once from either side, and together go once round the face.
std::string fault_of_face(const Mesh& mesh, const Diagram& d, FaceId f, const std::vector<const CellPiece*>& pieces,
                          const std::vector<std::uint32_t>& arcs) {
  const Nodes nodes(mesh, d);
  std::map<std::pair<std::uint32_t, bool>, int> used;
  std::map<std::size_t, std::size_t> round;
  std::size_t segments = 0;
  for (const CellPiece* piece : pieces) {
    std::vector<const std::vector<CellPiece::Side>*> loops{&piece->outline};
    for (const auto& hole : piece->holes) loops.push_back(&hole);
    for (const auto* loop : loops)
      for (std::size_t i = 0; i < loop->size(); ++i) {
        const auto& side = (*loop)[i];
        if (side.arc != kNone && d.arcs[side.arc].labels[side.reversed ? 1 : 0] != piece->labels)
          return "a piece lies on the wrong side of an arc";
        if (side.arc != kNone) ++used[{side.arc, side.reversed}];
        if (!on_outline(d, side)) continue;
        ++segments;
        const std::size_t from = nodes.of(f, side.from), to = nodes.of(f, (*loop)[(i + 1) % loop->size()].from);
        if (!round.emplace(from, to).second) return "two pieces start at the same point of the outline";
      }
  }
  for (const std::uint32_t arc : arcs)
    if (used[{arc, false}] != 1 || used[{arc, true}] != 1) return fmt::format("arc {} does not have a piece on either side", arc);
  std::size_t at = mesh.origin(3 * f), steps = 0;
  std::vector<VertexId> corners;
  do {
    if (at < mesh.vertex_count()) corners.push_back(static_cast<VertexId>(at));
    const auto next = round.find(at);
    if (next == round.end()) return "the pieces leave out a part of the outline";
    at = next->second;
    ++steps;
  } while (at != mesh.origin(3 * f) && steps <= segments);
  if (steps != segments) return "the pieces cover a part of the outline twice";
  if (corners != std::vector<VertexId>{mesh.origin(3 * f), mesh.origin(3 * f + 1), mesh.origin(3 * f + 2)})
    return "the pieces miss a corner";
  return "";
}

Outcome pieces_partition_their_facet(Trial& t) {
  if (!t.certified()) return undecided();
  const Diagram& d = t.solution().diagram();
  std::map<FaceId, std::vector<const CellPiece*>> pieces;
  std::map<FaceId, std::vector<std::uint32_t>> arcs;
  for (const auto& piece : d.pieces) pieces[piece.face].push_back(&piece);
  for (std::uint32_t i = 0; i < d.arcs.size(); ++i)
    if (!d.arcs[i].along_edge) arcs[d.arcs[i].face].push_back(i);
  for (const auto& [f, list] : pieces) {
    const std::string fault = fault_of_face(t.mesh(), d, f, list, arcs[f]);
    if (!fault.empty()) return violated(fmt::format("face {}: {}", f, fault));
  }
  for (FaceId f = 0; f < t.mesh().face_count(); ++f) {
    const bool reached = !std::isinf(t.solution().distance(t.mesh().origin(3 * f)));
    if (reached != (d.face_label[f] != kNone || pieces.count(f) != 0))
      return violated(fmt::format("face {} has neither label nor pieces, or is unreachable and has", f));
  }
  return holds();
}

Outcome euler(Trial& t) {
  if (!t.certified()) return undecided();
  const Mesh& mesh = t.mesh();
  const Diagram& d = t.solution().diagram();
  std::int64_t chi = 0, chi_of_mesh = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) chi_of_mesh += mesh.is_isolated(v) ? 0 : 1;
  for (kernel::HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) chi_of_mesh -= mesh.twin(h) == kNone || mesh.twin(h) > h ? 1 : 0;
  chi = chi_of_mesh;  // vertices and edges; a point inside an edge adds a vertex and cuts the edge in two
  chi_of_mesh += mesh.face_count();
  for (const auto& p : d.points)
    if (p.vertex == kNone && p.edge[0] == kNone) ++chi;
  for (const Arc& arc : d.arcs) chi -= arc.along_edge ? 0 : 1;
  std::set<FaceId> cut;
  for (const auto& piece : d.pieces) {
    cut.insert(piece.face);
    chi += 1 - static_cast<std::int64_t>(piece.holes.size());
  }
  chi += mesh.face_count() - static_cast<std::int64_t>(cut.size());
  return chi == chi_of_mesh ? holds() : violated(fmt::format("V - E + F is {} for the diagram, {} for the mesh", chi, chi_of_mesh));
}

Ball ball(const Enclosed& e) {
  const double middle = e.low / 2 + e.high / 2;
  return {middle, std::max(e.high - middle, middle - e.low) * (1 + 0x1p-50)};
}

Outcome bisector_points_are_equidistant(Trial& t) {
  const Diagram& d = t.solution().diagram();
  const auto is_enclosure = [](const Enclosed& e) { return e.low <= e.value && e.value <= e.high; };
  for (std::size_t a = 0; a < d.arcs.size(); ++a)
    for (const auto node : d.arcs[a].node) {
      const auto& point = d.points[node];
      if (point.face != d.arcs[a].face) continue;
      std::array<Ball, 2> distance;
      for (std::size_t side = 0; side < 2; ++side) {
        const auto& image = d.arcs[a].image[side];
        if (!is_enclosure(image[0]) || !is_enclosure(image[1]) || !is_enclosure(point.frame[0]) || !is_enclosure(point.frame[1]))
          return violated(fmt::format("arc {}: a value lies outside its enclosure", a));
        distance[side] = ball(d.arcs[a].weight[side]) +
                         sqrt(square(ball(point.frame[0]) - ball(image[0])) + square(ball(point.frame[1]) - ball(image[1])));
      }
      const Ball difference = distance[0] - distance[1];
      if (difference.is_finite() && std::fabs(difference.mid()) > difference.rad())
        return violated(fmt::format("arc {}: its end has distances {} and {}", a, distance[0].mid(), distance[1].mid()));
    }
  return holds();
}

/// Joins what touches.
class Union {
 public:
  explicit Union(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

/// Joins the ends of each edge that lies in the cell of source s at its ends and in the middle: what is beyond a relay may hang together with the rest of the
/// cell by a shared ray only, which has no piece.
void join_by_edges(Trial& t, SourceId s, Union& parts) {
  const Mesh& mesh = t.mesh();
  const auto is_in_cell = [&](const kernel::SurfacePoint& p) {
    const auto nearest = t.solution().query(p).nearest;
    return std::find(nearest.begin(), nearest.end(), s) != nearest.end();
  };
  for (kernel::HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.twin(h) < h) continue;
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    if (is_in_cell(point_at_vertex(mesh, a)) && is_in_cell(point_at_vertex(mesh, b)) && is_in_cell(point_on_edge(mesh, a, b, mpq_class(1, 2))))
      parts.join(a, b);
  }
}

/// All pieces and faces of a cell hang together, by common points of their outlines or by shared edges, with the place of the source: a geodesic to
/// the source never leaves the cell. An enclave does not.
Outcome cells_are_connected(Trial& t) {
  if (!t.certified()) return undecided();
  const Mesh& mesh = t.mesh();
  const Diagram& d = t.solution().diagram();
  const Nodes nodes(mesh, d);
  std::set<FaceId> cut;
  for (const auto& piece : d.pieces) cut.insert(piece.face);
  std::map<std::array<VertexId, 2>, std::vector<std::uint32_t>> on_edge;
  for (std::uint32_t p = 0; p < d.points.size(); ++p)
    if (d.points[p].edge[0] != kNone) on_edge[d.points[p].edge].push_back(p);
  for (SourceId s = 0; s < t.sources().size(); ++s) {
    const auto owns = [&](kernel::LabelSetId set) {
      return set != kNone && std::binary_search(d.label_sets[set].begin(), d.label_sets[set].end(), s);
    };
    Union parts(nodes.count());
    std::vector<std::pair<std::size_t, FaceId>> elements;
    for (const auto& piece : d.pieces) {
      if (!owns(piece.labels)) continue;
      elements.push_back({nodes.of(piece.face, piece.outline[0].from), piece.face});
      for (const auto& side : piece.outline) parts.join(elements.back().first, nodes.of(piece.face, side.from));
      for (const auto& hole : piece.holes)
        for (const auto& side : hole) parts.join(elements.back().first, nodes.of(piece.face, side.from));
    }
    for (FaceId f = 0; f < mesh.face_count(); ++f) {
      if (cut.count(f) != 0 || !owns(d.face_label[f])) continue;
      elements.push_back({mesh.origin(3 * f), f});
      for (kernel::HalfedgeId h = 3 * f; h < 3 * f + 3; ++h) {
        parts.join(mesh.origin(3 * f), mesh.origin(h));
        const VertexId a = mesh.origin(h), b = mesh.target(h);
        for (const std::uint32_t p : on_edge[{std::min(a, b), std::max(a, b)}]) parts.join(mesh.origin(3 * f), nodes.of_point(p));
      }
    }
    const auto is_apart = [&](const auto& element) { return parts.root(element.first) != parts.root(elements[0].first); };
    if (std::any_of(elements.begin(), elements.end(), is_apart)) join_by_edges(t, s, parts);
    for (const auto& [node, face] : elements)
      if (parts.root(node) != parts.root(elements[0].first))
        return violated(fmt::format("the cell of source {} is not connected: faces {} and {}", s, elements[0].second, face));
    const FaceId home = t.sources()[s].at.face;
    const bool at_vertex = kernel::locate(mesh, t.sources()[s].at).kind == kernel::Location::Kind::vertex;
    const bool hidden = d.cells[s].hidden;
    // Another source may come to this one with exactly its weight: its cell has no inside then.
    const bool shared = t.solution().query(t.sources()[s].at).nearest.size() > 1;
    if (!hidden && !at_vertex && !shared &&
        std::none_of(elements.begin(), elements.end(), [&](const auto& e) { return e.second == home; }))
      return violated(fmt::format("source {} does not lie in its cell", s));
    if (hidden && !elements.empty()) return violated(fmt::format("source {} is hidden and has a cell", s));
  }
  return holds();
}

constexpr std::array<Property, 4> kProperties = {{
    {"pieces_partition_their_facet", pieces_partition_their_facet, 1,
     "the pieces of a facet go once round it and lie on both sides of every arc"},
    {"euler", euler, 1, "vertices less edges plus faces of the diagram is that of the mesh"},
    {"bisector_points_are_equidistant", bisector_points_are_equidistant, 1,
     "the ends of an arc are equally far from both its images, within enclosures"},
    {"cells_are_connected", cells_are_connected, 1, "a cell hangs together and holds its source"},
}};

}  // namespace

std::span<const Property> diagram_properties() { return kProperties; }

}  // namespace gvd::fuzz
