#include "gvd/kernel/vertex_kind.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include "gvd/io/mesh_reader.hpp"
#include "gvd/kernel/mesh_facts.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "support/meshes.hpp"

namespace gvd::kernel {
namespace {

using predicates::Decisions;
using predicates::Predicate;
using robust::Stage;

std::uint64_t decided(const Decisions& decisions, Stage stage) { return decisions(static_cast<std::size_t>(Predicate::saddle), stage); }

std::vector<VertexKind> kinds_of(const MeshArrays& arrays) {
  Decisions decisions;
  const auto kinds = classify_vertices(Mesh(arrays), decisions);
  EXPECT_EQ(decided(decisions, Stage::undecided), 0u);
  return kinds;
}

MeshFacts facts_of(const MeshArrays& arrays) {
  Decisions decisions;
  const MeshFacts counted = facts(Mesh(arrays), decisions);
  EXPECT_EQ(decided(decisions, Stage::undecided), 0u);
  return counted;
}

std::size_t count(const std::vector<VertexKind>& kinds, VertexKind kind) {
  return static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), kind));
}

TEST(VertexKind, FlatGrids) {
  for (const auto diagonal : {test::Diagonal::rising, test::Diagonal::falling, test::Diagonal::alternating}) {
    for (const double step : {1.0, 0.1, 1e6 / 3}) {
      const auto kinds = kinds_of(test::flat_grid(6, 4, diagonal, step));
      EXPECT_EQ(count(kinds, VertexKind::convex), 4u);  // the corners
      EXPECT_EQ(count(kinds, VertexKind::flat), 7u * 5u - 4u);
    }
  }
}

TEST(VertexKind, PlaneWithHole) {
  const auto kinds = kinds_of(test::plane_with_hole(8, 6, 2, 5, 2, 4));
  EXPECT_EQ(count(kinds, VertexKind::relay), 4u);  // the corners of the hole, 3/2 pi
  EXPECT_EQ(count(kinds, VertexKind::convex), 4u);
}

TEST(VertexKind, BoxesAreConvexAtTheirCornersOnly) {
  for (const MeshArrays& arrays : {test::cube(4), test::box({3, 2, 1}, {3, 1, 2}), test::box({0.1, 0.7, 1e-3}, {2, 2, 2})}) {
    const auto kinds = kinds_of(arrays);
    EXPECT_EQ(count(kinds, VertexKind::convex), 8u);
    EXPECT_EQ(count(kinds, VertexKind::relay), 0u);
  }
}

TEST(VertexKind, DevelopableSurfacesAreFlatInside) {
  for (const MeshArrays& arrays : {test::staircase(4, 3), test::staircase(3, 3, 2, 5), test::roof(4, 3, 16, 12), test::roof(2, 3, 2, 7)}) {
    const Mesh mesh(arrays);
    const auto kinds = kinds_of(arrays);
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      if (!mesh.is_boundary(v)) {
        EXPECT_EQ(kinds[v], VertexKind::flat) << v;
      }
    }
    EXPECT_EQ(count(kinds, VertexKind::relay), 0u);
    EXPECT_EQ(count(kinds, VertexKind::convex), 4u);
  }
}

TEST(VertexKind, ConesAndSaddles) {
  for (const double height : {1e-6, 1e-3, 1.0, 1e3}) {
    EXPECT_EQ(kinds_of(test::cone(7, 1, height))[0], VertexKind::convex);
    EXPECT_EQ(kinds_of(test::saddle_fan(3, height))[0], VertexKind::relay);
    EXPECT_EQ(kinds_of(test::integer_saddle(height))[0], VertexKind::relay);
  }
  EXPECT_EQ(kinds_of(test::integer_saddle(0))[0], VertexKind::flat);
}

TEST(VertexKind, TiltedPlaneIsProvedByIntegers) {
  // Corners of several radicands would be slow; here all share one, and the quick proof takes every inner vertex.
  MeshArrays arrays = test::grid(20, 20, [](auto i, auto j) { return 3.0 * i - 7.0 * j + 0.25; });
  Decisions decisions;
  const auto kinds = classify_vertices(Mesh(arrays), decisions);
  EXPECT_EQ(count(kinds, VertexKind::flat), 21u * 21u - 4u);
  EXPECT_EQ(decided(decisions, Stage::algebra), 21u * 21u - 4u);
  arrays.points[10 * 21 + 10][2] = std::nextafter(arrays.points[10 * 21 + 10][2], 1e9);  // a summit of one ulp
  const auto bumped = classify_vertices(Mesh(arrays), decisions);
  EXPECT_EQ(bumped[10 * 21 + 10], VertexKind::convex);
  EXPECT_EQ(bumped[10 * 21 + 11], VertexKind::relay);
}

