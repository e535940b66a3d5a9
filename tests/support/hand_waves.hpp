#pragma once

#include "support/given_waves.hpp"

namespace gvd::test {

/// The waves of a facet with numbers that a test gives: doubles, taken as exact in every number type.
class HandWaves final : public GivenWaves {
 public:
  HandWaves(const kernel::Mesh& mesh, kernel::FaceId f, Point apex, double length) : GivenWaves(apex, length, true) {
    face = f;
    for (std::uint32_t k = 0; k < 3; ++k) corner[k] = mesh.origin(3 * f + k);
  }

  /// Adds a site without a cone; weight in frame units.
  std::uint32_t add(const kernel::FacetSite& site, Point image, double weight = 0) {
    return add_site(site, image, weight);
  }
  std::uint32_t add_corner(std::uint8_t k, kernel::LabelSetId labels, Point image, double weight = 0) {
    kernel::FacetSite site;
    site.corner = k;
    site.root = corner[k];
    site.labels = labels;
    return add(site, image, weight);
  }
  std::uint32_t add_window(kernel::WindowId window, std::uint8_t side, kernel::VertexId root, kernel::LabelSetId labels,
                           Point image, double weight = 0) {
    kernel::FacetSite site;
    site.window = window;
    site.side = side;
    site.root = root;
    site.labels = labels;
    return add(site, image, weight);
  }
};

}  // namespace gvd::test
