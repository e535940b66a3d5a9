#include "diagram_points.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "face_map.hpp"
#include "gvd/robust/rounding.hpp"
#include "node_numbers.hpp"

namespace gvd::kernel::subdivision {
namespace {

using predicates::PlanePoint;
using predicates::Predicate;
using robust::Stage;

template <class NT>
struct PointNumbers {
  std::array<NT, 3> position;
  PlanePoint<NT> frame;
};

constexpr int kExactBits = 192;  // of enclosures of exact numbers

Enclosed enclosed(const robust::Exact& x);
template <class T>
Enclosed enclosed(const robust::Ball<T>& x) {
  return {robust::Midpoint<T>::nearest(x.mid()), x.lower(), x.upper()};
}
/// The same in double-double with one operation an end: each is moved outward by more than its rounding.
Enclosed enclosed(const FacetWaves::DD& x) {
  const auto [hi, lo] = x.mid();
  const double out = (std::fabs(lo) + x.rad()) * (1 + 0x1p-50) + std::fabs(hi) * 0x1p-52;
  return {hi, x.rad() == 0 && lo == 0 ? hi : hi - out, x.rad() == 0 && lo == 0 ? hi : hi + out};
}
Enclosed enclosed(const robust::Exact& x) { return enclosed(x.enclosure(kExactBits)); }

/// Whether the double nearest to the midpoint is within an ulp of the truth, or of the size of the face.
bool is_sharp(const robust::Exact&, double) { return true; }
template <class T>
bool is_sharp(const robust::Ball<T>& x, double size) {
  const double magnitude = std::max(std::fabs(robust::Midpoint<T>::nearest(x.mid())), size);
  return x.rad() <= magnitude * 0x1p-55;
}

bool facet_has_exact(FacetWaves& waves, std::initializer_list<std::uint32_t> sites) {
  if (waves.exact_frame() == nullptr) return false;
  return std::all_of(sites.begin(), sites.end(),
                     [&](std::uint32_t site) { return site == FacetTessellation::kNoSite || waves.exact_site(site) != nullptr; });
}

/// Tries one stage after the other until `attempt(NT(), bits)` returns true; exact numbers only if `has_exact()`.
template <class HasExact, class Attempt>
Stage climb(const HasExact& has_exact, const Attempt& attempt) {
  if (attempt(FacetWaves::DD(), 0)) return Stage::double_double;
  for (const int bits : {128, 256})
    if (attempt(FacetWaves::M(), bits)) return Stage::mpfr;
  if (has_exact() && attempt(robust::Exact(), 0)) return Stage::algebra;
  for (const int bits : {512, 1024})
    if (attempt(FacetWaves::M(), bits)) return Stage::mpfr;
  return Stage::undecided;
}

/// A facet in space and in the frame of its input face.
template <class NT>
struct FacetSpace {
  FacetSpace(const DiagramInput& in, const Skeleton& facet, int bits)
      : numbers(numbers_without_waves<NT>(*facet.waves, bits)), map(in.input, in.refined, facet.face, numbers.frame, bits) {
    for (std::uint32_t k = 0; k < 3; ++k) corner[k] = position_in<NT>(in.refined, in.refined.origin(3 * facet.face + k), bits);
  }
  FacetNumbers<NT> numbers;
  FaceMap<NT> map;
  std::array<std::array<NT, 3>, 3> corner;
};

/// A wave as the arcs beside it have it: in the frame of the input face, in double-double.
struct PlacedWave {
  std::array<Enclosed, 2> image;
  Enclosed enclosed_weight;
  FacetWaves::DD weight;
  bool is_sharp = false;
  std::uint32_t facet = kNone;  ///< whose wave it is
};

/// The facets of one thread in double-double: the last one is kept for the next point or arc.
class PreciseNumbers {
 public:
  PreciseNumbers(const DiagramInput& in, const Subdivision& s, PreciseWaves& waves) : in_(in), s_(s), waves_(waves) {}

