#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <vector>

#include "edge_images.hpp"
#include "fuzz/properties/facets.hpp"
#include "fuzz/properties/many_bits.hpp"
#include "fuzz/properties/property.hpp"
#include "gvd/kernel/facet_numbers.hpp"
#include "gvd/kernel/tessellation.hpp"
#include "gvd/predicates/wave.hpp"
#include "node_numbers.hpp"
#include "subdivision.hpp"

namespace gvd::fuzz {
namespace {

using kernel::FaceId;
using kernel::FacetTessellation;
using kernel::HalfedgeId;
using kernel::kNone;
using robust::Sign;
using M = kernel::FacetWaves::M;
using Point = predicates::PlanePoint<M>;
using predicates::operator-;
using predicates::operator+;
using predicates::operator*;

/// A finished facet against the least of all its waves with so many bits that what does not tie differs: however it was decided, in nodes, in the middle
/// of arcs and of pieces of the outline, and at drawn points.
class FinishedFacet {
 public:
  FinishedFacet(const Facets& facets, FaceId f) : waves_(facets.waves(f)) {
    predicates::Decisions decisions;
    tess_ = tessellate(*facets.waves(f), decisions);
    load_numbers(*waves_, kManyBits, numbers_);
  }
  bool undecided() const { return tess_.undecided; }
  kernel::BoundaryFacet as_input() const { return {waves_->face, waves_.get(), &tess_}; }
  M along(std::uint32_t node) const { return node_parameter(*waves_, numbers_, tess_.nodes[node]); }

  std::string fault(Draw& draw) {
    for (std::uint32_t n = 0; n < tess_.nodes.size(); ++n) look_at(node_point(*waves_, numbers_, tess_.nodes[n]), tess_.nodes[n].sites, fmt::format("node {}", n));
    for (std::uint32_t a = 0; a < tess_.arcs.size(); ++a) look_at(middle_of(tess_.arcs[a]), {tess_.arcs[a].left, tess_.arcs[a].right}, fmt::format("the middle of arc {}", a));
    for (std::uint32_t p = 0; p < tess_.outline.size(); ++p) look_at_piece(p);
    look_at_drawn_point(draw);
    return fault_;
  }

 private:
  M distance_of(std::uint32_t site, const Point& p) const { return distance(*numbers_.sites[site], p); }
  std::optional<bool> sees(std::uint32_t site, const Point& p) const { return predicates::cone_contains(*numbers_.sites[site], p); }

  /// Pre: the regions meet at p.
  void look_at(const Point& p, const std::vector<std::uint32_t>& regions, const std::string& where) {
    if (!p.x.is_finite() || !p.y.is_finite() || !fault_.empty()) return;
    const M least = distance_of(regions.front(), p);
    for (const std::uint32_t region : regions) {
      if (differs(distance_of(region, p) - least)) fault_ = fmt::format("sites {} and {} do not tie at {}", regions.front(), region, where);
      bool seen = false;
      for (std::uint32_t site = 0; site < tess_.representative.size() && !seen; ++site) seen = tess_.representative[site] == region && sees(site, p) != false;
      if (!seen) fault_ = fmt::format("site {} does not see {}", region, where);
    }
    for (std::uint32_t rival = 0; rival < numbers_.sites.size(); ++rival)
      if (maybe_sign(distance_of(rival, p) - least) == Sign::negative && sees(rival, p) == true) fault_ = fmt::format("site {} is nearest at {}", rival, where);
  }

  /// Where the ray from the left one's image through the middle of the chord meets the arc.
  Point middle_of(const FacetTessellation::Arc& arc) const {
    const Point from = node_point(*waves_, numbers_, tess_.nodes[arc.from]), to = node_point(*waves_, numbers_, tess_.nodes[arc.to]);
    const Point chord = M(0.5) * (from + to);
    if (arc.tangent) return chord;
    const auto &left = *numbers_.sites[arc.left], &right = *numbers_.sites[arc.right];
    const Point ray = chord - left.image, apart = right.image - left.image;
    const M length = sqrt(squared_norm(ray)), lead = left.weight - right.weight;
    const M r = (squared_norm(apart) - square(lead)) / (dot(ray, apart) / length + lead).scaled(1);
    return left.image + (r / length) * ray;
  }

  void look_at_piece(std::uint32_t p) {
    const auto& piece = tess_.outline[p];
    const auto parameter = [&](std::uint32_t node, double corner) {
      return node == FacetTessellation::Piece::kNoNode || tess_.nodes[node].kind == FacetTessellation::Node::Kind::corner ? M(corner) : along(node);
    };
    const M from = parameter(piece.from, 0), to = parameter(piece.to, 1);
    if (maybe_sign(to - from) == Sign::negative && fault_.empty()) fault_ = fmt::format("piece {} of the outline runs backwards", p);
    look_at(point_at(numbers_.side[piece.side], M(0.5) * (from + to)), {piece.site}, fmt::format("the middle of piece {} of the outline", p));
  }

