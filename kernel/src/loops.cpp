#include "loops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "conic_area.hpp"
#include "face_map.hpp"
#include "wave_numbers.hpp"

namespace gvd::kernel::subdivision {
namespace {

/// The root of an element in a union-find forest, with path halving.
std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t x) {
  while (parent[x] != x) x = parent[x] = parent[parent[x]];
  return x;
}

/// The frame of a facet in that of its input face, in plain doubles: areas are for information.
struct PlainMap {
  explicit PlainMap(const FaceMap<FacetWaves::F>& map) : turn(plain(map.turn())) {
    for (std::size_t k = 0; k < 3; ++k) corner[k] = plain(map.corner(k));
  }
  static PlanePosition plain(const predicates::PlanePoint<FacetWaves::F>& p) { return {p.x.mid(), p.y.mid()}; }
  PlanePosition operator()(const predicates::PlanePoint<FacetWaves::F>& p) const {
    const double x = p.x.mid(), y = p.y.mid();
    return {corner[0].x + (x * turn.x - y * turn.y), corner[0].y + (x * turn.y + y * turn.x)};
  }
  PlanePosition turn;
  std::array<PlanePosition, 3> corner;
};

/// Follows the darts round the pieces of input faces.
class LoopFinder {
 public:
  LoopFinder(const DiagramInput& in, const Subdivision& s) : in_(in), s_(s) {}

  Loops run() {
    join_over_artificial_edges();
    make_loops();
    sort_loops();
    return std::move(loops_);
  }

 private:
  bool is_removed(std::uint32_t d) const {
    const Dart& dart = s_.darts[d];
    return dart.halfedge != kNone && dart.twin != kNone && in_.refined.is_artificial(dart.halfedge) &&
           s_.darts[dart.twin].labels == dart.labels;
  }

  /// A region is named by one of its darts: at first each outline of a facet by its own first one.
  void join_over_artificial_edges() {
    const std::uint32_t count = s_.dart_count();
    next_.resize(count);
    region_.assign(count, kNone);
    for (std::uint32_t d = 0; d < count; ++d) {
      next_[d] = s_.darts[d].next;
      for (std::uint32_t x = d; region_[x] == kNone; x = s_.darts[x].next) region_[x] = d;
    }
    if (in_.refined.face_count() != in_.input.face_count()) remove_artificial_edges();
  }

  void remove_artificial_edges() {
    const std::uint32_t count = s_.dart_count();
    std::vector<std::uint32_t> prev(count);
    for (std::uint32_t d = 0; d < count; ++d) prev[next_[d]] = d;
    for (std::uint32_t d = 0; d < count; ++d) {
      const std::uint32_t t = s_.darts[d].twin;
      if (!is_removed(d) || t < d) continue;
      region_[root_of(region_, d)] = root_of(region_, t);
      const std::uint32_t before_d = prev[d], after_d = next_[d], before_t = prev[t], after_t = next_[t];
      next_[before_d] = after_t;
      prev[after_t] = before_d;
      next_[before_t] = after_d;
      prev[after_d] = before_t;
    }
  }

