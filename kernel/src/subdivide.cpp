#include <algorithm>
#include <string>
#include <utility>

#include "gvd/kernel/error.hpp"
#include "subdivision.hpp"

namespace gvd::kernel::subdivision {
namespace {

class Subdivider {
 public:
  Subdivider(const DiagramInput& in, predicates::Decisions& decisions)
      : in_(in), mesh_(in.refined), decisions_(decisions), joiner_(in, decisions) {}

  Subdivision run() {
    make_skeletons();
    complete_skeletons();
    check_uniform_faces();
    join_sides();
    make_vertex_places();
    reserve_darts();
    for (std::uint32_t f = 0; f < s_.facets.size(); ++f) make_darts(f);
    pair_twins();
    make_links();
    index_ends();
    return std::move(s_);
  }

 private:
  void make_skeletons() {
    s_.facet_of.assign(mesh_.face_count(), kNone);
    const std::vector<FaceId> faces = faces_to_subdivide();
    s_.facets.reserve(faces.size());
    for (const FaceId f : faces) {
      s_.facet_of[f] = static_cast<std::uint32_t>(s_.facets.size());
      const auto given =
          std::lower_bound(in_.facets.begin(), in_.facets.end(), f, [](const BoundaryFacet& a, FaceId b) { return a.face < b; });
      if (given == in_.facets.end() || given->face != f)
        s_.facets.push_back(make_uniform_skeleton(f, in_.face_labels[f]));
      else if (given->tessellation->undecided)
        s_.facets.push_back({.face = f, .undecided = true});
      else
        s_.facets.push_back(checked_skeleton(*given));
    }
  }

  Skeleton checked_skeleton(const BoundaryFacet& facet) const {
    try {
      return make_skeleton(facet, *s_.memory);
    } catch (const InternalError&) {
      if (all_decided(decisions_)) throw;
      return {.face = facet.face, .undecided = true};  // it is built on something undecided
    }
  }

  /// Borders alone are enough where both facets of an edge show the same by identity. Elsewhere the waves between them play a part.
  void complete_skeletons() {
    to_ask_.assign(s_.facets.size(), 1);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::uint32_t f = 0; f < s_.facets.size(); ++f)
        if (std::exchange(to_ask_[f], 0) != 0) changed |= !is_joined_by_borders(f);
    }
  }

  /// Completes the facet, and a neighbour, if they are not.
  bool is_joined_by_borders(std::uint32_t f) {
    for (std::uint32_t k = 0; k < 3 && has_borders_only(s_.facets[f]); ++k) {
      const HalfedgeId h = 3 * s_.facets[f].face + k;
      const Skeleton* other = decided_facet(mesh_.twin(h));
      if (other == nullptr || other->waves == nullptr || (mesh_.twin(h) < h && has_borders_only(*other))) continue;  // asked from there
      if (joiner_.are_identical(h, s_.facets[f], *other)) continue;
      complete(f);
      const std::uint32_t g = s_.facet_of[other->face];
      if (has_borders_only(*other)) complete(g);
      return false;
    }
    return true;
  }

  static bool has_borders_only(const Skeleton& facet) { return facet.tessellation != nullptr && facet.tessellation->borders_only; }

  void complete(std::uint32_t f) {
    FacetWaves& waves = *s_.facets[f].waves;
    s_.completed.push_back(std::make_unique<FacetTessellation>(tessellate(waves, decisions_)));
    const FacetTessellation& whole = *s_.completed.back();
    s_.facets[f] = whole.undecided ? Skeleton{.face = waves.face, .undecided = true} : checked_skeleton({waves.face, &waves, &whole});
    for (HalfedgeId h = 3 * waves.face; h < 3 * waves.face + 3; ++h)
      if (const HalfedgeId twin = mesh_.twin(h); twin != kNone && s_.facet_of[Mesh::face(twin)] != kNone) to_ask_[s_.facet_of[Mesh::face(twin)]] = 1;
  }

  /// The tessellated faces, and all parts of an input face of which one part is tessellated.
  std::vector<FaceId> faces_to_subdivide() const {
    std::vector<FaceId> faces;
    for (const auto& facet : in_.facets) faces.push_back(facet.face);
    if (mesh_.face_count() == in_.input.face_count()) return faces;
    std::vector<std::uint8_t> touched(in_.input.face_count(), 0);
    for (const FaceId f : faces) touched[mesh_.input_face(f)] = 1;
    faces.clear();
    for (FaceId f = 0; f < mesh_.face_count(); ++f)
      if (touched[mesh_.input_face(f)] != 0) faces.push_back(f);
    return faces;
  }

