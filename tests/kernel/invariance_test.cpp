#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "gvd/kernel/extract.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using test::Random;

/// A mesh and its sources as a file has them: a source is a face of the file and weights of its corners.
struct Problem {
  struct Place {
    FaceId face;
    std::array<long, 3> corner_weights;
    double weight;
  };
  MeshArrays mesh;
  std::vector<Place> sources;
};

/// How an altered problem relates to the first one, and how its results are mapped back.
struct Renaming {
  std::vector<VertexId> vertex;              ///< first -> altered
  std::vector<SourceId> source;              ///< altered -> first
  std::array<std::size_t, 3> axis{0, 1, 2};  ///< coordinate k of the first is coordinate axis[k] of the altered
  int scale = 0;                             ///< altered = first * 2^scale
};

Renaming identity(const Problem& p) {
  Renaming same;
  same.vertex.resize(p.mesh.points.size());
  same.source.resize(p.sources.size());
  std::iota(same.vertex.begin(), same.vertex.end(), 0u);
  std::iota(same.source.begin(), same.source.end(), 0u);
  return same;
}

std::vector<std::uint32_t> shuffled(std::size_t n, Random& random) {
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
  return order;
}

/// Vertices, faces and sources in another order, and every face turned to start at another corner.
Problem renumbered(const Problem& p, Random& random, Renaming& map) {
  map = identity(p);
  map.vertex = shuffled(p.mesh.points.size(), random);
  const auto face_order = shuffled(p.mesh.faces.size(), random);
  map.source = shuffled(p.sources.size(), random);
  Problem q;
  q.mesh.points.resize(p.mesh.points.size());
  for (std::size_t v = 0; v < p.mesh.points.size(); ++v) q.mesh.points[map.vertex[v]] = p.mesh.points[v];
  std::vector<FaceId> new_face(face_order.size());
  std::vector<std::size_t> turn(face_order.size());
  for (std::size_t i = 0; i < face_order.size(); ++i) {
    const FaceId f = face_order[i];
    new_face[f] = static_cast<FaceId>(i);
    turn[f] = random.below(3);
    auto& face = q.mesh.faces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) face[k] = map.vertex[p.mesh.faces[f][(k + turn[f]) % 3]];
  }
  for (const SourceId s : map.source) {
    const auto& from = p.sources[s];
    auto& to = q.sources.emplace_back(from);
    to.face = new_face[from.face];
    for (std::size_t k = 0; k < 3; ++k) to.corner_weights[k] = from.corner_weights[(k + turn[from.face]) % 3];
  }
  return q;
}

Problem permuted(const Problem& p, const std::array<std::size_t, 3>& axis, Renaming& map) {
  map = identity(p);
  map.axis = axis;
  Problem q = p;
  for (std::size_t v = 0; v < p.mesh.points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) q.mesh.points[v][axis[k]] = p.mesh.points[v][k];
  return q;
}

Problem scaled(const Problem& p, int scale, Renaming& map) {
  map = identity(p);
  map.scale = scale;
  Problem q = p;
  for (Point& point : q.mesh.points)
    for (double& x : point) x = std::ldexp(x, scale);
  for (auto& source : q.sources) source.weight = std::ldexp(source.weight, scale);
  return q;
}

/// All that must not change, in the names and units of the first problem.
struct Result {
  Status status;
  testing::AssertionResult certified;  ///< with what was not proved
  std::vector<double> distance;
  std::vector<std::vector<SourceId>> nearest;
  std::string diagram;
};

Result solved(const Problem& p, const Renaming& map, unsigned threads = 1) {
  const Mesh mesh(p.mesh);
  std::vector<Source> sources;
  for (const auto& s : p.sources)
    sources.push_back(
        {point_in_face(mesh, s.face,
                       {mpq_class(s.corner_weights[0]), mpq_class(s.corner_weights[1]), mpq_class(s.corner_weights[2])}),
         s.weight});
  SolveOptions options;
  options.threads = threads;
  const auto solution = solve(mesh, sources, options);
  Result result{solution.status(), test::is_certified(solution), {}, {}, {}};
  for (const VertexId v : map.vertex) {
    result.distance.push_back(std::ldexp(solution.distance(v), -map.scale));
    auto& nearest = result.nearest.emplace_back();
    for (const SourceId s : solution.nearest(v)) nearest.push_back(map.source[s]);
    std::sort(nearest.begin(), nearest.end());
  }
  Diagram diagram = solution.diagram();
  for (DiagramPoint& point : diagram.points) {
    const Point at = point.position;
    for (std::size_t k = 0; k < 3; ++k) point.position[k] = std::ldexp(at[map.axis[k]], -map.scale);
  }
  result.diagram = canonical(diagram, {map.source});
  return result;
}

