// Worst cases of the distance field and of queries: folded rectangles with vertices in line with the sources, points as far from two of them, distances halfway
// between two doubles and flat vertices by construction, and nearest neighbours of all.
#include "gvd/kernel/solver.hpp"
#include "gvd/kernel/vertex_kind.hpp"
#include "support/closing_fans.hpp"
#include "support/folded_grid.hpp"
#include "support/truth.hpp"
#include "support/zero_cases.hpp"

namespace gvd::kernel {
namespace {

using predicates::Predicate;
using robust::Sign;
using robust::Stage;
using namespace gvd::test;

struct GridSource {
  std::uint32_t column;
  mpq_class height;
  double weight = 0;
};

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

/// No smaller: an edge from a vertex to a source beside it must not be shorter than 2^-200 of the longest.
mpq_class step_on_column(Random& random) {
  for (;;)
    if (const mpq_class step = small_step(random); step > mpq_class(1, mpz_class(1) << 150)) return step;
}

class FieldZeros : public testing::TestWithParam<ZeroShare> {
 protected:
  struct Truth {
    double distance;
    std::vector<SourceId> nearest;
  };
  /// The distances of all vertices, and of `points` more at a height, are those in the plane, in whichever order the sources are given.
  void ask(const FoldedGrid& grid, std::vector<GridSource> where, bool is_zero, int points = 0, const mpq_class& height = 0);
  void vertices_in_line(int points);
  void rows_between_sources();
  void midpoints();
  void flat_vertices();

