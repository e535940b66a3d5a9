#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "fuzz/properties/planar_layout.hpp"
#include "fuzz/properties/property.hpp"
#include "fuzz/properties/surface_points.hpp"
#include "gvd/robust/root_sum.hpp"

namespace gvd::fuzz {
namespace {

using kernel::SourceId;
using kernel::VertexId;
using robust::RootSum;
using robust::Sign;
using Place = PlanarLayout::Place;

std::vector<Place> places(const Trial& t, const PlanarLayout& layout) {
  std::vector<Place> result;
  for (const auto& s : t.sources()) result.push_back(layout.place(t.mesh(), s.at));
  return result;
}

Outcome distances_are_planar(Trial& t) {
  const auto layout = planar_layout(t.mesh());
  if (!layout) return skipped();
  const auto sites = places(t, *layout);
  for (VertexId v = 0; v < t.mesh().vertex_count(); ++v) {
    std::optional<RootSum> least;
    Sources labels;
    for (SourceId s = 0; s < sites.size(); ++s) {
      RootSum d(1, layout->squared_distance(layout->vertex[v], sites[s]));
      d += RootSum(mpq_class(t.sources()[s].weight));
      const Sign sign = least ? compare(d, *least) : Sign::negative;
      if (sign == Sign::positive) continue;
      if (sign == Sign::negative) labels.clear(), least = d;
      labels.push_back(s);
    }
    if (t.solution().distance(v) != least->rounded())
      return violated(
          fmt::format("{}: D is {}, in the plane it is {}", vertex_name(v), t.solution().distance(v), least->rounded()));
    if (t.certified() && nearest(t.solution(), v) != labels)
      return violated(
          fmt::format("{}: nearest are {}, in the plane {}", vertex_name(v), text_of(nearest(t.solution(), v)), text_of(labels)));
  }
  return t.certified() ? holds() : undecided();
}

/// The Voronoi diagram of the sites in the convex region, by comparing everything with everything, in rationals.
class PlanarDiagram {
 public:
  PlanarDiagram(const PlanarLayout& layout, std::vector<Place> sites) : layout_(layout), sites_(std::move(sites)) {
    for (SourceId a = 0; a < sites_.size(); ++a)
      for (SourceId b = a + 1; b < sites_.size(); ++b) {
        if (has_edge(a, b)) dual.insert({a, b});
        for (SourceId c = b + 1; c < sites_.size(); ++c) add_vertex(a, b, c);
      }
  }

  std::set<std::array<SourceId, 2>> dual;  ///< pairs whose common edge has a piece of positive length inside
  std::set<Sources> vertices;              ///< nearest sources of the vertices strictly inside
  bool touches_boundary = false;           ///< a vertex lies exactly on the boundary