/// Distances are right whatever the status; labels and diagram are promised when everything was decided.
void expect_same(const Result& first, const Result& altered, const std::string& what) {
  SCOPED_TRACE(what);
  EXPECT_EQ(first.distance, altered.distance);
  EXPECT_EQ(first.status, altered.status);
  if (first.status != Status::certified || altered.status != Status::certified) return;
  EXPECT_EQ(first.nearest, altered.nearest);
  EXPECT_EQ(first.diagram, altered.diagram);
}

Problem problem(MeshArrays mesh, std::uint32_t sources, bool weighted, std::uint64_t seed) {
  Random random(seed);
  Problem p{std::move(mesh), {}};
  for (std::uint32_t i = 0; i < sources; ++i) {
    Problem::Place place{random.below(static_cast<std::uint32_t>(p.mesh.faces.size())), {}, weighted ? random.uniform(0, 1) : 0};
    const std::uint32_t kind = random.below(3);  // a corner, a point of a side, a point inside
    for (std::size_t k = 0; k <= kind; ++k) place.corner_weights[k] = 1 + random.below(100);
    p.sources.push_back(place);
  }
  return p;
}

void expect_invariant(const Problem& p, std::uint64_t seed) {
  const Renaming same = identity(p);
  const Result first = solved(p, same);
  testing::Test::RecordProperty("status_" + std::to_string(seed), status_name(first.status));
  Random random(seed);
  Renaming map;
  for (int round = 0; round < 3; ++round) {
    const Problem other = renumbered(p, random, map);
    expect_same(first, solved(other, map), "renumbered " + std::to_string(round));
  }
  for (const std::array<std::size_t, 3>& axis : {std::array<std::size_t, 3>{1, 2, 0}, {2, 0, 1}, {1, 0, 2}}) {
    const Problem other = permuted(p, axis, map);
    expect_same(first, solved(other, map), "axes " + std::to_string(axis[0]) + std::to_string(axis[1]) + std::to_string(axis[2]));
  }
  for (const int scale : {-300, -1, 1, 40, 300}) {
    const Problem other = scaled(p, scale, map);
    expect_same(first, solved(other, map), "times 2^" + std::to_string(scale));
  }
  expect_same(first, solved(p, same, 2), "two threads");
}

TEST(Invariance, RandomTerrains) {
  for (const std::uint64_t seed : {0u, 1u, 2u, 3u, 4u}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Problem p = problem(test::random_terrain(6, 0.5 + static_cast<double>(seed), 700 + seed), 5, false, seed);
    EXPECT_TRUE(solved(p, identity(p)).certified);
    expect_invariant(p, seed);
  }
}

TEST(Invariance, FractalTerrain) {
  const Problem p = problem(test::fractal_terrain(4, 4, 0.6, 710), 12, false, 10);
  EXPECT_TRUE(solved(p, identity(p)).certified);
  expect_invariant(p, 10);
}

TEST(Invariance, WeightedSources) {
  const Problem p = problem(test::fractal_terrain(3, 2, 0.6, 720), 8, true, 20);
  EXPECT_TRUE(solved(p, identity(p)).certified);
  expect_invariant(p, 20);
}

TEST(Invariance, FlatMeshes) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_invariant(problem(test::flat_grid(5, 5, test::Diagonal::alternating), 5, false, 730 + seed), seed);
  }
}

TEST(Invariance, IntegerTerrains) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_invariant(problem(test::integer_terrain(5, 3, 740 + seed), 3, false, seed), seed);
  }
}

TEST(Invariance, ThereAndBackAreEquallyLong) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Mesh mesh(test::random_terrain(5, 1 + static_cast<double>(seed), 750 + seed));
    std::vector<std::vector<double>> distance;
    for (VertexId s = 0; s < mesh.vertex_count(); ++s) {
      const auto solution = solve(mesh, {test::at_vertex(mesh, s)}, test::distances_only());
      EXPECT_TRUE(test::is_certified(solution));
      auto& row = distance.emplace_back();
      for (VertexId v = 0; v < mesh.vertex_count(); ++v) row.push_back(solution.distance(v));
    }
    for (VertexId s = 0; s < mesh.vertex_count(); ++s)
      for (VertexId v = 0; v < s; ++v) EXPECT_EQ(distance[s][v], distance[v][s]) << s << " and " << v << ", seed " << seed;
  }
}

}  // namespace
}  // namespace gvd::kernel
