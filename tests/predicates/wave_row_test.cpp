// Waves and their cones side by side, against long numbers (docs/error-bounds.md#rows-of-waves).
#include <gtest/gtest.h>

#include "gvd/predicates/cone_row.hpp"
#include "support/true_wave.hpp"

namespace {

using gvd::predicates::ConeRow;
using gvd::predicates::DoubleLine;
using gvd::predicates::DoublePoint;
using gvd::predicates::DoubleWave;
using gvd::predicates::WaveRow;
using gvd::test::distance;
using gvd::test::Long;
using gvd::test::LongPoint;
using gvd::test::nearest;
using gvd::test::TrueWave;
using gvd::test::wide;
using gvd::predicates::operator-;

constexpr double kUnit = gvd::predicates::kUnit;
std::pmr::memory_resource* room() { return std::pmr::new_delete_resource(); }

class Family : public gvd::test::Shares {
 public:
  using Shares::Shares;
  double size() { return std::ldexp(1.0, static_cast<int>(bits() % 12) - 6); }
  std::size_t count() { return 1 + bits() % 9; }
  DoubleWave wave() {
    const double far = size();
    return {{far * share(), far * share()}, far * std::fabs(share()), std::ldexp(std::fabs(share()), -20 - static_cast<int>(bits() % 40))};
  }
  TrueWave member(const DoubleWave& wave) {
    const double turn = 3.2 * share(), part = 0.5 * wave.error * std::fabs(share()), rest = wave.error - part;
    return {{wide(wave.image.x) + wide(part * std::cos(turn)), wide(wave.image.y) + wide(part * std::sin(turn))}, wide(wave.weight) + wide(rest * share())};
  }
};

/// The literals against their derivations, to all orders.
TEST(WaveRow, LiteralsFollowFromTheirDerivations) {
  const Long one = wide(1), d = one + wide(kUnit);
  const Long reach = sqrt(d * d * d * d) * d;  // of its true value
  const Long of_distance = reach * d - one;
  // What is subtracted, two roundings short, and the last sum: all within 8 units of the distance.
  EXPECT_LT(nearest(of_distance) + kUnit + 2 * kUnit * gvd::predicates::kDoubleWaveError, gvd::predicates::kDoubleWaveError);
  // A component: difference, over the reach, the reciprocal and the product; then the step, the product, and the sums.
  const Long component = d * reach * d * d, rise = component * d * d * d * d;
  EXPECT_LE(nearest(rise - one), gvd::predicates::kRiseError * (1 - 0x1p-5));
}

TEST(WaveRow, DistancesAreWithinTheirBounds) {
  Family family(1);
  for (int round = 0; round < 3000; ++round) {
    std::vector<DoubleWave> waves(family.count());
    for (DoubleWave& wave : waves) wave = family.wave();
    const WaveRow row(waves, room());
    WaveRow::Reading reading(row, room());
    DoublePoint p = family.point();
    if (round % 8 == 0) p = waves[0].image;
    if (round % 8 == 1) p = {waves[0].image.x + std::ldexp(1.0, -40 * (round % 27)), waves[0].image.y};
    const DoublePoint way = family.point();
    row.read(p, reading);
    for (std::size_t i = 0; i < waves.size(); ++i) {
      EXPECT_EQ(reading.at(i), gvd::predicates::distance(waves[i], p));
      const Long truth = distance(family.member(waves[i]), wide(p));
      ASSERT_GE(nearest(truth - wide(reading.low(i))), 0) << "round " << round;
      ASSERT_GE(nearest(wide(reading.high(i)) - truth), 0) << "round " << round;
      // The tangent is nowhere above the wave of the doubles, but for its rounding.
      const LongPoint q{wide(p.x) + wide(way.x), wide(p.y) + wide(way.y)};
      const auto gradient = reading.gradient(i);
      const double rise = way.x * gradient.x + way.y * gradient.y, error = gvd::predicates::kRiseError * std::hypot(way.x, way.y);
      const TrueWave wave{wide(waves[i].image), wide(waves[i].weight)};
      ASSERT_GE(nearest(distance(wave, q) - (wide(reading.low(i)) + wide(rise) - wide(error))), 0) << "round " << round;
    }
  }
}

struct Ends {
  DoublePoint from, way;
  DoublePoint at(double t) const { return {from.x + t * way.x, from.y + t * way.y}; }
};
/// Marks of waves against wave 0 along a stretch.
std::vector<bool> marks_above(const std::vector<DoubleWave>& waves, const Ends& ends) {
  const WaveRow row(waves, room());
  WaveRow::Reading first(row, room()), last(row, room());
  WaveRow::Marks marks(row, room());
  row.read(ends.from, first);
  row.read(ends.at(1), last);
  const double error = (gvd::predicates::kRiseError + 8 * kUnit) * (2 + std::hypot(ends.way.x, ends.way.y));  // the ends, too, are rounded here
  row.mark_above({first, last, ends.way, first.high(0) + error, last.high(0) + error}, marks);
  std::vector<bool> result;
  for (std::size_t i = 0; i < waves.size(); ++i) result.push_back(marks[i]);
  return result;
}

TEST(WaveRow, WhatIsAboveIsFartherAllAlong) {
  Family family(2);
  int marked = 0, asked = 0;
  for (int round = 0; round < 1500; ++round) {
    std::vector<DoubleWave> waves(2 + family.count());
    for (DoubleWave& wave : waves) wave = family.wave();
    const Ends ends{family.point(), family.point()};
    const auto above = marks_above(waves, ends);
    const TrueWave guard = family.member(waves[0]);
    EXPECT_FALSE(above[0]);
    for (std::size_t i = 1; i < waves.size(); ++i, ++asked) {
      if (!above[i]) continue;
      ++marked;
      const TrueWave other = family.member(waves[i]);
      for (const double t : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0})
        ASSERT_GT(nearest(distance(other, wide(ends.at(t))) - distance(guard, wide(ends.at(t)))), 0) << "round " << round;
    }
  }
  EXPECT_GT(marked, asked / 4);
}