/// A fan in a plane that folds back over itself is not flat.
TEST(VertexKind, FoldedPlanarFans) {
  // Six spokes in the plane that go round twice: 4 pi.
  const MeshArrays twice = {{{0, 0, 0}, {2, 0, 0}, {-1, 2, 0}, {-1, -2, 0}, {3, 0, 0}, {-2, 3, 0}, {-2, -3, 0}},
                            {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}}};
  EXPECT_EQ(kinds_of(twice)[0], VertexKind::relay);
  // Forth and back: less than 2 pi.
  const MeshArrays back = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  EXPECT_EQ(kinds_of(back)[0], VertexKind::convex);
  // Forth and back, and exactly 2 pi in all: three right angles on the way, one of them back.
  const MeshArrays folded = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  EXPECT_EQ(kinds_of(folded)[0], VertexKind::flat);
  // Forth to a hair below a half turn, and back: the filter cannot tell it from 2 pi, and the quick proof has to see the fold.
  MeshArrays hair = folded;
  hair.points[3] = {-1, 0x1p-51, 0};
  hair.points[4] = {1, 1, 0};
  EXPECT_EQ(kinds_of(hair)[0], VertexKind::convex);
}

/// The same in a plane across no axis, where the quick proof is by integers.
TEST(VertexKind, TiltedFansThatAreNotStraight) {
  const MeshArrays folded = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {-1, 0, 0}, {0, 2, 2}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  EXPECT_EQ(kinds_of(folded)[0], VertexKind::flat) << "four right angles, two of them back";
  // Neighbouring Fibonacci numbers: their directions differ by 2^-72 or so.
  std::array<double, 56> f{0, 1};
  for (std::size_t n = 2; n < f.size(); ++n) f[n] = f[n - 1] + f[n - 2];
  const auto boundary = [&](std::size_t first, std::size_t last) {
    return kinds_of({{{0, 0, 0}, {f[first], f[first - 1], f[first - 1]}, {-1, 1, 1}, {-f[last], -f[last - 1], -f[last - 1]}}, {{0, 1, 2}, {0, 2, 3}}})[0];
  };
  EXPECT_EQ(boundary(54, 54), VertexKind::flat);
  EXPECT_EQ(boundary(54, 55), VertexKind::convex);
  EXPECT_EQ(boundary(55, 54), VertexKind::relay);
}

/// A star of faces in a plane, its first vertex inside (closed) or on the boundary, whatever its coordinates: flat.
MeshArrays planar_star(const std::vector<std::array<double, 2>>& spokes, bool closed, std::size_t axis, Point centre = {}) {
  MeshArrays star;
  star.points.push_back(centre);
  for (const auto& spoke : spokes) {
    Point p = centre;
    p[(axis + 1) % 3] = spoke[0];
    p[(axis + 2) % 3] = spoke[1];
    star.points.push_back(p);
  }
  const auto n = static_cast<VertexId>(spokes.size());
  for (VertexId k = 1; k < n; ++k) star.faces.push_back({0, k, k + 1});
  if (closed) star.faces.push_back({0, n, 1});
  return star;
}

TEST(VertexKind, PlanarStarsThatTheQuickProofLeavesToExactNumbers) {
  constexpr double kTiny = 0x1p-500;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Products too small to be exact; coordinates too far apart for their differences to be.
    EXPECT_EQ(kinds_of(planar_star({{1, kTiny}, {kTiny, 1}, {-1, kTiny}, {kTiny, -1}}, true, axis))[0], VertexKind::flat);
    EXPECT_EQ(kinds_of(planar_star({{kTiny, 1}, {-1, kTiny}, {-1, -1}, {1, -1}, {1, kTiny}}, true, axis))[0], VertexKind::flat);
    EXPECT_EQ(kinds_of(planar_star({{1e9, 0.1}, {0.3, 1e9}, {-1e9, -0.7}, {0.9, -1e9}}, true, axis, {0.1, 0.1, 0.1}))[0], VertexKind::flat);
    // Neighbours that only the last bits of the products tell from one line, either way round.
    EXPECT_EQ(kinds_of(planar_star({{1, 1 - 0x1p-52}, {1 + 0x1p-52, 1}, {-1, 1}, {0, -1}}, true, axis))[0], VertexKind::flat);
    EXPECT_EQ(kinds_of(planar_star({{0, -1}, {-1, 1}, {1 + 0x1p-52, 1}, {1, 1 - 0x1p-52}}, true, axis))[0], VertexKind::flat);
  }
}