  /// Beside a face with one label set that is not tessellated, the other face shows the same set all along the edge.
  void check_uniform_faces() const {
    if (!all_decided(decisions_)) return;
    for (HalfedgeId h = 0; h < mesh_.halfedge_count(); ++h) {
      if (s_.facet_of[Mesh::face(h)] == kNone && !agrees_beyond(h))
        throw InternalError("facet " + std::to_string(Mesh::face(h)) +
                            " is not tessellated, but its label set differs from that beyond side " + std::to_string(h % 3));
    }
  }

  /// Whether beyond half-edge h of an untessellated face there is its label set only, as far as that is known.
  bool agrees_beyond(HalfedgeId h) const {
    const HalfedgeId twin = mesh_.twin(h);
    if (twin == kNone) return true;
    const std::uint32_t facet = s_.facet_of[Mesh::face(twin)];
    const LabelSetId labels = in_.face_labels[Mesh::face(h)];
    if (facet == kNone) return in_.face_labels[Mesh::face(twin)] == labels;
    const auto& pieces = s_.facets[facet].sides[twin % 3].pieces;
    return std::all_of(pieces.begin(), pieces.end(), [&](const Piece& piece) { return piece.labels == labels; });
  }

  const Skeleton* decided_facet(HalfedgeId h) const {
    if (h == kNone) return nullptr;
    const std::uint32_t f = s_.facet_of[Mesh::face(h)];
    return f == kNone || s_.facets[f].undecided ? nullptr : &s_.facets[f];
  }

