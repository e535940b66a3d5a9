#include <fmt/format.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "contenders.hpp"
#include "edge_images.hpp"
#include "fuzz/properties/facets.hpp"
#include "fuzz/properties/many_bits.hpp"
#include "fuzz/properties/property.hpp"
#include "gvd/predicates/enclosed_frame.hpp"
#include "gvd/predicates/wave.hpp"
#include "wave_numbers.hpp"

/// What identity or algebra proves equal is not asked a second time by the kernel. Here it is: with so many bits that whoever is not equal differs.
namespace gvd::fuzz {
namespace {

using kernel::FaceId;
using kernel::FacetSite;
using kernel::HalfedgeId;
using kernel::kNone;
using kernel::VertexId;
using robust::Sign;
using F = kernel::FacetWaves::F;
using M = kernel::FacetWaves::M;
using predicates::operator-;
using predicates::operator+;

template <class NT>
bool differ(const predicates::PlanePoint<NT>& a, const predicates::PlanePoint<NT>& b) { return differs(a.x - b.x) || differs(a.y - b.y); }
/// Whether a point is certainly not on the line of a boundary ray.
template <class NT>
bool is_off(const predicates::Site<NT>& window, std::size_t end, const predicates::PlanePoint<NT>& p) { return differs(predicates::cone_side(window, end, p)); }

/// The waves of a facet by numbers of one type alone: what certainly differs.
template <class NT>
class Judge {
 public:
  using Point = predicates::PlanePoint<NT>;
  using Site = predicates::Site<NT>;

  Judge(const Facets& facets, FaceId f) : facets_(facets), waves_(facets.waves(f)) {
    load_numbers(*waves_, kManyBits, numbers_);
    unit_ = numbers_.frame->length.scaled(-facets.resolution().frames().scale());
  }
  const Site& operator[](std::size_t site) const { return *numbers_.sites[site]; }
  const predicates::SideLine<NT>& side(std::size_t k) const { return numbers_.side[k]; }
  const Point& corner(std::size_t k) const { return numbers_.side[k].origin; }
  /// Exact enough for NT = M only.
  M distance_of(VertexId v) const { return facets_.resolution().distance(v, kManyBits) / unit_; }
  /// In units of the side, which may be read backwards: foot, height, weight.
  std::array<NT, 3> along(std::size_t site, std::size_t k, bool backwards) const {
    const auto z = kernel::seen_from_side(side(k), (*this)[site].image);
    return {backwards ? NT(1.0) - z.x : z.x, z.y, (*this)[site].weight / sqrt(side(k).square)};
  }
  Point mirrored(std::size_t site, std::size_t k) const {
    const auto z = kernel::seen_from_side(side(k), (*this)[site].image);
    return kernel::placed_at_side(side(k), {z.x, -z.y});
  }

  bool have_other_images(std::size_t a, std::size_t b) const { return differ((*this)[a].image, (*this)[b].image); }
  bool have_other_weights(std::size_t a, std::size_t b) const { return differs((*this)[a].weight - (*this)[b].weight); }
  bool are_other_waves(std::size_t a, std::size_t b) const { return have_other_images(a, b) || have_other_weights(a, b); }
  bool are_not_mirrored(std::size_t a, std::size_t b, std::size_t k) const {
    return have_other_weights(a, b) || differ(mirrored(a, k), (*this)[b].image);
  }
  bool is_no_relay(std::size_t parent, std::size_t relay) const { return starts_elsewhere((*this)[parent], (*this)[relay].image, (*this)[relay].weight); }
  bool is_no_mirrored_relay(std::size_t parent, std::size_t relay, std::size_t k) const {
    return starts_elsewhere((*this)[parent], mirrored(relay, k), (*this)[relay].weight);
  }
  bool differ_at(std::size_t a, std::size_t b, const Point& p) const { return differs(distance((*this)[a], p) - distance((*this)[b], p)); }
  /// Two boundary rays.
  bool are_other_lines(std::size_t a, std::size_t end_a, std::size_t b, std::size_t end_b) const {
    return is_off((*this)[a], end_a, (*this)[b].image) || is_off((*this)[a], end_a, (*this)[b].cone[end_b]);
  }

