// What users reported of other libraries, one test a report. Where a report holds data that are small, they are used; else the mesh
// is built to have the property that the report describes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "fuzz/generators/family.hpp"
#include "fuzz/properties/property.hpp"
#include "gvd/io/source_reader.hpp"
#include "gvd/kernel/error.hpp"
#include "gvd/kernel/solver.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Source> sources_at(const Mesh& mesh, const std::string& lines) {
  io::SourceReport report;
  return io::parse_sources(lines, "sources", mesh, report);
}

Solution solved(const Mesh& mesh, const std::string& lines) {
  Solution solution = solve(mesh, sources_at(mesh, lines));
  EXPECT_TRUE(test::is_certified(solution)) << lines;
  return solution;
}

/// Distances and labels on a convex piece of the plane z = 0 are those of the plane.
void expect_planar(const Mesh& mesh, const std::string& lines) {
  const auto sources = sources_at(mesh, lines);
  test::expect_truth(
      mesh, sources,
      [&](VertexId v, std::size_t s) {
        const ExactPoint a = mesh.exact_point(v), b = exact_position(mesh, sources[s].at);
        return test::planar_distance({a[0], a[1]}, {b[0], b[1]});
      },
      lines);
}

/// Two triangles: (0,0), (1,0), (1,1), (0,1), cut from vertex 0 to vertex 2.
Mesh square(double side = 1) { return Mesh({{{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}}, {{0, 1, 2}, {0, 2, 3}}}); }

/// Three quarters of a square of side 2: the geodesic from (0, 2) to (2, 0) bends at the boundary vertex (1, 1), vertex 4.
Mesh l_shape() {
  return Mesh({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}},
               {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}}});
}

void expect_symmetric(const Mesh& mesh) {
  std::vector<std::vector<double>> distance;
  for (VertexId s = 0; s < mesh.vertex_count(); ++s) {
    const auto solution = solve(mesh, {test::at_vertex(mesh, s)}, test::distances_only());
    auto& row = distance.emplace_back();
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) row.push_back(solution.distance(v));
  }
  for (VertexId s = 0; s < mesh.vertex_count(); ++s)
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_EQ(distance[s][v], distance[v][s]) << s << " and " << v;
      EXPECT_TRUE(std::isfinite(distance[s][v]));
      EXPECT_EQ(distance[s][v] == 0, s == v);
    }
}

/// A path starts where it was asked for, repeats no point, stays on the surface, and is as long as its distance.
void expect_sound_path(const Mesh& mesh, const Solution& solution, VertexId v) {
  const auto answer = solution.path(point_at_vertex(mesh, v));
  ASSERT_FALSE(answer.path.empty()) << v;
  EXPECT_EQ(answer.path.front().vertex, v);
  double length = 0;
  for (std::size_t i = 0; i + 1 < answer.path.size(); ++i) {
    const auto &a = answer.path[i], &b = answer.path[i + 1];
    const double leg = std::hypot(a.position[0] - b.position[0], a.position[1] - b.position[1], a.position[2] - b.position[2]);
    EXPECT_GT(leg, 0) << "a point is there twice";
    ASSERT_NE(a.face, kNone);
    length += leg;
    if (a.vertex != kNone || a.edge[0] == kNone) continue;
    EXPECT_TRUE(a.t.value >= 0 && a.t.value <= 1);
    for (std::size_t k = 0; k < 3; ++k) {
      const double from = mesh.point(a.edge[0])[k], to = mesh.point(a.edge[1])[k];
      EXPECT_NEAR(a.position[k], from + a.t.value * (to - from), 1e-13);
    }
  }
  EXPECT_NEAR(length, answer.distance, 1e-12 * (1 + answer.distance));
}

TEST(KnownFailures, CGAL_6681_SourceOnTheBorder) {
  const Mesh mesh = square();
  expect_planar(mesh, "e 0 1 0.5");
  expect_planar(mesh, "e 3 0 0.25");
  const auto there = solve(mesh, sources_at(mesh, "e 0 1 0.5")).query(point_on_edge(mesh, 0, 2, mpq_class(1, 2)));
  const auto back = solve(mesh, sources_at(mesh, "e 0 2 0.5")).query(point_on_edge(mesh, 0, 1, mpq_class(1, 2)));
  EXPECT_EQ(there.distance, 0.5);
  EXPECT_EQ(back.distance, 0.5);
}

TEST(KnownFailures, CGAL_1179_SourceAndTargetOnOneEdge) {
  const Mesh mesh = square(4);
  for (const char* line : {"e 0 2 0.25", "e 0 2 0.75", "e 2 0 0.125"}) expect_planar(mesh, line);
  // The diagonal has length 4 sqrt 2; half of it lies between the two.
  const auto answer = solved(mesh, "e 0 2 0.25").query(point_on_edge(mesh, 0, 2, mpq_class(3, 4)));
  EXPECT_EQ(answer.distance, std::sqrt(8.0));
}

