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

std::pmr::vector<predicates::DoubleWave> waves_of(const Contenders& contenders, FacetLadder& ladder) {
  std::pmr::vector<predicates::DoubleWave> waves(ladder.room());
  waves.reserve(contenders.size());
  for (std::size_t i = 0; i < contenders.size(); ++i) waves.push_back(ladder.doubles()[contenders[i].site]);
  return waves;
}

}  // namespace

FacetFilter::FacetFilter(const Contenders& contenders, FacetLadder& ladder)
    : contenders_(contenders), numbers_(ladder.filter()), room_(ladder.room()), waves_(waves_of(contenders, ladder)), row_(waves_, room_), corner_(room_), cones_(contenders.size(), room_) {
  for (std::size_t k = 0; k < 3; ++k) {
    Side& side = sides_[k];
    side.origin = middle(numbers_.side[k].origin);
    side.direction = middle(numbers_.side[k].direction);
    side.length = std::sqrt(dot(side.direction, side.direction));
    side.error = (radius(numbers_.side[k].origin) + radius(numbers_.side[k].direction) + 4 * kUnit * (one_norm(side.origin) + one_norm(side.direction))) * (1 + 0x1p-48);
  }
  corner_.reserve(3);
  for (const Side& side : sides_) corner_.push_back(reading(side.origin));
  for (std::size_t i = 0; i < contenders.size(); ++i)
    if (has_cone(i)) cones_.set(i, {make_ray(contenders[i], 0), make_ray(contenders[i], 1)}, contenders[i].attains_corner);
  cones_.look_at({{{sides_[0].origin, sides_[0].error}, {sides_[1].origin, sides_[1].error}, {sides_[2].origin, sides_[2].error}}});
}

predicates::DoubleLine FacetFilter::make_ray(const Contender& wave, std::size_t end) const {
  const auto& site = *numbers_.sites[wave.cone_site[end]];
  predicates::DoubleLine ray;
  ray.from = middle(site.image);
  ray.from_error = radius(site.image);
  ray.along = minus(middle(site.cone[end]), ray.from);
  ray.along_error = (ray.from_error + radius(site.cone[end])) * (1 + 0x1p-48);
  if (end == 0) ray.along = {-ray.along.x, -ray.along.y};
  return ray;
}

Bounded FacetFilter::lead(std::size_t k, std::uint32_t a, std::uint32_t b, double t) const {
  const DoublePoint p = sides_[k].at(t);
  const auto &wa = waves_[a], &wb = waves_[b];
  Bounded lead = predicates::difference(wa, distance(wa, p), wb, distance(wb, p));
  lead.error += 2 * sides_[k].error;
  return lead;
}

Bounded FacetFilter::lead_at_corner(std::size_t c, std::uint32_t a, std::uint32_t b) const {
  Bounded lead = predicates::difference(waves_[a], corner_[c].at(a), waves_[b], corner_[c].at(b));
  lead.error += 2 * sides_[c].error;
  return lead;
}

Bounded FacetFilter::slope_at_corner(std::size_t k, std::size_t c, std::uint32_t a, std::uint32_t b) const {
  const auto &wa = waves_[a], &wb = waves_[b];
  const DoublePoint& corner = sides_[c].origin;
  const auto reach = [&](const predicates::DoubleWave& wave) { return distance({wave.image, 0, 0}, corner); };
  const auto rise = [&](const predicates::DoubleWave& wave) { return dot(sides_[k].direction, minus(corner, wave.image)) / reach(wave); };
  const double slope = rise(wb) - rise(wa);
  // The unit vectors are off by twice the error over the reach, and by roundings.
  const double turn = 4 * ((wa.error + sides_[c].error) / reach(wa) + (wb.error + sides_[c].error) / reach(wb)) + 32 * kUnit;
  return {slope, turn * (sides_[k].length + sides_[k].error) + 4 * sides_[k].error};
}

Bounded FacetFilter::cone_side(std::size_t k, std::uint32_t i, std::size_t end, double t) const {
  const Bounded from = cones_.at_corner(i, end, k), to = cones_.at_corner(i, end, (k + 1) % 3);
  const double error = std::max(from.error, to.error) + 4 * kUnit * (std::fabs(from.value) + std::fabs(to.value));
  return {from.value + t * (to.value - from.value), error * (1 + 0x1p-48)};
}

Bounded FacetFilter::cone_side(std::uint32_t i, std::size_t end, const Point& p, double error) const {
  return predicates::side_of(cones_.ray(i, end), p, error);
}

}  // namespace gvd::kernel