  PreciseFacet& facet(std::uint32_t f) {
    if (last_ != f) facet_.emplace(in_, s_.facets[f]);
    last_ = f;
    return *facet_;
  }
  const predicates::PreciseWave& wave(std::uint32_t f, std::uint32_t site) { return waves_(f, site); }
  /// Valid until another facet is asked for.
  const PlacedWave& placed(std::uint32_t f, std::uint32_t site) {
    if (site >= placed_.size()) placed_.resize(s_.facets[f].waves->sites.size());
    if (placed_[site].facet != f) place(f, site);
    return placed_[site];
  }

 private:
  void place(std::uint32_t f, std::uint32_t site) {
    const robust::BallQuad placed = facet(f).placed(wave(f, site));
    const FacetWaves::DD x = placed.lane(0), y = placed.lane(1), weight = placed.lane(2);
    const double size = std::max(std::fabs(x.mid().hi), std::fabs(y.mid().hi));
    placed_[site] = {{enclosed(x), enclosed(y)}, enclosed(weight), weight, is_sharp(x, size) && is_sharp(y, size) && is_sharp(weight, 0), f};
  }

  const DiagramInput& in_;
  const Subdivision& s_;
  PreciseWaves& waves_;
  std::uint32_t last_ = kNone;
  std::optional<PreciseFacet> facet_;
  std::vector<PlacedWave> placed_;  // by site, of the facets they name
};

class PointBuilder {
 public:
  PointBuilder(const DiagramInput& in, const Subdivision& s) : in_(in), s_(s) {}

  Stage build(std::uint32_t p, DiagramPoint& point, PreciseNumbers& precise) const {
    const Place& place = s_.places[p];
    if (place.kind == Place::Kind::vertex) {
      at_vertex(place, point);
      return Stage::identity;
    }
    const Skeleton& facet = s_.facets[place.facet];
    point.face = in_.refined.input_face(facet.face);
    if (place.kind == Place::Kind::edge && !in_.refined.is_artificial(place.halfedge)) point.edge = input_edge(in_, place.halfedge);
    const auto& node = facet.tessellation->nodes[place.node];
    if (const auto near = numbers_near(place, node, precise); near && accept(*near, point)) return Stage::double_double;
    const auto has_exact = [&] {
      return facet_has_exact(*facet.waves, {node.defining[0], node.defining[1], node.defining[2], node.ray});
    };
    return climb(has_exact, [&]<class NT>(const NT&, int bits) { return accept(numbers<NT>(facet, node, bits), point); });
  }

 private:
  using Node = FacetTessellation::Node;

  /// From the doubles of the tessellation; nothing for a ray that meets a side.
  static std::optional<PointNumbers<FacetWaves::DD>> numbers_near(const Place& place, const Node& node, PreciseNumbers& precise) {
    const bool on_side = node.kind == Node::Kind::side, on_ray = node.ray != FacetTessellation::kNoSite;
    if (on_side && on_ray) return std::nullopt;
    PreciseFacet& facet = precise.facet(place.facet);
    const auto wave = [&](std::uint32_t site) -> const predicates::PreciseWave& { return precise.wave(place.facet, site); };
    const auto& def = node.defining;
    if (on_side) {
      const auto side = predicates::side_line(facet.frame(), node.where);
      const auto t = predicates::side_tie_near(side, wave(def[0]), wave(def[1]), node.t.mid(), node.t.rad());
      return PointNumbers<FacetWaves::DD>{coordinates(facet.on_side(node.where, t)), facet.placed(predicates::point_of_side(side, t))};
    }
    const predicates::NearPoint start{{node.x.mid(), node.y.mid()}, (node.x.rad() + node.y.rad()) * (1 + 0x1p-50)};
    const auto p = on_ray ? predicates::ray_vertex_near(wave(node.ray), wave(def[0]), wave(def[1]), start)
                          : predicates::vertex_near(wave(def[0]), wave(def[1]), wave(def[2]), start);
    return PointNumbers<FacetWaves::DD>{coordinates(facet.in_space(p)), facet.placed(p)};
  }

  static std::array<FacetWaves::DD, 3> coordinates(const robust::BallQuad& p) { return {p.lane(0), p.lane(1), p.lane(2)}; }

