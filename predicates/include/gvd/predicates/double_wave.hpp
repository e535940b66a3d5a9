#pragma once

#include <cmath>

#include "gvd/predicates/filter_error.hpp"
#include "gvd/predicates/site.hpp"

/// Waves of a facet in plain doubles: each is the exact wave that its doubles say, and a bound tells how far the true one is from it at any point.
/// Derivations: docs/error-bounds.md#waves-in-doubles.
namespace gvd::predicates {

using DoublePoint = PlanePoint<double>;

/// A number and how far it may be from the truth.
struct Bounded {
  double value = 0, error = 0;
  bool positive() const noexcept { return value > error; }
  bool negative() const noexcept { return value < -error; }
};

struct DoubleWave {
  DoublePoint image{0, 0};
  double weight = 0;
  double error = 0;  ///< at least |true image - image| + |true weight - weight|
};

inline DoubleWave double_wave(const Site<robust::Ball<double>>& site) {
  const double weight = site.weight.mid();
  const double below_zero = 2 * kDoubleWaveError * std::fmax(0.0, -weight);  // no weight is, but who knows who made the site
  return {{site.image.x.mid(), site.image.y.mid()},
          weight,
          (site.image.x.rad() + site.image.y.rad() + site.weight.rad() + below_zero) * (1 + 0x1p-48)};
}

/// weight + |p - image|, rounded.
inline double distance(const DoubleWave& wave, const DoublePoint& p) noexcept {
  const double dx = p.x - wave.image.x, dy = p.y - wave.image.y;
  return wave.weight + std::sqrt(dx * dx + dy * dy);
}

/// Bound of the distance to the true wave's value, for a computed value.
inline double distance_error(const DoubleWave& wave, double computed) noexcept { return wave.error + kDoubleWaveError * computed + 0x1p-500; }

/// b(p) - a(p) for two computed values of one and the same point, against the truth.
inline Bounded difference(const DoubleWave& a, double at_a, const DoubleWave& b, double at_b) noexcept {
  return {at_b - at_a, (a.error + b.error + kDoubleWaveError * (at_a + at_b)) * (1 + 0x1p-48) + 0x1p-499};
}

/// By how much wave a comes after b to the image of b, where b has just its weight.
inline Bounded lag_at_image(const DoubleWave& a, const DoubleWave& b) noexcept {
  const double at_b = distance(a, b.image);
  return {at_b - b.weight, (a.error + b.error + kDoubleWaveError * (at_b + std::fabs(b.weight))) * (1 + 0x1p-48) + 0x1p-499};
}

/// Whether the images are certainly not as far apart as the weights: then the two never come along one line.
inline bool certainly_unrelated(const DoubleWave& a, const DoubleWave& b) noexcept {
  const double dx = a.image.x - b.image.x, dy = a.image.y - b.image.y, later = a.weight - b.weight;
  const double sum = std::fabs(dx) + std::fabs(dy) + std::fabs(later);  // at least that of the two distances
  const double error = (a.error + b.error + kDoubleWaveError * sum) * sum * (1 + 0x1p-48) + 0x1p-998;
  return std::fabs(dx * dx + dy * dy - later * later) > error;
}

/// Whether a is nearer than b everywhere, by the triangle inequality: it is at the image of b.
inline bool certainly_nearer(const DoubleWave& a, const DoubleWave& b) noexcept { return lag_at_image(a, b).negative(); }

/// The cross product of two differences of points that are known up to `error_a` and `error_b`.
inline Bounded bounded_cross(const DoublePoint& a, double error_a, const DoublePoint& b, double error_b) noexcept {
  const double size_a = std::fabs(a.x) + std::fabs(a.y), size_b = std::fabs(b.x) + std::fabs(b.y);
  const double error = kOrientationError * size_a * size_b + size_a * error_b + size_b * error_a + error_a * error_b;
  return {a.x * b.y - a.y * b.x, error * (1 + 0x1p-48) + 0x1p-500};
}

}  // namespace gvd::predicates