  /// Finds the stations of every side, and gives each a place.
  void join_sides() {
    stations_of_.assign(3 * s_.facets.size(), {0, 0});
    open_.assign(3 * s_.facets.size(), 0);
    for (std::uint32_t f = 0; f < s_.facets.size(); ++f) {
      if (s_.facets[f].undecided) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const HalfedgeId h = 3 * s_.facets[f].face + k;
        const HalfedgeId twin = mesh_.twin(h);
        const Skeleton* other = decided_facet(twin);
        if (other == nullptr)
          take_own_events(f, k, twin != kNone && (s_.facet_of[Mesh::face(twin)] != kNone || !agrees_beyond(twin)));
        else if (h < twin)
          join_over(h, f, k, twin, *other);
      }
    }
  }

  /// From one corner of the side to the next; node_left is the facet's own node.
  std::span<const Station> stations(std::uint32_t f, std::uint32_t k) const {
    const auto& [begin, end] = stations_of_[3 * f + k];
    return {stations_.data() + begin, stations_.data() + end};
  }

  void take_own_events(std::uint32_t f, std::uint32_t k, bool open) {
    joint_.stations.clear();
    for (const Event& event : s_.facets[f].sides[k].events)
      if (event.essential) joint_.stations.push_back({kNone, event.node, kNone});
    open_[3 * f + k] = open ? 1 : 0;
    give_places(3 * s_.facets[f].face + k, f, kNone, open);
    keep_stations(f, k);
  }

  void join_over(HalfedgeId h, std::uint32_t f, std::uint32_t k, HalfedgeId twin, const Skeleton& other) {
    const std::uint32_t g = s_.facet_of[Mesh::face(twin)];
    joiner_.join(h, s_.facets[f], other, joint_);
    if (!joint_.decided) {
      take_own_events(f, k, true);
      take_own_events(g, twin % 3, true);
      return;
    }
    give_places(h, f, g, false);
    keep_stations(f, k);
    std::reverse(joint_.stations.begin(), joint_.stations.end());
    for (Station& station : joint_.stations) {
      std::swap(station.node_left, station.node_right);
      std::swap(station.passed_left, station.passed_right);
    }
    keep_stations(g, twin % 3);
  }

  void keep_stations(std::uint32_t f, std::uint32_t k) {
    const auto begin = static_cast<std::uint32_t>(stations_.size());
    stations_.insert(stations_.end(), joint_.stations.begin(), joint_.stations.end());
    stations_of_[3 * f + k] = {begin, static_cast<std::uint32_t>(stations_.size())};
  }

  void give_places(HalfedgeId h, std::uint32_t f, std::uint32_t g, bool open) {
    const HalfedgeId twin = mesh_.twin(h);
    for (Station& station : joint_.stations) {
      station.place = static_cast<std::uint32_t>(s_.places.size());
      Place place{.kind = Place::Kind::edge, .boundary = twin == kNone, .open = open, .halfedge = std::min(h, twin)};
      const bool both = station.node_left != kNone && station.node_right != kNone;
      const bool mine =
          both ? mesh_.input_face(s_.facets[f].face) <= mesh_.input_face(s_.facets[g].face) : station.node_left != kNone;
      place.facet = mine ? f : g;
      place.node = mine ? station.node_left : station.node_right;
      s_.places.push_back(place);
    }
  }

  void make_vertex_places() {
    s_.vertex_place.assign(mesh_.vertex_count(), kNone);
    for (std::uint32_t f = 0; f < s_.facets.size(); ++f) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const VertexId v = mesh_.origin(3 * s_.facets[f].face + k);
        if (s_.vertex_place[v] == kNone) {
          s_.vertex_place[v] = static_cast<std::uint32_t>(s_.places.size());
          s_.places.push_back({.kind = Place::Kind::vertex, .boundary = mesh_.is_boundary(v), .vertex = v});
        }
        Place& place = s_.places[s_.vertex_place[v]];
        place.open |= s_.facets[f].undecided || open_[3 * f + k] != 0 || open_[3 * f + (k + 2) % 3] != 0;
      }
    }
  }

  // ---- darts ----

  void reserve_darts() {
    std::size_t count = stations_of_.size() + stations_.size();
    for (const Skeleton& facet : s_.facets) count += 2 * facet.kept.size();
    s_.darts.reserve(count);
  }

  void make_darts(std::uint32_t f) {
    if (s_.facets[f].undecided) return;
    const Skeleton& facet = s_.facets[f];
    node_place_.assign(facet.tessellation == nullptr ? 0 : facet.tessellation->nodes.size(), kNone);
    for (std::uint32_t k = 0; k < 3; ++k) make_side_darts(f, k);
    make_arc_darts(f);
    link_outline(f);
    link_inner_nodes(facet);
  }

  std::uint32_t add_dart(Dart dart) {
    s_.darts.push_back(dart);
    return static_cast<std::uint32_t>(s_.darts.size() - 1);
  }

  void make_side_darts(std::uint32_t f, std::uint32_t k) {
    const Skeleton& facet = s_.facets[f];
    const HalfedgeId h = 3 * facet.face + k;
    const SideView& view = facet.sides[k];
    const VertexId v = mesh_.origin(h);
    if (facet.corner_node[k] != kNone) node_place_[facet.corner_node[k]] = s_.vertex_place[v];
    std::uint32_t piece = 0;
    side_first_[k] = add_dart(
        {.from = s_.vertex_place[v], .facet = f, .halfedge = h, .site = view.pieces[0].site, .labels = view.pieces[0].labels});
    for (const Station& station : stations(f, k)) {
      if (station.node_left != kNone) node_place_[station.node_left] = station.place;
      if (const std::uint32_t last = station.node_left != kNone ? station.node_left : station.passed_left; last != kNone)
        piece = std::find_if(view.events.begin(), view.events.end(), [&](const Event& e) { return e.node == last; })->after;
      add_dart(
          {.from = station.place, .facet = f, .halfedge = h, .site = view.pieces[piece].site, .labels = view.pieces[piece].labels});
    }
  }

  void make_arc_darts(std::uint32_t f) {
    const Skeleton& facet = s_.facets[f];
    if (facet.tessellation == nullptr) return;
    arc_dart_.assign(facet.tessellation->arcs.size(), kNone);
    for (const std::uint32_t a : facet.kept) {
      const auto& arc = facet.tessellation->arcs[a];
      const std::uint32_t from = place_of(f, arc.from), to = place_of(f, arc.to);
      const std::uint32_t d =
          add_dart({.from = from, .facet = f, .arc = a, .site = arc.left, .labels = facet.waves->sites[arc.left].labels});
      add_dart({.from = to, .facet = f, .arc = a, .site = arc.right, .labels = facet.waves->sites[arc.right].labels});
      s_.darts[d].twin = d + 1;
      s_.darts[d + 1].twin = d;
      arc_dart_[a] = d;
    }
  }

  std::uint32_t place_of(std::uint32_t f, std::uint32_t node) {
    std::uint32_t& place = node_place_[node];
    if (place == kNone) {
      if (s_.facets[f].tessellation->nodes[node].kind != FacetTessellation::Node::Kind::inside)
        throw InternalError("facet " + std::to_string(s_.facets[f].face) + ": an arc ends on the outline where there is no place");
      place = static_cast<std::uint32_t>(s_.places.size());
      s_.places.push_back({.kind = Place::Kind::inside, .facet = f, .node = node});
    }
    return place;
  }

  std::uint32_t outgoing(const Spoke& spoke) const { return arc_dart_[spoke.arc] + (spoke.reversed ? 1 : 0); }
  std::uint32_t incoming(const Spoke& spoke) const { return arc_dart_[spoke.arc] + (spoke.reversed ? 0 : 1); }

  /// Links the darts that meet at a place of the outline: `in` arrives along a side, `out` leaves along a side, arcs stand between.
  void link_at(std::uint32_t in, std::uint32_t out, std::span<const Spoke> spokes) {
    std::uint32_t target = out;
    for (const Spoke& spoke : spokes) {
      s_.darts[incoming(spoke)].next = target;
      target = outgoing(spoke);
    }
    s_.darts[in].next = target;
  }

  void link_outline(std::uint32_t f) {
    const Skeleton& facet = s_.facets[f];
    const auto spokes_of = [&](std::uint32_t node) { return node == kNone ? std::span<const Spoke>() : facet.spokes_at(node); };
    for (std::uint32_t k = 0; k < 3; ++k) {
      std::uint32_t dart = side_first_[k];
      for (const Station& station : stations(f, k)) {
        link_at(dart, dart + 1, spokes_of(station.node_left));
        ++dart;
      }
      const std::uint32_t corner = (k + 1) % 3;
      link_at(dart, side_first_[corner], spokes_of(facet.corner_node[corner]));
    }
  }

  void link_inner_nodes(const Skeleton& facet) {
    if (facet.tessellation == nullptr) return;
    for (std::uint32_t n = 0; n < facet.spokes_end.size(); ++n) {
      const std::span<const Spoke> spokes = facet.spokes_at(n);
      if (facet.tessellation->nodes[n].kind != FacetTessellation::Node::Kind::inside || spokes.empty()) continue;
      std::uint32_t target = outgoing(spokes.back());
      for (const Spoke& spoke : spokes) {
        s_.darts[incoming(spoke)].next = target;
        target = outgoing(spoke);
      }
    }
  }

  // ---- over the edges ----

  /// Darts along the two sides of a joined edge run against one another.
  void pair_twins() {
    std::vector<std::array<std::uint32_t, 2>> range(3 * s_.facets.size(), {0, 0});
    for (std::uint32_t d = 0, count = s_.dart_count(); d < count; ++d) {
      const Dart& dart = s_.darts[d];
      if (dart.halfedge == kNone) continue;
      auto& r = range[3 * dart.facet + dart.halfedge % 3];
      if (r[1] == 0) r[0] = d;
      r[1] = d + 1;
    }
    for (std::uint32_t side = 0; side < range.size(); ++side) {
      const std::uint32_t f = side / 3;
      if (s_.facets[f].undecided || open_[side] != 0) continue;
      const HalfedgeId twin = mesh_.twin(3 * s_.facets[f].face + side % 3);
      if (decided_facet(twin) == nullptr) continue;
      const auto& theirs = range[3 * s_.facet_of[Mesh::face(twin)] + twin % 3];
      for (std::uint32_t d = range[side][0]; d < range[side][1]; ++d) s_.darts[d].twin = theirs[1] - 1 - (d - range[side][0]);
    }
  }

  void make_links() {
    for (std::uint32_t d = 0, count = s_.dart_count(); d < count; ++d) {
      const Dart& dart = s_.darts[d];
      if (dart.twin == kNone || dart.twin < d || s_.darts[dart.twin].labels == dart.labels) continue;
      s_.links.push_back({d, dart.from, s_.to(d), {dart.labels, s_.darts[dart.twin].labels}});
    }
  }

  void index_ends() {
    s_.end_start.assign(s_.places.size() + 1, 0);
    for (const Link& link : s_.links) {
      ++s_.end_start[link.from + 1];
      ++s_.end_start[link.to + 1];
    }
    for (std::size_t p = 0; p < s_.places.size(); ++p) s_.end_start[p + 1] += s_.end_start[p];
    std::vector<std::uint32_t> fill(s_.end_start.begin(), s_.end_start.end() - 1);
    s_.ends.resize(2 * s_.links.size());
    for (std::uint32_t l = 0; l < s_.links.size(); ++l) {
      s_.ends[fill[s_.links[l].from]++] = {l, false};
      s_.ends[fill[s_.links[l].to]++] = {l, true};
    }
  }

  const DiagramInput& in_;
  const Mesh& mesh_;
  predicates::Decisions& decisions_;
  EdgeJoiner joiner_;
  Subdivision s_;
  std::vector<std::uint8_t> to_ask_;  // per facet: whether borders alone are enough is not known
  std::vector<Station> stations_;
  std::vector<std::array<std::uint32_t, 2>> stations_of_;  // per facet and side: a range
  std::vector<std::uint8_t> open_;                         // per facet and side: nothing is known beyond
  Joint joint_;                                            // of the edge at hand
  // of the facet whose darts are being made
  std::vector<std::uint32_t> node_place_, arc_dart_;
  std::array<std::uint32_t, 3> side_first_{};
};

}  // namespace

Subdivision subdivide(const DiagramInput& in, predicates::Decisions& decisions) { return Subdivider(in, decisions).run(); }

}  // namespace gvd::kernel::subdivision