  template <class NT>
  PointNumbers<NT> numbers(const Skeleton& facet, const Node& node, int bits) const {
    FacetSpace<NT> space(in_, facet, bits);
    const auto& corner = space.corner;
    PointNumbers<NT> result;
    add_waves(*facet.waves, node, bits, space.numbers);
    if (node.kind == Node::Kind::side) {  // two corners only: what they have in common stays exact
      const NT t = node_parameter(*facet.waves, space.numbers, node);
      const auto &a = corner[node.where], &b = corner[(node.where + 1) % 3];
      for (std::size_t i = 0; i < 3; ++i) result.position[i] = a[i] + t * (b[i] - a[i]);
      result.frame = space.map(predicates::point_at(space.numbers.side[node.where], t));
      return result;
    }
    const PlanePoint<NT> p = node_point(*facet.waves, space.numbers, node), &apex = space.numbers.frame->apex;
    const NT b2 = p.y / apex.y, b1 = p.x - apex.x * b2;
    for (std::size_t i = 0; i < 3; ++i)
      result.position[i] = corner[0][i] + (b1 * (corner[1][i] - corner[0][i]) + b2 * (corner[2][i] - corner[0][i]));
    result.frame = space.map(p);
    return result;
  }

  template <class NT>
  bool accept(const PointNumbers<NT>& numbers, DiagramPoint& point) const {
    bool unique = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<double> value = rounded(numbers.position[i]);
      unique = unique && value.has_value();
      point.position[i] = value ? *value : enclosed(numbers.position[i]).value;
    }
    point.frame = {enclosed(numbers.frame.x), enclosed(numbers.frame.y)};
    const double size = std::max(std::fabs(point.frame[0].value), std::fabs(point.frame[1].value));
    return unique && is_sharp(numbers.frame.x, size) && is_sharp(numbers.frame.y, size);
  }

  void at_vertex(const Place& place, DiagramPoint& point) const {
    using NT = FacetWaves::DD;
    const Point& p = in_.refined.point(place.vertex);
    for (std::size_t i = 0; i < 3; ++i) point.position[i] = p[i] + 0.0;
    if (place.vertex < in_.refined.input_vertex_count()) point.vertex = place.vertex;
    in_.refined.for_each_outgoing(place.vertex, [&](HalfedgeId h) {
      point.face = std::min(point.face, in_.refined.input_face(Mesh::face(h)));
      if (point.vertex != kNone) return;
      for (const HalfedgeId side : {h, Mesh::prev(h)})
        if (!in_.refined.is_artificial(side)) point.edge = input_edge(in_, side);
    });
    const auto bary = barycentric_in_face(in_.input, point.face, in_.refined, place.vertex);
    const auto frame = input_frame<NT>(in_.input, point.face, 0);
    const NT b1 = robust::from<NT>(bary[1]), b2 = robust::from<NT>(bary[2]);
    point.frame = {enclosed(b1 * frame.length + b2 * frame.apex.x), enclosed(b2 * frame.apex.y)};
  }

  const DiagramInput& in_;
  const Subdivision& s_;
};

/// Calls `work(item, numbers)` for the items of each owner, in parallel; `owner[i]` is that of item i.
template <class Work>
void for_each_owner(const DiagramInput& in, const Subdivision& s, PreciseWaves& waves, const std::vector<std::uint32_t>& owner, std::size_t owners,
                    Work&& work) {
  std::vector<std::uint32_t> start(owners + 1, 0), items(owner.size());
  for (const std::uint32_t o : owner) ++start[o + 1];
  for (std::size_t o = 0; o < owners; ++o) start[o + 1] += start[o];
  std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
  for (std::uint32_t i = 0; i < owner.size(); ++i) items[fill[owner[i]]++] = i;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, owners, 16), [&](const tbb::blocked_range<std::size_t>& range) {
    PreciseNumbers numbers(in, s, waves);
    for (std::size_t o = range.begin(); o < range.end(); ++o)
      for (std::uint32_t k = start[o]; k < start[o + 1]; ++k) work(items[k], numbers);
  });
}

// ---- arcs ----

