#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "support/truth.hpp"

/// Shapes of diagrams that are easy to forget.
namespace gvd::kernel {
namespace {

using test::at_vertex;

VertexId vertex_at(const Mesh& mesh, const Point& p) {
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.point(v) == p) return v;
  ADD_FAILURE() << "no vertex there";
  return kNone;
}

Source in_face(const Mesh& mesh, FaceId f, long a, long b, long c, double weight = 0) {
  return {point_in_face(mesh, f, {mpq_class(a), mpq_class(b), mpq_class(c)}), weight};
}

std::set<std::array<SourceId, 2>> dual(const Diagram& d) {
  std::set<std::array<SourceId, 2>> pairs;
  for (const DualEdge& e : d.dual) pairs.insert(e.sources);
  return pairs;
}

double total_area(const Diagram& d) {
  double sum = 0;
  for (const Cell& c : d.cells) sum += c.area;
  return sum;
}

TEST(Shapes, EdgeAlongMeshEdges) {
  // Two sources that mirror each other in the column x = 2, a line of mesh edges, of a roof and of a plane.
  for (const auto& arrays : {test::flat_grid(4, 4), test::roof(2, 4, 8, 6)}) {
    const Mesh mesh(arrays);
    const double left = mesh.point(1)[0], right = mesh.point(3)[0], middle = mesh.point(2)[0];
    const std::vector<Source> sources = {at_vertex(mesh, 2 * 5 + 1), at_vertex(mesh, 2 * 5 + 3)};
    ASSERT_EQ(left + right, 2 * middle);
    const auto solution = solve(mesh, sources);
    ASSERT_TRUE(test::is_certified(solution));
    const Diagram& d = solution.diagram();
    ASSERT_EQ(d.edges.size(), 1u);
    EXPECT_FALSE(d.edges[0].closed);
    EXPECT_EQ(d.edges[0].arcs.size(), 4u);
    for (const Arc& arc : d.arcs) {
      EXPECT_TRUE(arc.along_edge);
      for (const auto node : arc.node) EXPECT_EQ(d.points[node].position[0], middle);
    }
    EXPECT_TRUE(d.vertices.empty());
    EXPECT_EQ(d.boundary_meetings.size(), 2u);
    EXPECT_TRUE(d.break_points.empty());
    EXPECT_EQ(d.cells[0].area, d.cells[1].area);
  }
}

TEST(Shapes, SeveralSourcesInOneFacet) {
  // A triangle with corners (0, 0), (12, 0), (0, 12) and three sources inside; the circumcentre of (2, 2), (6, 2), (2, 6) is (4,
  // 4).
  const Mesh mesh({{{0, 0, 0}, {12, 0, 0}, {0, 12, 0}, {12, 12, 0}}, {{0, 1, 2}, {1, 3, 2}}});
  const std::vector<Source> sources = {in_face(mesh, 0, 8, 2, 2), in_face(mesh, 0, 4, 6, 2), in_face(mesh, 0, 4, 2, 6)};
  const auto solution = solve(mesh, sources);
  ASSERT_TRUE(test::is_certified(solution));
  const Diagram& d = solution.diagram();
  ASSERT_EQ(d.vertices.size(), 1u);
  EXPECT_EQ(d.points[d.vertices[0].point].position, (Point{4, 4, 0}));
  EXPECT_EQ(d.vertices[0].sources, (std::vector<SourceId>{0, 1, 2}));
  EXPECT_EQ(d.edges.size(), 3u);
  EXPECT_EQ(d.boundary_meetings.size(), 3u);
  EXPECT_NEAR(total_area(d), 144, 1e-12);
  EXPECT_NEAR(d.cells[0].area, 16, 1e-13);
}

TEST(Shapes, SteepPeakIsAnIslandInOneCell) {
  // A needle on a plane: its top is a source; the wave of the other source comes up on all sides. The edge between them is closed,
  // and the other cell has a hole.
  auto arrays = test::random_terrain(8, 0.01, 900);
  arrays.points[4 * 9 + 4][2] = 20;
  const Mesh mesh(arrays);
  const std::vector<Source> sources = {at_vertex(mesh, 4 * 9 + 4), at_vertex(mesh, 0)};
  const auto solution = solve(mesh, sources);
  ASSERT_TRUE(test::is_certified(solution));
  const Diagram& d = solution.diagram();
  ASSERT_EQ(d.edges.size(), 1u);
  EXPECT_TRUE(d.edges[0].closed);
  EXPECT_TRUE(d.vertices.empty());
  EXPECT_TRUE(d.boundary_meetings.empty());
  EXPECT_EQ(d.cells[0].euler, 1);
  EXPECT_EQ(d.cells[1].euler, 0);
  EXPECT_EQ(dual(d), (std::set<std::array<SourceId, 2>>{{0, 1}}));
}

TEST(Shapes, WeightedTripleWithTwoVertices) {
  // A late source between two early ones: its cell is a lens, and all three meet above and below it.
  const Mesh mesh({{{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}}, {{0, 1, 2}, {0, 2, 3}}});
  const auto at = [&](long x, long y, double weight) {
    // In face 0 below the diagonal y = x, in face 1 above it.
    const long low = y <= x ? 10 - x : 10 - y, high = y <= x ? y + 10 : x + 10, side = 20 - low - high;
    return y <= x ? in_face(mesh, 0, low, side, high, weight) : in_face(mesh, 1, low, high, side, weight);
  };
  const std::vector<Source> sources = {at(-4, 0, 0), at(4, 0, 0), at(0, 0, 3)};
  const auto solution = solve(mesh, sources);
  ASSERT_TRUE(test::is_certified(solution));
  const Diagram& d = solution.diagram();
  // |p| + 3 = |p - (4, 0)| on the y axis: y + 3 = sqrt(16 + y^2), so y = 7 / 6.
  std::set<Point> found;
  for (const GvdVertex& v : d.vertices) {
    EXPECT_EQ(v.sources, (std::vector<SourceId>{0, 1, 2}));
    found.insert(d.points[v.point].position);
  }
  EXPECT_EQ(found, (std::set<Point>{{0, -7.0 / 6, 0}, {0, 7.0 / 6, 0}}));
  EXPECT_EQ(d.edges.size(), 4u);
  EXPECT_EQ(d.dual.size(), 3u);
  for (const DualEdge& e : d.dual) EXPECT_EQ(e.edges.size(), e.sources[1] == 1 ? 2u : 1u);
  EXPECT_EQ(d.cells[0].euler, 1);
  EXPECT_NEAR(total_area(d), 400, 1e-11);
}

TEST(Shapes, SummitAgainstItsSurroundings) {
  // A pyramid with eight sides, one source on its top and one at each corner of its foot: rings of edges and vertices round the
  // top.
  const auto arrays = test::cone(8, 4, 3);
  const Mesh mesh(arrays);
  std::vector<Source> sources;
  for (VertexId v = 0; v <= 8; ++v) sources.push_back(at_vertex(mesh, v));
  const auto solution = solve(mesh, sources);
  ASSERT_TRUE(test::is_certified(solution));
  const Diagram& d = solution.diagram();
  EXPECT_EQ(d.cells[0].neighbours.size(), 8u);
  EXPECT_EQ(d.vertices.size(), 8u);
}

TEST(Shapes, BorderOfASharedRegionAlongEdges) {
  // Source 1 reaches source 0 with exactly its weight, so behind the hole's corner both are nearest; the borders of that region run along mesh edges.
  const Mesh mesh(test::plane_with_hole(9, 6, 2, 5, 2, 5));
  std::vector<Source> sources;
  for (const auto& [place, weight] : std::vector<std::pair<Point, double>>{{{2, 5, 0}, 1}, {{3, 5, 0}, 0}, {{6, 3, 0}, 0}}) {
    sources.push_back(at_vertex(mesh, vertex_at(mesh, place)));
    sources.back().weight = weight;
  }
  const auto solution = solve(mesh, sources);
  ASSERT_TRUE(test::is_certified(solution));
  EXPECT_EQ(solution.nearest(vertex_at(mesh, {0, 4, 0})).size(), 2u);
  EXPECT_FALSE(solution.diagram().shared.empty());
}

TEST(Shapes, ArcsAlongAnEdgeHaveTheImagesThatAreNearestThere) {
  // The side of a box and parts of two others. The edge from (5, 0, 0) to (5, 1, 1) halves the way between source 1 and the image
  // of source 0 over the top, which takes over from that over the front in the middle of the edge: found by fuzzing.
  const Mesh mesh(test::MeshArrays{{{3, 1, 1}, {4, 0, 1}, {4, 1, 1}, {5, 0, 0}, {5, 1, 1}, {5, 0, 1}, {5, 2, 0}, {5, 2, 1}},
                                   {{1, 2, 0}, {3, 6, 4}, {3, 4, 5}, {3, 5, 1}, {1, 5, 2}, {5, 4, 2}, {6, 7, 4}, {2, 4, 7}}});
  const auto solution = solve(mesh, {at_vertex(mesh, 1), at_vertex(mesh, 6)});
  ASSERT_TRUE(test::is_certified(solution));
  const Diagram& d = solution.diagram();
  std::size_t along_edge = 0;
  for (const Arc& arc : d.arcs) {
    if (!arc.along_edge) continue;
    ++along_edge;
    for (const std::uint32_t node : arc.node) {
      const auto distance = [&](std::size_t i) {
        return std::hypot(d.points[node].frame[0].value - arc.image[i][0].value,
                          d.points[node].frame[1].value - arc.image[i][1].value);
      };
      EXPECT_NEAR(distance(0), distance(1), 1e-12);
    }
  }
  EXPECT_EQ(along_edge, 1u);
}

TEST(Shapes, EdgeEndsAtARelayingCorner) {
  // Two arms of a corridor of width 2 that meet at a right angle; one source in each, 3 from the inner corner (2, 2) along its
  // walls. They are separated by the diagonal, from the inner corner to the outer one.
  const auto full = test::flat_grid(6, 6);
  test::MeshArrays arrays{full.points, {}};
  for (std::uint32_t j = 0; j < 6; ++j)
    for (std::uint32_t i = 0; i < 6; ++i)
      if (i < 2 || j < 2)
        for (const std::uint32_t k : {0u, 1u}) arrays.faces.push_back(full.faces[2 * (j * 6 + i) + k]);
  const Mesh mesh(test::without_isolated(arrays));
  const VertexId corner = vertex_at(mesh, {2, 2, 0});
  const std::vector<Source> sources = {at_vertex(mesh, vertex_at(mesh, {5, 2, 0})), at_vertex(mesh, vertex_at(mesh, {2, 5, 0}))};
  const auto solution = solve(mesh, sources);
  EXPECT_EQ(solution.distance(corner), 3);
  EXPECT_EQ(solution.nearest(corner).size(), 2u);
  EXPECT_EQ(solution.summary().ties, 3u);
  ASSERT_TRUE(test::is_certified(solution));
  const Diagram& d = solution.diagram();
  ASSERT_EQ(d.edges.size(), 1u);
  EXPECT_EQ(d.boundary_meetings.size(), 2u);
  EXPECT_TRUE(d.shared.empty());
  EXPECT_NEAR(d.cells[0].area, 10, 1e-13);
}

TEST(Shapes, SharedRegionOfTwoSourcesOneSaddle) {
  // A hole's corner hides both sources from the region behind it; both are 5 from it: (3, 4) and (4, 3) before the corner.
  const Mesh mesh(test::plane_with_hole(16, 16, 6, 10, 6, 10));
  const VertexId corner = vertex_at(mesh, {6, 10, 0});
  const std::vector<Source> sources = {at_vertex(mesh, vertex_at(mesh, {3, 6, 0})), at_vertex(mesh, vertex_at(mesh, {2, 7, 0}))};
  const auto solution = solve(mesh, sources);
  ASSERT_TRUE(test::is_certified(solution));
  const auto told = solution.nearest(corner);
  EXPECT_EQ(told.size(), 2u);
  EXPECT_EQ(solution.distance(corner), 5);
  ASSERT_EQ(solution.diagram().shared.size(), 1u);
  EXPECT_GT(solution.diagram().shared[0].area, 0);
  const auto behind = solution.nearest(vertex_at(mesh, {10, 11, 0}));
  EXPECT_EQ(behind.size(), 2u);
  const auto& d = solution.diagram();
  EXPECT_NEAR(total_area(d) - d.shared[0].area, 240, 1e-10);
}

TEST(Shapes, RegionTouchesItsFacetOnlyAtTheRelay) {
  // Random saddles whose sources lie behind one another: Euler's formula is checked inside; the areas must add up.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    test::Random random(seed);
    auto arrays = test::saddle_fan(3 + seed % 3, 1.5);
    for (Point& p : arrays.points)
      for (double& x : p) x += random.uniform(-0.05, 0.05);
    const Mesh mesh(arrays);
    double surface = 0;
    std::vector<Source> sources;
    for (std::uint32_t i = 0; i < 3; ++i) sources.push_back(test::inside_face(mesh, random.below(mesh.face_count()), random));
    const auto solution = solve(mesh, sources);
    ASSERT_TRUE(test::is_certified(solution));
    for (FaceId f = 0; f < mesh.face_count(); ++f) {
      const Point &a = mesh.point(mesh.origin(3 * f)), &b = mesh.point(mesh.origin(3 * f + 1)),
                  &c = mesh.point(mesh.origin(3 * f + 2));
      const Point u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
      surface += std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
    }
    EXPECT_NEAR(total_area(solution.diagram()) / surface, 1, 1e-12);
  }
}

}  // namespace
}  // namespace gvd::kernel
