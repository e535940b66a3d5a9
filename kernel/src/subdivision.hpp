#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gvd/kernel/extract.hpp"

/// The subdivision of the surface by label sets, as the extraction builds it: places, darts and links (docs/diagram.md).
namespace gvd::kernel::subdivision {

/// Whether nothing is undecided so far. If so, a contradiction is an error of ours; otherwise it is one more undecided place.
inline bool all_decided(const predicates::Decisions& decisions) { return decisions.total(robust::Stage::undecided) == 0; }

/// A point where something meets: a vertex of the refined mesh, a point inside one of its edges, or a point inside a facet.
struct Place {
  enum class Kind : std::uint8_t { vertex, edge, inside };
  Kind kind = Kind::inside;
  bool boundary = false;                      ///< on the boundary of the mesh
  bool open = false;                          ///< beside an undecided facet or edge: what meets here is not all known
  VertexId vertex = kNone;                    ///< vertex
  HalfedgeId halfedge = kNone;                ///< edge: the half-edge with the lower id
  std::uint32_t facet = kNone, node = kNone;  ///< edge, inside: a node of a tessellation (index into the facets) that constructs it
};

/// A directed side of a region, the region on its left: one side of a kept arc, or a piece of a side of a facet.
struct Dart {
  std::uint32_t from = kNone;  ///< place
  std::uint32_t twin = kNone;  ///< kNone: boundary of the mesh, or the face beyond has no darts
  std::uint32_t next = kNone;  ///< the next dart round the region, within the facet
  std::uint32_t facet = kNone;
  std::uint32_t arc = kNone;    ///< arc of the tessellation; kNone: a piece of a side
  HalfedgeId halfedge = kNone;  ///< of a piece of a side
  std::uint32_t site = kNone;   ///< on the left; of a piece of a side: where it begins
  LabelSetId labels = kNone;    ///< on the left
};

/// A place where the regions along one side of a facet change, or where kept arcs end on it.
struct Event {
  std::uint32_t node = kNone;
  std::uint32_t before = 0, after = 0;  ///< indices of the pieces
  bool essential = false;               ///< the label set changes or a kept arc ends here
};

/// One region met along a side, in the order of the half-edge.
struct Piece {
  std::uint32_t site = kNone;
  LabelSetId labels = kNone;
  std::uint32_t last_site = kNone;  ///< where it ends: another one only if no more than borders are known
};

/// What one facet shows on one of its sides, in the order of the half-edge: pieces.size() == events.size() + 1.
struct SideView {
  std::pmr::vector<Piece> pieces;
  std::pmr::vector<Event> events;
  void assign_reversed(const SideView& view);
};

/// An arc as it leaves a node.
struct Spoke {
  std::uint32_t arc = kNone;
  bool reversed = false;  ///< the arc ends here
};

/// One tessellated facet with the arcs between equal label sets taken away.
struct Skeleton {
  FaceId face = kNone;
  FacetWaves* waves = nullptr;  ///< nullptr: a face with one label set and no tessellation
  const FacetTessellation* tessellation = nullptr;
  LabelSetId only_label = kNone;      ///< if waves == nullptr
  bool undecided = false;             ///< no darts are made
  std::pmr::vector<std::uint32_t> kept{};  ///< arcs between different label sets
  std::array<SideView, 3> sides{};
  std::array<std::uint32_t, 3> corner_node{kNone, kNone, kNone};
  std::pmr::vector<Spoke> spokes{};           ///< by node: kept arcs counter-clockwise (on the outline: from the outgoing side)
  std::pmr::vector<std::uint32_t> spokes_end{};  ///< per node: where its own end