 private:
  mpq_class inner(const Place& a, const Place& b) const { return a[0] * b[0] + layout_.stretch * a[1] * b[1]; }
  static Place minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1]}; }
  static mpq_class cross(const Place& a, const Place& b) { return a[0] * b[1] - a[1] * b[0]; }

  /// -1 outside, 0 on the boundary, 1 inside.
  int side_of(const Place& p) const {
    int side = 1;
    const auto& outline = layout_.outline;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Place &u = layout_.vertex[outline[i]], &v = layout_.vertex[outline[(i + 1) % outline.size()]];
      side = std::min(side, sgn(cross(minus(v, u), minus(p, u))));
    }
    return side;
  }

  void add_vertex(SourceId a, SourceId b, SourceId c) {
    // |p - a|^2 = |p - b|^2 = |p - c|^2, two linear equations in p - a.
    const Place u = minus(sites_[b], sites_[a]), v = minus(sites_[c], sites_[a]);
    const mpq_class det = 2 * layout_.stretch * cross(u, v), uu = inner(u, u), vv = inner(v, v);
    if (sgn(det) == 0) return;
    const Place p{sites_[a][0] + layout_.stretch * (uu * v[1] - vv * u[1]) / det, sites_[a][1] + (vv * u[0] - uu * v[0]) / det};
    const int side = side_of(p);
    if (side < 0) return;
    const Place from_a = minus(p, sites_[a]);
    const mpq_class radius = inner(from_a, from_a);
    Sources nearest;
    for (SourceId s = 0; s < sites_.size(); ++s) {
      const Place to = minus(p, sites_[s]);
      const int order = cmp(inner(to, to), radius);
      if (order < 0) return;
      if (order == 0) nearest.push_back(s);
    }
    if (side == 0) touches_boundary = true;
    if (side > 0) vertices.insert(nearest);
  }

  /// Clips the bisector middle + t along by all others and by the region.
  bool has_edge(SourceId a, SourceId b) {
    const Place &p = sites_[a], &q = sites_[b], d = minus(q, p);
    if (d[0] == 0 && d[1] == 0) return false;
    const Place middle{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2}, along{-layout_.stretch * d[1], d[0]};
    low_.reset();
    high_.reset();
    empty_ = false;
    const auto& outline = layout_.outline;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Place &u = layout_.vertex[outline[i]], side = minus(layout_.vertex[outline[(i + 1) % outline.size()]], u);
      keep(-cross(side, along), cross(side, minus(middle, u)), true);
    }
    for (SourceId s = 0; s < sites_.size(); ++s) {
      if (s == a || s == b) continue;
      // |x - p|^2 <= |x - s|^2
      const Place e = minus(sites_[s], p), to_s = minus(middle, sites_[s]), to_p = minus(middle, p);
      keep(2 * inner(e, along), inner(to_s, to_s) - inner(to_p, to_p), false);
    }
    return !empty_ && low_ && high_ && *low_ < *high_;
  }
  /// Keeps the t with slope t <= bound. An edge along the boundary of the region has no inside.
  void keep(const mpq_class& slope, const mpq_class& bound, bool boundary) {
    if (sgn(slope) == 0) {
      empty_ = empty_ || sgn(bound) < 0 || (boundary && sgn(bound) == 0);
      return;
    }
    const mpq_class t = bound / slope;
    if (sgn(slope) > 0 && (!high_ || t < *high_)) high_ = t;
    if (sgn(slope) < 0 && (!low_ || t > *low_)) low_ = t;
  }

  const PlanarLayout& layout_;
  std::vector<Place> sites_;
  std::optional<mpq_class> low_, high_;
  bool empty_ = false;
};

Outcome dual_is_the_clipped_delaunay(Trial& t) {
  if (t.weighted() || !t.solution().duplicates().empty()) return skipped();
  if (t.sources().size() > 12) return skipped();
  const auto layout = planar_layout(t.mesh());
  if (!layout) return skipped();
  if (!t.certified()) return undecided();
  const PlanarDiagram truth(*layout, places(t, *layout));
  if (truth.touches_boundary) return skipped();
  const auto& d = t.solution().diagram();
  std::set<std::array<SourceId, 2>> dual;
  for (const auto& e : d.dual) dual.insert(e.sources);
  if (dual != truth.dual) {
    for (const auto& e : truth.dual)
      if (dual.count(e) == 0)
        return violated(fmt::format("the cells of {} and {} share an edge that the diagram has not", e[0], e[1]));
    return violated("the diagram has an edge that the plane has not");
  }
  std::set<Sources> vertices;
  for (const auto& v : d.vertices)
    if (!v.on_boundary) vertices.insert(v.sources);
  if (vertices != truth.vertices) return violated("the vertices are not the circumcentres inside the region");
  return holds();
}

constexpr std::array<Property, 2> kProperties = {{
    {"distances_are_planar", distances_are_planar, 3,
     "on a surface that unfolds to a convex region, D and labels are those of the plane"},
    {"dual_is_the_clipped_delaunay", dual_is_the_clipped_delaunay, 3,
     "and the dual is those Delaunay edges and triangles whose Voronoi edge or vertex lies in the region"},
}};

}  // namespace

std::span<const Property> planar_properties() { return kProperties; }

}  // namespace gvd::fuzz