 private:
  /// Whether a wave does not come to a point at just that distance.
  static bool starts_elsewhere(const Site& parent, const Point& p, const NT& at) {
    const NT later = at - parent.weight;
    return maybe_sign(later) == Sign::negative || differs(squared_norm(p - parent.image) - square(later));
  }

  const Facets& facets_;
  std::unique_ptr<kernel::FieldWaves> waves_;
  kernel::FacetNumbers<NT> numbers_;
  NT unit_;
};

/// All that the waves of a facet claim of one another.
class Claims {
 public:
  Claims(const Facets& facets, FaceId f)
      : judge_(facets, f), rough_(facets, f), waves_(facets.waves(f)), ladder_(*waves_, decisions_), contenders_(*waves_, ladder_) {}

  std::string fault() {
    for (std::size_t i = 0; i < sites().size(); ++i) {
      look_at_names(i);
      for (std::size_t j = 0; j < sites().size(); ++j)
        if (i != j) look_at_strips(i, j);
    }
    for (std::size_t i = 0; i < contenders_.size(); ++i)
      for (std::size_t j = 0; j < contenders_.size(); ++j)
        if (i != j) look_at_contenders(i, j);
    for (std::size_t i = 0; i < contenders_.size(); ++i) look_at_rays(i);
    const auto representative = contenders_.representatives();
    for (std::size_t i = 0; i < sites().size(); ++i) refute(judge_.are_other_waves(i, representative[i]), "one image", i, representative[i]);
    return fault_;
  }

  const std::vector<FacetSite>& sites() const { return waves_->sites; }
  const Judge<M>& judge() const { return judge_; }
  const Judge<F>& rough() const { return rough_; }

 private:
  void refute(bool is_wrong, const char* claim, std::size_t a, std::size_t b) {
    if (is_wrong && fault_.empty()) fault_ = fmt::format("sites {} and {}: {}", a, b, claim);
  }

  void look_at_names(std::size_t i) {
    const FacetSite& site = sites()[i];
    for (std::size_t k = 0; k < 3; ++k) {
      refute(site.attains_corner[k] && differs(distance(judge_[i], judge_.corner(k)) - judge_.distance_of(waves_->corner[k])), "attains a corner", i, k);
      for (std::size_t j = 0; j < i; ++j)
        if (site.path_to_corner[k] != FacetSite::kNoPath && site.path_to_corner[k] == sites()[j].path_to_corner[k])
          refute(judge_.differ_at(i, j, judge_.corner(k)), "one path to a corner", i, j);
    }
    if (site.window == kNone) return;
    for (std::size_t end = 0; end < 2; ++end) {
      if (site.cone[end] == kNone) continue;
      refute(site.attains_cone[end] && differs(distance(judge_[i], judge_[i].cone[end]) - judge_.distance_of(site.cone[end])), "attains the vertex of its cone", i, end);
      for (std::size_t k = 0; k < 3; ++k)
        refute(site.cone[end] == waves_->corner[k] && differ(judge_[i].cone[end], judge_.corner(k)), "a corner bounds its cone", i, end);
    }
  }

  /// By the strips. Who is asked for its cone is a window, and a relay is another root.
  void look_at_strips(std::size_t i, std::size_t j) {
    const bool windows = sites()[i].window != kNone && sites()[j].window != kNone, other_root = sites()[i].root != sites()[j].root;
    if (sites()[i].window == kNone) return;
    if (windows) {
      refute(waves_->have_one_image(i, j) && judge_.have_other_images(i, j), "strips round flat vertices", i, j);
      refute(waves_->are_proved_one_wave(i, j) && judge_.are_other_waves(i, j), "one wave by algebra", i, j);
    }
    refute(other_root && waves_->is_own_relay(i, j) && judge_.is_no_relay(i, j), "a relay on the strip", i, j);
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& parent = judge_[i];
      if (other_root && sites()[i].cone[end] == sites()[j].root)
        refute(waves_->is_at_cone_vertex(i, j) && differ(parent.cone[end], judge_[j].image), "a relay at the vertex of the cone", i, j);
      refute(other_root && waves_->is_relay_on_ray(i, end, j) && (judge_.is_no_relay(i, j) || is_off(parent, end, judge_[j].image)), "a relay on a ray", i, j);
      for (std::size_t end_j = 0; windows && end_j < 2; ++end_j)
        refute(waves_->share_cone_vertex(i, end, j, end_j) && differ(parent.cone[end], judge_[j].cone[end_j]), "one vertex of cones", i, j);
    }
  }

