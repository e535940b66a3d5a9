#pragma once

#include <array>
#include <deque>
#include <vector>

#include "gvd/kernel/facet.hpp"

namespace gvd::test {

/// The waves of a facet with numbers that a test gives: doubles, taken as exact in every number type.
class HandWaves final : public kernel::FacetWaves {
 public:
  HandWaves(const kernel::Mesh& mesh, kernel::FaceId f, std::array<double, 2> apex, double length) {
    face = f;
    for (std::uint32_t k = 0; k < 3; ++k) corner[k] = mesh.origin(3 * f + k);
    set_frame(f_.frame, apex, length);
    set_frame(dd_.frame, apex, length);
    set_frame(m_.frame, apex, length);
    set_frame(exact_.frame, apex, length);
  }

  /// Adds a site without a cone; weight in frame units.
  std::uint32_t add(const kernel::FacetSite& site, std::array<double, 2> image, double weight = 0) {
    sites.push_back(site);
    add_site(f_.sites, image, weight);
    add_site(dd_.sites, image, weight);
    add_site(m_.sites, image, weight);
    add_site(exact_.sites, image, weight);
    return static_cast<std::uint32_t>(sites.size() - 1);
  }
  std::uint32_t add_corner(std::uint8_t k, kernel::LabelSetId labels, std::array<double, 2> image, double weight = 0) {
    kernel::FacetSite site;
    site.corner = k;
    site.root = corner[k];
    site.labels = labels;
    return add(site, image, weight);
  }
  std::uint32_t add_window(kernel::WindowId window, std::uint8_t side, kernel::VertexId root, kernel::LabelSetId labels,
                           std::array<double, 2> image, double weight = 0) {
    kernel::FacetSite site;
    site.window = window;
    site.side = side;
    site.root = root;
    site.labels = labels;
    return add(site, image, weight);
  }

  const predicates::FacetFrame<F>& frame(F) override { return f_.frame; }
  const predicates::Site<F>& site(std::size_t i, F) override { return f_.sites[i]; }
  const predicates::FacetFrame<DD>& frame(DD) override { return dd_.frame; }
  const predicates::Site<DD>& site(std::size_t i, DD) override { return dd_.sites[i]; }
  const predicates::FacetFrame<M>& frame(M, int) override { return m_.frame; }
  const predicates::Site<M>& site(std::size_t i, M, int) override { return m_.sites[i]; }
  const predicates::FacetFrame<robust::Exact>* exact_frame() override { return &exact_.frame; }
  const predicates::Site<robust::Exact>* exact_site(std::size_t i) override { return &exact_.sites[i]; }

 private:
  template <class NT>
  struct Numbers {
    predicates::FacetFrame<NT> frame;
    std::deque<predicates::Site<NT>> sites;
  };
  template <class NT>
  static void set_frame(predicates::FacetFrame<NT>& frame, std::array<double, 2> apex, double length) {
    frame = {{number<NT>(apex[0]), number<NT>(apex[1])}, number<NT>(length)};
  }
  template <class NT>
  static void add_site(std::deque<predicates::Site<NT>>& sites, std::array<double, 2> image, double weight) {
    predicates::Site<NT> site;
    site.image = {number<NT>(image[0]), number<NT>(image[1])};
    site.weight = number<NT>(weight);
    sites.push_back(site);
  }
  template <class NT>
  static NT number(double x) {
    return robust::from_double<NT>(x, 256);
  }

  Numbers<F> f_;
  Numbers<DD> dd_;
  Numbers<M> m_;
  Numbers<robust::Exact> exact_;
};

}  // namespace gvd::test
