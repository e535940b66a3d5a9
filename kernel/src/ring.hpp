#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contenders.hpp"
#include "gvd/kernel/node_point.hpp"

namespace gvd::kernel {

/// The regions round one point of a facet where several waves tie (docs/architecture.md#ties-at-a-point). Away from the point in
/// direction e a wave grows by -e.u, u being the unit vector to its image, and it is there only in the directions in which its cone
/// goes on: the regions are the upper envelope of the e.u over the angle of the facet. Nothing is assumed of the position of the
/// images, cones or weights.
class Ring {
 public:
  using Node = FacetTessellation::Node;

  Ring(FacetWaves& waves, const Contenders& contenders, FacetLadder& ladder)
      : waves_(waves), contenders_(contenders), ladder_(ladder) {}

  /// The contenders that are nearest in an angle of directions, counter-clockwise; at a corner or on a side from the direction in
  /// which the outline goes on to the one it came from (there one may appear twice), inside beginning anywhere. Empty on failure.
  /// Pre: `tied` are contenders whose closed cones contain the point, which they reach at one distance; no nearer one does.
  std::vector<std::uint32_t> regions(const Node& node, std::span<const std::uint32_t> tied);

  /// Whether `other` reaches the node at the distance of the waves known to be nearest there, and sees it. Empty on failure.
  std::optional<bool> ties(const Node& node, std::span<const std::uint32_t> known, std::uint32_t other);
  /// Adds to the waves that are known to tie at the node and to be nearest there whatever else does so and sees it. False on failure.
  bool add_ties(const Node& node, std::vector<std::uint32_t>& known);

 private:
  struct Direction {
    enum class Kind : std::uint8_t { side, back, away, towards, overtaking };
    Kind kind = Kind::side;
    std::uint32_t a = 0, b = 0;  ///< side, or a wave's image, or the waves a and b: turning through it, b takes over from a
    bool operator==(const Direction&) const = default;
  };
  struct Wave {
    std::uint32_t contender = 0;
    bool starts_here = false;                  ///< the wave of the corner itself
    std::array<bool, 2> on_ray{false, false};  ///< the point lies on this boundary ray of the cone
    std::optional<bool> on_side_line;          ///< the image lies on the line of the node's side; asked for when needed
  };

  bool is_apart(const predicates::PlanePoint<FacetLadder::F>& p, std::uint32_t known, std::uint32_t other) const;
  bool load(const Node& node, std::span<const std::uint32_t> tied);
  robust::MaybeSign at_ray(std::uint32_t contender, std::size_t end);
  std::optional<std::uint32_t> winner_after(const Direction& d);
  enum class Beside : std::uint8_t { before, after };
  std::optional<bool> seen(std::uint32_t i, const Direction& d, Beside beside);
  robust::MaybeSign better_after(std::uint32_t i, std::uint32_t j, const Direction& d);
  bool is_side(const Direction& d) const;
  bool are_mirrored(std::uint32_t i, std::uint32_t j, const Direction& d);
  robust::MaybeSign slope(std::uint32_t i, std::uint32_t j, const Direction& d);
  std::optional<bool> same_direction(std::uint32_t i, std::uint32_t j);
  robust::MaybeSign behind(std::uint32_t i, std::uint32_t j);
  std::optional<std::uint32_t> along_side(const Direction& d, Beside beside, std::uint32_t inward);
  bool add_slivers(const Direction& begin, const Direction& end, std::uint32_t first, std::uint32_t last,
                   std::vector<std::uint32_t>& regions);
  std::optional<Direction> next_change(const Direction& from, std::uint32_t winner);
  std::optional<bool> comes_before(const Direction& from, const Direction& a, const Direction& b);
  std::optional<int> quadrant(const Direction& from, const Direction& d);
  robust::Sign mirrored(std::uint32_t i, std::uint32_t j, std::size_t side);
  robust::Sign along_mirror(const Direction& change, const Direction& side);
  robust::Sign same_line(const Direction& a, const Direction& b);
  bool is_on_node_ray(const Node& node, std::uint32_t wave, std::size_t end) const;
  template <class Known>
  bool relay_on_ray(std::uint32_t wave, std::size_t end, const Known& is_known) const;
  bool tie_by_identity(const Node& node, std::uint32_t i, std::uint32_t j) const;
  bool is_on_side_line(const Direction& d);
  bool are_known_alike(std::uint32_t i, std::uint32_t j) const;
  bool alike(std::uint32_t i, std::uint32_t j);
  robust::MaybeSign turn_to_image(const Direction& side, const Direction& image, bool from_side);
  robust::MaybeSign turn(const Direction& a, const Direction& b);
  robust::MaybeSign along(const Direction& a, const Direction& b);

  template <class NT>
  predicates::PlanePoint<NT> to_image(const FacetNumbers<NT>& numbers, std::uint32_t wave) const;
  template <class NT>
  predicates::PlanePoint<NT> difference(const FacetNumbers<NT>& numbers, std::uint32_t i, std::uint32_t j) const;
  template <class NT>
  predicates::PlanePoint<NT> vector(const FacetNumbers<NT>& numbers, const Direction& d) const;
  template <class Test>
  robust::MaybeSign decide(const Test& test);

  FacetWaves& waves_;
  const Contenders& contenders_;
  FacetLadder& ladder_;
  const Node* node_ = nullptr;
  std::vector<Wave> tied_;
  std::vector<signed char> same_;  // per pair of tied_: 0 unknown, 1 the directions to the images are one, -1 they are not
};

}  // namespace gvd::kernel
