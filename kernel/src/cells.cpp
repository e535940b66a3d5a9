#include "cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "gvd/kernel/error.hpp"

namespace gvd::kernel::subdivision {
namespace {

double face_area(const Mesh& mesh, FaceId f) {
  const Point &a = mesh.point(mesh.origin(3 * f)), &b = mesh.point(mesh.origin(3 * f + 1)), &c = mesh.point(mesh.origin(3 * f + 2));
  std::array<double, 3> u{}, v{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
  }
  return 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}

class PieceMaker {
 public:
  PieceMaker(const DiagramInput& in, const Subdivision& s, const Loops& loops, const std::vector<std::uint32_t>& point_of, const LinkArcs& link_arcs,
             Diagram& d)
      : in_(in), s_(s), loops_(loops), point_of_(point_of), link_arcs_(link_arcs), d_(d), link_of_(s.darts.size(), kNone) {
    for (std::uint32_t l = 0; l < s.links.size(); ++l) link_of_[s.links[l].dart] = link_of_[s.darts[s.links[l].dart].twin] = l;
  }

  void run() {
    label_uniform_faces();
    make_pieces();
    sum_areas();
  }

 private:
  void label_uniform_faces() {
    d_.face_label.assign(in_.input.face_count(), kNone);
    for (FaceId f = 0; f < in_.refined.face_count(); ++f)
      if (s_.facet_of[f] == kNone) d_.face_label[in_.refined.input_face(f)] = in_.face_labels[f];
    std::vector<std::uint8_t> several(in_.input.face_count(), 0);
    for (const Skeleton& facet : s_.facets)
      if (facet.undecided) several[in_.refined.input_face(facet.face)] = 1;
    for (const Loop& loop : loops_.list) {
      LabelSetId& label = d_.face_label[loop.face];
      if (label == kNone) label = loop.labels;
      if (label != loop.labels) several[loop.face] = 1;
    }
    for (FaceId f = 0; f < in_.input.face_count(); ++f) {
      if (several[f] == 0) continue;
      d_.face_label[f] = kNone;
      ++d_.boundary_facets;
    }
  }

  void make_pieces() {
    std::uint32_t last_region = kNone;
    for (const Loop& loop : loops_.list) {
      if (d_.face_label[loop.face] != kNone) continue;
      if (loop.region != last_region) {
        d_.pieces.push_back({.face = loop.face, .labels = loop.labels, .outline = outline(loop), .holes = {}});
        last_region = loop.region;
      } else {
        d_.pieces.back().holes.push_back(outline(loop));
      }
    }
  }

  /// The name of a place in an outline: a point or a corner; kNone if it is neither.
  std::uint32_t name_of(std::uint32_t p, FaceId face) const {
    if (point_of_[p] != kNone) return point_of_[p];
    const Place& place = s_.places[p];
    if (place.kind == Place::Kind::vertex)
      for (std::uint32_t k = 0; k < 3; ++k)
        if (in_.input.origin(3 * face + k) == place.vertex) return CellPiece::kCorner | k;
    return kNone;
  }

  std::vector<CellPiece::Side> outline(const Loop& loop) const {
    const auto darts = std::span(loops_.darts).subspan(loop.begin, loop.end - loop.begin);
    std::vector<CellPiece::Side> sides;
    sides.reserve(darts.size());
    for (const std::uint32_t d : darts) {
      const std::uint32_t name = name_of(s_.darts[d].from, loop.face);
      if (name == kNone) continue;
      CellPiece::Side side{.from = name};
      const std::uint32_t link = link_of_[d];
      if (link != kNone) {
        side.arc = link_arcs_.arc[link];
        side.reversed = (link_arcs_.reversed[link] != 0) != (s_.links[link].dart != d);
      }
      sides.push_back(side);
    }
    return sides;
  }

  void sum_areas() {
    std::vector<double> area(in_.label_sets.size(), 0);
    std::vector<bool> present(in_.label_sets.size());  // an area may underflow
    const auto add = [&](LabelSetId labels, double value) {
      if (labels == kNone) return;
      area[labels] += value;
      present[labels] = true;
    };
    for (FaceId f = 0; f < in_.input.face_count(); ++f) add(d_.face_label[f], face_area(in_.input, f));
    for (const Loop& loop : loops_.list)
      if (d_.face_label[loop.face] == kNone) add(loop.labels, loop.area);
    for (LabelSetId labels = 0; labels < area.size(); ++labels) {
      for (const SourceId source : in_.label_sets[labels]) d_.cells[source].area += area[labels];
      if (in_.label_sets[labels].size() > 1 && present[labels]) d_.shared.push_back({labels, area[labels]});
    }
  }

