#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "gvd/kernel/facet.hpp"
#include "gvd/robust/rational.hpp"
#include "real.hpp"

/// Waves of one facet in a plane with an irrational axis.
namespace gvd::test {

/// The point (x, y sqrt(c)), c that of its plane.
struct LatticePoint {
  mpq_class x, y;
  friend LatticePoint operator+(const LatticePoint& a, const LatticePoint& b) { return {a.x + b.x, a.y + b.y}; }
  friend LatticePoint operator*(const mpq_class& k, const LatticePoint& a) { return {k * a.x, k * a.y}; }
};

/// A wave with weight given + times sqrt(r), r that of its facet.
struct LatticeWave {
  std::uint8_t side;
  LatticePoint image;
  mpq_class given, times;
  std::optional<std::array<LatticePoint, 2>> cone = std::nullopt;
};

/// A facet with corners (0, 0), (length, 0) and apex, and waves over its sides. No number of it is rounded but by the number types; each of them knows its
/// own errors, as on a mesh.
class LatticeWaves final : public kernel::FacetWaves {
 public:
  using Exact = robust::Exact;

  LatticeWaves(int c, int r, mpq_class length, LatticePoint apex) : c_(c), r_(r), length_(std::move(length)), apex_(std::move(apex)) {
    face = 0;
    corner = {0, 1, 2};
  }

  /// A window, of which the source is another than that of all before it.
  std::uint32_t add(const LatticeWave& wave) {
    const auto i = static_cast<std::uint32_t>(sites.size());
    kernel::FacetSite site;
    site.window = i;
    site.side = wave.side;
    site.root = site.labels = 10 + i;
    if (wave.cone) site.cone = {100 + 2 * i, 101 + 2 * i};
    sites.push_back(site);
    waves_.push_back(wave);
    return i;
  }
  /// A relay at the vertex that bounds the cone of `parent` there: its wave touches the parent's along that ray.
  std::uint32_t add_relay(std::uint32_t parent, std::size_t end, const LatticeWave& wave) {
    const std::uint32_t i = add(wave);
    sites[i].root = sites[parent].cone[end];
    sites[parent].attains_cone[end] = true;
    return i;
  }
  /// Finds out which waves attain the corners. To be called when all are there. An image turned by 2^-300 may be farther by 2^-600 only: that is seen.
  void finish() {
    for (std::size_t k = 0; k < 3; ++k) {
      const LatticePoint at = k == 0 ? LatticePoint{0, 0} : k == 1 ? LatticePoint{length_, 0} : apex_;
      std::vector<std::optional<Long>> d;
      std::optional<Long> least;
      for (const LatticeWave& wave : waves_) {
        d.push_back(sees(wave, at) ? std::optional(distance(wave, at)) : std::nullopt);
        if (d.back() && (!least || *d.back() < *least)) least = d.back();
      }
      for (std::size_t i = 0; i < waves_.size(); ++i) sites[i].attains_corner[k] = d[i] && *d[i] - *least <= ldexp(*least, -1000);
    }
  }

  static constexpr std::array<std::uint8_t, 3> kMirroredCorner{1, 0, 2}, kMirroredSide{0, 2, 1};
  /// In a mirror that exchanges corners 0 and 1, the waves in the opposite order.
  LatticeWaves mirrored() const {
    const auto image = [&](const LatticePoint& p) { return LatticePoint{length_ - p.x, p.y}; };
    LatticeWaves result(c_, r_, length_, image(apex_));
    result.offers_exact = offers_exact;
    for (std::size_t i = waves_.size(); i-- > 0;) {
      LatticeWave wave = waves_[i];
      wave.side = kMirroredSide[wave.side];
      wave.image = image(wave.image);
      if (wave.cone) wave.cone = {image((*wave.cone)[1]), image((*wave.cone)[0])};
      kernel::FacetSite site = sites[i];
      site.side = wave.side;
      std::swap(site.cone[0], site.cone[1]);
      std::swap(site.attains_cone[0], site.attains_cone[1]);
      std::swap(site.attains_corner[0], site.attains_corner[1]);
      result.waves_.push_back(wave);
      result.sites.push_back(site);
    }
    return result;
  }

