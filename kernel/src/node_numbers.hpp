#pragma once

#include <cstdint>

#include "gvd/kernel/node_point.hpp"
#include "wave_numbers.hpp"

/// The points of a tessellation in any number type, asking only for the waves that define them. Where a number type cannot
/// construct a point, the result is a ball of infinite radius.
namespace gvd::kernel {

/// Frame and sides alone; waves are added by add_waves.
template <class NT>
FacetNumbers<NT> numbers_without_waves(FacetWaves& waves, int bits) {
  FacetNumbers<NT> numbers;
  numbers.frame = &frame_in<NT>(waves, bits);
  for (std::size_t k = 0; k < 3; ++k) numbers.side[k] = predicates::side_line(*numbers.frame, k);
  numbers.sites = SiteNumbers<NT>(waves.sites.size());
  return numbers;
}

/// Those that define the node.
template <class NT>
void add_waves(FacetWaves& waves, const FacetTessellation::Node& node, int bits, FacetNumbers<NT>& numbers) {
  for (const std::uint32_t site : {node.defining[0], node.defining[1], node.defining[2], node.ray})
    if (site != FacetTessellation::kNoSite) numbers.sites.set(site, site_in<NT>(waves, site, bits));
}

/// The parameter of a node along its side. Pre: node n lies on a side.
template <class NT>
NT side_parameter(FacetWaves& waves, const FacetTessellation& tess, std::uint32_t n, int bits) {
  auto numbers = numbers_without_waves<NT>(waves, bits);
  add_waves(waves, tess.nodes[n], bits, numbers);
  return node_parameter(waves, numbers, tess.nodes[n]);
}

}  // namespace gvd::kernel
