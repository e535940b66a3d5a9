#pragma once

#include <array>
#include <deque>
#include <optional>

#include "gvd/kernel/facet.hpp"
#include "gvd/predicates/wave.hpp"

namespace gvd::test {

/// Waves of one facet with corners (0,0), (1,0), apex, from doubles that count as exact in every number type. Vertices 0, 1, 2 are the corners.
class PlanarWaves final : public kernel::FacetWaves {
 public:
  using Point = std::array<double, 2>;
  using Exact = robust::Exact;

  explicit PlanarWaves(Point apex, bool offers_exact = true) : offers_exact_(offers_exact) {
    face = 0;
    corner = {0, 1, 2};
    set_frame(f_.frame, apex);
    set_frame(dd_.frame, apex);
    set_frame(m_.frame, apex);
    set_frame(exact_.frame, apex);
  }

  /// A wave over `side` that sees the whole facet.
  std::uint32_t add(std::uint8_t side, kernel::VertexId root, Point image, double weight) {
    kernel::FacetSite site;
    site.window = static_cast<kernel::WindowId>(sites.size());
    site.side = side;
    site.root = root;
    site.labels = root;
    return add_site(site, image, weight, std::nullopt);
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
    return add_site(site, at, weight, std::nullopt);
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

  const predicates::FacetFrame<F>& frame(F) override { return f_.frame; }
  const predicates::Site<F>& site(std::size_t i, F) override { return f_.sites[i]; }
  const predicates::FacetFrame<DD>& frame(DD) override { return dd_.frame; }
  const predicates::Site<DD>& site(std::size_t i, DD) override { return dd_.sites[i]; }
  const predicates::FacetFrame<M>& frame(M, int) override { return m_.frame; }
  const predicates::Site<M>& site(std::size_t i, M, int) override { return m_.sites[i]; }
  const predicates::FacetFrame<Exact>* exact_frame() override { return offers_exact_ ? &exact_.frame : nullptr; }
  const predicates::Site<Exact>* exact_site(std::size_t i) override { return &exact_.sites[i]; }

 private:
  template <class NT>
  struct Numbers {
    predicates::FacetFrame<NT> frame;
    std::deque<predicates::Site<NT>> sites;
  };
  template <class NT>
  static NT number(double x) {
    return robust::from_double<NT>(x, 256);
  }
  template <class NT>
  static predicates::PlanePoint<NT> point(Point p) {
    return {number<NT>(p[0]), number<NT>(p[1])};
  }
  template <class NT>
  static void set_frame(predicates::FacetFrame<NT>& frame, Point apex) {
    frame = {point<NT>(apex), number<NT>(1)};
  }
  template <class NT>
  static void add_to(Numbers<NT>& numbers, Point image, double weight, const std::optional<std::array<Point, 2>>& cone) {
    predicates::Site<NT> site;
    site.image = point<NT>(image);
    site.weight = number<NT>(weight);
    site.has_cone = cone.has_value();
    if (cone) site.cone = {point<NT>((*cone)[0]), point<NT>((*cone)[1])};
    numbers.sites.push_back(site);
  }
  std::uint32_t add_site(const kernel::FacetSite& site, Point image, double weight, const std::optional<std::array<Point, 2>>& cone) {
    sites.push_back(site);
    add_to(f_, image, weight, cone);
    add_to(dd_, image, weight, cone);
    add_to(m_, image, weight, cone);
    add_to(exact_, image, weight, cone);
    return static_cast<std::uint32_t>(sites.size() - 1);
  }

  bool offers_exact_;
  Numbers<F> f_;
  Numbers<DD> dd_;
  Numbers<M> m_;
  Numbers<Exact> exact_;
};

}  // namespace gvd::test
