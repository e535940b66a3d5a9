#include "gvd/predicates/precise_points.hpp"

#include <algorithm>
#include <limits>

#include "fused_multiply_add.hpp"
#include "gvd/predicates/filter_error.hpp"

namespace gvd::predicates {

using robust::BallQuad;
using robust::DoubleDouble;
using robust::DoubleQuad;

namespace {

using Ball = DoubleDoubleBall;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastTurn = 0x1p-30;  // of the determinant to the squares of its rows: below, the next number type is asked
constexpr double kRoundings = 1 + 0x1p-20, kUnderflown = 0x1p-900;

Ball nothing() { return {DoubleDouble(0.0), kInfinity}; }

double size_of(const PrecisePoint& p) { return std::fabs(p.x.mid().hi) + std::fabs(p.y.mid().hi); }
double error_of(const PrecisePoint& p) { return p.x.rad() + p.y.rad(); }

/// Up to four waves as a point sees them, one a lane.
struct Sights {
  BallQuad value;                 ///< weight + distance to the image
  DoubleQuad unit_x, unit_y;      ///< gradient of the value
  DoubleQuad reach, error;        ///< distance to the image, and how far the two points may be off
  DoubleQuad turn, curvature;     ///< bounds of the gradient's error but for rounding, and of half the second derivative within a quarter of the reach

