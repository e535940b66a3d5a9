#pragma once

#include <type_traits>

#include "gvd/kernel/facet.hpp"
#include "gvd/predicates/side_tie.hpp"

/// The numbers of single waves of a facet by number type, so that one formula serves every stage of the ladder.
namespace gvd::kernel {

template <class NT>
const predicates::FacetFrame<NT>& frame_in(FacetWaves& waves, int bits) {
  if constexpr (std::is_same_v<NT, robust::Exact>)
    return *waves.exact_frame();
  else if constexpr (std::is_same_v<NT, FacetWaves::M>)
    return waves.frame(NT(), bits);
  else
    return waves.frame(NT());
}

template <class NT>
const predicates::Site<NT>& site_in(FacetWaves& waves, std::uint32_t site, int bits) {
  if constexpr (std::is_same_v<NT, robust::Exact>)
    return *waves.exact_site(site);
  else if constexpr (std::is_same_v<NT, FacetWaves::M>)
    return waves.site(site, NT(), bits);
  else
    return waves.site(site, NT());
}

/// A point of the frame relative to a directed side: its origin is 0, its target 1.
template <class NT>
predicates::PlanePoint<NT> seen_from_side(const predicates::SideLine<NT>& side, const predicates::PlanePoint<NT>& p) {
  const auto from_origin = p - side.origin;
  return {dot(side.direction, from_origin) / side.square, cross(side.direction, from_origin) / side.square};
}
/// Its inverse.
template <class NT>
predicates::PlanePoint<NT> placed_at_side(const predicates::SideLine<NT>& side, const predicates::PlanePoint<NT>& z) {
  const auto& d = side.direction;
  return {side.origin.x + z.x * d.x - z.y * d.y, side.origin.y + z.x * d.y + z.y * d.x};
}

}  // namespace gvd::kernel