TEST(KnownFailures, CGAL_3993_StuckAtABoundaryEdge) {
  const Mesh mesh = l_shape();
  const auto solution = solved(mesh, "v 6\n");
  EXPECT_EQ(solution.distance(2), std::sqrt(8.0));
  const auto answer = solution.path(point_at_vertex(mesh, 2));
  ASSERT_EQ(answer.path.size(), 5u);  // across two diagonals
  EXPECT_EQ(answer.path[2].vertex, 4u);
  const auto past = solved(mesh, "v 7\n");
  EXPECT_EQ(past.distance(5), 2);  // along both sides of the notch
  EXPECT_EQ(past.distance(2), 1 + std::sqrt(2.0));
}

TEST(KnownFailures, CGAL_9646_VertexSourceAnUlpOff) {
  const Mesh mesh(test::flat_grid(3, 3));
  // A corner of the face, but for a weight of 2^-54 for another one.
  const auto solution = solved(mesh, "f 8 1 5.551115123125783e-17 0\n");
  const VertexId v = mesh.origin(3 * 8);
  EXPECT_GT(solution.distance(v), 0);
  EXPECT_LT(solution.distance(v), 1e-16);
  EXPECT_EQ(solved(mesh, "f 8 1 0 0\n").distance(v), 0);
}

TEST(KnownFailures, CGAL_5280_IsolatedVertex) {
  auto arrays = test::flat_grid(2, 2);
  arrays.points.insert(arrays.points.begin(), {7, 7, 7});
  for (auto& face : arrays.faces)
    for (auto& v : face) ++v;
  const Mesh mesh(arrays);
  const auto solution = solved(mesh, "v 1");
  EXPECT_EQ(solution.distance(0), kInfinity);
  EXPECT_TRUE(solution.nearest(0).empty());
  EXPECT_EQ(solution.distance(9), std::sqrt(8.0));
}

TEST(KnownFailures, CGAL_8979_EmptyDuplicatedOrDriftingPathPoints) {
  const Mesh mesh(test::random_terrain(6, 2, 8979));
  const auto solution = solved(mesh, "v 0\n");
  for (VertexId v = 1; v < mesh.vertex_count(); ++v) expect_sound_path(mesh, solution, v);
}

TEST(KnownFailures, Libigl_2554_UnreachableIsNotZero) {
  const Mesh mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, {2, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}});
  const auto solution = solved(mesh, "v 0\n");
  EXPECT_EQ(solution.distance(5), kInfinity);
  EXPECT_TRUE(solution.nearest(5).empty());
  EXPECT_TRUE(solution.path(point_at_vertex(mesh, 5)).path.empty());
  EXPECT_EQ(solution.summary().unreachable_vertices, 3u);
}

TEST(KnownFailures, Libigl_1013_BoxWithAHole) {
  auto arrays = test::box({1, 1, 2}, {2, 2, 2});
  arrays.faces.erase(arrays.faces.begin() + 4, arrays.faces.begin() + 6);
  expect_symmetric(Mesh(test::without_isolated(arrays)));
}

TEST(KnownFailures, Libigl_2535_IntervalOfLengthZero) {
  // Rays from the source run exactly through vertices, so that windows end where others begin.
  const Mesh mesh(test::flat_grid(4, 4));
  expect_planar(mesh, "f 12 1 1 1\n");
  expect_planar(mesh, "f 12 1 2 1\nf 13 1 1 2\n");
}

TEST(KnownFailures, GeometryCentral_119_BoundaryVertexMakesTheQueueGrow) {
  const Mesh mesh(test::flat_grid(20, 20));
  const auto solution = solve(mesh, sources_at(mesh, "v 10\n"), test::distances_only());
  EXPECT_TRUE(test::is_certified(solution));
  EXPECT_LT(solution.summary().windows_propagated, 40u * mesh.face_count());
}

TEST(KnownFailures, GeometryCentral_212_SourceAtABoundaryVertexOfAGrid) {
  expect_planar(Mesh(test::flat_grid(5, 5, test::Diagonal::alternating)), "v 5\n");
}

TEST(KnownFailures, GeometryCentral_36_NotANumberOnTerrain) {
  auto arrays = test::random_terrain(8, 3, 36);
  for (auto& p : arrays.points) p[0] = std::ldexp(p[0], -20);  // faces so thin that cotangents explode
  const Mesh mesh(arrays);
  const auto solution = solve(mesh, sources_at(mesh, "v 40\n"), test::distances_only());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) EXPECT_TRUE(std::isfinite(solution.distance(v))) << v;
}

