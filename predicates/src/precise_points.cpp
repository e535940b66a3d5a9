#include "gvd/predicates/precise_points.hpp"

#include <algorithm>
#include <limits>

#include "fused_multiply_add.hpp"
#include "gvd/predicates/filter_error.hpp"

namespace gvd::predicates {

using robust::DoubleDouble;

namespace {

using Ball = DoubleDoubleBall;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastTurn = 0x1p-30;  // of the determinant to the squares of its rows: below, the next number type is asked
constexpr double kRoundings = 1 + 0x1p-20, kUnderflown = 0x1p-900;

Ball nothing() { return {DoubleDouble(0.0), kInfinity}; }

double size_of(const PrecisePoint& p) { return std::fabs(p.x.mid().hi) + std::fabs(p.y.mid().hi); }
double error_of(const PrecisePoint& p) { return p.x.rad() + p.y.rad(); }

/// A wave as a point sees it.
struct Sight {
  Ball value;           ///< weight + distance to the image
  DoublePoint unit;     ///< gradient of the value
  double reach, error;  ///< distance to the image, and how far the two points may be off
  /// Bounds of the gradient's error but for rounding, and of half the second derivative within a quarter of the reach.
  double turn() const { return 4 * error / reach; }
  double curvature() const { return 1 / reach; }
};

inline Sight sight(const PreciseWave& wave, const PrecisePoint& p) {
  const PrecisePoint away = p - wave.image;
  const Ball reach = sqrt(squared_norm(away));
  const double r = reach.mid().hi;
  return {wave.weight + reach, {away.x.mid().hi / r, away.y.mid().hi / r}, r, error_of(away)};
}

/// A residual as a double: what it is off by.
inline double rest_of(const Ball& residual) { return residual.rad() + kUnit * std::fabs(residual.mid().hi); }

/// How far a step of Newton's iteration may be from the way to the zero: `fixed` and what grows with the way, a first bound of which is `way`.
inline double left_by_step(double step, double fixed, double turn, double curvature, double way) {
  double left = kInfinity;
  for (int round = 0; round < 2; ++round) {
    left = (fixed + way * (turn + way * curvature)) * kRoundings + kUnderflown;
    way = std::min(way, (step + left) * kRoundings);
  }
  return left;
}

/// Two equations: residuals f, rows of the derivative, and their errors.
struct Equations {
  std::array<double, 2> f;
  std::array<DoublePoint, 2> row;
  double f_error, turn_error, curvature;
};

inline PrecisePoint newton_step(const Equations& eq, const NearPoint& start) {
  const auto& [a, b] = eq.row;
  const double det = a.x * b.y - a.y * b.x, square = a.x * a.x + a.y * a.y + b.x * b.x + b.y * b.y;
  if (!(std::fabs(det) > kLeastTurn * square)) return {nothing(), nothing()};
  const DoublePoint step{(eq.f[1] * a.y - eq.f[0] * b.y) / det, (eq.f[0] * b.x - eq.f[1] * a.x) / det};
  const double inverse = 1.01 * std::sqrt(square) / std::fabs(det), condition = square / std::fabs(det);
  const double rounding = 8.5 * kUnit * condition * (std::fabs(eq.f[0]) + std::fabs(eq.f[1]));
  const double left = left_by_step(std::fabs(step.x) + std::fabs(step.y), inverse * (eq.f_error + rounding), inverse * eq.turn_error,
                                   inverse * eq.curvature, start.radius);
  return {Ball(robust::two_sum(start.at.x, step.x), left), Ball(robust::two_sum(start.at.y, step.y), left)};
}

inline bool is_far(const Sight& sight, double radius) { return 4 * radius < sight.reach && 4 * sight.error < sight.reach; }

inline PrecisePoint vertex_near_here(const PreciseWave& i, const PreciseWave& j, const PreciseWave& k, const NearPoint& start) {
  const PrecisePoint p{Ball(start.at.x), Ball(start.at.y)};
  const Sight si = sight(i, p), sj = sight(j, p), sk = sight(k, p);
  if (!is_far(si, start.radius) || !is_far(sj, start.radius) || !is_far(sk, start.radius)) return {nothing(), nothing()};
  const Ball fi = si.value - sj.value, fk = sk.value - sj.value;
  return newton_step({{fi.mid().hi, fk.mid().hi},
                      {DoublePoint{si.unit.x - sj.unit.x, si.unit.y - sj.unit.y}, DoublePoint{sk.unit.x - sj.unit.x, sk.unit.y - sj.unit.y}},
                      rest_of(fi) + rest_of(fk),
                      32 * kUnit + si.turn() + 2 * sj.turn() + sk.turn(),
                      si.curvature() + 2 * sj.curvature() + sk.curvature()},
                     start);
}

inline PrecisePoint ray_vertex_near_here(const PreciseWave& parent, const PreciseWave& relay, const PreciseWave& other, const NearPoint& start) {
  const PrecisePoint p{Ball(start.at.x), Ball(start.at.y)};
  const Sight to_relay = sight(relay, p), to_other = sight(other, p);
  const PrecisePoint ray = relay.image - parent.image;
  const double size = size_of(ray), ray_error = error_of(ray);
  if (!is_far(to_relay, start.radius) || !is_far(to_other, start.radius) || !(4 * ray_error < size)) return {nothing(), nothing()};
  const Ball off = cross(ray, p - relay.image), lead = to_other.value - to_relay.value;
  const double scale = 1 / size;
  return newton_step({{scale * off.mid().hi, lead.mid().hi},
                      {DoublePoint{-scale * ray.y.mid().hi, scale * ray.x.mid().hi},
                       DoublePoint{to_other.unit.x - to_relay.unit.x, to_other.unit.y - to_relay.unit.y}},
                      scale * (off.rad() + 2 * kUnit * std::fabs(off.mid().hi)) + rest_of(lead),
                      32 * kUnit + to_relay.turn() + to_other.turn() + 4 * ray_error * scale,
                      to_relay.curvature() + to_other.curvature()},
                     start);
}

inline Ball side_tie_near_here(const SideLine<Ball>& side, const PreciseWave& from, const PreciseWave& to, double start, double radius) {
  const PrecisePoint p = point_at(side, Ball(start));
  const Sight of_from = sight(from, p), of_to = sight(to, p);
  const double length = size_of(side.direction) * kRoundings;
  if (!is_far(of_from, radius * length) || !is_far(of_to, radius * length)) return nothing();
  const Ball lead = of_to.value - of_from.value;
  const double slope = side.direction.x.mid().hi * (of_to.unit.x - of_from.unit.x) + side.direction.y.mid().hi * (of_to.unit.y - of_from.unit.y);
  const double step = -lead.mid().hi / slope, inverse = kRoundings / std::fabs(slope);
  const double turn = length * (32 * kUnit + of_from.turn() + of_to.turn()) + 2 * error_of(side.direction);
  const double curvature = length * length * (of_from.curvature() + of_to.curvature());
  const double fixed = inverse * (rest_of(lead) + 2 * kUnit * std::fabs(lead.mid().hi));
  const double left = left_by_step(std::fabs(step), fixed, inverse * turn, inverse * curvature, radius);
  return {robust::two_sum(start, step), left};
}

inline PreciseWave wave_over_side_here(const Disc<DoubleDouble>& image, unsigned side, const Ball& distance, const EdgeFrame<DoubleDouble>& first) {
  const double u = unit<DoubleDouble>(0);
  return {at_first_side(image, side, enclosed_apex(first, u)), distance / enclosed_length(first, u)};
}

inline FrameInSpace frame_in_space_here(const std::array<std::array<Ball, 3>, 3>& corner, const PrecisePoint& apex) {
  FrameInSpace frame;
  for (std::size_t i = 0; i < 3; ++i) {
    frame.origin[i] = corner[0][i];
    frame.along[i] = corner[1][i] - corner[0][i];
    frame.across[i] = ((corner[2][i] - corner[0][i]) - apex.x * frame.along[i]) / apex.y;
  }
  return frame;
}

inline std::array<Ball, 3> in_space_here(const FrameInSpace& frame, const PrecisePoint& p) {
  std::array<Ball, 3> at;
  for (std::size_t i = 0; i < 3; ++i) at[i] = frame.origin[i] + (p.x * frame.along[i] + p.y * frame.across[i]);
  return at;
}

inline std::array<Ball, 3> between_here(const std::array<Ball, 3>& a, const std::array<Ball, 3>& b, const Ball& t) {
  std::array<Ball, 3> at;
  for (std::size_t i = 0; i < 3; ++i) at[i] = a[i] + t * (b[i] - a[i]);
  return at;
}

inline PrecisePoint multiple_here(const Ball& factor, const PrecisePoint& p) { return factor * p; }

inline PrecisePoint turned_and_moved_here(const PrecisePoint& base, const PrecisePoint& turn, const PrecisePoint& p) {
  return {base.x + (p.x * turn.x - p.y * turn.y), base.y + (p.x * turn.y + p.y * turn.x)};
}

}  // namespace

PreciseWave wave_of_corner(unsigned corner, const Ball& distance, const EdgeFrame<DoubleDouble>& first) {
  const double u = unit<DoubleDouble>(0);
  return {corner_point<Ball>({enclosed_apex(first, u), {}}, corner), distance / enclosed_length(first, u)};
}

// Each function twice: `name_here` compiled for any processor, and for one with fused multiply-add.
#ifdef GVD_CHOOSES_FMA
#define GVD_TWICE(Result, name, Parameters, arguments)                                \
  namespace {                                                                         \
  GVD_FMA Result name##_by_fma Parameters { return name##_here arguments; }           \
  }                                                                                   \
  Result name Parameters { return has_fma() ? name##_by_fma arguments : name##_here arguments; }
#else
#define GVD_TWICE(Result, name, Parameters, arguments) \
  Result name Parameters { return name##_here arguments; }
#endif

using Space = std::array<Ball, 3>;
GVD_TWICE(PreciseWave, wave_over_side, (const Disc<DoubleDouble>& image, unsigned side, const Ball& distance, const EdgeFrame<DoubleDouble>& first),
          (image, side, distance, first))
GVD_TWICE(PrecisePoint, vertex_near, (const PreciseWave& i, const PreciseWave& j, const PreciseWave& k, const NearPoint& start), (i, j, k, start))
GVD_TWICE(PrecisePoint, ray_vertex_near, (const PreciseWave& parent, const PreciseWave& relay, const PreciseWave& other, const NearPoint& start),
          (parent, relay, other, start))
GVD_TWICE(Ball, side_tie_near, (const SideLine<Ball>& side, const PreciseWave& from, const PreciseWave& to, double start, double radius),
          (side, from, to, start, radius))
GVD_TWICE(FrameInSpace, frame_in_space, (const std::array<Space, 3>& corner, const PrecisePoint& apex), (corner, apex))
GVD_TWICE(Space, in_space, (const FrameInSpace& frame, const PrecisePoint& p), (frame, p))
GVD_TWICE(Space, between, (const Space& a, const Space& b, const Ball& t), (a, b, t))
GVD_TWICE(PrecisePoint, multiple, (const Ball& factor, const PrecisePoint& p), (factor, p))
GVD_TWICE(PrecisePoint, turned_and_moved, (const PrecisePoint& base, const PrecisePoint& turn, const PrecisePoint& p), (base, turn, p))

}  // namespace gvd::predicates
