#pragma once

#include "gvd/kernel/facet_numbers.hpp"
#include "gvd/kernel/tessellation.hpp"
#include "gvd/predicates/bisector_vertex.hpp"

namespace gvd::kernel {

/// Wave `site` as seen from wave `pivot`.
template <class NT>
predicates::RelativeWave<NT> relative_wave(const FacetWaves& waves, const FacetNumbers<NT>& numbers, std::uint32_t pivot,
                                           std::uint32_t site) {
  using predicates::operator-;
  const auto &from = *numbers.sites[pivot], &to = *numbers.sites[site];
  const bool same_weight = waves.sites[pivot].root == waves.sites[site].root;
  return {to.image - from.image, same_weight ? NT(0.0) : to.weight - from.weight, same_weight};
}

/// The vertex of three waves, regions i, pivot, k counter-clockwise, relative to the pivot's image.
template <class NT>
predicates::BisectorVertex<NT> vertex_of(const FacetWaves& waves, const FacetNumbers<NT>& numbers, std::uint32_t i, std::uint32_t pivot,
                                         std::uint32_t k) {
  return predicates::bisector_vertex(relative_wave(waves, numbers, pivot, i), relative_wave(waves, numbers, pivot, k));
}

/// The point of the boundary ray of window `ray` through the vertex where `relay` starts that ties with `other`, relative to the relay.
template <class NT>
predicates::BisectorVertex<NT> vertex_on_ray(const FacetWaves& waves, const FacetNumbers<NT>& numbers, std::uint32_t ray,
                                             std::uint32_t relay, std::uint32_t other) {
  using predicates::operator-;
  const auto direction = numbers.sites[relay]->image - numbers.sites[ray]->image;
  NT length;
  if constexpr (std::is_same_v<NT, robust::Exact>)
    length = numbers.sites[relay]->weight - numbers.sites[ray]->weight;  // the same by identity, and a simpler expression
  else
    length = sqrt(predicates::squared_norm(direction));
  return predicates::tangent_vertex(direction, length, relative_wave(waves, numbers, relay, other));
}

/// The parameter of a node on a side: 0 at corner `node.where`, 1 at the next corner.
template <class NT>
NT node_parameter(const FacetWaves& waves, const FacetNumbers<NT>& numbers, const FacetTessellation::Node& node) {
  const auto& side = numbers.side[node.where];
  if (node.ray != FacetTessellation::kNoSite) {
    const auto& window = *numbers.sites[node.ray];
    return predicates::ray_meeting(side, window.image, window.cone[node.ray_end]);
  }
  const std::uint32_t from = node.defining[0], to = node.defining[1];
  const auto tie = predicates::overtaking(side, *numbers.sites[from], *numbers.sites[to], waves.sites[from].root == waves.sites[to].root);
  return tie.existence == predicates::Existence::proved ? tie.t : NT(0.0) / NT(0.0);
}

/// Constructs the point of a node again, in any number type, from the sites that define it (frame of half-edge 3 * face, frame units).
/// Pre: the node comes from the tessellation of `waves`; `numbers` are those of `waves`. For Exact, those of the sites involved must be there.
/// The enclosure may be unbounded in a number type that is too coarse to tell which point is meant; ask the next one then.
template <class NT>
predicates::PlanePoint<NT> node_point(const FacetWaves& waves, const FacetNumbers<NT>& numbers, const FacetTessellation::Node& node) {
  using Kind = FacetTessellation::Node::Kind;
  using predicates::operator+;
  const bool on_ray = node.ray != FacetTessellation::kNoSite;
  const auto& def = node.defining;
  if (node.kind == Kind::corner) return predicates::corner_point(*numbers.frame, node.where);
  if (node.kind == Kind::side) return predicates::point_at(numbers.side[node.where], node_parameter(waves, numbers, node));
  const predicates::BisectorVertex<NT> vertex =
      on_ray ? vertex_on_ray(waves, numbers, node.ray, def[0], def[1]) : vertex_of(waves, numbers, def[0], def[1], def[2]);
  if (vertex.existence != predicates::Existence::proved) return {NT(0.0) / NT(0.0), NT(0.0) / NT(0.0)};
  return vertex.p + numbers.sites[on_ray ? def[0] : def[1]]->image;
}

}  // namespace gvd::kernel
