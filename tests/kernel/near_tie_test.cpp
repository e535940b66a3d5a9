// Distances that differ from one another, or from a midpoint, by less than double-double sees, over more square classes than algebra multiplies out: MPFR decides.
#include <gtest/gtest.h>

#include "support/bump.hpp"
#include "support/mirrored_terrain.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using predicates::Predicate;
using robust::Stage;

using test::kWidth;
using test::mirrored_terrain;

/// Which source is nearest at each vertex of the mirror line, and how many decisions MPFR made: one source in the first square, the other its mirror image, but
/// `step` nearer to the mirror line.
struct Answer {
  std::vector<std::vector<SourceId>> nearest;
  std::uint64_t by_mpfr;
};
Answer ask(const Mesh& mesh, const mpq_class& step) {
  const auto solution = solve(mesh, test::mirrored_sources(mesh, step), test::distances_only());
  Answer answer{{}, solution.decisions()(static_cast<std::size_t>(Predicate::vertex_distance), Stage::mpfr)};
  for (VertexId v = kWidth / 2; v < mesh.vertex_count(); v += kWidth + 1) {
    const auto told = solution.nearest(v);
    answer.nearest.emplace_back(told.begin(), told.end());
  }
  return answer;
}

TEST(NearTies, MpfrTellsSourcesApart) {
  const Mesh mesh(mirrored_terrain());
  const Answer coarse = ask(mesh, mpq_class(1, 1 << 20)), coarse_back = ask(mesh, mpq_class(-1, 1 << 20));
  EXPECT_EQ(coarse.by_mpfr, 0u);
  std::uint64_t by_mpfr = 0;
  for (const unsigned bits : {150u, 250u, 400u}) {
    const mpq_class step(1, mpz_class(1) << bits);
    const Answer fine = ask(mesh, step), back = ask(mesh, -step);
    EXPECT_EQ(fine.nearest, coarse.nearest) << bits;
    EXPECT_EQ(back.nearest, coarse_back.nearest) << bits;
    by_mpfr += fine.by_mpfr + back.by_mpfr;
  }
  EXPECT_NE(coarse.nearest, coarse_back.nearest);
  EXPECT_GT(by_mpfr, 0u);
}

/// The distance of the far end of the terrain from a source that moves along a side of its face.
double distance_from(const Mesh& mesh, const mpq_class& t, std::uint64_t& by_mpfr) {
  const auto solution = solve(mesh, {{point_in_face(mesh, 0, {mpq_class(1, 2) - t, mpq_class(1, 4) + t, mpq_class(1, 4)}), 0}}, test::distances_only());
  EXPECT_TRUE(test::is_certified(solution));
  by_mpfr += solution.decisions()(static_cast<std::size_t>(Predicate::rounding), Stage::mpfr);
  return solution.distance(kWidth + kWidth);
}

// Between two places with neighbouring doubles for distances there is one where the distance lies halfway. It is approached until only MPFR tells on which side the
// source is: the answer must stay one of the two doubles.
TEST(NearTies, MpfrRoundsNearMidpoints) {
  const Mesh mesh(mirrored_terrain());
  std::uint64_t by_mpfr = 0;
  mpq_class low = 0, high = 0;
  const double first = distance_from(mesh, low, by_mpfr);
  double second = first;
  while (second == first) {
    low = high;
    high += mpq_class(1, mpz_class(1) << 52);
    second = distance_from(mesh, high, by_mpfr);
  }
  ASSERT_TRUE(second == std::nextafter(first, 0) || second == std::nextafter(first, HUGE_VAL));
  for (int step = 0; step < 130; ++step) {
    const mpq_class middle = (low + high) / 2;
    const double d = distance_from(mesh, middle, by_mpfr);
    ASSERT_TRUE(d == first || d == second) << step;
    (d == first ? low : high) = middle;
  }
  // Around that place the answers are those of either side, at every distance from it.
  for (unsigned bits = 60; bits < 140; ++bits) {
    const mpq_class step(1, mpz_class(1) << bits);
    EXPECT_EQ(distance_from(mesh, low - step, by_mpfr), first) << bits;
    EXPECT_EQ(distance_from(mesh, high + step, by_mpfr), second) << bits;
  }
  EXPECT_GT(by_mpfr, 40u);
}

// Two sources tie at a point by their symmetry on one edge, which algebra proves; two others tie there, too, over too many square classes. Which pair is the nearer one is a matter of
// 2^-150 and less.
TEST(NearTies, MpfrTellsPairsApart) {
  const Mesh mesh(mirrored_terrain());
  const auto far = test::mirrored_sources(mesh, 0);
  const VertexId low = kWidth / 2 + 2 * (kWidth + 1), high = low + kWidth + 1;
  const SurfacePoint middle = point_on_edge(mesh, low, high, mpq_class(1, 2));
  const double weight = solve(mesh, far, test::distances_only()).query(middle).distance - 0.25;
  const auto ask = [&](const mpq_class& t) {
    std::vector<Source> sources = far;
    for (const mpq_class& at : {mpq_class(mpq_class(1, 2) - t), mpq_class(mpq_class(1, 2) + t)}) sources.push_back({point_on_edge(mesh, low, high, at), weight});
    return solve(mesh, sources, test::distances_only()).query(middle);
  };
  // The last ones are the nearer ones where t is small.
  mpq_class near = 0, away(1, 2);
  ASSERT_EQ(ask(near + mpq_class(1, 1000)).nearest, (std::vector<SourceId>{2, 3}));
  for (int step = 0; step < 180; ++step) {
    const mpq_class t = (near + away) / 2;
    const PointAnswer answer = ask(t);
    const bool is_near = answer.nearest == std::vector<SourceId>{2, 3};
    ASSERT_TRUE(is_near || answer.nearest == (std::vector<SourceId>{0, 1})) << step;
    EXPECT_TRUE(!is_near || !answer.undecided) << step;
    (is_near ? near : away) = t;
  }
}

TEST(NearTies, MpfrTellsWhetherACornerIsHidden) {
  const test::Bump bump;
  const Mesh mesh(bump.arrays);
  for (const unsigned bits : {20u, 60u, 150u, 400u}) {
    for (const bool hidden : {true, false}) {
      const auto solution = solve(mesh, {{hidden ? bump.below(mesh, bits) : bump.above(mesh, bits), 0}}, test::distances_only());
      ASSERT_TRUE(test::is_certified(solution));
      const auto path = solution.path(point_at_vertex(mesh, bump.kLast)).path;
      EXPECT_EQ(std::any_of(path.begin(), path.end(), [&](const PathPoint& p) { return p.vertex == bump.kBump; }), hidden) << bits;
      EXPECT_EQ(solution.decisions()(static_cast<std::size_t>(Predicate::window_orientation), Stage::mpfr) > 0, bits > 100) << bits;
    }
  }
}

}  // namespace
}  // namespace gvd::kernel