TEST(VertexKind, PlanarBoundariesOnEitherSideOfStraight) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double bend : {0.0, 0x1p-60, -0x1p-60}) {
      const auto expected = bend == 0 ? VertexKind::flat : bend > 0 ? VertexKind::convex : VertexKind::relay;
      EXPECT_EQ(kinds_of(planar_star({{1, 0}, {0, 1}, {-1, bend}}, false, axis))[0], expected) << bend;
      EXPECT_EQ(kinds_of(planar_star({{0, 1}, {-1, 0}, {bend, -1}}, false, axis))[0], bend == 0  ? VertexKind::flat
                                                                                   : bend > 0 ? VertexKind::relay
                                                                                              : VertexKind::convex);
    }
  // The same in a plane across no axis, of whole numbers of 40 bits.
  const double most = 0x1p38, bit = 1;
  for (const double bend : {0.0, bit, -bit}) {
    const MeshArrays tilted = {{{0, 0, 0}, {most, 0, 0}, {0, most, most}, {-most, bend, bend}}, {{0, 1, 2}, {0, 2, 3}}};
    EXPECT_EQ(kinds_of(tilted)[0], bend == 0 ? VertexKind::flat : bend > 0 ? VertexKind::convex : VertexKind::relay) << bend;
  }
}

TEST(VertexKind, ScalingTurningAndRenumberingChangeNothing) {
  test::Random random(11);
  for (const MeshArrays& arrays : {test::integer_terrain(8, 3, 5), test::random_terrain(8, 0.5, 6), test::staircase(3, 3)}) {
    const auto kinds = kinds_of(arrays);
    MeshArrays other = arrays;
    for (Point& p : other.points) std::rotate(p.begin(), p.begin() + 1, p.end());
    for (auto& face : other.faces) std::rotate(face.begin(), face.begin() + random.below(3), face.end());
    for (auto& face : other.faces) {
      if (random.below(2) == 0) std::swap(face[0], face[1]);
    }
    for (std::size_t f = other.faces.size(); f > 1; --f) std::swap(other.faces[f - 1], other.faces[random.below(static_cast<std::uint32_t>(f))]);
    EXPECT_EQ(kinds_of(other), kinds);
    for (const int shift : {-900, -300, 30, 200}) {
      MeshArrays scaled = arrays;
      for (Point& p : scaled.points) {
        for (double& x : p) x = std::ldexp(x, shift);
      }
      EXPECT_EQ(kinds_of(scaled), kinds) << shift;
    }
  }
}

/// Sources that are inserted are flat, and every other vertex keeps its kind, though its corners changed.
TEST(VertexKind, RefinementKeepsKinds) {
  test::Random random(12);
  for (const MeshArrays& arrays : {test::integer_terrain(6, 3, 1), test::random_terrain(6, 0.3, 2), test::cube(2), test::flat_grid(4, 4)}) {
    const Mesh mesh(arrays);
    const auto kinds = kinds_of(arrays);
    std::vector<Source> sources;
    for (int i = 0; i < 60; ++i) {
      const FaceId f = random.below(mesh.face_count());
      const mpq_class third(1, 3);
      sources.push_back({i % 3 == 0 ? point_on_edge(mesh, mesh.origin(3 * f), mesh.target(3 * f), mpq_class(1 + random.below(9)) / 11)
                                    : point_in_face(mesh, f, {mpq_class(1 + random.below(7)), mpq_class(1 + random.below(7)), third}),
                         0});
    }
    RefinedSources where;
    const Mesh refined = refine(mesh, sources, where);
    Decisions decisions;
    auto refined_kinds = classify_vertices(refined, decisions);
    EXPECT_EQ(decided(decisions, Stage::undecided), 0u);
    ASSERT_GT(refined.vertex_count(), mesh.vertex_count());
    for (VertexId v = mesh.vertex_count(); v < refined.vertex_count(); ++v) EXPECT_EQ(refined_kinds[v], VertexKind::flat);
    refined_kinds.resize(mesh.vertex_count());
    EXPECT_EQ(refined_kinds, kinds);
  }
}

