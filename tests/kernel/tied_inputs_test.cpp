#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/truth.hpp"

/// Inputs on which many decisions are exact ties: they must end certified, and be right.
namespace gvd::kernel {
namespace {

using test::MeshArrays;
using test::Random;

/// Every label set and distance against one run per source.
void expect_right(const Mesh& mesh, const std::vector<Source>& sources, const std::string& what) {
  SCOPED_TRACE(what);
  const auto solution = solve(mesh, sources);
  EXPECT_TRUE(test::is_certified(solution));
  std::vector<std::vector<double>> alone;
  for (const Source& source : sources) {
    const auto single = solve(mesh, {source});
    auto& distances = alone.emplace_back();
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) distances.push_back(single.distance(v));
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    double least = INFINITY;
    for (const auto& distances : alone) least = std::min(least, distances[v]);
    ASSERT_EQ(solution.distance(v), least) << "vertex " << v;
    for (const SourceId s : solution.nearest(v)) EXPECT_EQ(alone[s][v], least) << "vertex " << v << ", source " << s;
  }
}

std::vector<Source> random_vertices(const Mesh& mesh, Random& random, bool weighted) {
  std::vector<Source> sources;
  const std::uint32_t count = 1 + random.below(6);
  for (std::uint32_t i = 0; i < count; ++i) {
    sources.push_back(test::at_vertex(mesh, random.below(mesh.vertex_count())));
    if (weighted) sources.back().weight = random.below(3);
  }
  return sources;
}

/// Meshes whose faces are all of one square class.
MeshArrays one_class(std::uint32_t kind, Random& random) {
  const auto diagonal = static_cast<test::Diagonal>(random.below(3));
  const std::uint32_t a = 1 + random.below(4), b = 1 + random.below(4);
  switch (kind) {
    case 0:
      return test::flat_grid(2 + a, 2 + b, diagonal);
    case 1:
      return test::plane_with_hole(5 + a, 5 + b, 2, 4, 2, 4 + b % 2);
    case 2:
      return test::cube(a);
    case 3:
      return test::staircase(a, b);
    case 4:
      return test::box({double(a), double(b), 2}, {a, b, 1 + a % 2});
    default:
      return test::roof(2 * a, b, 4, 4);
  }
}

TEST(TiedInputs, OneSquareClass) {
  Random random(91);
  for (std::uint32_t round = 0; round < 90; ++round) {
    const Mesh mesh(one_class(round % 5, random));
    expect_right(mesh, random_vertices(mesh, random, round % 3 == 0), "round " + std::to_string(round));
  }
}

TEST(TiedInputs, SeveralSquareClasses) {
  Random random(92);
  for (std::uint32_t round = 0; round < 24; ++round) {
    const std::uint32_t a = random.below(3), b = 1 + random.below(3);
    const auto height = [&](std::uint32_t x, std::uint32_t y) { return static_cast<double>((x / 2 * a + y / 3 * b) % 3); };
    const Mesh mesh(round % 2 == 0 ? test::grid(4 + a, 4 + b, height, static_cast<test::Diagonal>(random.below(3)))
                                   : test::roof(2 * (1 + a), 2 * b, 4, 4));
    expect_right(mesh, random_vertices(mesh, random, round % 3 == 0), "round " + std::to_string(round));
  }
}

/// n x n squares with integer heights 0 .. levels - 1, mirrored in the line x = n / 2 together with their diagonals. Pre: n even.
MeshArrays mirrored_terrain(std::uint32_t n, std::uint32_t levels, Random& random) {
  const std::uint32_t half = n / 2, row = n + 1;
  std::vector<double> height((half + 1) * row);
  for (double& z : height) z = random.below(levels);
  const auto mirrored = [&](std::uint32_t x, std::uint32_t y) { return height[y * (half + 1) + std::min(x, n - x)]; };
  auto arrays = test::grid(n, n, mirrored, test::Diagonal::rising);
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = half; x < n; ++x) {
      const std::uint32_t v = y * row + x, f = 2 * (y * n + x);
      arrays.faces[f] = {v, v + 1, v + row};
      arrays.faces[f + 1] = {v + 1, v + row + 1, v + row};
    }
  return arrays;
}

