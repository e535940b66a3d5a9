#pragma once

#include <array>
#include <deque>
#include <optional>

#include "gvd/kernel/facet.hpp"
#include "gvd/predicates/wave.hpp"

namespace gvd::test {

/// Waves of one facet from doubles that count as exact in every number type.
class GivenWaves : public kernel::FacetWaves {
 public:
  using Point = std::array<double, 2>;
  using Exact = robust::Exact;

  const predicates::FacetFrame<F>& frame(F) override { return f_.frame; }
  const predicates::Site<F>& site(std::size_t i, F) override { return f_.sites[i]; }
  const predicates::FacetFrame<DD>& frame(DD) override { return dd_.frame; }
  const predicates::Site<DD>& site(std::size_t i, DD) override { return dd_.sites[i]; }
  const predicates::FacetFrame<M>& frame(M, int) override { return m_.frame; }
  const predicates::Site<M>& site(std::size_t i, M, int) override { return m_.sites[i]; }
  const predicates::FacetFrame<Exact>* exact_frame() override { return offers_exact_ ? &exact_.frame : nullptr; }
  const predicates::Site<Exact>* exact_site(std::size_t i) override { return &exact_.sites[i]; }

 protected:
  GivenWaves(Point apex, double length, bool offers_exact) : offers_exact_(offers_exact) {
    f_.set_frame(apex, length);
    dd_.set_frame(apex, length);
    m_.set_frame(apex, length);
    exact_.set_frame(apex, length);
  }
  std::uint32_t add_site(const kernel::FacetSite& site, Point image, double weight, const std::optional<std::array<Point, 2>>& cone = {}) {
    sites.push_back(site);
    f_.add(image, weight, cone);
    dd_.add(image, weight, cone);
    m_.add(image, weight, cone);
    exact_.add(image, weight, cone);
    return static_cast<std::uint32_t>(sites.size() - 1);
  }

  template <class NT>
  struct Numbers {
    predicates::FacetFrame<NT> frame;
    std::deque<predicates::Site<NT>> sites;

    static NT number(double x) { return robust::from_double<NT>(x, 256); }
    static predicates::PlanePoint<NT> point(Point p) { return {number(p[0]), number(p[1])}; }
    void set_frame(Point apex, double length) { frame = {point(apex), number(length)}; }
    void add(Point image, double weight, const std::optional<std::array<Point, 2>>& cone) {
      predicates::Site<NT> site;
      site.image = point(image);
      site.weight = number(weight);
      site.has_cone = cone.has_value();
      if (cone) site.cone = {point((*cone)[0]), point((*cone)[1])};
      sites.push_back(site);
    }
  };
  bool offers_exact_;
  Numbers<F> f_;
  Numbers<DD> dd_;
  Numbers<M> m_;
  Numbers<Exact> exact_;
};

}  // namespace gvd::test