TEST(VertexKind, StagesOnATerrain) {
  Decisions decisions;
  const Mesh mesh(test::fractal_terrain(7, 30, 0.6, 3));
  classify_vertices(mesh, decisions);
  EXPECT_EQ(decided(decisions, Stage::filter), mesh.vertex_count());
}

TEST(MeshFacts, CountsOfSimpleShapes) {
  const MeshFacts hole = facts_of(test::plane_with_hole(6, 5, 2, 4, 1, 3));
  EXPECT_EQ(hole.vertices, 41u);
  EXPECT_EQ(hole.faces, 52u);
  EXPECT_EQ(hole.edges, 93u);
  EXPECT_EQ(hole.boundary_edges, 30u);
  EXPECT_EQ(hole.boundary_loops, 2u);
  EXPECT_EQ(hole.components, 1u);
  EXPECT_EQ(hole.saddles, 0u);
  EXPECT_EQ(hole.boundary_relays, 4u);
  EXPECT_EQ(hole.flat_vertices, 11u);
  EXPECT_EQ(hole.euler, 0);
  EXPECT_EQ(hole.bbox[0], (Point{0, 0, 0}));
  EXPECT_EQ(hole.bbox[1], (Point{6, 5, 0}));

  MeshArrays two = test::cube(2);
  const auto shift = static_cast<std::uint32_t>(two.points.size());
  const MeshArrays triangle = {{{5, 5, 5}, {6, 5, 5}, {5, 6, 5}, {9, 9, -9}}, {{0, 1, 2}}};
  two.points.insert(two.points.end(), triangle.points.begin(), triangle.points.end());
  for (const auto& f : triangle.faces) two.faces.push_back({f[0] + shift, f[1] + shift, f[2] + shift});
  std::swap(two.faces[3][1], two.faces[3][2]);
  const MeshFacts both = facts_of(two);
  EXPECT_EQ(both.components, 2u);
  EXPECT_EQ(both.boundary_loops, 1u);
  EXPECT_EQ(both.isolated_vertices, 1u);
  EXPECT_EQ(both.flipped_faces, 1u);
  EXPECT_EQ(both.euler, 3);
  EXPECT_EQ(both.flat_vertices, 18u);
  EXPECT_EQ(both.bbox[1], (Point{9, 9, 5}));
  EXPECT_EQ(both.bbox[0], (Point{0, 0, -9}));
}

/// The facts of the article's own data; the folder is not part of the repository.
class ArticleData : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name) {
    const char* const folder = std::getenv("GVD_TEST_DATA");
    if (folder == nullptr) return {};
    const auto path = std::filesystem::path(folder) / name;
    return std::filesystem::exists(path) ? path : std::filesystem::path();
  }
};

TEST_F(ArticleData, StHelens) {
  const auto path = file("st_helens_tin.vtk");
  if (path.empty()) GTEST_SKIP() << "st_helens_tin.vtk is not in $GVD_TEST_DATA";
  const Mesh mesh(io::read_mesh(path));
  Decisions decisions;
  const MeshFacts counted = facts(mesh, decisions);
  EXPECT_EQ(counted.vertices, 8800u);
  EXPECT_EQ(counted.faces, 17222u);
  EXPECT_EQ(counted.edges, 26021u);
  EXPECT_EQ(counted.boundary_edges, 376u);
  EXPECT_EQ(counted.saddles, 4943u);
  EXPECT_EQ(counted.flipped_faces, 6818u);
  EXPECT_EQ(decided(decisions, Stage::filter), 8800u);
}

TEST_F(ArticleData, BumpOfSaddle) {
  const auto path = file("topographic_bump_of_saddle.vtk");
  if (path.empty()) GTEST_SKIP() << "topographic_bump_of_saddle.vtk is not in $GVD_TEST_DATA";
  const MeshFacts counted = facts_of(io::read_mesh(path));
  EXPECT_EQ(counted.vertices, 6u);
  EXPECT_EQ(counted.saddles, 1u);
}

}  // namespace
}  // namespace gvd::kernel