  const DiagramInput& in_;
  const Subdivision& s_;
  const Loops& loops_;
  const std::vector<std::uint32_t>& point_of_;
  const LinkArcs& link_arcs_;
  Diagram& d_;
  std::vector<std::uint32_t> link_of_;  // per dart
};

// ---- Euler characteristics ----

/// Counts the vertices, edges and faces of the subdivided surface that lie in the closed region of each label set, and of each
/// source.
class EulerCount {
 public:
  EulerCount(const DiagramInput& in, const Subdivision& s)
      : of_labels(in.label_sets.size(), 0), of_source(in.sources.size(), 0), in_(in), s_(s), inside_(in.label_sets.size(), 0) {
    count_faces();
    count_edges();
    count_vertices();
    distribute_inside();
  }

  std::vector<std::int64_t> of_labels, of_source;
  std::int64_t of_surface = 0;  ///< of the part that is reached

 private:
  /// Adds a cell of the subdivision, whose closure in the regions of these two label sets it is.
  void add_between(LabelSetId a, LabelSetId b, std::int64_t sign) {
    if (!is_single(a) || !is_single(b)) return add(std::array{a, b}, sign);
    of_surface += sign;
    for (const LabelSetId l : {a, b}) {
      of_labels[l] += sign;
      of_source[in_.label_sets[l].front()] += sign;
    }
  }
  bool is_single(LabelSetId l) const { return in_.label_sets[l].size() == 1; }
  /// The same for any label sets, no two of them the same.
  void add(std::span<const LabelSetId> around, std::int64_t sign) {
    of_surface += sign;
    sources_.clear();
    for (const LabelSetId l : around) {
      of_labels[l] += sign;
      sources_.insert(sources_.end(), in_.label_sets[l].begin(), in_.label_sets[l].end());
    }
    std::sort(sources_.begin(), sources_.end());
    sources_.erase(std::unique(sources_.begin(), sources_.end()), sources_.end());
    for (const SourceId source : sources_) of_source[source] += sign;
  }
  /// The same inside the region of one label set.
  void add_inside(LabelSetId labels, std::int64_t sign) {
    if (labels == kNone) return;
    of_surface += sign;
    inside_[labels] += sign;
  }
  void distribute_inside() {
    for (LabelSetId l = 0; l < inside_.size(); ++l) {
      of_labels[l] += inside_[l];
      for (const SourceId source : in_.label_sets[l]) of_source[source] += inside_[l];
    }
  }

  bool is_plain(FaceId f) const { return s_.facet_of[f] == kNone; }

  /// Each outline of a facet bounds a disc: their number agrees with the characteristic of the facet.
  void count_faces() {
    for (FaceId f = 0; f < in_.refined.face_count(); ++f)
      if (is_plain(f)) add_inside(in_.face_labels[f], 1);
    std::vector<std::uint8_t> visited(s_.darts.size(), 0);
    std::vector<std::int64_t> discs(s_.facets.size(), 0), arcs(s_.facets.size(), 0), inner(s_.facets.size(), 0);
    for (const Place& place : s_.places)
      if (place.kind == Place::Kind::inside) ++inner[place.facet];
    for (std::uint32_t d = 0, count = s_.dart_count(); d < count; ++d) {
      const Dart& dart = s_.darts[d];
      if (dart.arc != kNone) ++arcs[dart.facet];
      if (visited[d] != 0) continue;
      for (std::uint32_t x = d; visited[x] == 0; x = s_.darts[x].next) {
        visited[x] = 1;
        if (s_.darts[x].labels != dart.labels)
          throw InternalError("an outline with two label sets in facet " + std::to_string(s_.facets[dart.facet].face));
      }
      ++discs[dart.facet];
      add_inside(dart.labels, 1);
    }
    for (std::size_t f = 0; f < s_.facets.size(); ++f) {  // outline: as many places as sides; arcs have two darts
      if (!s_.facets[f].undecided && inner[f] - arcs[f] / 2 + discs[f] != 1)
        throw InternalError("facet " + std::to_string(s_.facets[f].face) + ": the regions are not discs");
    }
  }

  void count_edges() {
    for (HalfedgeId h = 0; h < in_.refined.halfedge_count(); ++h) {
      const HalfedgeId twin = in_.refined.twin(h);
      if ((twin != kNone && twin < h) || !is_plain(Mesh::face(h))) continue;
      if (twin == kNone || is_plain(Mesh::face(twin))) add_inside(in_.face_labels[Mesh::face(h)], -1);
    }
    for (std::uint32_t d = 0, count = s_.dart_count(); d < count; ++d) {
      const Dart& dart = s_.darts[d];
      if (dart.twin != kNone && dart.twin < d) continue;
      const LabelSetId beyond = dart.twin == kNone ? dart.labels : s_.darts[dart.twin].labels;
      dart.labels == beyond ? add_inside(beyond, -1) : add_between(dart.labels, beyond, -1);
    }
  }

