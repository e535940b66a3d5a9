// Worst cases of the distance field and of queries: folded rectangles with vertices in line with the sources, points as far from two of them by construction,
// and nearest neighbours of both.
#include "gvd/kernel/solver.hpp"
#include "support/folded_grid.hpp"
#include "support/truth.hpp"
#include "support/worst_case_tally.hpp"

namespace gvd::kernel {
namespace {

using predicates::Predicate;
using robust::Sign;
using robust::Stage;
using namespace gvd::test;

/// Two sources on one column, mirrored in the height `middle`: what lies there is as far from both. `off`: the upper one is that much too high.
struct MirroredSources {
  std::uint32_t column;
  mpq_class low, high, off;
  mpq_class middle() const { return (low + high) / 2; }
};

MirroredSources mirrored_sources(const FoldedGrid& grid, Random& random) {
  MirroredSources s{random.below(grid.columns() + 1), 0, 0, 0};
  const std::uint32_t low = random.below(grid.rows);
  s.low = low;
  s.high = low + 1 + random.below(grid.rows - low);
  if (random.below(2) == 0) s.low += mpq_class(1, 4), s.high -= mpq_class(1, 4);
  return s;
}

SurfacePoint on_column(const FoldedGrid& grid, const Mesh& mesh, std::uint32_t column, const mpq_class& y) {
  const auto row = static_cast<std::uint32_t>(std::min(std::floor(y.get_d()), grid.rows - 1.0));
  return point_on_edge(mesh, grid.vertex(column, row), grid.vertex(column, row + 1), y - row);
}

/// A point of some face at the given height.
SurfacePoint at_height(const FoldedGrid& grid, const Mesh& mesh, const mpq_class& y, Random& random) {
  const auto row = static_cast<std::uint32_t>(std::min(std::floor(y.get_d()), grid.rows - 1.0));
  const FaceId face = 2 * (row * grid.columns() + random.below(grid.columns())) + random.below(2);
  const mpq_class above = y - row, part(1 + static_cast<int>(random.below(7)), 8);
  const auto is_high = [&](std::size_t k) { return mesh.point(mesh.origin(static_cast<HalfedgeId>(3 * face + k)))[1] > row; };
  const std::size_t high = static_cast<std::size_t>(is_high(0)) + is_high(1) + is_high(2);
  std::array<mpq_class, 3> weight;
  bool first = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool is_pair = is_high(k) == (high == 2);
    weight[k] = is_high(k) ? above : mpq_class(1 - above);
    if (!is_pair) continue;
    weight[k] *= first ? part : mpq_class(1 - part);
    first = false;
  }
  return point_in_face(mesh, face, weight);
}

struct Truth {
  double distance;
  std::vector<SourceId> nearest;
};
Truth truth(const std::array<std::array<Real, 2>, 2>& source, const std::array<Real, 2>& p) {
  std::array<Real, 2> d;
  for (std::size_t s = 0; s < 2; ++s) d[s] = sqrt((p[0] - source[s][0]) * (p[0] - source[s][0]) + (p[1] - source[s][1]) * (p[1] - source[s][1]));
  const Sign sign = sign_of(d[0] - d[1], d[0] + d[1]);
  const Real& least = sign == Sign::positive ? d[1] : d[0];
  std::vector<SourceId> nearest;
  if (sign != Sign::positive) nearest.push_back(0);
  if (sign != Sign::negative) nearest.push_back(1);
  return {mpfr_get_d(least.backend().data(), MPFR_RNDN), nearest};
}

class FieldZeros : public testing::Test {
 protected:
  void ask(const FoldedGrid& grid, const MirroredSources& where, bool is_tie) {
    const Mesh mesh(grid.arrays);
    const std::vector<Source> sources{{on_column(grid, mesh, where.column, where.low), 0}, {on_column(grid, mesh, where.column, where.high + where.off), 0}};
    const std::array<std::array<Real, 2>, 2> flat{grid.place(mesh, sources[0].at), grid.place(mesh, sources[1].at)};
    const Solution solution = solve(mesh, sources, distances_only());
    ASSERT_TRUE(is_certified(solution));
    (is_tie ? zeros : neighbours).merge(solution.decisions());
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      const Truth expected = truth(flat, grid.flat[v]);
      const auto nearest = solution.nearest(v);
      ASSERT_EQ(solution.distance(v), expected.distance) << v;
      ASSERT_EQ(std::vector<SourceId>(nearest.begin(), nearest.end()), expected.nearest) << v;
    }
    for (int i = 0; i < kPoints; ++i) {
      const SurfacePoint at = at_height(grid, mesh, where.middle(), random);
      const Truth expected = truth(flat, grid.place(mesh, at));
      if (is_tie) {
        ASSERT_EQ(expected.nearest.size(), 2u);
      }
      const PointAnswer answer = solution.query(at);
      ASSERT_FALSE(answer.undecided);
      ASSERT_EQ(answer.distance, expected.distance);
      ASSERT_EQ(answer.nearest, expected.nearest);
      ++(is_tie ? points.zeros : points.neighbours)[answer.stage];
    }
  }
  static constexpr int kPoints = 20;
  Random random{900};
  predicates::Decisions zeros, neighbours;
  Tally points;
};

TEST_F(FieldZeros, AndTheirNeighbours) {
  for (int round = 0; round < 400; ++round) {
    const FoldedGrid grid = folded_grid(random);
    MirroredSources where = mirrored_sources(grid, random);
    if (where.high <= where.low) continue;
    ask(grid, where, true);
    // No smaller: an edge from a vertex to a source beside it must not be shorter than 2^-200 of the longest.
    mpq_class step = small_step(random);
    while (step < mpq_class(1, mpz_class(1) << 150)) step = small_step(random);
    if (random.below(2) == 0)
      where.low += step;  // and what is in line with the lower one
    else
      where.off = -step;
    ask(grid, where, false);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
  points.record();
  const auto count = [](const predicates::Decisions& decisions, Predicate p, Stage s) { return decisions(static_cast<std::size_t>(p), s); };
  EXPECT_GE(count(zeros, Predicate::window_orientation, Stage::algebra), 5000u);
  EXPECT_GE(count(zeros, Predicate::saddle, Stage::algebra), 4000u);
  EXPECT_GE(count(zeros, Predicate::vertex_distance, Stage::algebra), 1500u);
  for (const Predicate p : {Predicate::window_orientation, Predicate::vertex_distance})
    for (const Stage s : {Stage::filter, Stage::double_double, Stage::algebra}) EXPECT_GT(count(neighbours, p, s), 0u);
  EXPECT_GE(points.zeros[Stage::algebra], 5000);
  EXPECT_GT(points.neighbours[Stage::double_double], 0);
}

}  // namespace
}  // namespace gvd::kernel