  void look_at_contenders(std::size_t i, std::size_t j) {
    const std::size_t a = contenders_[i].site, b = contenders_[j].site;
    const bool one_wave = contenders_.eclipses(i, j) && contenders_.eclipses(j, i);
    refute(contenders_.eclipses(i, j) && judge_.is_no_relay(a, b), "eclipsed", a, b);
    refute(one_wave && judge_.are_other_waves(a, b), "halves of one wave", a, b);
    if (const int end = contenders_.tangent_end(i, j); end != kernel::Contenders::kNotTangent) {
      const auto ray = static_cast<std::size_t>(end);
      const auto& parent = judge_[contenders_[i].cone_site[ray]];
      if (one_wave)
        refute(judge_.are_other_lines(contenders_[i].cone_site[1], 1, contenders_[j].cone_site[0], 0), "cones that touch", a, b);
      else
        refute(judge_.is_no_relay(a, b) || is_off(parent, ray, judge_[b].image), "tangent", a, b);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      refute(contenders_.mirrored(i, j, k) != Sign::zero && judge_.are_not_mirrored(a, b, k), "mirrored", a, b);
      if (!rough_.is_no_mirrored_relay(a, b, k) || !rough_.is_no_mirrored_relay(b, a, k))
        refute(contenders_.mirrored_on_way(i, j, k) && judge_.is_no_mirrored_relay(a, b, k) && judge_.is_no_mirrored_relay(b, a, k), "mirrored on its way", a, b);
      refute(contenders_.tie_at_corner(ladder_, i, j, k) && judge_.differ_at(a, b, judge_.corner(k)), "tie at a corner", a, b);
      if (contenders_.tie_on_ray_along(ladder_, i, j, k))
        refute(judge_.differ_at(a, b, judge_.corner(k)) || judge_.differ_at(a, b, judge_.corner((k + 1) % 3)), "tie along a side", a, b);
      if (rough_.is_no_mirrored_relay(a, b, k)) continue;
      const int end = contenders_.mirrored_tangent_end(i, j, k);
      if (end == kernel::Contenders::kNotTangent) continue;
      const auto ray = static_cast<std::size_t>(end);
      refute(judge_.is_no_mirrored_relay(a, b, k) || is_off(judge_[contenders_[i].cone_site[ray]], ray, judge_.mirrored(b, k)), "tangent in the mirror", a, b);
    }
  }

  void look_at_rays(std::size_t i) {
    for (std::size_t end = 0; contenders_[i].has_cone && end < 2; ++end) {
      const std::uint32_t own = contenders_[i].cone_site[end];
      for (std::size_t k = 0; k < 3; ++k)
        refute(contenders_.runs_along(ladder_, i, end, k) && (is_off(judge_[own], end, judge_.corner(k)) || is_off(judge_[own], end, judge_.corner((k + 1) % 3))),
               "a ray along a side", own, k);
      for (std::uint32_t site = 0; site < sites().size(); ++site)
        for (std::size_t other = 0; sites()[site].window != kNone && other < 2; ++other)
          refute(contenders_.is_on_ray(i, end, site, other) && judge_.are_other_lines(own, end, site, other), "one ray", own, site);
    }
  }