TEST(TiedInputs, MirroredTerrain) {
  // Every point of the mirror line is as far from a source as from its mirror image. There boundary rays run along sides, relays lie on the
  // rays of each other's mirror images, and most images have more square classes than exact numbers carry: identities must do.
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::uint32_t n = 8 + 2 * static_cast<std::uint32_t>(seed % 4), row = n + 1;
    const Mesh mesh(mirrored_terrain(n, 3 + random.below(4), random));
    std::vector<Source> sources;
    for (std::uint32_t pairs = 1 + random.below(3); pairs > 0; --pairs) {
      const std::uint32_t first = row * random.below(row), column = random.below(n / 2);
      for (const std::uint32_t v : {first + column, first + n - column}) sources.push_back(test::at_vertex(mesh, v));
    }
    const auto solution = solve(mesh, sources);
    EXPECT_TRUE(test::is_certified(solution));
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      if (v % row == n / 2) {
        EXPECT_GE(solution.nearest(v).size(), 2u) << v;
      }
      EXPECT_EQ(solution.distance(v), solution.distance(v / row * row + n - v % row));
    }
  }
}

TEST(TiedInputs, LongStraightLines) {
  // From one flat vertex to the next a path along edges has a leg each, far more than are compared exactly; a window has one that is as long.
  for (const int slope : {0, 1}) {
    const Mesh mesh(test::grid(2, 100, [&](auto x, auto) { return slope * std::abs(x - 1.0); }));
    for (const std::vector<VertexId>& at : {std::vector<VertexId>{0}, {1}, {0, 302}}) {
      std::vector<Source> sources;
      for (const VertexId v : at) sources.push_back(test::at_vertex(mesh, v));
      test::expect_truth(mesh, sources, [&](VertexId v, std::size_t s) {
        const auto place = [&](VertexId u) { return std::array{static_cast<int>(u % 3), static_cast<int>(u / 3)}; };
        const auto a = place(v), b = place(at[s]);
        const int dx = a[0] - b[0], dy = a[1] - b[1];
        return robust::RootSum(1, (1 + slope) * dx * dx + dy * dy);
      });
    }
  }
}

TEST(TiedInputs, SourcesInARowInOneFace) {
  // Their bisectors are parallel: no three of them meet, in whatever face they are seen together. Beyond the source's own face nearly every face has a
  // square class of its own, so only numbers of the place where the strips part show it.
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const Mesh mesh(test::random_terrain(10, 2, seed));
    const FaceId f = 2 * (5 * 10 + 5);
    std::vector<Source> inside, on_edge;
    for (const long k : {1, 2, 3}) {
      inside.push_back({point_in_face(mesh, f, {mpq_class(k), mpq_class(5 - k), mpq_class(1)}), 0});
      on_edge.push_back({point_on_edge(mesh, mesh.origin(3 * f), mesh.target(3 * f), mpq_class(k, 5)), 0});
    }
    expect_right(mesh, inside, "inside a face, seed " + std::to_string(seed));
    expect_right(mesh, on_edge, "on an edge, seed " + std::to_string(seed));
  }
}

TEST(TiedInputs, CubeWithSourcesInAllCorners) {
  for (const std::uint32_t n : {1u, 2u, 3u, 10u}) {
    SCOPED_TRACE(n);
    const Mesh mesh(test::cube(n));
    std::vector<Source> sources;
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      const Point& p = mesh.point(v);
      if (std::all_of(p.begin(), p.end(), [](double x) { return x == 0 || x == 1; })) sources.push_back(test::at_vertex(mesh, v));
    }
    ASSERT_EQ(sources.size(), 8u);
    const auto solution = solve(mesh, sources);
    ASSERT_TRUE(test::is_certified(solution));
    const Diagram& d = solution.diagram();
    EXPECT_EQ(d.vertices.size(), 6u);
    for (const GvdVertex& v : d.vertices) {
      EXPECT_EQ(v.edges.size(), 4u);
      EXPECT_EQ(v.sources.size(), 4u);
      const Point& p = d.points[v.point].position;  // the middle of a side
      EXPECT_EQ(std::count(p.begin(), p.end(), 0.5), 2);
    }
    EXPECT_EQ(d.edges.size(), 12u);
    for (const Cell& cell : d.cells) {
      EXPECT_EQ(cell.neighbours.size(), 3u);
      EXPECT_NEAR(cell.area, 0.75, 1e-12);
    }
  }
}

