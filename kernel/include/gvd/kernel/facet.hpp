#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gvd/kernel/ids.hpp"
#include "gvd/predicates/precise_points.hpp"
#include "gvd/predicates/site.hpp"

namespace gvd::kernel {

/// What is known of a wave of a facet without any number. The facet f has corners 0, 1, 2 (of half-edges 3f, 3f+1, 3f+2) and
/// sides 0, 1, 2 (side k from corner k to corner k+1).
struct FacetSite {
  WindowId window = kNone;      ///< the window, or kNone for a corner (relay or source)
  std::uint8_t side = 0;        ///< window: the side over which it comes in
  std::uint8_t corner = kNoCorner;  ///< corner site: which one
  VertexId root = kNone;        ///< where the wave starts: a source or a relay
  LabelSetId labels = kNone;    ///< the nearest sources of the root
  /// Window: the vertices that bound its cone; 0 on the side of the origin of side `side`, 1 on that of its target.
  std::array<VertexId, 2> cone{kNone, kNone};
  /// Window: whether the window attains D at that cone vertex (its boundary ray there is a geodesic). Exact, by lookup.
  /// If it does and the cone vertex relays, the relay's wave is tangent to this one along the boundary ray.
  std::array<bool, 2> attains_cone{false, false};
  /// Whether the wave attains D at corner k of the facet, exactly (known for all three corners of the facet).
  std::array<bool, 3> attains_corner{false, false, false};

  /// The path by which the wave reaches corner k, whether that is the nearest or not; kNoPath if it does not reach it or no name is known.
  /// Waves with the same path to a corner tie there, by identity.
  std::array<std::uint64_t, 3> path_to_corner{kNoPath, kNoPath, kNoPath};

  static constexpr std::uint64_t kNoPath = ~std::uint64_t{0};
  static constexpr std::uint8_t kNoCorner = 255;
};

/// The wave set of one facet: the sites, and their numbers for each stage of the ladder. Sites are complete (every wave that is
/// nearest anywhere in the closed facet is there) and may contain waves that are nearest nowhere.
class FacetWaves {
 public:
  virtual ~FacetWaves() = default;

  FaceId face = kNone;
  std::array<VertexId, 3> corner{};          ///< vertices of the refined mesh
  std::array<LabelSetId, 3> corner_labels{};  ///< exact label sets of the corners
  /// Whether the total angle at corner k is exactly 2 pi (interior) or pi (boundary): then two windows that come to it by one path and pass it on
  /// either side have the same image.
  std::array<bool, 3> corner_is_flat{};
  std::vector<FacetSite> sites;

  using F = robust::Ball<double>;
  using DD = robust::Ball<robust::DoubleDouble>;
  using M = robust::Ball<robust::Mpfr>;

  /// Numbers in the frame of half-edge 3 * face (corner 0 = 0, corner 1 = 1, corner 2 = apex), weights in units of that side.
  virtual const predicates::FacetFrame<F>& frame(F) = 0;
  virtual const predicates::Site<F>& site(std::size_t i, F) = 0;
  virtual const predicates::FacetFrame<DD>& frame(DD) = 0;
  virtual const predicates::Site<DD>& site(std::size_t i, DD) = 0;
  /// The same in double-double by value, and of a wave its image and weight alone: cheaper, for who asks once.
  virtual predicates::FacetFrame<DD> precise_frame() { return frame(DD()); }
  virtual predicates::PreciseWave precise_wave(std::size_t i) { return {site(i, DD()).image, site(i, DD()).weight}; }
  virtual const predicates::FacetFrame<M>& frame(M, int bits) = 0;
  virtual const predicates::Site<M>& site(std::size_t i, M, int bits) = 0;
  /// Null if there are no exact numbers at all. A site whose strip crosses too many square classes has undefined ones.
  virtual const predicates::FacetFrame<robust::Exact>* exact_frame() = 0;
  virtual const predicates::Site<robust::Exact>* exact_site(std::size_t i) = 0;
  /// Whether the exact numbers cost less than MPFR's: the faces are all of one square class.
  virtual bool exact_is_cheap() { return false; }
  // References and pointers stay valid while the object lives, except those to M numbers: until other `bits` are asked for.

  /// Whether two windows of one root have the same image by identity: the left one's strip and the right one's enclose only vertices with a total
  /// angle of exactly 2 pi. True is a proof, false says nothing.
  virtual bool have_one_image(std::size_t left, std::size_t right) {
    static_cast<void>(left);
    static_cast<void>(right);
    return false;
  }