TEST(KnownFailures, GeometryCentral_133_PathAtTheBoundaryOfABump) {
  const Mesh mesh(test::grid(8, 8, [](double i, double j) { return 3 * std::exp(-((i - 4) * (i - 4) + (j - 4) * (j - 4)) / 4); }));
  const auto solution = solve(mesh, sources_at(mesh, "v 37\n"));
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (v != 37) expect_sound_path(mesh, solution, v);
}

TEST(KnownFailures, Pygeodesic_11_ZeroAndNoPathBetweenDifferentVertices) {
  const Mesh mesh(test::cube(2));
  const auto solution = solved(mesh, "v 3\n");
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (v == 3) continue;
    EXPECT_GT(solution.distance(v), 0);
    expect_sound_path(mesh, solution, v);
  }
}

TEST(KnownFailures, Pygeodesic_14_InfinityOnAVoxelSurface) {
  fuzz::Wish wish;
  wish.family = "double_torus";
  wish.sources = 1;
  wish.weighted = 0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    fuzz::Trial trial(fuzz::make_case(seed, wish), seed);
    for (VertexId v = 0; v < trial.mesh().vertex_count(); ++v) EXPECT_TRUE(std::isfinite(trial.alone(0).distance(v)));
  }
}

TEST(KnownFailures, TvbGdist_38_AsymmetricDistances) { expect_symmetric(Mesh(test::random_terrain(5, 3, 38))); }

/// The meshes of the reports are closed surfaces of the brain with faults; a mesh that is no surface is refused, the place named.
TEST(KnownFailures, TvbGdist_22_VertexWithTwoFans) {
  try {
    const Mesh mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}});
    FAIL() << "two faces that touch in a vertex only are no surface";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("vertex 0"), std::string::npos) << e.what();
  }
}
TEST(KnownFailures, TvbGdist_70_EdgeOfThreeFaces) {
  const MeshArrays arrays{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  EXPECT_THROW(Mesh{arrays}, InputError);
}
TEST(KnownFailures, TvbGdist_71_PinchedEdge) {
  // Two tetrahedra that share an edge: each vertex of it has two fans, the edge four faces.
  const MeshArrays arrays{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}},
                          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 1, 4}, {0, 5, 1}, {0, 4, 5}, {1, 5, 4}}};
  EXPECT_THROW(Mesh{arrays}, InputError);
}

/// A square around the points (x, y) and the diagram of them as sources.
struct PlanarCells {
  explicit PlanarCells(std::vector<std::array<double, 2>> sites)
      : mesh({{{6, 53, 0}, {7, 53, 0}, {7, 54, 0}, {6, 54, 0}}, {{0, 1, 2}, {0, 2, 3}}}) {
    for (const auto& p : sites) {
      char line[80];
      std::snprintf(line, sizeof line, "xy %.17g %.17g\n", p[0], p[1]);
      lines += line;
    }
    expect_planar(mesh, lines);
    solution = std::make_unique<Solution>(solved(mesh, lines));
    double sum = 0;
    for (const Cell& cell : solution->diagram().cells) {
      EXPECT_EQ(cell.euler, 1) << "source " << cell.source;
      EXPECT_FALSE(cell.hidden) << "source " << cell.source;
      sum += cell.area;
    }
    area = sum;
  }
  double area = 0;
  Mesh mesh;
  std::string lines;
  std::unique_ptr<Solution> solution;
};

/// The points of the report.
TEST(KnownFailures, Geos_1040_FourPointsWithOverlappingCells) {
  const PlanarCells cells(
      {{6.6584, 53.583000000000006}, {6.6576, 53.583600000000004}, {6.657, 53.5848}, {6.6572000000000005, 53.5842}});
  EXPECT_EQ(cells.solution->summary().cells, 4u);
  EXPECT_NEAR(cells.area, 1, 1e-12) << "cells overlap, or leave something out";
}
TEST(KnownFailures, Geos_1123_NearDuplicates) {
  const PlanarCells cells({{6.5, 53.5}, {6.5 + 1e-7, 53.5}, {6.5, 53.5 + 1e-9}, {6.25, 53.75}, {6.25 + 1e-13, 53.75}});
  EXPECT_EQ(cells.solution->summary().cells, 5u);
  EXPECT_TRUE(cells.solution->duplicates().empty());
  EXPECT_NEAR(cells.area, 1, 1e-12);
}
TEST(KnownFailures, Scipy_10464_CloseSitesAreNotMerged) {
  const PlanarCells cells({{6.5, 53.5}, {std::nextafter(6.5, 7), 53.5}});
  EXPECT_EQ(cells.solution->summary().cells, 2u);
  EXPECT_EQ(cells.solution->diagram().dual.size(), 1u);
  EXPECT_NEAR(cells.area, 1, 1e-12);
}

}  // namespace
}  // namespace gvd::kernel
