// Points of equal distance in double-double from a double near them, against points known by construction.
#include "gvd/predicates/precise_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "gvd/predicates/filter_error.hpp"
#include "gvd/robust/mpfr_float.hpp"
#include "support/meshes.hpp"

namespace gvd::predicates {
namespace {

using robust::DoubleDouble;
using robust::Mpfr;
using Ball = DoubleDoubleBall;

constexpr int kTruthBits = 400;

Mpfr wide(double x) { return Mpfr(x, kTruthBits); }
Mpfr wide(const DoubleDouble& x) { return wide(x.hi) + wide(x.lo); }
DoubleDouble rounded(const Mpfr& x) {
  const double hi = x.to_double();
  return {hi, (x - wide(hi)).to_double()};
}
bool contains(const Ball& ball, const Mpfr& truth) { return std::fabs((truth - wide(ball.mid())).to_double()) <= ball.rad() * (1 + 0x1p-50); }

struct Point {
  Mpfr x, y;
};
Mpfr distance(const Point& a, const Point& b) {
  const Mpfr x = a.x - b.x, y = a.y - b.y;
  return sqrt(x * x + y * y);
}

/// Makes balls around true numbers, which lie anywhere in them.
class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed) {}
  test::Random& random() { return random_; }
  Mpfr number(double low, double high) { return wide(random_.uniform(low, high)) + wide(random_.uniform(-1, 1) * 0x1p-60); }
  Point point(double low, double high) { return {number(low, high), number(low, high)}; }
  Ball ball(const Mpfr& truth) {
    const double radius = coarse_ ? 0x1p-60 : 0x1p-100 * (1 + std::fabs(truth.to_double()));
    return {rounded(truth + wide(radius * random_.uniform(-0.9, 0.9))), radius};
  }
  PreciseWave wave(const Point& image, const Mpfr& weight) { return {{ball(image.x), ball(image.y)}, ball(weight)}; }
  /// Of the place to start from: a sixteenth of the reach to nearly nothing. Balls of the next case are narrow or not.
  double radius(double reach) {
    coarse_ = random_.below(4) == 0;
    return reach * std::ldexp(1.0, -static_cast<int>(random_.below(6) == 0 ? 100 : 4 + random_.below(45)));
  }
  double beside(const Mpfr& truth, double radius) { return (truth + wide(radius * random_.uniform(-0.6, 0.6))).to_double(); }

 private:
  test::Random random_;
  bool coarse_ = false;
};

constexpr int kCases = 20000;

/// How many results say something, and how many are as sharp as rounding to a double needs.
struct Tally {
  int bounded = 0, sharp = 0, wide_start = 0;
  void add(const Ball& ball, double start) {
    if (!(ball.rad() < 1)) return;
    ++bounded;
    sharp += ball.rad() <= 0x1p-56;
    wide_start += ball.rad() < start * 0x1p-8;
  }
  void expect_useful() const {
    EXPECT_GT(bounded, kCases * 3 / 4);
    EXPECT_GT(sharp, kCases / 4);
    EXPECT_GT(wide_start, kCases / 2);
  }
};

TEST(PrecisePoints, VerticesLieInTheirBalls) {
  Maker make(1);
  Tally tally;
  for (int round = 0; round < kCases; ++round) {
    const Point p = make.point(0, 1);
    const double spread = std::ldexp(1.0, -static_cast<int>(make.random().below(12)));  // directions close to one another, too
    const Point centre = make.point(-2, 2);
    std::array<PreciseWave, 3> waves;
    double reach = 10;
    const Mpfr value = make.number(5, 6);
    for (PreciseWave& wave : waves) {
      const Point image{centre.x + make.number(-spread, spread), centre.y + make.number(-spread, spread)};
      wave = make.wave(image, value - distance(p, image));
      reach = std::min(reach, distance(p, image).to_double());
    }
    const double radius = make.radius(reach);
    const NearPoint start{{make.beside(p.x, radius), make.beside(p.y, radius)}, radius + 0x1p-52};
    const PrecisePoint found = vertex_near(waves[0], waves[1], waves[2], start);
    ASSERT_TRUE(contains(found.x, p.x) && contains(found.y, p.y)) << round;
    tally.add(found.x, start.radius);
  }
  tally.expect_useful();
}

TEST(PrecisePoints, PointsOnRaysLieInTheirBalls) {
  Maker make(2);
  Tally tally;
  for (int round = 0; round < kCases; ++round) {
    const Point parent = make.point(-2, 0), relay = make.point(0, 1), other = make.point(-2, 3);
    const Mpfr length = distance(parent, relay), along = make.number(0, 2);
    const Point p{relay.x + along * (relay.x - parent.x), relay.y + along * (relay.y - parent.y)};
    const Mpfr weight = make.number(1, 2), to_relay = weight + along * length;
    const double reach = std::min(distance(p, other).to_double(), distance(p, relay).to_double()), radius = make.radius(reach);
    const NearPoint start{{make.beside(p.x, radius), make.beside(p.y, radius)}, radius + 0x1p-51};
    const PrecisePoint found = ray_vertex_near(make.wave(parent, weight - length), make.wave(relay, weight),
                                               make.wave(other, to_relay - distance(p, other)), start);
    ASSERT_TRUE(contains(found.x, p.x) && contains(found.y, p.y)) << round;
    tally.add(found.x, start.radius);
  }
  tally.expect_useful();
}