  Judge<M> judge_;
  Judge<F> rough_;  ///< what it tells apart is not asked for
  std::unique_ptr<kernel::FieldWaves> waves_;
  predicates::Decisions decisions_;
  kernel::FacetLadder ladder_;
  kernel::Contenders contenders_;
  std::string fault_;
};

/// The waves on either side of an edge that are said to be as far all along it.
std::string fault_across(const Facets& facets, HalfedgeId h, const Claims& left, const Claims& right) {
  const HalfedgeId twin = facets.mesh().twin(h);
  const auto are_apart = [&](const auto& of_left, const auto& of_right, std::size_t a, std::size_t b) {
    const auto x = of_left.along(a, h % 3, false), y = of_right.along(b, twin % 3, true);
    return differs(x[0] - y[0]) || differs(square(x[1]) - square(y[1])) || differs(x[2] - y[2]);
  };
  for (std::size_t a = 0; a < left.sites().size(); ++a)
    for (std::size_t b = 0; b < right.sites().size(); ++b) {
      if (are_apart(left.rough(), right.rough(), a, b) || !are_as_far_along(facets.resolution(), h, left.sites()[a], right.sites()[b])) continue;
      if (are_apart(left.judge(), right.judge(), a, b))
        return fmt::format("sites {} and {} of facets {} and {}: as far along their edge", a, b, kernel::Mesh::face(h), kernel::Mesh::face(twin));
    }
  return "";
}

/// The paths that are said to tie at a vertex, and those that are said to be as far as these.
std::string fault_at(const Facets& facets, VertexId v) {
  const auto& resolution = facets.resolution();
  const auto& field = resolution.field();
  const auto& frames = resolution.frames();
  const double unit = predicates::unit<robust::Mpfr>(kManyBits);
  const auto is_other = [&](VertexId via, kernel::WindowId window) {
    const HalfedgeId h = window == kNone ? resolution.edge_between(via, v) : field.windows[window].halfedge();
    const auto frame = frames.in_mpfr(kernel::Mesh::face(h), kManyBits)[h % 3];
    const M leg = window == kNone ? predicates::enclosed_length(frame, unit)
                                  : predicates::last_leg(unfold_mpfr(frames, strip_of(facets.mesh(), field, window), kManyBits).image, frame, unit);
    return differs(resolution.distance(via, kManyBits) + leg - resolution.distance(v, kManyBits));
  };
  std::string fault;
  for (std::uint32_t c = field.first_candidate[v]; c != kNone; c = field.candidates[c].next)
    if (field.candidates[c].via != v && is_other(field.candidates[c].via, field.candidates[c].window)) return fmt::format("vertex {}: two nearest paths", v);
  facets.mesh().for_each_outgoing(v, [&](HalfedgeId spoke) {
    const HalfedgeId h = kernel::Mesh::next(spoke);
    for (kernel::WindowId w = field.first_window[h]; w != kNone; w = field.windows[w].next)
      if (field.windows[w].root != v && resolution.is_as_far(w, v) && is_other(field.windows[w].root, w)) fault = fmt::format("vertex {}: a window that is as far", v);
  });
  for (VertexId u = 0; u < v; ++u)
    if (resolution.is_reached(u) && resolution.have_equal_distances(u, v) && differs(resolution.distance(u, kManyBits) - resolution.distance(v, kManyBits)))
      return fmt::format("vertices {} and {}: as far", u, v);
  return fault;
}

Outcome identities_hold(Trial& t) {
  const Facets facets(t);
  const auto& mesh = facets.mesh();
  Draw draw = t.draw("identities_hold");
  std::map<FaceId, Claims> claims;
  std::set<VertexId> corners;
  for (const FaceId f : facets.patch(draw)) {
    Claims& own = claims.try_emplace(f, facets, f).first->second;
    if (const std::string fault = own.fault(); !fault.empty()) return violated(fmt::format("facet {} of the refined mesh, {}", f, fault));
    for (HalfedgeId h = 3 * f; h < 3 * f + 3; ++h) {
      if (corners.insert(mesh.origin(h)).second)
        if (const std::string fault = fault_at(facets, mesh.origin(h)); !fault.empty()) return violated(fault);
      if (mesh.twin(h) == kNone) continue;
      const auto across = claims.find(kernel::Mesh::face(mesh.twin(h)));
      if (across == claims.end()) continue;
      if (const std::string fault = fault_across(facets, h, own, across->second); !fault.empty()) return violated(fault);
    }
  }
  return claims.empty() ? skipped() : holds();
}

constexpr std::array<Property, 1> kProperties = {{
    {"identities_hold", identities_hold, 300, "what identity or algebra calls equal does not differ with 512 bits"},
}};

}  // namespace

std::span<const Property> identity_properties() { return kProperties; }

}  // namespace gvd::fuzz