TEST(TiedInputs, FlatLattice) {
  for (const std::uint32_t step : {3u, 4u, 5u}) {
    SCOPED_TRACE(step);
    const std::uint32_t n = 4 * step;
    const Mesh mesh(test::flat_grid(n, n));
    std::vector<Source> sources;
    for (std::uint32_t j = 0; j <= n; j += step)
      for (std::uint32_t i = 0; i <= n; i += step) sources.push_back(test::at_vertex(mesh, j * (n + 1) + i));
    const auto solution = solve(mesh, sources);
    ASSERT_TRUE(test::is_certified(solution));
    const Diagram& d = solution.diagram();
    EXPECT_EQ(d.vertices.size(), 16u);
    for (const GvdVertex& v : d.vertices) EXPECT_EQ(v.edges.size(), 4u);
    EXPECT_EQ(d.break_points.size(), 0u);
    EXPECT_EQ(d.edges.size(), 40u);
    for (SourceId s = 0; s < 25; ++s) {
      const auto part = [](SourceId k) { return k == 0 || k == 4 ? 0.5 : 1.0; };
      EXPECT_NEAR(d.cells[s].area, part(s % 5) * part(s / 5) * step * step, 1e-10);
    }
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      const auto ways = [&](double x) { return std::fmod(2 * x, 2 * step) == step ? 2u : 1u; };
      EXPECT_EQ(solution.nearest(v).size(), ways(mesh.point(v)[0]) * ways(mesh.point(v)[1]));
    }
  }
}

/// A ring about a round hole, 2 k sides round, mirrored in the x-axis. Vertex i of the hole lies at i / k of half a turn, i + 2 k outside of it.
MeshArrays ring(std::uint32_t k) {
  MeshArrays mesh;
  for (const double radius : {1.0, 2.0}) {
    for (std::uint32_t i = 0; i < 2 * k; ++i) {
      const double turn = M_PI * std::min(i, 2 * k - i) / k, y = i % k == 0 ? 0 : radius * std::sin(turn);
      mesh.points.push_back({radius * std::cos(turn), i < k ? y : -y, 0});
    }
  }
  for (std::uint32_t i = 0; i < 2 * k; ++i) {
    const std::uint32_t j = (i + 1) % (2 * k), outer_i = i + 2 * k, outer_j = j + 2 * k;
    if (i < k)
      mesh.faces.insert(mesh.faces.end(), {{i, outer_i, outer_j}, {i, outer_j, j}});
    else
      mesh.faces.insert(mesh.faces.end(), {{i, outer_i, j}, {outer_i, outer_j, j}});
  }
  return mesh;
}

// Behind a round hole the two ways round it are as long: two thirds of the hole's upper half bend them, of which each leg has its image below. There is a
// limit to the number of legs, and beyond it everything is known but whether the two are equal.
TEST(TiedInputs, BothWaysRoundAHole) {
  for (const std::uint32_t k : {20u, 60u, 150u}) {
    SCOPED_TRACE(k);
    const Mesh mesh(ring(k));
    const auto solution = solve(mesh, {test::at_vertex(mesh, 3 * k)}, test::distances_only());
    EXPECT_EQ(solution.status(), k < 100 ? Status::certified : Status::undecided);
    double length = std::sqrt(3.0), side = 2 * std::sin(M_PI / (2 * k));
    for (std::uint32_t i = 0; 3 * i < 2 * k; ++i) length += side;
    EXPECT_NEAR(solution.distance(0), length, 2 * side);
    for (VertexId v = 1; v < k; ++v) EXPECT_EQ(solution.distance(v), solution.distance(2 * k - v)) << v;
    EXPECT_EQ(solution.nearest(0).size(), 1u);
  }
}

}  // namespace
}  // namespace gvd::kernel
