#include "gvd/predicates/bisector_vertex.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "gvd/predicates/side_tie.hpp"
#include "support/meshes.hpp"

namespace gvd::predicates {
namespace {

using B = robust::Ball<double>;
struct Wave {
  double x, y, weight;
};

RelativeWave<B> relative(const Wave& pivot, const Wave& w) {
  const bool same = pivot.weight == w.weight;
  return {{B(w.x) - B(pivot.x), B(w.y) - B(pivot.y)}, same ? B(0.0) : B(w.weight) - B(pivot.weight), same};
}
double distance(const Wave& w, double x, double y) { return w.weight + std::hypot(x - w.x, y - w.y); }
Wave random_wave(test::Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.below(3) == 0 ? 0.5 : random.uniform(0, 1)};
}

TEST(BisectorVertex, TiesTheThreeAndHasThemCounterClockwise) {
  test::Random random(1);
  int found = 0, both = 0;
  for (int round = 0; round < 3000; ++round) {
    const Wave a = random_wave(random), b = random_wave(random), c = random_wave(random);
    int orders = 0;
    for (const bool turned : {false, true}) {
      const Wave &i = turned ? c : a, &k = turned ? a : c;
      const auto vertex = bisector_vertex(relative(b, i), relative(b, k));
      if (vertex.existence != Existence::proved) continue;
      ++orders;
      const double x = b.x + vertex.p.x.mid(), y = b.y + vertex.p.y.mid();
      const double slack = 1e-9 * (1 + std::hypot(x, y)), value = distance(b, x, y);
      EXPECT_NEAR(distance(a, x, y), value, slack);
      EXPECT_NEAR(distance(c, x, y), value, slack);
      EXPECT_NEAR(b.weight + vertex.rho.mid(), value, slack);
      const auto unit = [&](const Wave& w) {
        const double r = std::hypot(w.x - x, w.y - y);
        return PlanePoint<double>{(w.x - x) / r, (w.y - y) / r};
      };
      const auto ui = unit(i), uj = unit(b), uk = unit(k);
      const double turn = (uj.x - ui.x) * (uk.y - ui.y) - (uj.y - ui.y) * (uk.x - ui.x);
      EXPECT_TRUE(turn > 0 || std::hypot(x, y) > 20) << "round " << round;  // far away the three directions are nearly one
      // the same point from another pivot
      const auto again = bisector_vertex(relative(i, k), relative(i, b));
      ASSERT_EQ(again.existence, Existence::proved);
      EXPECT_NEAR(i.x + again.p.x.mid(), x, 1e-6 * (1 + std::hypot(x, y)));
    }
    found += orders > 0;
    both += orders == 2;
  }
  EXPECT_GT(found, 500);
  EXPECT_GT(both, 20);
}

// Its image is near the vertex, but it starts after the time of the vertex by more than that: on the other sheet of its cone, which the lifted form does not tell.
TEST(BisectorVertex, AWaveThatStartsTooLateDoesNotConflict) {
  test::Random random(3);
  int late = 0;
  std::map<robust::Sign, int> said;
  for (int round = 0; round < 3000; ++round) {
    const Wave a = random_wave(random), b = random_wave(random), c = random_wave(random);
    Wave rival = random_wave(random);
    rival.weight *= 3;
    const auto vertex = bisector_vertex(relative(b, a), relative(b, c));
    if (vertex.existence != Existence::proved) continue;
    const double x = b.x + vertex.p.x.mid(), y = b.y + vertex.p.y.mid(), value = b.weight + vertex.rho.mid();
    const auto sign = conflict(relative(b, rival), vertex);
    const double lead = value - distance(rival, x, y);
    if (!sign || std::fabs(lead) < 1e-6 * (1 + value)) continue;
    EXPECT_EQ(*sign, lead > 0 ? robust::Sign::positive : robust::Sign::negative) << round;
    ++said[*sign];
    late += rival.weight - value > std::hypot(rival.x - x, rival.y - y);
  }
  EXPECT_GT(late, 20);
  EXPECT_GT(said[robust::Sign::positive], 100);
  EXPECT_GT(said[robust::Sign::negative], 100);
}

TEST(SideTie, OvertakingIsWhereTheDifferenceFalls) {
  test::Random random(2);
  const SideLine<B> side{{B(0.25), B(-0.5)}, {B(1.0), B(0.5)}, B(1.25)};
  int found = 0;
  for (int round = 0; round < 3000; ++round) {
    const Wave a = random_wave(random), b = random_wave(random);
    const Site<B> from{{B(a.x), B(a.y)}, B(a.weight), {}, false}, to{{B(b.x), B(b.y)}, B(b.weight), {}, false};
    const auto tie = overtaking(side, from, to, a.weight == b.weight);
    const auto g = [&](double t) { return distance(b, 0.25 + t, -0.5 + 0.5 * t) - distance(a, 0.25 + t, -0.5 + 0.5 * t); };
    if (tie.existence == Existence::impossible) {  // then the difference never goes from positive to negative
      bool positive = false, falls = false;
      for (int n = -400; n <= 400; ++n) {
        falls = falls || (positive && g(n * 0.01) < -1e-12);
        positive = positive || g(n * 0.01) > 1e-12;
      }
      EXPECT_FALSE(falls) << "round " << round;
    }
    if (tie.existence != Existence::proved || std::fabs(tie.t.mid()) > 10) continue;
    ++found;
    EXPECT_NEAR(g(tie.t.mid()), 0, 1e-9);
    EXPECT_GT(g(tie.t.mid() - 1e-4), g(tie.t.mid() + 1e-4));
  }
  EXPECT_GT(found, 500);
}

}  // namespace
}  // namespace gvd::predicates