class ArcBuilder {
 public:
  ArcBuilder(const DiagramInput& in, const Subdivision& s) : in_(in), s_(s) {
    start_.assign(in.refined.vertex_count(), std::numeric_limits<double>::quiet_NaN());
    for (const DiagramSource& source : in.sources)
      if (!source.hidden) start_[source.vertex] = source.weight;
  }

  void build(DirectedLink link, Arc& arc, PreciseNumbers& precise) const {
    const Dart* beside[2] = {&s_.darts[dart_beside(s_, link, 0)], &s_.darts[dart_beside(s_, link, 1)]};
    const std::size_t low =
        in_.refined.input_face(s_.facets[beside[0]->facet].face) <= in_.refined.input_face(s_.facets[beside[1]->facet].face) ? 0
                                                                                                                             : 1;
    const Dart& home = *beside[low];
    arc.face = in_.refined.input_face(s_.facets[home.facet].face);
    arc.along_edge = home.halfedge != kNone && !in_.refined.is_artificial(home.halfedge);
    const FacetWaves& left = *s_.facets[beside[0]->facet].waves;
    const FacetWaves& right = *s_.facets[beside[1]->facet].waves;
    const FacetSite &l = left.sites[beside[0]->site], &r = right.sites[beside[1]->site];
    arc.labels = {l.labels, r.labels};
    arc.root = {l.root, r.root};
    if (beside[0]->facet == beside[1]->facet && numbers_near(beside, arc, precise)) return;
    climb([] { return false; }, [&]<class NT>(const NT&, int bits) { return numbers<NT>(beside, home, arc, bits); });
  }

 private:
  /// Of an arc inside a facet.
  bool numbers_near(const Dart* const (&beside)[2], Arc& arc, PreciseNumbers& precise) const {
    bool sharp = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const PlacedWave& wave = precise.placed(beside[i]->facet, beside[i]->site);
      arc.image[i] = wave.image;
      arc.weight[i] = wave.enclosed_weight;
      sharp = sharp && wave.is_sharp;
    }
    arc.conic = conic(beside, arc, [&] {
      return maybe_sign(precise.placed(beside[0]->facet, beside[0]->site).weight - precise.placed(beside[1]->facet, beside[1]->site).weight);
    });
    return sharp;
  }

  template <class NT>
  bool numbers(const Dart* const (&beside)[2], const Dart& home, Arc& arc, int bits) const {
    const Skeleton& facet = s_.facets[home.facet];
    const auto& frame = frame_in<NT>(*facet.waves, bits);
    const FaceMap<NT> map(in_.input, in_.refined, facet.face, &frame, bits);
    std::array<NT, 2> weight;
    bool sharp = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const Dart& dart = *beside[i];
      const Skeleton& other = s_.facets[dart.facet];
      const auto& site = site_in<NT>(*other.waves, dart.site, bits);
      PlanePoint<NT> image = site.image;
      if (dart.facet != home.facet) {  // unfolded over the edge
        const auto z = seen_from_side(predicates::side_line(frame_in<NT>(*other.waves, bits), dart.halfedge % 3), site.image);
        image = placed_at_side(predicates::side_line(frame, home.halfedge % 3), PlanePoint<NT>{NT(1.0) - z.x, -z.y});
      }
      weight[i] = site.weight * frame_in<NT>(*other.waves, bits).length;
      sharp = set_wave(arc, i, map(image), weight[i]) && sharp;
    }
    arc.conic = conic(beside, arc, [&] { return maybe_sign(weight[0] - weight[1]); });
    return sharp;
  }

  template <class NT>
  static bool set_wave(Arc& arc, std::size_t i, const PlanePoint<NT>& image, const NT& weight) {
    arc.image[i] = {enclosed(image.x), enclosed(image.y)};
    arc.weight[i] = enclosed(weight);
    const double size = std::max(std::fabs(arc.image[i][0].value), std::fabs(arc.image[i][1].value));
    return is_sharp(image.x, size) && is_sharp(image.y, size) && is_sharp(weight, 0);
  }

  /// `compare_weights()`: the sign of their difference.
  template <class CompareWeights>
  Arc::Conic conic(const Dart* const (&beside)[2], const Arc& arc, const CompareWeights& compare_weights) const {
    const Dart& dart = *beside[0];
    const bool inner = dart.arc != kNone;
    if (inner && s_.facets[dart.facet].tessellation->arcs[dart.arc].tangent) return Arc::Conic::ray;
    if (arc.root[0] == arc.root[1] || start_together(arc.root)) return Arc::Conic::line;
    const robust::MaybeSign difference = compare_weights();
    if (difference == robust::Sign::zero) return Arc::Conic::line;
    if (inner) return Arc::Conic::hyperbola;
    return difference ? Arc::Conic::ray : Arc::Conic::line;  // along an edge: on its line, or mirrored in it
  }

  /// Whether two roots are sources of one weight.
  bool start_together(const std::array<VertexId, 2>& root) const { return start_[root[0]] == start_[root[1]]; }

  const DiagramInput& in_;
  const Subdivision& s_;
  std::vector<double> start_;  // per vertex: the weight of a source that starts there, or not a number
};

}  // namespace