  std::span<const Spoke> spokes_at(std::uint32_t node) const {
    const std::uint32_t begin = node == 0 ? 0 : spokes_end[node - 1];
    return std::span(spokes).subspan(begin, spokes_end[node] - begin);
  }
};

/// Its lists are in `memory`. Pre: the tessellation is not undecided. Throws InternalError if the tessellation is not a subdivision of the facet.
Skeleton make_skeleton(const BoundaryFacet& facet, std::pmr::memory_resource& memory);
Skeleton make_uniform_skeleton(FaceId face, LabelSetId labels);

/// Whether `same(a, b)` holds for any sites a and b that the two given ones stand for.
template <class Same>
bool any_pair(const Skeleton& left, std::uint32_t left_site, const Skeleton& right, std::uint32_t right_site, const Same& same) {
  if (left.waves == nullptr || right.waves == nullptr) return false;
  if (same(left.waves->sites[left_site], right.waves->sites[right_site])) return true;  // as a rule
  const auto& of_left = left.tessellation->representative;
  const auto& of_right = right.tessellation->representative;
  for (std::size_t i = 0; i < of_left.size(); ++i) {
    if (of_left[i] != left_site) continue;
    for (std::size_t j = 0; j < of_right.size(); ++j)
      if (of_right[j] == right_site && same(left.waves->sites[i], right.waves->sites[j])) return true;
  }
  return false;
}

/// A point where the two sides of an edge are joined: nodes of either side, or of both.
struct Station {
  std::uint32_t place = kNone;
  std::uint32_t node_left = kNone, node_right = kNone;  ///< of the facet of the half-edge, of the facet of its twin
  /// Where a facet has no node at the station: its last one before, going along its own half-edge, if that is no station and the station begins a stretch
  /// on which the facets differ.
  std::uint32_t passed_left = kNone, passed_right = kNone;
};

/// Joins what the two facets of an edge show on it.
struct Joint {
  bool decided = true;
  std::vector<Station> stations;  ///< in the order of the half-edge
};

/// Decides order and equality of nodes seen from the two facets of an edge.
class EdgeJoiner {
 public:
  EdgeJoiner(const DiagramInput& in, predicates::Decisions& decisions) : in_(in), decisions_(decisions) {}
  /// h: the half-edge of the left facet; the right one has its twin.
  void join(HalfedgeId h, const Skeleton& left, const Skeleton& right, Joint& joint);
  /// Whether either facet shows the same label sets there, between the same essential events by identity.
  bool are_identical(HalfedgeId h, const Skeleton& left, const Skeleton& right) const;
  /// Whether a site of one facet and a site of a neighbour facet over half-edge h of the former are one wave, by identity.
  static bool same_wave(const DiagramInput& in, HalfedgeId h, const Skeleton& left, std::uint32_t left_site, const Skeleton& right,
                        std::uint32_t right_site);

 private:
  static bool goes_over(const DiagramInput& in, HalfedgeId h, const FacetSite& a, const FacetSite& b);
  struct View;
  enum class Order : std::uint8_t { less, equal, greater, unknown };
  Order compare(const View& view, std::size_t left_event, std::size_t right_event);
  bool identical(const View& view, const Event& a, const Event& b) const;
  bool are_on_one_ray(const View& view, const Event& a, const Event& b) const;
  bool cross_alike(const View& view, const Event& a, const Event& b) const;
  bool contradict(const View& view, std::span<const Piece> of_left, std::span<const Piece> of_right) const;
  bool merge(const View& view, std::span<const std::size_t> left, std::span<const std::size_t> right, std::vector<Station>& out);
  bool insert_inner_events(const View& view, Joint& joint);
  std::optional<std::vector<std::size_t>> inner_events(const View& view, bool of_left, std::size_t from, std::size_t to,
                                                       Station* before, Station* behind);

  const DiagramInput& in_;
  predicates::Decisions& decisions_;
  // of the edge at hand
  mutable SideView reversed_;  // of the right facet
  std::vector<std::size_t> left_events_, right_events_;
  std::vector<Station> all_stations_;
};

/// A piece of a GVD edge inside one facet or along one edge. It runs along its dart; the twin dart lies on the other side.
struct Link {
  std::uint32_t dart = kNone;
  std::uint32_t from = kNone, to = kNone;          ///< places
  std::array<LabelSetId, 2> labels{kNone, kNone};  ///< left and right
};

/// The end of a link at a place.
struct LinkEnd {
  std::uint32_t link = kNone;
  bool at_to = false;
};

struct Subdivision {
  /// Where the small lists of the facets are; given back as a whole.
  std::unique_ptr<std::pmr::monotonic_buffer_resource> memory = std::make_unique<std::pmr::monotonic_buffer_resource>();
  std::vector<Skeleton> facets;         ///< sorted by face
  std::vector<std::uint32_t> facet_of;  ///< per face of the refined mesh: index into `facets` or kNone
  std::vector<Place> places;
  std::vector<std::uint32_t> vertex_place;  ///< per vertex of the refined mesh, kNone if no facet touches it
  std::vector<Dart> darts;
  std::vector<Link> links;
  std::vector<std::uint32_t> end_start;  ///< per place: range of `ends`
  std::vector<LinkEnd> ends;
  std::vector<std::unique_ptr<FacetTessellation>> completed;  ///< of facets for which their borders alone did not do

  std::uint32_t dart_count() const { return static_cast<std::uint32_t>(darts.size()); }
  std::uint32_t to(std::uint32_t dart) const { return darts[darts[dart].next].from; }
  std::span<const LinkEnd> ends_at(std::uint32_t place) const {
    return {ends.data() + end_start[place], ends.data() + end_start[place + 1]};
  }
};

Subdivision subdivide(const DiagramInput& in, predicates::Decisions& decisions);

}  // namespace gvd::kernel::subdivision