  const std::vector<LatticeWave>& waves() const { return waves_; }
  std::array<Real, 2> flat(const LatticePoint& p) const { return {real(p.x), real(p.y) * sqrt(Real(c_))}; }
  /// 420 decimal digits.
  using Long = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<420>, boost::multiprecision::et_off>;
  /// Cones aside.
  Long distance(const LatticeWave& wave, const LatticePoint& p) const {
    const auto number = [](const mpq_class& q) { return Long(q.get_mpq_t()); };
    const mpq_class dx = wave.image.x - p.x, dy = wave.image.y - p.y;
    return number(wave.given) + number(wave.times) * sqrt(Long(r_)) + sqrt(number(dx * dx + c_ * dy * dy));
  }
  bool sees(const LatticeWave& wave, const LatticePoint& p) const {
    const auto turn = [&](const LatticePoint& ray) -> mpq_class {
      return (ray.x - wave.image.x) * (p.y - wave.image.y) - (ray.y - wave.image.y) * (p.x - wave.image.x);
    };
    return !wave.cone || (turn((*wave.cone)[0]) <= 0 && turn((*wave.cone)[1]) >= 0);
  }

  const predicates::FacetFrame<F>& frame(F) override { return numbers(f_, 0).frame; }
  const predicates::Site<F>& site(std::size_t i, F) override { return numbers(f_, 0).sites[i]; }
  const predicates::FacetFrame<DD>& frame(DD) override { return numbers(dd_, 0).frame; }
  const predicates::Site<DD>& site(std::size_t i, DD) override { return numbers(dd_, 0).sites[i]; }
  const predicates::FacetFrame<M>& frame(M, int bits) override { return numbers(m_, bits).frame; }
  const predicates::Site<M>& site(std::size_t i, M, int bits) override { return numbers(m_, bits).sites[i]; }
  const predicates::FacetFrame<Exact>* exact_frame() override { return offers_exact ? &numbers(exact_, 0).frame : nullptr; }
  const predicates::Site<Exact>* exact_site(std::size_t i) override { return &numbers(exact_, 0).sites[i]; }

  bool is_own_relay(std::size_t parent, std::size_t relay) override {
    const auto& cone = sites[parent].cone;
    return sites[relay].root == cone[0] || sites[relay].root == cone[1];
  }

  bool offers_exact = true;

  template <class NT>
  struct Numbers {
    int bits = -1;
    predicates::FacetFrame<NT> frame;
    std::deque<predicates::Site<NT>> sites;
  };
  /// In any number type; `from` makes a number of a rational.
  template <class NT, class From>
  Numbers<NT> numbers_from(const From& from) const {
    Numbers<NT> known;
    const NT axis = sqrt(from(c_)), root = sqrt(from(r_));
    const auto number = [&](const mpq_class& q) { return from(q / length_); };
    const auto point = [&](const LatticePoint& p) { return predicates::PlanePoint<NT>{number(p.x), number(p.y) * axis}; };
    known.frame = {point(apex_), from(length_)};
    for (const LatticeWave& wave : waves_) {
      predicates::Site<NT> site;
      site.image = point(wave.image);
      site.weight = number(wave.given) + number(wave.times) * root;
      site.has_cone = wave.cone.has_value();
      if (wave.cone) site.cone = {point((*wave.cone)[0]), point((*wave.cone)[1])};
      known.sites.push_back(site);
    }
    return known;
  }

 private:
  template <class NT>
  const Numbers<NT>& numbers(Numbers<NT>& known, int bits) const {
    if (known.bits == bits) return known;
    known = numbers_from<NT>([&](const mpq_class& q) { return robust::from<NT>(q, bits); });
    known.bits = bits;
    return known;
  }

  int c_, r_;
  mpq_class length_;
  LatticePoint apex_;
  std::vector<LatticeWave> waves_;
  Numbers<F> f_;
  Numbers<DD> dd_;
  Numbers<M> m_;
  Numbers<Exact> exact_;
};

}  // namespace gvd::test
