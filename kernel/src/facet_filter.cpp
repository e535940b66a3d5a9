#include "facet_filter.hpp"

#include <algorithm>
#include <cmath>

namespace gvd::kernel {
namespace {

using predicates::Bounded;
using predicates::DoublePoint;
using predicates::kUnit;

DoublePoint middle(const predicates::PlanePoint<FacetWaves::F>& p) { return {p.x.mid(), p.y.mid()}; }
double radius(const predicates::PlanePoint<FacetWaves::F>& p) { return (p.x.rad() + p.y.rad()) * (1 + 0x1p-48); }
double one_norm(const DoublePoint& p) { return std::fabs(p.x) + std::fabs(p.y); }
DoublePoint minus(const DoublePoint& a, const DoublePoint& b) { return {a.x - b.x, a.y - b.y}; }
double dot(const DoublePoint& a, const DoublePoint& b) { return a.x * b.x + a.y * b.y; }

/// Takes off what lies where a linear function is negative, whose values at 0 and 1 are given; `low` and `high` round its root.
template <class Low, class High>
void cut(FacetFilter::Stretch& stretch, double at_0, double at_1, Low low, High high) {
  if (at_0 < 0 && at_1 < 0)
    stretch = {2, -1};
  else if (at_0 < 0)
    stretch.low = std::max(stretch.low, low(at_0, at_1));
  else if (at_1 < 0)
    stretch.high = std::min(stretch.high, high(at_0, at_1));
}

}  // namespace

FacetFilter::FacetFilter(const Contenders& contenders, FacetLadder& ladder) : waves_(ladder.room()) {
  const auto& numbers = ladder.filter();
  for (std::size_t k = 0; k < 3; ++k) {
    Side& side = sides_[k];
    side.origin = middle(numbers.side[k].origin);
    side.direction = middle(numbers.side[k].direction);
    side.length = std::sqrt(dot(side.direction, side.direction));
    side.error = (radius(numbers.side[k].origin) + radius(numbers.side[k].direction) + 4 * kUnit * (one_norm(side.origin) + one_norm(side.direction))) * (1 + 0x1p-48);
  }
  waves_.resize(contenders.size());
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    Wave& wave = waves_[i];
    wave.wave = ladder.doubles()[contenders[i].site];
    for (std::size_t c = 0; c < 3; ++c) {
      const DoublePoint away = minus(sides_[c].origin, wave.wave.image);
      const double r = wave.reach[c] = std::sqrt(dot(away, away));
      wave.at_corner[c] = wave.wave.weight + r;
    }
    wave.has_cone = contenders[i].has_cone;
    for (std::size_t end = 0; wave.has_cone && end < 2; ++end) {
      wave.ray[end] = make_ray(numbers, contenders[i], end);
      cut_stretches(wave.ray[end], contenders[i], wave);
    }
  }
}

/// The side of a boundary ray is linear along a side of the facet, so its bounds at the corners bound it in between. A wave sees the corners that it
/// attains.
void FacetFilter::cut_stretches(const Ray& ray, const Contender& contender, Wave& wave) {
  std::array<double, 3> most, least;
  for (std::size_t k = 0; k < 3; ++k) {
    const Bounded& at = ray.at_corner[k];
    const double error = at.error + 0x1p-50 * (std::fabs(at.value) + at.error);
    most[k] = at.value + error;
    least[k] = contender.attains_corner[k] ? std::max(0.0, at.value - error) : at.value - error;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    cut(wave.stretch[k], most[k], most[next], predicates::below_zero_of, predicates::above_zero_of);
    cut(wave.seen[k], least[k], least[next], predicates::above_zero_of, predicates::below_zero_of);
  }
}

FacetFilter::Ray FacetFilter::make_ray(const FacetNumbers<FacetWaves::F>& numbers, const Contender& wave, std::size_t end) const {
  const auto& site = *numbers.sites[wave.cone_site[end]];
  Ray ray;
  ray.from = middle(site.image);
  ray.from_error = radius(site.image);
  ray.along = minus(middle(site.cone[end]), ray.from);
  ray.along_error = (ray.from_error + radius(site.cone[end])) * (1 + 0x1p-48);
  if (end == 0) ray.along = {-ray.along.x, -ray.along.y};
  for (std::size_t c = 0; c < 3; ++c) ray.at_corner[c] = predicates::side_of(ray, sides_[c].origin, sides_[c].error);
  return ray;
}

Bounded FacetFilter::lead(std::size_t k, std::uint32_t a, std::uint32_t b, double t) const {
  const DoublePoint p = sides_[k].at(t);
  const auto &wa = waves_[a].wave, &wb = waves_[b].wave;
  Bounded lead = predicates::difference(wa, distance(wa, p), wb, distance(wb, p));
  lead.error += 2 * sides_[k].error;
  return lead;
}

Bounded FacetFilter::lead_at_corner(std::size_t c, std::uint32_t a, std::uint32_t b) const {
  Bounded lead = predicates::difference(waves_[a].wave, waves_[a].at_corner[c], waves_[b].wave, waves_[b].at_corner[c]);
  lead.error += 2 * sides_[c].error;
  return lead;
}

Bounded FacetFilter::slope_at_corner(std::size_t k, std::size_t c, std::uint32_t a, std::uint32_t b) const {
  const Wave &wa = waves_[a], &wb = waves_[b];
  const auto rise = [&](const Wave& wave) { return dot(sides_[k].direction, minus(sides_[c].origin, wave.wave.image)) / wave.reach[c]; };
  const double slope = rise(wb) - rise(wa);
  // The unit vectors are off by twice the error over the reach, and by roundings.
  const double turn =
      4 * ((wa.wave.error + sides_[c].error) / wa.reach[c] + (wb.wave.error + sides_[c].error) / wb.reach[c]) + 32 * kUnit;
  return {slope, turn * (sides_[k].length + sides_[k].error) + 4 * sides_[k].error};
}

Bounded FacetFilter::cone_side(std::size_t k, std::uint32_t i, std::size_t end, double t) const {
  const auto& corner = waves_[i].ray[end].at_corner;
  const Bounded &from = corner[k], &to = corner[(k + 1) % 3];
  const double error = std::max(from.error, to.error) + 4 * kUnit * (std::fabs(from.value) + std::fabs(to.value));
  return {from.value + t * (to.value - from.value), error * (1 + 0x1p-48)};
}

Bounded FacetFilter::cone_side(std::uint32_t i, std::size_t end, const Point& p, double error) const {
  return predicates::side_of(waves_[i].ray[end], p, error);
}

}  // namespace gvd::kernel