TEST(WaveRow, WhatTiesSomewhereIsNeverAbove) {
  Family family(3);
  for (int round = 0; round < 20000; ++round) {
    std::vector<DoubleWave> waves{family.wave(), family.wave()};
    const Ends ends{family.point(), family.point()};
    const DoublePoint tie = ends.at(round % 4 == 0 ? 0 : round % 4 == 1 ? 1 : 0.5 + 0.5 * family.share());
    waves[0].weight += 300;
    waves[1].weight = gvd::predicates::distance(waves[0], tie) - gvd::predicates::distance({waves[1].image, 0, 0}, tie);
    EXPECT_FALSE(marks_above(waves, ends)[1]) << "round " << round;
  }
}

struct Cone {
  std::array<DoubleLine, 2> rays;
  /// The sides of members of the rays at a point of the side from p to q.
  std::array<double, 2> sides(Family& family, const DoublePoint& p, const DoublePoint& q, double t) const {
    const LongPoint from_p = wide(p), step = wide(q) - from_p, at{from_p.x + wide(t) * step.x, from_p.y + wide(t) * step.y};
    std::array<double, 2> result{};
    for (std::size_t end = 0; end < 2; ++end) {
      const DoubleLine& ray = rays[end];
      const auto moved = [&](const DoublePoint& x, double error) {
        const double part = error * family.share();
        return LongPoint{wide(x.x) + wide(0.7 * part), wide(x.y) + wide(0.7 * part)};
      };
      result[end] = nearest(cross(moved(ray.along, ray.along_error), at - moved(ray.from, ray.from_error)));
    }
    return result;
  }
};

TEST(ConeRow, WhatIsSeenOfTheSidesIsSeen) {
  Family family(4);
  int inside = 0, outside = 0, certain = 0;
  for (int round = 0; round < 1500; ++round) {
    const std::array<ConeRow::Corner, 3> corners{{{family.point(), 0}, {family.point(), 0}, {family.point(), 0}}};
    std::vector<Cone> cones(family.count());
    ConeRow row(cones.size() + 1, room());
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const double error = std::ldexp(1.0, -10 - round % 40), far = family.size();
      const DoublePoint image{far * family.share(), far * family.share()}, a = family.point(), b = family.point();
      cones[i].rays = {DoubleLine{image, {image.x - a.x, image.y - a.y}, error, error}, DoubleLine{image, {b.x - image.x, b.y - image.y}, error, error}};
      row.set(i, cones[i].rays, {false, false, false});
    }
    row.look_at(corners);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(row.seen(cones.size(), k).contains(0, 1) && row.stretch(cones.size(), k).contains(0, 1));
    for (std::size_t i = 0; i < cones.size(); ++i) {
      for (std::size_t end = 0; end < 2; ++end) {
        const auto ray = row.ray(i, end);
        EXPECT_TRUE(ray.from.x == cones[i].rays[end].from.x && ray.along.y == cones[i].rays[end].along.y && ray.along_error == cones[i].rays[end].along_error);
        for (std::size_t c = 0; c < 3; ++c) {
          const auto expected = gvd::predicates::side_of(ray, corners[c].at, corners[c].error), found = row.at_corner(i, end, c);
          EXPECT_TRUE(found.value == expected.value && found.error == expected.error);
        }
      }
      for (std::size_t k = 0; k < 3; ++k)
        for (const double t : {0.0, 0.2, 0.5, 0.8, 1.0, row.seen(i, k).low, row.stretch(i, k).high}) {
          if (!(0 <= t && t <= 1)) continue;
          const auto sides = cones[i].sides(family, corners[k].at, corners[(k + 1) % 3].at, t);
          const bool sees = sides[0] > 0 && sides[1] > 0, misses = sides[0] < 0 || sides[1] < 0;
          inside += sees, outside += misses, certain += row.seen(i, k).contains(t, t) || row.stretch(i, k).misses(t, t);
          ASSERT_FALSE(sees && row.stretch(i, k).misses(t, t)) << "round " << round;
          ASSERT_FALSE(misses && row.seen(i, k).contains(t, t)) << "round " << round;
        }
    }
  }
  EXPECT_GT(inside, 3000);
  EXPECT_GT(certain, (inside + outside) * 7 / 10);
}

/// A wave that attains a corner sees it, though doubles cannot tell.
TEST(ConeRow, ACornerThatIsAttainedIsSeen) {
  const std::array<ConeRow::Corner, 3> corners{{{{0, 0}, 0x1p-40}, {{1, 0}, 0x1p-40}, {{0, 1}, 0x1p-40}}};
  ConeRow row(2, room());
  const DoubleLine through_corner{{0, -1}, {1, 1}, 0x1p-40, 0x1p-40};
  row.set(0, {through_corner, through_corner}, {false, true, false});
  row.set(1, {through_corner, through_corner}, {false, false, false});
  row.look_at(corners);
  EXPECT_EQ(row.seen(0, 1).low, 0);
  EXPECT_GT(row.seen(1, 1).low, 0);
  EXPECT_EQ(row.stretch(0, 1).low, 0);
}

}  // namespace
