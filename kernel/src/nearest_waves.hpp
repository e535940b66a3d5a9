#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "facet_waves.hpp"
#include "gvd/kernel/diagram.hpp"
#include "refined_point.hpp"

namespace gvd::kernel {

/// The waves that bring a point its distance.
struct NearestWaves {
  /// Indices in FieldWaves::sites. The nearest wave is one of them.
  std::vector<std::uint32_t> sites;
  Enclosed distance;         ///< mesh units; the value is correctly rounded if `is_decided`
  bool is_decided = false;   ///< the distance is rounded, and all sites have one label set or are exactly tied
  bool is_one_path = false;  ///< all sites are certainly nearest
  robust::Stage stage = robust::Stage::filter;  ///< the last one that was asked
};

/// Decides which waves of a facet are nearest at one of its points. With `to_one_path` it also decides between waves of the same
/// labels, which matter for nothing but the path.
NearestWaves nearest_waves(const Resolution& resolution, FieldWaves& waves, const RefinedPoint& at, bool to_one_path);

}  // namespace gvd::kernel
