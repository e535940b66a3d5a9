#pragma once

#include "support/given_waves.hpp"

namespace gvd::test {

/// Waves of one facet with corners (0,0), (1,0), apex, from doubles that count as exact in every number type. Vertices 0, 1, 2 are the corners.
class PlanarWaves final : public GivenWaves {
 public:
  explicit PlanarWaves(Point apex, bool offers_exact = true) : GivenWaves(apex, 1, offers_exact) {
    face = 0;
    corner = {0, 1, 2};
  }

  /// A wave over `side` that sees the whole facet.
  std::uint32_t add(std::uint8_t side, kernel::VertexId root, Point image, double weight) {
    kernel::FacetSite site;
    site.window = static_cast<kernel::WindowId>(sites.size());
    site.side = side;
    site.root = root;
    site.labels = root;
    return add_site(site, image, weight);
  }
  /// A window with a cone.
  std::uint32_t add(std::uint8_t side, kernel::VertexId root, Point image, double weight, std::array<Point, 2> cone,
                    std::array<kernel::VertexId, 2> cone_vertices, std::array<bool, 2> attains_cone) {
    kernel::FacetSite site;
    site.window = static_cast<kernel::WindowId>(sites.size());
    site.side = side;
    site.root = root;
    site.labels = root;
    site.cone = cone_vertices;
    site.attains_cone = attains_cone;
    return add_site(site, image, weight, cone);
  }
  std::uint32_t add_corner(std::uint8_t k, Point at, double weight) {
    kernel::FacetSite site;
    site.corner = k;
    site.root = k;
    site.labels = k;
    return add_site(site, at, weight);
  }

  /// Finds out which waves attain the corners, exactly. To be called when all are there.
  void finish() {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = predicates::corner_point(exact_.frame, k);
      std::optional<Exact> least;
      for (const auto& site : exact_.sites) {
        if (predicates::cone_contains(site, at) != true) continue;
        const Exact d = predicates::distance(site, at);
        if (!least || maybe_sign(d - *least) == robust::Sign::negative) least = d;
      }
      for (std::size_t i = 0; i < sites.size(); ++i) {
        const auto& site = exact_.sites[i];
        sites[i].attains_corner[k] = predicates::cone_contains(site, at) == true &&
                                     maybe_sign(predicates::distance(site, at) - *least) == robust::Sign::zero;
      }
    }
  }
};

}  // namespace gvd::test