TEST(PrecisePoints, TiesOnSidesLieInTheirBalls) {
  Maker make(3);
  Tally tally;
  for (int round = 0; round < kCases; ++round) {
    const Point apex{make.number(-1, 2), make.number(0.01, 2)};
    const FacetFrame<Ball> frame{{make.ball(apex.x), make.ball(apex.y)}, Ball(1.0)};
    const std::size_t k = make.random().below(3);
    const Point corner[] = {{wide(0), wide(0)}, {wide(1), wide(0)}, apex};
    const Point &a = corner[k], &b = corner[(k + 1) % 3];
    const Mpfr t = make.number(0, 1);
    const Point p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    const Point from = make.point(-2, 2), to = make.point(-2, 2);
    const Mpfr weight = make.number(0, 1);
    const double reach = std::min(distance(p, from).to_double(), distance(p, to).to_double());
    const double radius = make.radius(reach) / distance(a, b).to_double();
    const double start = make.beside(t, radius);
    const Ball found = side_tie_near(side_line(frame, k), make.wave(from, weight),
                                     make.wave(to, weight + distance(p, from) - distance(p, to)), start, radius + 0x1p-52);
    ASSERT_TRUE(contains(found, t)) << round;
    tally.add(found, radius);
  }
  tally.expect_useful();
}

TEST(PrecisePoints, SayNothingWhereTheyCannot) {
  Maker make(4);
  const PreciseWave a = make.wave({wide(-1), wide(0)}, wide(0)), b = make.wave({wide(1), wide(0)}, wide(0));
  EXPECT_FALSE(std::isfinite(vertex_near(a, b, a, {{0, 1}, 0x1p-30}).x.rad())) << "two waves, not three";
  EXPECT_FALSE(std::isfinite(vertex_near(a, b, make.wave({wide(0), wide(1)}, wide(0)), {{0, 1}, 0x1p-30}).x.rad())) << "at an image";
  EXPECT_FALSE(std::isfinite(vertex_near(a, b, make.wave({wide(0), wide(2)}, wide(0)), {{0, 1}, INFINITY}).x.rad()));
  EXPECT_FALSE(std::isfinite(vertex_near(a, b, make.wave({wide(0), wide(2)}, wide(0)), {{NAN, 1}, 0x1p-30}).x.rad()));
  const SideLine<Ball> side{{Ball(0.0), Ball(1.0)}, {Ball(1.0), Ball(0.0)}, Ball(1.0)};
  EXPECT_FALSE(std::isfinite(side_tie_near(side, a, a, 0.5, 0x1p-30).rad())) << "one wave, not two";
}

// The sums of docs/error-bounds.md#points-in-double-double.
TEST(PrecisePoints, LiteralsFollowFromTheirDerivation) {
  const double least_left = 0.75;  // of a distance, without the image's error
  EXPECT_LE(2 / least_left, 4) << "errors of images in a unit vector";
  const double unit_vector = 2 / least_left + 1 + 1, row = 2 * unit_vector + 2;
  EXPECT_LE(2 * row, 32) << "two rows";
  EXPECT_LE(row + 2, 32) << "a ray and a row";
  EXPECT_LE(row + 6, 32) << "the slope along a side";
  EXPECT_LE(1 / (2 * 0.5), 1) << "half the second derivative, times the distance";
  const double most = 0x1p30;
  for (const double k : {2.0, 3.0, 1e3, most}) {
    EXPECT_LE((k + 4) * (1 + 0x1p-20), 8.5 * k);
    EXPECT_LE((1 + 4 * kUnit) / (1 - kUnit * (k + 1)), 1.01);
  }
}

// A point is carried to space and to the frame of a face by its corners.
TEST(PrecisePoints, AreCarriedToSpace) {
  test::Random random(5);
  for (int round = 0; round < 1000; ++round) {
    const auto coordinate = [&] { return Ball(random.uniform(-100, 100)); };
    const auto point = [&] { return robust::BallQuad(coordinate(), coordinate(), coordinate(), Ball()); };
    const std::array<robust::BallQuad, 3> corner{point(), point(), point()};
    // Any apex will do: the corners are where the three points of the frame go.
    const PrecisePoint apex{Ball(random.uniform(-1, 2)), Ball(random.uniform(0.1, 2))};
    const FrameInSpace frame = frame_in_space(corner, apex);
    const PrecisePoint points[] = {{Ball(0.0), Ball(0.0)}, {Ball(1.0), Ball(0.0)}, apex};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = in_space(frame, points[k]);
      for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_TRUE(contains(at.lane(i), wide(corner[k].lane(i).mid())));
        ASSERT_LE(at.lane(i).rad(), 1e-26);
      }
    }
    const double t = random.uniform();
    const auto at = between(corner[0], corner[1], Ball(t));
    for (std::size_t i = 0; i < 3; ++i)
      ASSERT_TRUE(contains(at.lane(i), wide(corner[0].lane(i).mid()) + wide(t) * (wide(corner[1].lane(i).mid()) - wide(corner[0].lane(i).mid()))));
    const PrecisePoint base{Ball(random.uniform(-1, 1)), Ball(random.uniform(-1, 1))}, turn{Ball(random.uniform(-1, 1)), Ball(random.uniform(-1, 1))};
    const PrecisePoint placed = turned_and_moved(base, turn, apex), by_hand{base.x + turn.x * apex.x - turn.y * apex.y, base.y + turn.x * apex.y + turn.y * apex.x};
    ASSERT_TRUE(contains(placed.x, wide(by_hand.x.mid())) || placed.x.mid() == by_hand.x.mid());
    ASSERT_LE((wide(placed.y.mid()) - wide(by_hand.y.mid())).to_double(), 1e-29);
  }
}