std::array<VertexId, 2> input_edge(const DiagramInput& in, HalfedgeId h) {
  const Mesh& mesh = in.refined;
  // Along the edge: the other unsplit side at an inserted vertex that belongs to the same input face.
  const auto follow = [&](VertexId v, HalfedgeId side) {
    while (v >= mesh.input_vertex_count()) {
      const FaceId face = mesh.input_face(Mesh::face(side));
      HalfedgeId next = kNone;
      mesh.for_each_outgoing(v, [&](HalfedgeId out) {
        for (const HalfedgeId candidate : {out, Mesh::prev(out)}) {
          if (mesh.is_artificial(candidate) || mesh.input_face(Mesh::face(candidate)) != face) continue;
          if (candidate != side) next = candidate;
        }
      });
      v = mesh.origin(next) == v ? mesh.target(next) : mesh.origin(next);
      side = next;
    }
    return v;
  };
  const VertexId a = follow(mesh.origin(h), h), b = follow(mesh.target(h), h);
  return {std::min(a, b), std::max(a, b)};
}

std::vector<DiagramPoint> construct_points(const DiagramInput& in, const Subdivision& s, PreciseWaves& waves, const std::vector<std::uint32_t>& places,
                                           predicates::Decisions& decisions) {
  std::vector<DiagramPoint> points(places.size());
  std::vector<Stage> stage(places.size());
  std::vector<std::uint32_t> owner(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::uint32_t facet = s.places[places[i]].facet;
    owner[i] = facet == kNone ? static_cast<std::uint32_t>(s.facets.size()) : facet;
  }
  const PointBuilder builder(in, s);
  for_each_owner(in, s, waves, owner, s.facets.size() + 1,
                 [&](std::uint32_t i, PreciseNumbers& numbers) { stage[i] = builder.build(places[i], points[i], numbers); });
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (stage[i] == Stage::undecided)
      predicates::undecided(decisions, Predicate::rounding,
                            "coordinates of a point of the diagram in face " + std::to_string(points[i].face));
    else
      predicates::count(decisions, Predicate::rounding, stage[i]);
  }
  return points;
}

void construct_arcs(const DiagramInput& in, const Subdivision& s, PreciseWaves& waves, const std::vector<DirectedLink>& links,
                    std::vector<Arc>& arcs) {
  std::vector<std::uint32_t> owner(links.size());
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    const Dart &left = s.darts[dart_beside(s, links[i], 0)], &right = s.darts[dart_beside(s, links[i], 1)];
    owner[i] = left.facet == right.facet ? left.facet : static_cast<std::uint32_t>(s.facets.size());
  }
  const ArcBuilder builder(in, s);
  for_each_owner(in, s, waves, owner, s.facets.size() + 1, [&](std::uint32_t i, PreciseNumbers& numbers) {
    if (owner[i] < s.facets.size()) builder.build(links[i], arcs[i], numbers);
  });
  PreciseNumbers numbers(in, s, waves);
  for (std::uint32_t i = 0; i < links.size(); ++i)
    if (owner[i] == s.facets.size()) builder.build(links[i], arcs[i], numbers);
}

}  // namespace gvd::kernel::subdivision