  double unit_x_from(std::size_t a, std::size_t b) const { return unit_x[b] - unit_x[a]; }
  double unit_y_from(std::size_t a, std::size_t b) const { return unit_y[b] - unit_y[a]; }
  bool are_far(std::size_t count, double radius) const {
    bool far = true;
    for (std::size_t k = 0; k < count; ++k) far = far && 4 * radius < reach[k] && 4 * error[k] < reach[k];
    return far;
  }
};

inline Sights sights(const PreciseWave& a, const PreciseWave& b, const PreciseWave& c, const BallQuad& x, const BallQuad& y) {
  const BallQuad away_x = x - BallQuad(a.image.x, b.image.x, c.image.x, c.image.x), away_y = y - BallQuad(a.image.y, b.image.y, c.image.y, c.image.y);
  const BallQuad reach = sqrt(square(away_x) + square(away_y));
  const DoubleQuad r = reach.mid().hi, error = away_x.rad() + away_y.rad();
  return {BallQuad(a.weight, b.weight, c.weight, c.weight) + reach, away_x.mid().hi / r, away_y.mid().hi / r, r, error,
          robust::quad(4) * error / r, robust::quad(1) / r};
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

inline PrecisePoint vertex_near_here(const PreciseWave& i, const PreciseWave& j, const PreciseWave& k, const NearPoint& start) {
  const Sights seen = sights(j, i, k, BallQuad(Ball(start.at.x)), BallQuad(Ball(start.at.y)));
  if (!seen.are_far(3, start.radius)) return {nothing(), nothing()};
  const BallQuad lead = seen.value - seen.value.lanes<0, 0, 0, 0>();
  const Ball fi = lead.lane(1), fk = lead.lane(2);
  return newton_step({{fi.mid().hi, fk.mid().hi},
                      {DoublePoint{seen.unit_x_from(0, 1), seen.unit_y_from(0, 1)}, DoublePoint{seen.unit_x_from(0, 2), seen.unit_y_from(0, 2)}},
                      rest_of(fi) + rest_of(fk),
                      32 * kUnit + seen.turn[1] + 2 * seen.turn[0] + seen.turn[2],
                      seen.curvature[1] + 2 * seen.curvature[0] + seen.curvature[2]},
                     start);
}

inline PrecisePoint ray_vertex_near_here(const PreciseWave& parent, const PreciseWave& relay, const PreciseWave& other, const NearPoint& start) {
  const Sights seen = sights(relay, other, other, BallQuad(Ball(start.at.x)), BallQuad(Ball(start.at.y)));
  const BallQuad from(relay.image.x, relay.image.y, relay.image.y, relay.image.x);
  const BallQuad ray = from - BallQuad(parent.image.x, parent.image.y, parent.image.y, parent.image.x);  // x, y, y, x
  const double size = std::fabs(ray.mid().hi[0]) + std::fabs(ray.mid().hi[1]), ray_error = ray.rad()[0] + ray.rad()[1];
  if (!seen.are_far(2, start.radius) || !(4 * ray_error < size)) return {nothing(), nothing()};
  const Ball x(start.at.x), y(start.at.y);
  const BallQuad products = ray * (BallQuad(y, x, x, y) - from.lanes<1, 0, 0, 1>());
  const Ball off = products.lane(0) - products.lane(1), lead = seen.value.lane(1) - seen.value.lane(0);
  const double scale = 1 / size;
  return newton_step({{scale * off.mid().hi, lead.mid().hi},
                      {DoublePoint{-scale * ray.mid().hi[1], scale * ray.mid().hi[0]}, DoublePoint{seen.unit_x_from(0, 1), seen.unit_y_from(0, 1)}},
                      scale * (off.rad() + 2 * kUnit * std::fabs(off.mid().hi)) + rest_of(lead),
                      32 * kUnit + seen.turn[0] + seen.turn[1] + 4 * ray_error * scale,
                      seen.curvature[0] + seen.curvature[1]},
                     start);
}

/// x and y of the point in all lanes each.
inline BallQuad at_parameter(const SideLine<Ball>& side, const Ball& t) {
  const auto& [o, d] = std::pair(side.origin, side.direction);
  return BallQuad(o.x, o.y, o.x, o.y) + BallQuad(t) * BallQuad(d.x, d.y, d.x, d.y);
}

inline Ball side_tie_near_here(const SideLine<Ball>& side, const PreciseWave& from, const PreciseWave& to, double start, double radius) {
  const BallQuad p = at_parameter(side, Ball(start));
  const Sights seen = sights(from, to, to, p.lanes<0, 0, 0, 0>(), p.lanes<1, 1, 1, 1>());
  const double length = size_of(side.direction) * kRoundings;
  if (!seen.are_far(2, radius * length)) return nothing();
  const Ball lead = seen.value.lane(1) - seen.value.lane(0);
  const double slope = side.direction.x.mid().hi * seen.unit_x_from(0, 1) + side.direction.y.mid().hi * seen.unit_y_from(0, 1);
  const double step = -lead.mid().hi / slope, inverse = kRoundings / std::fabs(slope);
  const double turn = length * (32 * kUnit + seen.turn[0] + seen.turn[1]) + 2 * error_of(side.direction);
  const double curvature = length * length * (seen.curvature[0] + seen.curvature[1]);
  const double fixed = inverse * (rest_of(lead) + 2 * kUnit * std::fabs(lead.mid().hi));
  const double left = left_by_step(std::fabs(step), fixed, inverse * turn, inverse * curvature, radius);
  return {robust::two_sum(start, step), left};
}

inline PrecisePoint point_of_side_here(const SideLine<Ball>& side, const Ball& t) {
  const BallQuad p = at_parameter(side, t);
  return {p.lane(0), p.lane(1)};
}

inline PreciseWave wave_over_side_here(const Disc<DoubleDouble>& image, unsigned side, const Ball& distance, const EdgeFrame<DoubleDouble>& first) {
  const double u = unit<DoubleDouble>(0);
  return {at_first_side(image, side, enclosed_apex(first, u)), distance / enclosed_length(first, u)};
}

inline FrameInSpace frame_in_space_here(const std::array<BallQuad, 3>& corner, const PrecisePoint& apex) {
  const BallQuad along = corner[1] - corner[0];
  return {corner[0], along, ((corner[2] - corner[0]) - BallQuad(apex.x) * along) / BallQuad(apex.y)};
}

inline BallQuad in_space_here(const FrameInSpace& frame, const PrecisePoint& p) {
  return frame.origin + (BallQuad(p.x) * frame.along + BallQuad(p.y) * frame.across);
}

inline BallQuad between_here(const BallQuad& a, const BallQuad& b, const Ball& t) { return a + BallQuad(t) * (b - a); }

inline PrecisePoint multiple_here(const Ball& factor, const PrecisePoint& p) { return factor * p; }

inline BallQuad multiple_here(const Ball& factor, const PreciseWave& wave) {
  return BallQuad(factor, factor, wave.weight, wave.weight) * BallQuad(wave.image.x, wave.image.y, factor, factor);
}

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

GVD_TWICE(PreciseWave, wave_over_side, (const Disc<DoubleDouble>& image, unsigned side, const Ball& distance, const EdgeFrame<DoubleDouble>& first),
          (image, side, distance, first))
GVD_TWICE(PrecisePoint, vertex_near, (const PreciseWave& i, const PreciseWave& j, const PreciseWave& k, const NearPoint& start), (i, j, k, start))
GVD_TWICE(PrecisePoint, ray_vertex_near, (const PreciseWave& parent, const PreciseWave& relay, const PreciseWave& other, const NearPoint& start),
          (parent, relay, other, start))
GVD_TWICE(Ball, side_tie_near, (const SideLine<Ball>& side, const PreciseWave& from, const PreciseWave& to, double start, double radius),
          (side, from, to, start, radius))
GVD_TWICE(PrecisePoint, point_of_side, (const SideLine<Ball>& side, const Ball& t), (side, t))
GVD_TWICE(FrameInSpace, frame_in_space, (const std::array<BallQuad, 3>& corner, const PrecisePoint& apex), (corner, apex))
GVD_TWICE(BallQuad, in_space, (const FrameInSpace& frame, const PrecisePoint& p), (frame, p))
GVD_TWICE(BallQuad, between, (const BallQuad& a, const BallQuad& b, const Ball& t), (a, b, t))
GVD_TWICE(PrecisePoint, multiple, (const Ball& factor, const PrecisePoint& p), (factor, p))
GVD_TWICE(BallQuad, multiple, (const Ball& factor, const PreciseWave& wave), (factor, wave))
GVD_TWICE(PrecisePoint, turned_and_moved, (const PrecisePoint& base, const PrecisePoint& turn, const PrecisePoint& p), (base, turn, p))

}  // namespace gvd::predicates