/// Waves that tie at (0, 0), from images at that distance in the directions of the axes.
PreciseWave wave_at(double x, double y, double value, double error = 0) {
  const auto ball = [&](double at) { return Ball(DoubleDouble(at), error / 2); };
  return {{ball(x), ball(y)}, Ball(value - std::hypot(x, y))};
}
bool is_known(const PrecisePoint& p) { return p.x.rad() < 1 && p.y.rad() < 1; }

// The bounds hold within a quarter of the reach of each wave: where one of them is too near or known too badly, nothing is said.
TEST(PrecisePoints, EachWaveMustBeFarOff) {
  constexpr double kReach = 4, kLess = 1 - 0x1p-10, kMore = 1 + 0x1p-10;
  for (std::size_t which = 0; which < 3; ++which) {
    SCOPED_TRACE(which);
    const auto near = [&](double reach, double error, double radius) {
      std::array<PreciseWave, 3> waves{wave_at(-kReach, 0, 5), wave_at(0, kReach, 5), wave_at(kReach, 0, 5)};
      const double size = which == 1 ? 0 : which == 0 ? -reach : reach;
      waves[which] = wave_at(size, which == 1 ? reach : 0, 5, error);
      return is_known(vertex_near(waves[0], waves[1], waves[2], {{0, 0}, radius}));
    };
    EXPECT_TRUE(near(4 * 0x1p-10 * kMore, 0, 0x1p-10));
    EXPECT_FALSE(near(4 * 0x1p-10 * kLess, 0, 0x1p-10));
    EXPECT_TRUE(near(0x1p-10, 0x1p-12 * kLess, 0x1p-40));
    EXPECT_FALSE(near(0x1p-10, 0x1p-12 * kMore, 0x1p-40));
  }
  // On a ray: the relay, the other wave, and how well the direction of the ray is known.
  const auto on_ray = [](double relay, double other, double parent_error, double relay_error, double radius) {
    const PreciseWave parent = wave_at(-2 - relay, 0, 5, parent_error);
    return is_known(ray_vertex_near(parent, wave_at(-relay, 0, 5, relay_error), wave_at(other, 0, 5), {{0, 0}, radius}));
  };
  EXPECT_TRUE(on_ray(kReach, kReach, 0, 0, 0x1p-10));
  EXPECT_TRUE(on_ray(4 * 0x1p-10 * kMore, kReach, 0, 0, 0x1p-10));
  EXPECT_FALSE(on_ray(4 * 0x1p-10 * kLess, kReach, 0, 0, 0x1p-10));
  EXPECT_TRUE(on_ray(kReach, 4 * 0x1p-10 * kMore, 0, 0, 0x1p-10));
  EXPECT_FALSE(on_ray(kReach, 4 * 0x1p-10 * kLess, 0, 0, 0x1p-10));
  EXPECT_TRUE(on_ray(0x1p-10, kReach, 0, 0x1p-12 * kLess, 0x1p-40));
  EXPECT_FALSE(on_ray(0x1p-10, kReach, 0, 0x1p-12 * kMore, 0x1p-40));
  EXPECT_TRUE(on_ray(kReach, kReach, 0.5 * kLess, 0, 0x1p-40));
  EXPECT_FALSE(on_ray(kReach, kReach, 0.5 * kMore, 0, 0x1p-40));
  // On a side, from (-1, 0) to (1, 0): radius and start are parameters of it.
  const SideLine<Ball> side{{Ball(-1.0), Ball(0.0)}, {Ball(2.0), Ball(0.0)}, Ball(2.0)};
  const auto on_side = [&](double from, double to, double radius) {
    return side_tie_near(side, wave_at(-from, 0, 5), wave_at(to, 0, 5), 0.5, radius).rad() < 1;
  };
  EXPECT_TRUE(on_side(8 * 0x1p-10 * kMore, kReach, 0x1p-10));
  EXPECT_FALSE(on_side(8 * 0x1p-10 * kLess, kReach, 0x1p-10));
  EXPECT_TRUE(on_side(kReach, 8 * 0x1p-10 * kMore, 0x1p-10));
  EXPECT_FALSE(on_side(kReach, 8 * 0x1p-10 * kLess, 0x1p-10));
}

}  // namespace
}  // namespace gvd::predicates