  Random random{GetParam().seed()};
  ZeroCounts counts;
};

void FieldZeros::ask(const FoldedGrid& grid, std::vector<GridSource> where, bool is_zero, int points, const mpq_class& height) {
  if (random.below(2) == 0) std::reverse(where.begin(), where.end());
  const Mesh mesh(grid.arrays);
  std::vector<Source> sources;
  std::vector<std::array<Real, 2>> flat;
  for (const GridSource& s : where) {
    sources.push_back({on_column(grid, mesh, s.column, s.height), s.weight});
    flat.push_back(grid.place(mesh, sources.back().at));
  }
  const auto truth = [&](const std::array<Real, 2>& p) {
    std::vector<Real> d;
    for (std::size_t s = 0; s < flat.size(); ++s)
      d.push_back(sqrt((p[0] - flat[s][0]) * (p[0] - flat[s][0]) + (p[1] - flat[s][1]) * (p[1] - flat[s][1])) + Real(where[s].weight));
    const Real least = *std::min_element(d.begin(), d.end());
    Truth result{mpfr_get_d(least.backend().data(), MPFR_RNDN), {}};
    for (SourceId s = 0; s < d.size(); ++s)
      if (sign_of(d[s] - least, Real(grid.rows)) == Sign::zero) result.nearest.push_back(s);
    return result;
  };
  const Solution solution = solve(mesh, sources, distances_only());
  ASSERT_TRUE(is_certified(solution));
  predicates::Decisions& tally = is_zero ? counts.zeros : counts.neighbours;
  tally.merge(solution.decisions());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const Truth expected = truth(grid.flat[v]);
    const auto nearest = solution.nearest(v);
    ASSERT_EQ(solution.distance(v), expected.distance) << v;
    ASSERT_EQ(std::vector<SourceId>(nearest.begin(), nearest.end()), expected.nearest) << v;
  }
  for (int i = 0; i < points; ++i) {
    const SurfacePoint at = at_height(grid, mesh, height, random);
    const Truth expected = truth(grid.place(mesh, at));
    ASSERT_EQ(expected.nearest.size() > 1, is_zero);
    const PointAnswer answer = solution.query(at);
    ASSERT_FALSE(answer.undecided);
    ASSERT_EQ(answer.distance, expected.distance);
    ASSERT_EQ(answer.nearest, expected.nearest);
    predicates::count(tally, Predicate::point_distance, answer.stage);
  }
}

/// Two sources on one column: vertices in line with them abound, and what lies at the height between them is as far from both. Then one of them a step off.
void FieldZeros::vertices_in_line(int points) {
  const FoldedGrid grid = folded_grid(3 + random.below(2), random);
  const std::uint32_t column = random.below(grid.columns() + 1), low = random.below(grid.rows);
  const mpq_class inwards = random.below(2) == 0 ? mpq_class(1, 4) : mpq_class(0);
  std::vector<GridSource> sources{{column, low + inwards}, {column, low + 1 + random.below(grid.rows - low) - inwards}};
  const mpq_class middle = (sources[0].height + sources[1].height) / 2;
  ask(grid, sources, true, points, middle);
  if (random.below(2) == 0)
    sources[0].height += step_on_column(random);
  else
    sources[1].height -= step_on_column(random);
  if (!HasFatalFailure()) ask(grid, sources, false, points, middle);
}

/// Sources on every other row of a column: all vertices of the rows between them are as far from two. Then every other source a step off, or later by one.
void FieldZeros::rows_between_sources() {
  const FoldedGrid grid = folded_grid(9 + random.below(4), random);
  std::vector<GridSource> sources;
  const std::uint32_t column = random.below(grid.columns() + 1);
  for (std::uint32_t row = 0; row <= grid.rows; row += 2) sources.push_back({column, row});
  ask(grid, sources, true);
  for (std::size_t i = 1; i < sources.size(); i += 2) {
    const mpq_class step = step_on_column(random);
    if (random.below(2) == 0)
      sources[i].height -= step;
    else
      sources[i].weight = step.get_d();
  }
  if (!HasFatalFailure()) ask(grid, sources, false);
}

/// Sources of one weight at the feet of all columns, each the nearest to its own one, where distances are whole. The weight has 53 bits and the last one set;
/// where the sum has a bit more before the point, it lies halfway between two doubles. Then the sources a step up their columns, or the weight an ulp off.
void FieldZeros::midpoints() {
  const FoldedGrid grid = folded_grid(40, random);
  const int bits = 6 + static_cast<int>(random.below(7));
  const double least = std::ldexp(1.0, bits) - 1 - random.below(8), ulp = std::ldexp(1.0, bits - 53);
  double weight = least + ulp * static_cast<double>(random.next() % (std::uint64_t{1} << (53 - bits)) | 1);
  std::vector<GridSource> sources;
  for (std::uint32_t column = 0; column <= grid.columns(); ++column) sources.push_back({column, 0, weight});
  ask(grid, sources, true);
  const bool later = random.below(4) == 0;
  if (later) weight = ulp_neighbour(weight, random);
  for (GridSource& s : sources) {
    s.weight = weight;
    if (!later) s.height += step_on_column(random);
  }
  if (!HasFatalFailure()) ask(grid, sources, false);
}

/// A vertex whose angles add up to 2 pi, or to pi at the border, in a plane or along a fold. Then a spoke an ulp off, or by what doubles see.
void FieldZeros::flat_vertices() {
  constexpr std::array kFans{grid_fan, coplanar_fan, pythagorean_fan, folded_fan<false>, folded_fan<true>};
  const auto has_area = [](const std::array<Spoke, 2>& corner) {
    const auto& [d, e] = corner;
    return d[0] * e[1] != d[1] * e[0] || d[1] * e[2] != d[2] * e[1] || d[2] * e[0] != d[0] * e[2];
  };
  ClosingFan fan;
  do fan = kFans[random.below(5)](random);
  while (!std::all_of(fan.corners.begin(), fan.corners.end(), has_area));
  MeshArrays arrays;
  const Point centre{double(random.below(64)) - 32, double(random.below(64)) - 32, double(random.below(64)) - 32};
  arrays.points.push_back(centre);
  const auto add = [&](const Spoke& s) { arrays.points.push_back({centre[0] + s[0], centre[1] + s[1], centre[2] + s[2]}); };
  for (const auto& corner : fan.corners) add(corner[0]);
  const bool closed = fan.quarter_turns == 4;
  if (!closed) add(fan.corners.back()[1]);
  const auto n = static_cast<std::uint32_t>(arrays.points.size() - 1);
  for (std::uint32_t i = 1; i <= fan.corners.size(); ++i) arrays.faces.push_back({0, i, i % n + 1});
  for (const bool is_zero : {true, false}) {
    if (!is_zero) {
      Point& p = arrays.points[1 + random.below(n)];
      if (random.below(4) > 0)
        nudge(p, random);
      else
        p[random.below(3)] += 0x1p-10;
    }
    Real sum = -acos(Real(0)) * fan.quarter_turns;
    for (const auto& face : arrays.faces) {
      std::array<Real, 3> d, e;
      Real product = 0, dd = 0, ee = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        d[k] = Real(arrays.points[face[1]][k]) - Real(centre[k]);
        e[k] = Real(arrays.points[face[2]][k]) - Real(centre[k]);
        product += d[k] * e[k];
        dd += d[k] * d[k];
        ee += e[k] * e[k];
      }
      sum += atan2(sqrt(dd * ee - product * product), product);
    }
    const Sign truth = sign_of(sum, Real(1));
    if (is_zero) {
      ASSERT_EQ(truth, Sign::zero);
    }
    predicates::Decisions all, others;
    const auto kinds = classify_vertices(Mesh(arrays), all);
    EXPECT_EQ(kinds[0], truth == Sign::zero ? VertexKind::flat : truth == Sign::positive ? VertexKind::relay : VertexKind::convex);
    EXPECT_TRUE(all.undecided_list().empty());
    (is_zero ? counts.zeros : counts.neighbours).merge(all);
    // Turned round, and begun elsewhere.
    MeshArrays turned = arrays;
    for (auto& face : turned.faces) std::swap(face[1], face[2]);
    std::reverse(turned.faces.begin(), turned.faces.end());
    EXPECT_EQ(classify_vertices(Mesh(turned), others), kinds);
  }
}

TEST_P(FieldZeros, AndTheirNeighbours) {
  const Predicate predicate = GetParam().predicate;
  for (int round = 0; counts.at_zero(predicate) < GetParam().cases(); ++round) {
    ASSERT_LT(round, 20000);
    switch (predicate) {
      case Predicate::window_orientation: vertices_in_line(0); break;
      case Predicate::point_distance: vertices_in_line(50); break;
      case Predicate::vertex_distance: rows_between_sources(); break;
      case Predicate::rounding: midpoints(); break;
      case Predicate::saddle: flat_vertices(); break;
      default: FAIL() << "no cases of this predicate are made here";
    }
    if (HasFailure()) FAIL() << "round " << round;
  }
  if (predicate == Predicate::point_distance || predicate == Predicate::rounding)
    counts.expect_neighbours(predicate, {Stage::double_double, Stage::algebra});
  else
    counts.expect_neighbours(predicate, {Stage::filter, Stage::double_double, Stage::algebra});
}

INSTANTIATE_TEST_SUITE_P(Shares, FieldZeros, testing::ValuesIn(shares_of(ZeroTest::field)), [](const auto& share) { return share.param.name(); });

}  // namespace
}  // namespace gvd::kernel