  /// Whether two windows have one image and roots that are as far, by algebra of the strips: one wave, cones aside. True is a proof, false says nothing.
  virtual bool are_proved_one_wave(std::size_t a, std::size_t b) {
    static_cast<void>(a);
    static_cast<void>(b);
    return false;
  }

  /// Whether a window and another wave, of equal weight, have images that are mirror images in the side over which the window enters: then they tie
  /// along that side. True is a proof, false says nothing.
  virtual bool are_mirror_images(std::size_t entering, std::size_t other) {
    static_cast<void>(entering);
    static_cast<void>(other);
    return false;
  }

  /// Whether another wave, mirrored in a side, would be that of a relay at the vertex that bounds end `end` of the cone of window `parent`: the parent attains
  /// that vertex, the root of `other` is as far, and the images are mirrored. True is a proof, false says nothing.
  virtual bool is_mirrored_at_cone_vertex(std::size_t parent, std::size_t end, std::size_t other, std::uint8_t side) {
    static_cast<void>(parent), static_cast<void>(end), static_cast<void>(other), static_cast<void>(side);
    return false;
  }

  /// Whether another wave, mirrored in a side, would be that of a relay on the way of window `parent`: the parent's strip turns about a vertex, comes to it by a
  /// nearest path, and shows it in the mirror image of the other wave's image, and its root is as far as that vertex. Then along that side the other wave is
  /// nowhere nearer than the parent, cones aside. True is a proof, false says nothing.
  virtual bool is_mirrored_on_strip(std::size_t parent, std::size_t other, std::uint8_t side) {
    static_cast<void>(parent), static_cast<void>(other), static_cast<void>(side);
    return false;
  }

  /// Whether two windows are as far from corner k, cones aside, by algebra of the strips. True is a proof, false says nothing.
  virtual bool are_as_far_from_corner(std::size_t a, std::size_t b, std::uint8_t k) {
    static_cast<void>(a), static_cast<void>(b), static_cast<void>(k);
    return false;
  }

  /// Whether two rays bound cones of windows in one and the same unfolded vertex, by identity: from that vertex on the strips cross the same sides.
  virtual bool share_cone_vertex(std::size_t a, std::size_t end_a, std::size_t b, std::size_t end_b) {
    static_cast<void>(a), static_cast<void>(end_a), static_cast<void>(b), static_cast<void>(end_b);
    return false;
  }

  /// Whether the image of `relay`, whose root bounds the cone of window `parent` and is attained there, is that vertex of the cone by identity: the
  /// parent's strip saw the root in that one place only, and the relay's image is there. Asked only where doubles cannot exclude it, as is_own_relay.
  virtual bool is_at_cone_vertex(std::size_t parent, std::size_t relay) { return is_own_relay(parent, relay); }

  /// Whether the root of `relay`, on the strip of window `parent` (is_own_relay), lies on boundary ray `end` of the parent by identity: the nearest path
  /// to the farther one of that root and the cone's vertex comes straight through the nearer one. True is a proof, false says nothing.
  virtual bool is_relay_on_ray(std::size_t parent, std::size_t end, std::size_t relay) {
    static_cast<void>(parent), static_cast<void>(end), static_cast<void>(relay);
    return false;
  }

  /// The waves `which`, in their order, in the frame of the last side that the strips of all of them cross, counting back from the facet, if from there on
  /// they unfold what is behind alike: whatever holds between them alone is told by fewer and simpler numbers. Empty if they have no such side but the
  /// facet's own, or no exact numbers.
  virtual std::vector<predicates::Site<robust::Exact>> where_they_part(std::span<const std::uint32_t> which) {
    static_cast<void>(which);
    return {};
  }

  /// Whether the path to the root of `relay` goes through the strip of window `parent`, which turns about that root and then crosses the same
  /// faces as the strip of `relay`: then the relay's image lies on a ray of the parent and the weights differ by the distance of the images,
  /// by identity. Asked only of different roots, and where doubles cannot exclude it; so the default is wrong only where a different strip of the same relay has an image
  /// closer than rounding errors.
  virtual bool is_own_relay(std::size_t parent, std::size_t relay) {
    static_cast<void>(parent);
    static_cast<void>(relay);
    return true;
  }
};

}  // namespace gvd::kernel