  void count_vertices() {
    around_.resize(s_.places.size());
    for (const Dart& dart : s_.darts) note(dart.from, dart.labels);
    for (VertexId v = 0; v < in_.refined.vertex_count(); ++v) {
      if (in_.refined.is_isolated(v)) continue;
      const std::uint32_t place = s_.vertex_place[v];
      if (place == kNone) {
        add_inside(in_.face_labels[Mesh::face(in_.refined.outgoing(v))], 1);
        continue;
      }
      in_.refined.for_each_outgoing(v, [&](HalfedgeId h) {
        if (is_plain(Mesh::face(h))) note(place, in_.face_labels[Mesh::face(h)]);
      });
    }
    add_places();
  }

  /// The first two label sets round a place; hardly any has more.
  struct Around {
    LabelSetId first = kNone, second = kNone;
  };
  void note(std::uint32_t place, LabelSetId labels) {
    Around& around = around_[place];
    if (labels == kNone || labels == around.first || labels == around.second) return;
    if (around.first == kNone)
      around.first = labels;
    else if (around.second == kNone)
      around.second = labels;
    else
      further_.push_back({place, labels});
  }

  void add_places() {
    std::sort(further_.begin(), further_.end());
    further_.erase(std::unique(further_.begin(), further_.end()), further_.end());
    auto next = further_.begin();
    for (std::uint32_t p = 0; p < around_.size(); ++p) {
      const auto [first, second] = around_[p];
      if (next != further_.end() && next->first == p) {
        labels_ = {first, second};
        for (; next != further_.end() && next->first == p; ++next) labels_.push_back(next->second);
        add(labels_, 1);
      } else if (second != kNone) {
        add_between(first, second, 1);
      } else {
        add_inside(first, 1);
      }
    }
  }

  const DiagramInput& in_;
  const Subdivision& s_;
  std::vector<std::int64_t> inside_;
  std::vector<Around> around_;                                     // per place
  std::vector<std::pair<std::uint32_t, LabelSetId>> further_;  // place, another label set there
  std::vector<SourceId> sources_;
  std::vector<LabelSetId> labels_;
};

/// V - E + F of the part of the refined mesh that is reached, from the mesh alone.
std::int64_t euler_of_reached(const DiagramInput& in, const Subdivision& s) {
  const Mesh& mesh = in.refined;
  const auto reached = [&](HalfedgeId h) { return s.facet_of[Mesh::face(h)] != kNone || in.face_labels[Mesh::face(h)] != kNone; };
  std::int64_t euler = 0;
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    if (!reached(h)) continue;
    if (h % 3 == 0) ++euler;
    if (mesh.twin(h) == kNone || h < mesh.twin(h)) --euler;
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (!mesh.is_isolated(v) && reached(mesh.outgoing(v))) ++euler;
  return euler;
}

void check_euler(const EulerCount& count, const DiagramInput& in, const Subdivision& s, const Chains& chains) {
  const std::int64_t surface = euler_of_reached(in, s);
  if (count.of_surface != surface) throw InternalError("the subdivision does not have the Euler characteristic of the surface");
  std::int64_t sum = 0;
  for (const std::int64_t euler : count.of_labels) sum += euler;
  for (const Chain& chain : chains.chains) sum += chain.closed ? 0 : 1;
  std::vector<LabelSetId> around;
  for (std::uint32_t p = 0; p < s.places.size(); ++p) {
    if (!is_end(chains.role[p])) continue;
    around.clear();
    for (const LinkEnd& end : s.ends_at(p))
      around.insert(around.end(), s.links[end.link].labels.begin(), s.links[end.link].labels.end());
    std::sort(around.begin(), around.end());
    sum -= std::unique(around.begin(), around.end()) - around.begin() - 1;
  }
  if (sum != surface)
    throw InternalError("Euler's formula does not hold for the diagram: " + std::to_string(sum) + " instead of " +
                        std::to_string(surface));
}

}  // namespace

void count_cells(const DiagramInput& in, const Subdivision& s, const Chains& chains, bool check, Diagram& diagram) {
  const EulerCount count(in, s);
  if (check) check_euler(count, in, s, chains);
  diagram.cells.resize(in.sources.size());
  for (SourceId i = 0; i < in.sources.size(); ++i) {
    diagram.cells[i].source = i;
    diagram.cells[i].hidden = in.sources[i].hidden;
    diagram.cells[i].euler = count.of_source[i];
  }
}

void make_cells(const DiagramInput& in, const Subdivision& s, const Loops& loops, const std::vector<std::uint32_t>& point_of, const LinkArcs& link_arcs,
                Diagram& diagram) {
  PieceMaker(in, s, loops, point_of, link_arcs, diagram).run();
}

}  // namespace gvd::kernel::subdivision
