#include "chains.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>

#include "fan_image.hpp"
#include "gvd/kernel/error.hpp"
#include "gvd/predicates/plane.hpp"
#include "wave_numbers.hpp"

namespace gvd::kernel::subdivision {
namespace {

void add_sources(const DiagramInput& in, LabelSetId labels, std::vector<SourceId>& to) {
  if (labels == kNone) return;
  to.insert(to.end(), in.label_sets[labels].begin(), in.label_sets[labels].end());
}

void sort_unique(std::vector<std::uint32_t>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

std::vector<SourceId> sources_of_links(const DiagramInput& in, const Subdivision& s, std::uint32_t place) {
  std::vector<SourceId> sources;
  for (const LinkEnd& end : s.ends_at(place))
    for (const LabelSetId labels : s.links[end.link].labels) add_sources(in, labels, sources);
  sort_unique(sources);
  return sources;
}

/// How a wave comes to the faces round a vertex: as the window whose apex the vertex is, or from a neighbour of the vertex.
struct Arrival {
  WindowId window = kNone;
  VertexId root = kNone;
  bool operator==(const Arrival&) const = default;
};

class Tracer {
 public:
  Tracer(const DiagramInput& in, const Subdivision& s, bool certain) : in_(in), s_(s), certain_(certain) {}

  Chains run() {
    result_.role.assign(s_.places.size(), Role::none);
    for (std::uint32_t p = 0; p < s_.places.size(); ++p) result_.role[p] = role_of(p);
    visited_.assign(s_.links.size(), 0);
    for (std::uint32_t p = 0; p < s_.places.size(); ++p) {
      if (!is_end(result_.role[p])) continue;
      for (const LinkEnd& end : s_.ends_at(p))
        if (visited_[end.link] == 0) walk({end.link, end.at_to}, false);
    }
    for (std::uint32_t l = 0; l < s_.links.size(); ++l)
      if (visited_[l] == 0) walk({l, false}, true);
    return std::move(result_);
  }

 private:
  Role role_of(std::uint32_t p) {
    const auto ends = s_.ends_at(p);
    if (ends.empty()) return Role::none;
    const Place& place = s_.places[p];
    if (ends.size() > 2 || label_sets_around(p) > 2 || has_further_source(p)) return Role::vertex;
    if (place.boundary) return Role::boundary;
    if (place.open) return Role::open;
    if (ends.size() != 2) return contradiction(p, "a GVD edge ends where no other one does");
    const DirectedLink in{ends[0].link, !ends[0].at_to}, out{ends[1].link, ends[1].at_to};
    for (std::size_t side = 0; side < 2; ++side)
      if (label_beside(s_, in, side) != label_beside(s_, out, side))
        return contradiction(p, "the label sets beside a GVD edge are exchanged");
    for (std::size_t side = 0; side < 2; ++side) {
      if (continues(p, in, out, side)) continue;
      if (proved_different(p, in, out, side)) return Role::break_point;
      const std::optional<bool> same =
          place.kind == Place::Kind::vertex ? same_at_vertex(p, in, out, side) : same_at_edge(in, out, side);
      if (same == true) continue;
      if (!same) result_.doubts.push_back("whether the conic changes at " + describe(p));
      return Role::break_point;
    }
    return inside_input_face(in_, place) ? Role::erased : Role::crossing;
  }

  Role contradiction(std::uint32_t p, const char* what) const {
    if (certain_) throw InternalError(std::string(what) + " at " + describe(p));
    return Role::open;
  }

  std::size_t label_sets_around(std::uint32_t p) const {
    if (const auto ends = s_.ends_at(p); ends.size() == 2) {
      const auto &a = s_.links[ends[0].link].labels, &b = s_.links[ends[1].link].labels;
      if (a == b || (a[0] == b[1] && a[1] == b[0])) return 2;
    }
    std::vector<LabelSetId> around;
    for (const LinkEnd& end : s_.ends_at(p))
      for (const LabelSetId labels : s_.links[end.link].labels) around.push_back(labels);
    sort_unique(around);
    return around.size();
  }

  /// A vertex may have a nearest source that has no region around it.
  bool has_further_source(std::uint32_t p) const {
    return s_.places[p].kind == Place::Kind::vertex && sources_at(in_, s_, p).size() > sources_of_links(in_, s_, p).size();
  }

  /// Whether the wave on one side of a GVD edge stays the same at a place, by identity.
  bool continues(std::uint32_t p, DirectedLink in, DirectedLink out, std::size_t side) const {
    const Dart &a = s_.darts[dart_beside(s_, in, side)], &b = s_.darts[dart_beside(s_, out, side)];
    const Place& place = s_.places[p];
    const Skeleton &fa = s_.facets[a.facet], &fb = s_.facets[b.facet];
    if (a.facet == b.facet && a.site == b.site) return true;
    if (place.kind == Place::Kind::vertex) return continues_at_vertex(place.vertex, fa, a.site, fb, b.site);
    if (a.facet == b.facet) return false;
    const HalfedgeId h = place.halfedge, twin = in_.refined.twin(h);
    return EdgeJoiner::same_wave(in_, fa.face == Mesh::face(h) ? h : twin, fa, a.site, fb, b.site);
  }

  /// Whether the waves on one side before and after a place certainly have different images: other roots, or other distances from
  /// the ends of the edge that the facets share. Round a vertex that is not flat no plane shows both arcs: images on one side are
  /// turned against the other's.
  bool proved_different(std::uint32_t p, DirectedLink in, DirectedLink out, std::size_t side) const {
    const Dart &a = s_.darts[dart_beside(s_, in, side)], &b = s_.darts[dart_beside(s_, out, side)];
    const Place& place = s_.places[p];
    if (s_.facets[a.facet].waves == nullptr || s_.facets[b.facet].waves == nullptr) return false;
    FacetWaves &wa = *s_.facets[a.facet].waves, &wb = *s_.facets[b.facet].waves;
    if (wa.sites[a.site].root != wb.sites[b.site].root) return true;
    if (place.kind == Place::Kind::vertex) return !is_flat(s_.facets[a.facet], place.vertex);
    return other_distances<FacetWaves::F>(wa, a.site, wb, b.site, 0) || other_distances<FacetWaves::DD>(wa, a.site, wb, b.site, 0) ||
           (!(wa.exact_is_cheap() && wb.exact_is_cheap()) && other_distances_in_mpfr(wa, a.site, wb, b.site, {128, 256}));
  }

  static bool other_distances_in_mpfr(FacetWaves& wa, std::uint32_t a, FacetWaves& wb, std::uint32_t b, std::initializer_list<int> precisions) {
    return std::any_of(precisions.begin(), precisions.end(), [&](int bits) { return other_distances<FacetWaves::M>(wa, a, wb, b, bits); });
  }

  /// Whether two images of one root are certainly at different distances from an end of the edge that the facets share.
  template <class NT>
  static bool other_distances(FacetWaves& wa, std::uint32_t a, FacetWaves& wb, std::uint32_t b, int bits) {
    using predicates::operator-;
    const int unit = std::ilogb(wa.frame(FacetWaves::F()).length.mid());  // so that no square overflows
    const auto square_from = [=](FacetWaves& waves, std::uint32_t site, VertexId v) {
      const auto k = static_cast<std::size_t>(std::find(waves.corner.begin(), waves.corner.end(), v) - waves.corner.begin());
      const auto& frame = frame_in<NT>(waves, bits);
      return squared_norm(site_in<NT>(waves, site, bits).image - predicates::corner_point(frame, k)) * square(frame.length.scaled(-unit));
    };
    for (const VertexId v : wa.corner) {
      if (std::find(wb.corner.begin(), wb.corner.end(), v) == wb.corner.end()) continue;
      const auto sign = maybe_sign(square_from(wa, a, v) - square_from(wb, b, v));
      if (sign && *sign != robust::Sign::zero) return true;
    }
    return false;
  }

  /// Whether they have one image, by algebra: the same distances from the ends of the edge that the facets share, on the same side
  /// of it. Pre: one root. Empty where the strips cross too many square classes.
  std::optional<bool> same_at_edge(DirectedLink in, DirectedLink out, std::size_t side) const {
    using predicates::operator-;
    const Dart &a = s_.darts[dart_beside(s_, in, side)], &b = s_.darts[dart_beside(s_, out, side)];
    if (s_.facets[a.facet].waves == nullptr || s_.facets[b.facet].waves == nullptr) return std::nullopt;
    FacetWaves &wa = *s_.facets[a.facet].waves, &wb = *s_.facets[b.facet].waves;
    std::vector<VertexId> shared;
    for (const VertexId v : wa.corner)
      if (std::find(wb.corner.begin(), wb.corner.end(), v) != wb.corner.end()) shared.push_back(v);
    if (shared.size() < 2) return std::nullopt;
    const auto corner = [](FacetWaves& waves, VertexId v) {
      const auto k = static_cast<std::size_t>(std::find(waves.corner.begin(), waves.corner.end(), v) - waves.corner.begin());
      return predicates::corner_point(*waves.exact_frame(), k);
    };
    const auto square_from = [&](FacetWaves& waves, std::uint32_t site, VertexId v) {
      return squared_norm(waves.exact_site(site)->image - corner(waves, v)) * square(waves.exact_frame()->length);
    };
    const auto beside = [&](FacetWaves& waves, std::uint32_t site) {
      const auto origin = corner(waves, shared[0]);
      return maybe_sign(cross(corner(waves, shared[1]) - origin, waves.exact_site(site)->image - origin));
    };
    for (std::size_t i = 0; i < 2; ++i) {
      const auto difference = maybe_sign(square_from(wa, a.site, shared[i]) - square_from(wb, b.site, shared[i]));
      if (difference == robust::Sign::zero) continue;
      const bool other = difference || other_distances_in_mpfr(wa, a.site, wb, b.site, {512, 1024});
      return other ? std::optional(false) : std::nullopt;
    }
    const auto of_a = beside(wa, a.site), of_b = beside(wb, b.site);
    if (!of_a || !of_b) return std::nullopt;
    return *of_a == *of_b;
  }

  /// The same at a vertex: round a flat one images can be compared whichever way one turns.
  std::optional<bool> same_at_vertex(std::uint32_t p, DirectedLink in, DirectedLink out, std::size_t side) const {
    const Dart &a = s_.darts[dart_beside(s_, in, side)], &b = s_.darts[dart_beside(s_, out, side)];
    const Skeleton &fa = s_.facets[a.facet], &fb = s_.facets[b.facet];
    const VertexId v = s_.places[p].vertex;
    if (fa.waves == nullptr || fb.waves == nullptr || !is_flat(fa, v)) return std::nullopt;
    return have_one_image_round(in_.refined, v, *fa.waves, a.site, *fb.waves, b.site);
  }

  /// Round a flat vertex a wave that comes in once is one image, though other windows carry it on the two sides.
  bool continues_at_vertex(VertexId v, const Skeleton& fa, std::uint32_t a, const Skeleton& fb, std::uint32_t b) const {
    if (!is_flat(fa, v) || !is_flat(fb, v)) return false;
    return any_pair(fa, a, fb, b, [&](const FacetSite& x, const FacetSite& y) {
      const auto by_x = arrival(x, v), by_y = arrival(y, v);
      return by_x && by_y && *by_x == *by_y;
    });
  }

  static bool is_flat(const Skeleton& facet, VertexId v) {
    for (std::size_t k = 0; k < 3; ++k)
      if (facet.waves->corner[k] == v) return facet.waves->corner_is_flat[k];
    return false;
  }

  /// By which way the wave of a site comes to the faces round v for the last time; nothing if its strip does not.
  std::optional<Arrival> arrival(const FacetSite& site, VertexId v) const {
    HalfedgeId first = kNone;
    for (WindowId w = site.window; w != kNone;) {
      const WindowOrigin origin = in_.window(w);
      if (in_.refined.apex(origin.halfedge) == v) return Arrival{w, site.root};
      first = origin.halfedge;
      w = origin.parent;
    }
    if (first != kNone && in_.refined.origin(first) != v && in_.refined.target(first) != v) return std::nullopt;
    return Arrival{kNone, site.root};
  }

  void walk(DirectedLink first, bool closed) {
    Chain chain{.links = {}, .closed = closed};
    for (DirectedLink link = first;;) {
      visited_[link.link] = 1;
      chain.links.push_back(link);
      const std::uint32_t p = to_place(s_, link);
      if (is_end(result_.role[p])) break;
      const auto ends = s_.ends_at(p);
      const LinkEnd& next = ends[0].link == link.link && ends[0].at_to != link.reversed ? ends[1] : ends[0];
      link = {next.link, next.at_to};
      if (visited_[link.link] != 0) break;
    }
    result_.chains.push_back(std::move(chain));
  }

  std::string describe(std::uint32_t p) const {
    const Place& place = s_.places[p];
    if (place.kind == Place::Kind::vertex) return "vertex " + std::to_string(place.vertex);
    if (place.kind == Place::Kind::edge)
      return "a point of side " + std::to_string(place.halfedge % 3) + " of facet " + std::to_string(Mesh::face(place.halfedge));
    return "a point of facet " + std::to_string(s_.facets[place.facet].face);
  }

  const DiagramInput& in_;
  const Subdivision& s_;
  bool certain_;
  Chains result_;
  std::vector<std::uint8_t> visited_;
};

}  // namespace

bool inside_input_face(const DiagramInput& in, const Place& place) {
  if (place.kind == Place::Kind::inside) return true;
  if (place.kind == Place::Kind::edge) return in.refined.is_artificial(place.halfedge);
  if (place.vertex < in.refined.input_vertex_count() || place.boundary) return false;
  bool inside = true;
  in.refined.for_each_outgoing(place.vertex, [&](HalfedgeId h) { inside = inside && in.refined.is_artificial(h); });
  return inside;
}

std::vector<SourceId> sources_at(const DiagramInput& in, const Subdivision& s, std::uint32_t place) {
  std::vector<SourceId> sources = sources_of_links(in, s, place);
  if (s.places[place].kind == Place::Kind::vertex) add_sources(in, in.vertex_labels[s.places[place].vertex], sources);
  sort_unique(sources);
  return sources;
}

Chains trace(const DiagramInput& in, const Subdivision& s, bool all_decided) { return Tracer(in, s, all_decided).run(); }
}  // namespace gvd::kernel::subdivision
