#pragma once

#include <optional>
#include <vector>

#include "contenders.hpp"
#include "ring.hpp"

namespace gvd::kernel {

/// The order of the waves round the corners of a facet: which regions meet there, by direction.
class CornerOrder {
 public:
  CornerOrder(FacetWaves& waves, const Contenders& contenders, FacetLadder& ladder)
      : waves_(waves), contenders_(contenders), ladder_(ladder) {}

  /// The contenders whose regions have corner c as a corner with a positive angle, from the direction of the side that starts at c
  /// counter-clockwise to that of the side that ends there. Empty on failure.
  std::vector<std::uint32_t> sequence(std::size_t c);

  enum class Direction { outgoing, incoming };  ///< along the side that starts at the corner, or back along the one that ends there
  /// Which of two contenders that tie at corner c is nearer right beside it in that direction, cones aside: positive if p is. Zero: to first order
  /// they are equal there, so they cross nowhere else on that side (their difference has two zeros at most). Empty on failure.
  robust::MaybeSign nearer_beside(std::size_t c, Direction direction, std::uint32_t p, std::uint32_t q);

 private:
  std::string describe(std::size_t c, std::uint32_t p, std::uint32_t q, const char* what) const;

  FacetWaves& waves_;
  const Contenders& contenders_;
  FacetLadder& ladder_;
};

}  // namespace gvd::kernel