  void make_loops() {
    arc_area_.assign(s_.darts.size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<std::uint8_t> visited(s_.darts.size(), 0);
    loops_.darts.reserve(s_.darts.size());
    for (std::uint32_t d = 0, count = s_.dart_count(); d < count; ++d) {
      if (visited[d] != 0 || is_removed(d)) continue;
      const FaceId face = in_.refined.input_face(s_.facets[s_.darts[d].facet].face);
      const auto begin = static_cast<std::uint32_t>(loops_.darts.size());
      Loop loop{root_of(region_, d), s_.darts[d].labels, face, begin, begin};
      P from{};  // of the dart, if it goes on in the facet of the one before
      for (std::uint32_t x = d, facet = kNone; visited[x] == 0; x = next_[x]) {
        visited[x] = 1;
        loops_.darts.push_back(x);
        const Dart& dart = s_.darts[x];
        if (dart.facet != facet) from = position(map_of(dart.facet), dart.facet, dart.from);
        facet = dart.facet;
        const P to = position(map_of(facet), facet, s_.to(x));
        loop.area += dart_area(x, from, to);
        from = to;
      }
      loop.end = static_cast<std::uint32_t>(loops_.darts.size());
      loops_.list.push_back(loop);
    }
  }

  /// Within a face pieces in the order of their lowest dart; of a piece first the outer outline, which alone has a positive area.
  void sort_loops() {
    const auto& list = loops_.list;
    std::vector<std::uint32_t> first_of(s_.darts.size(), kNone);
    for (const Loop& loop : list) first_of[loop.region] = std::min(first_of[loop.region], loops_.darts[loop.begin]);
    using Key = std::tuple<FaceId, std::uint32_t, bool, std::uint32_t>;  // the last one tells any two apart
    using Keyed = std::pair<Key, std::uint32_t>;
    std::vector<Keyed> order, others;  // only pieces of split faces are not in order already
    order.reserve(list.size());
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      const Loop& loop = list[i];
      const Keyed keyed{{loop.face, first_of[loop.region], loop.area < 0, loops_.darts[loop.begin]}, i};
      (order.empty() || order.back() < keyed ? order : others).push_back(keyed);
    }
    std::sort(others.begin(), others.end());
    const auto middle = static_cast<std::ptrdiff_t>(order.size());
    order.insert(order.end(), others.begin(), others.end());
    std::inplace_merge(order.begin(), order.begin() + middle, order.end());
    std::vector<Loop> sorted;
    sorted.reserve(list.size());
    for (const auto& [key, i] : order) sorted.push_back(list[i]);
    loops_.list = std::move(sorted);
  }

  // ---- areas, in the frame of the input face ----

  using NT = FacetWaves::F;
  using P = PlanePosition;

  P position(const PlainMap& map, std::uint32_t facet, std::uint32_t p) const {
    const Skeleton& f = s_.facets[facet];
    const Place& place = s_.places[p];
    if (place.kind == Place::Kind::vertex) {
      for (std::uint32_t k = 0; k < 3; ++k)
        if (in_.refined.origin(3 * f.face + k) == place.vertex) return map.corner[k];
    }
    const auto& node = s_.facets[place.facet].tessellation->nodes[place.node];
    if (place.kind == Place::Kind::inside) return map({node.x, node.y});
    const bool own = place.facet == facet;
    const std::size_t side =
        own ? node.where : (Mesh::face(place.halfedge) == f.face ? place.halfedge : in_.refined.twin(place.halfedge)) % 3;
    const double t = own ? node.t.mid() : 1 - node.t.mid();
    const P &a = map.corner[side], &b = map.corner[(side + 1) % 3];
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  }

  const PlainMap& map_of(std::uint32_t facet) {
    if (mapped_ != facet) {
      const Skeleton& f = s_.facets[facet];
      map_.emplace(FaceMap<NT>(in_.input, in_.refined, f.face, f.waves == nullptr ? nullptr : &frame_in<NT>(*f.waves, 0), 0));
      mapped_ = facet;
    }
    return *map_;
  }

  double dart_area(std::uint32_t d, const P& from, const P& to) {
    const Dart& dart = s_.darts[d];
    if (dart.arc == kNone) return straight_area(from, to);
    const Skeleton& f = s_.facets[dart.facet];
    const auto& arc = f.tessellation->arcs[dart.arc];
    if (arc.tangent) return straight_area(from, to);
    if (!std::isnan(arc_area_[dart.twin])) return -arc_area_[dart.twin];  // the same arc the other way
    const PlainMap& map = map_of(dart.facet);
    const double unit = frame_in<NT>(*f.waves, 0).length.mid();
    const auto &mine = site_in<NT>(*f.waves, arc.left, 0), &other = site_in<NT>(*f.waves, arc.right, 0);
    const double area = conic_area(map(mine.image), mine.weight.mid() * unit, map(other.image), other.weight.mid() * unit,
                                   dart.site == arc.left ? from : to, dart.site == arc.left ? to : from);
    return arc_area_[d] = dart.site == arc.left ? area : -area;
  }

  const DiagramInput& in_;
  const Subdivision& s_;
  std::vector<std::uint32_t> next_, region_;
  Loops loops_;
  std::vector<double> arc_area_;  // per dart of an arc, once known
  std::optional<PlainMap> map_;
  std::uint32_t mapped_ = kNone;
};

}  // namespace

Loops find_loops(const DiagramInput& in, const Subdivision& s) { return LoopFinder(in, s).run(); }

}  // namespace gvd::kernel::subdivision
