#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "facet_ladder.hpp"
#include "gvd/predicates/wave.hpp"

namespace gvd::kernel {

/// A wave that competes for the facet: a site, or several windows of one root with the same image whose cones touch, as one.
struct Contender {
  std::uint32_t site = 0;      ///< index in FacetWaves::sites; the lowest of those merged
  std::uint8_t entry = 0;      ///< bit k: comes in over side k
  std::uint8_t corner = FacetSite::kNoCorner;
  VertexId root = kNone;
  bool has_cone = false;
  /// Per end of the cone: its vertex, whether it is attained, and the site whose boundary ray it is.
  std::array<VertexId, 2> cone{kNone, kNone};
  std::array<bool, 2> attains_cone{false, false};
  std::array<std::uint32_t, 2> cone_site{0, 0};
  std::array<bool, 3> attains_corner{false, false, false};
  std::array<std::uint64_t, 3> path_to_corner{FacetSite::kNoPath, FacetSite::kNoPath, FacetSite::kNoPath};

  /// Whether both are known to have one and the same distance at corner k.
  bool ties_at_corner(const Contender& other, std::size_t k) const {
    return (attains_corner[k] && other.attains_corner[k]) ||
           (path_to_corner[k] != FacetSite::kNoPath && path_to_corner[k] == other.path_to_corner[k]);
  }
  bool enters_over(std::size_t side) const { return (entry >> side & 1) != 0; }
  /// Whether the wave is known to attain D at vertex v of the mesh; v may be a corner of the facet or bound the cone.
  bool attains(const FacetWaves& waves, VertexId v) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (waves.corner[k] == v && attains_corner[k]) return true;
    return (cone[0] == v && attains_cone[0]) || (cone[1] == v && attains_cone[1]);
  }
};

/// Positive strictly inside the boundary ray `end` of the contender's cone, zero on it, negative outside.
template <class NT>
NT cone_side(const FacetNumbers<NT>& numbers, const Contender& c, std::size_t end, const predicates::PlanePoint<NT>& p) {
  return predicates::cone_side(*numbers.sites[c.cone_site[end]], end, p);
}

/// The contenders of a facet and their tangencies.
class Contenders {
 public:
  static constexpr int kNotTangent = -1;

  /// Merges windows of the same image. On failure `ladder.failed()`.
  Contenders(FacetWaves& waves, FacetLadder& ladder);

  std::size_t size() const { return list_.size(); }
  const Contender& operator[](std::size_t i) const { return list_[i]; }
  /// The end of the parent's cone at which `relay` starts (then the two tie exactly on that ray, and inside the parent's cone the parent
  /// is nearer), or kNotTangent. Two that are one wave, with cones that touch, are tangent as well: the left one is called the parent.
  int tangent_end(std::size_t parent, std::size_t relay) const { return pair(parent, relay).tangent; }
  bool tangent(std::size_t a, std::size_t b) const { return tangent_end(a, b) != kNotTangent || tangent_end(b, a) != kNotTangent; }
  /// The one that starts on the ray where a tangent pair parts: the relay, or, if the two are one wave, the vertex between them.
  std::uint32_t starts_on_ray(std::size_t parent, std::size_t relay) const;
  /// Whether `relay` is, by identity, nowhere nearer than `wave`, cones aside: the path to the relay goes through `wave`'s strip, so its weight is
  /// that of `wave` plus the distance of the images, and their bisector is the ray beyond the relay. (Tangent pairs are of this kind.)
  bool eclipses(std::size_t wave, std::size_t relay) const { return pair(wave, relay).eclipsed; }
  /// Whether either of the two eclipses the other one, or is tangent to it.
  bool related(std::size_t a, std::size_t b) const { return pair(a, b).related; }
  /// Whether the two tie along a side because their images are mirror images in it: positive if i comes in over that side, negative if j does, zero
  /// if nothing of the kind is proved.
  robust::Sign mirrored(std::size_t i, std::size_t j, std::size_t side) const;
  /// Whether, by algebra of the strips, one of the two is along a side nowhere nearer than the other, but as near in one point of its line: the mirror image of
  /// its image is that of a relay on the other one's way.
  bool mirrored_on_way(std::size_t i, std::size_t j, std::size_t side) const;
  /// Whether the two are as far from corner k, by name or by algebra of the strips.
  bool tie_at_corner(FacetLadder& ladder, std::size_t i, std::size_t j, std::size_t k) const;
  /// As tangent_end, for the mirror image of the relay in a side: which may be no contender.
  int mirrored_tangent_end(std::size_t parent, std::size_t relay, std::size_t side) const;
  /// Whether boundary ray `end` of i is, by identity, on one line with ray `site_end` of a site: it is that ray, or both go through one relay, or
  /// one unfolded vertex, and one of the two waves eclipses the other.
  bool is_on_ray(std::size_t i, std::size_t end, std::uint32_t site, std::size_t site_end) const;
  /// The same for the rays of two sites.
  bool are_one_ray(std::uint32_t site, std::size_t end, std::uint32_t other, std::size_t other_end) const;
  /// Whether boundary ray `end` of i runs along a side of the facet: then every point of the side is on it. Proved from the images alone, since the
  /// numbers of such a point may be beyond all proof.
  bool runs_along(FacetLadder& ladder, std::size_t i, std::size_t end, std::size_t side) const;
  /// Whether a relay starts on a boundary ray of its parent that runs along a side, before the side or where it begins: then they tie all along it.
  bool tie_on_ray_along(FacetLadder& ladder, std::size_t parent, std::size_t relay, std::size_t side) const;
  std::string name(std::size_t i) const;
  /// Per site the one that stands for it: itself, or the lowest of the windows with its image.
  std::vector<std::uint32_t> representatives() const { return {representative_.begin(), representative_.end()}; }
  /// FacetWaves::where_they_part for the sites of contenders, each by one of the windows merged in it, over a side that all come over if there
  /// is one. Empty if it has no answer.
  std::vector<predicates::Site<robust::Exact>> where_they_part(std::span<const std::uint32_t> sites) const;