  void look_at_drawn_point(Draw& draw) {
    const double b1 = 1.0 + draw.below(1000), b2 = 1.0 + draw.below(1000), b0 = 1.0 + draw.below(1000);
    const M sum(b0 + b1 + b2), x = M(b1) / sum, y = M(b2) / sum;
    const Point p{x + y * numbers_.frame->apex.x, y * numbers_.frame->apex.y};
    for (std::uint32_t site = 0; site < numbers_.sites.size() && fault_.empty(); ++site) {
      if (sees(site, p) != true || has_region(tess_.representative[site])) continue;
      bool nearest = true;
      for (std::uint32_t rival = 0; rival < numbers_.sites.size() && nearest; ++rival)
        nearest = rival == site || sees(rival, p) == false || maybe_sign(distance_of(site, p) - distance_of(rival, p)) == Sign::negative;
      if (nearest) fault_ = fmt::format("site {} is nearest at a point and has no region", site);
    }
  }
  bool has_region(std::uint32_t site) const {
    return std::any_of(tess_.outline.begin(), tess_.outline.end(), [&](const auto& piece) { return piece.site == site; }) ||
           std::any_of(tess_.arcs.begin(), tess_.arcs.end(), [&](const auto& arc) { return arc.left == site || arc.right == site; });
  }

  std::unique_ptr<kernel::FieldWaves> waves_;
  kernel::FacetNumbers<M> numbers_;
  FacetTessellation tess_;
  std::string fault_;
};

/// What is joined over an edge lies in one place, and in order.
std::string fault_of_joint(const kernel::subdivision::Joint& joint, const FinishedFacet& left, const FinishedFacet& right) {
  std::vector<M> places;
  for (const auto& station : joint.stations) {
    if (station.node_left == kNone && station.node_right == kNone) continue;
    const M of_left = station.node_left == kNone ? M(0.0) : left.along(station.node_left);
    const M of_right = station.node_right == kNone ? of_left : M(1.0) - right.along(station.node_right);
    if (station.node_left != kNone && differs(of_left - of_right)) return "points in two places are joined";
    places.push_back(of_right);
    if (places.size() > 1 && maybe_sign(places.back() - places[places.size() - 2]) == Sign::negative) return "points are joined out of order";
  }
  return "";
}

Outcome regions_are_nearest(Trial& t) {
  const Facets facets(t);
  const auto& mesh = facets.mesh();
  const auto& resolution = facets.resolution();
  Draw draw = t.draw("regions_are_nearest");
  const std::vector<kernel::DiagramSource> sources;
  const std::vector<kernel::LabelSetId> face_labels;
  const std::vector<kernel::BoundaryFacet> none;
  const auto origin = [&](kernel::WindowId w) { return kernel::WindowOrigin{resolution.field().windows[w].parent, resolution.field().windows[w].halfedge()}; };
  const auto as_far_along = [&](HalfedgeId h, const auto& left, const auto& right) { return are_as_far_along(resolution, h, left, right); };
  const kernel::DiagramInput in{t.mesh(), mesh, sources, resolution.sets().all(), resolution.labels(), face_labels, none, origin, as_far_along};
  predicates::Decisions decisions;
  kernel::subdivision::EdgeJoiner joiner(in, decisions);
  std::pmr::monotonic_buffer_resource memory;
  std::vector<std::unique_ptr<FinishedFacet>> finished(mesh.face_count());
  std::vector<kernel::subdivision::Skeleton> skeletons(mesh.face_count());
  const auto patch = facets.patch(draw);
  bool open = false;
  for (const FaceId f : patch) {
    auto facet = std::make_unique<FinishedFacet>(facets, f);
    open = open || facet->undecided();
    if (facet->undecided()) continue;
    if (const std::string fault = facet->fault(draw); !fault.empty()) return violated(fmt::format("facet {} of the refined mesh: {}", f, fault));
    skeletons[f] = kernel::subdivision::make_skeleton(facet->as_input(), memory);
    finished[f] = std::move(facet);
    for (HalfedgeId h = 3 * f; h < 3 * f + 3; ++h) {
      const FaceId other = mesh.twin(h) == kNone ? f : kernel::Mesh::face(mesh.twin(h));
      if (other == f || !finished[other]) continue;
      kernel::subdivision::Joint joint;
      joiner.join(h, skeletons[f], skeletons[other], joint);
      open = open || !joint.decided;
      const std::string fault = joint.decided ? fault_of_joint(joint, *finished[f], *finished[other]) : "";
      if (!fault.empty()) return violated(fmt::format("facets {} and {} of the refined mesh: {}", f, other, fault));
    }
  }
  return open ? undecided() : patch.empty() ? skipped() : holds();
}

constexpr std::array<Property, 1> kProperties = {{
    {"regions_are_nearest", regions_are_nearest, 100, "with 512 bits, what ties in a finished facet ties, nothing is nearer there, and points joined over edges are one"},
}};

}  // namespace

std::span<const Property> region_properties() { return kProperties; }

}  // namespace gvd::fuzz