 private:
  /// What is known of an ordered pair.
  struct Pair {
    signed char tangent = kNotTangent;
    bool eclipsed = false;  ///< the second by the first
    bool related = false;
  };
  const Pair& pair(std::size_t a, std::size_t b) const { return pairs_[a * list_.size() + b]; }
  Pair& pair(std::size_t a, std::size_t b) { return pairs_[a * list_.size() + b]; }
  void find_pairs(const FacetLadder& ladder);
  void merge_same_images(FacetLadder& ladder);
  bool are_to_be_merged(FacetLadder& ladder, std::size_t left, std::size_t right) const;
  void merge(std::size_t left, std::size_t right);
  bool may_have_one_image(const FacetLadder& ladder, const Contender& left, const Contender& right) const;
  bool same_image(FacetLadder& ladder, const Contender& left, const Contender& right) const;
  bool may_touch(const FacetLadder& ladder, const Contender& left, const Contender& right) const;
  bool touching(FacetLadder& ladder, const Contender& left, const Contender& right) const;
  void find_tangencies(FacetLadder& ladder);
  void find_tangent_end(const FacetLadder& ladder, std::size_t parent, std::size_t relay);
  bool are_one_wave(FacetLadder& ladder, const Contender& a, const Contender& b) const;
  void share_eclipses(FacetLadder& ladder);
  bool share_ray(std::size_t a, std::size_t end_a, std::size_t b, std::size_t end_b) const;
  bool finds_eclipse(FacetLadder& ladder, const Contender& wave, const Contender& relay) const;
  std::optional<bool> is_gap_closed_where_they_part(const Contender& wave, const Contender& relay) const;
  bool may_enter_beyond(FacetLadder& ladder, const Contender& wave, const Contender& relay) const;
  int ray_through(FacetLadder& ladder, std::size_t p, std::size_t r) const;

  template <class Test>
  bool any_windows(std::size_t i, std::size_t j, const Test& test) const;
  bool may_be_mirror_images(const Contender& entering, const Contender& other, std::size_t side) const;
  bool are_mirror_images(const Contender& entering, const Contender& other, std::size_t side) const;

  FacetWaves& waves_;
  std::pmr::vector<Contender> list_;
  mutable std::map<std::array<std::size_t, 3>, bool> mirrored_;  ///< asked for: i that comes in over the side, j, the side
  mutable std::map<std::array<std::size_t, 3>, bool> on_way_;    ///< asked for: whether j is mirrored on the way of i, the side
  mutable std::map<std::array<std::size_t, 3>, bool> at_corner_;  ///< asked for: whether i and j tie at a corner
  mutable std::map<std::array<std::size_t, 3>, bool> runs_along_;  ///< asked for: i, end of its cone, side
  std::pmr::vector<std::uint32_t> representative_;
  std::pmr::vector<Pair> pairs_;
  std::pmr::vector<std::array<std::uint32_t, 2>> may_be_related_;  ///< ordered pairs that doubles do not exclude, in order
};

}  // namespace gvd::kernel
