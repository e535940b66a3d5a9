#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "gvd/robust/root_sum.hpp"
#include "support/surface_points.hpp"

namespace gvd::kernel {
namespace {

using test::in_face;

bool lies_in(const Mesh& mesh, const PathPoint& p, FaceId face) {
  const auto has = [&](VertexId v) {
    return mesh.origin(3 * face) == v || mesh.origin(3 * face + 1) == v || mesh.origin(3 * face + 2) == v;
  };
  if (p.vertex != kNone) return has(p.vertex);
  if (p.edge[0] != kNone) return has(p.edge[0]) && has(p.edge[1]);
  return true;
}

/// What every path must fulfil. Returns the number of its points.
std::size_t check_path(const Mesh& mesh, const std::vector<Source>& sources, const Solution& solution, const SurfacePoint& at) {
  const PointAnswer answer = solution.path(at), plain = solution.query(at);
  EXPECT_EQ(answer.distance, plain.distance);
  EXPECT_EQ(answer.nearest, plain.nearest);
  EXPECT_TRUE(plain.path.empty());
  EXPECT_FALSE(answer.undecided);
  const auto& path = answer.path;
  if (path.empty()) {
    ADD_FAILURE() << "no path";
    return 0;
  }
  const auto place = [&](const SurfacePoint& p) {
    const ExactPoint exact = exact_position(mesh, p);
    return Point{exact[0].get_d(), exact[1].get_d(), exact[2].get_d()};  // truncated: within an ulp
  };
  const Source& source = sources[answer.nearest.front()];
  EXPECT_LE(test::straight_distance(path.front().position, place(at)), 1e-14);
  EXPECT_LE(test::straight_distance(path.back().position, place(source.at)), 1e-14);
  EXPECT_EQ(path.back().face, kNone);
  double length = source.weight;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const PathPoint& p = path[i];
    if (p.edge[0] != kNone) {
      EXPECT_LT(p.edge[0], p.edge[1]);
      EXPECT_LE(p.t.low, p.t.value);
      EXPECT_GE(p.t.high, p.t.value);
      EXPECT_GT(p.t.value, 0);
      EXPECT_LT(p.t.value, 1);
      for (std::size_t k = 0; k < 3; ++k) {
        const double a = mesh.point(p.edge[0])[k], b = mesh.point(p.edge[1])[k];
        EXPECT_NEAR(p.position[k], a + p.t.value * (b - a), 1e-14);
      }
    } else if (p.vertex != kNone) {
      EXPECT_EQ(p.position, mesh.point(p.vertex));
    } else {
      EXPECT_TRUE(i == 0 || i + 1 == path.size()) << "a point inside a face in the middle of a path";
    }
    if (i + 1 == path.size()) break;
    EXPECT_NE(p.face, kNone);
    EXPECT_TRUE(lies_in(mesh, p, p.face) && lies_in(mesh, path[i + 1], p.face)) << "point " << i;
    const double step = test::straight_distance(p.position, path[i + 1].position);
    EXPECT_GT(step, 0);
    length += step;
  }
  if (path.front().vertex == kNone && path.front().edge[0] == kNone && path.size() > 1) {
    EXPECT_EQ(path.front().face, at.face);
  }
  EXPECT_NEAR(length, answer.distance, 1e-14 * static_cast<double>(path.size()) * (1 + answer.distance));
  return path.size();
}

TEST(Path, IsStraightInThePlane) {
  for (const auto diagonal : {test::Diagonal::rising, test::Diagonal::falling, test::Diagonal::alternating}) {
    const Mesh mesh(test::flat_grid(4, 4, diagonal));
    const std::vector<Source> sources{{in_face(9, 1, 2, 1), 0},
                                      {in_face(9, 3, 1, 2), 0},
                                      test::vertex_source(mesh, 24),
                                      {point_on_edge(mesh, 0, 1, mpq_class(1, 3)), 0}};
    const Solution solution = test::solve_field(mesh, sources);
    for (FaceId f = 0; f < mesh.face_count(); ++f) {
      for (int a = 0; a <= 3; ++a) {
        for (int b = 0; a + b <= 3; ++b) check_path(mesh, sources, solution, in_face(f, a, b, 3 - a - b));
      }
    }
  }
}

/// From (0,0) to (4,2): the way goes through the vertex (2,1).
TEST(Path, NamesVerticesOnItsWay) {
  const Mesh mesh(test::flat_grid(4, 2));
  const std::vector<Source> sources{test::vertex_source(mesh, 0)};
  const Solution solution = test::solve_field(mesh, sources);
  const SurfacePoint end = point_at_vertex(mesh, 14);
  check_path(mesh, sources, solution, end);
  std::vector<VertexId> vertices;
  for (const PathPoint& p : solution.path(end).path)
    if (p.vertex != kNone) vertices.push_back(p.vertex);
  EXPECT_EQ(vertices, (std::vector<VertexId>{14, 7, 0}));
}

TEST(Path, CrossesEdgesWhereTheLineDoes) {
  const Mesh mesh(test::flat_grid(2, 1, test::Diagonal::rising));
  const std::vector<Source> sources{test::vertex_source(mesh, 0)};
  const Solution solution = test::solve_field(mesh, sources);
  const auto path = solution.path(point_on_edge(mesh, 2, 5, mpq_class(1, 2))).path;  // (2, 1/2)
  ASSERT_EQ(path.size(), 4u);
  EXPECT_EQ(path[1].edge, (std::array<VertexId, 2>{1, 5}));  // the diagonal x - 1 = y of the second square: x / 4 = x - 1
  EXPECT_DOUBLE_EQ(path[1].t.value, 1.0 / 3);
  EXPECT_EQ(path[2].edge, (std::array<VertexId, 2>{1, 4}));
  EXPECT_DOUBLE_EQ(path[2].t.value, 0.25);
  EXPECT_EQ(path[3].vertex, 0u);
}

TEST(Path, BendsRoundTheCornerOfAHole) {
  const Mesh mesh(test::plane_with_hole(6, 6, 2, 4, 2, 4));
  const auto vertex_at = [&](double x, double y) {
    VertexId v = 0;
    while (mesh.point(v) != Point{x, y, 0}) ++v;
    return v;
  };
  const std::vector<Source> sources{test::vertex_source(mesh, vertex_at(0, 3))};
  const Solution solution = test::solve_field(mesh, sources);
  const SurfacePoint behind = point_on_edge(mesh, vertex_at(6, 2), vertex_at(6, 3), mpq_class(1, 2));
  const auto answer = solution.path(behind);
  // (0,3) -> (2,2) -> (4,2) -> (6,5/2)
  EXPECT_EQ(answer.distance, (robust::RootSum(1, 5) + robust::RootSum(2) + robust::RootSum(1, mpq_class(17, 4))).rounded());
  std::vector<VertexId> corners;
  for (const PathPoint& p : answer.path)
    if (p.vertex == vertex_at(2, 2) || p.vertex == vertex_at(4, 2)) corners.push_back(p.vertex);
  EXPECT_EQ(corners, (std::vector<VertexId>{vertex_at(4, 2), vertex_at(2, 2)}));
  test::Random random(1);
  for (int i = 0; i < 200; ++i) check_path(mesh, sources, solution, test::random_point(mesh, random));
}

TEST(Path, GoesOverTheMiddleOfACubesEdge) {
  const Mesh mesh(test::cube(1));
  const std::vector<Source> sources{test::vertex_source(mesh, 0)};
  const Solution solution = test::solve_field(mesh, sources);
  VertexId opposite = 0;
  while (mesh.point(opposite) != Point{1, 1, 1}) ++opposite;
  const SurfacePoint end = point_at_vertex(mesh, opposite);
  EXPECT_GE(check_path(mesh, sources, solution, end), 3u);
  bool middle = false;
  for (const PathPoint& p : solution.path(end).path)
    middle = middle || (p.t.value == 0.5 && test::straight_distance(mesh.point(p.edge[0]), mesh.point(p.edge[1])) == 1);
  EXPECT_TRUE(middle);
}

TEST(Path, PassesOverASaddle) {
  const Mesh mesh(test::integer_saddle(2));
  const std::vector<Source> sources{{in_face(0, 1, 1, 1), 0}};
  const Solution solution = test::solve_field(mesh, sources);
  test::Random random(2);
  int over = 0;
  for (int i = 0; i < 100; ++i) {
    const SurfacePoint at = test::random_point(mesh, random);
    check_path(mesh, sources, solution, at);
    const auto path = solution.path(at).path;
    over += std::any_of(path.begin(), path.end(), [](const PathPoint& p) { return p.vertex == 0; });
  }
  EXPECT_GT(over, 10);
  EXPECT_LT(over, 90);
}

TEST(Path, EndsAtTheLeastOfTiedSources) {
  const Mesh mesh(test::flat_grid(4, 2));
  for (const bool swapped : {false, true}) {
    const std::vector<Source> sources{test::vertex_source(mesh, swapped ? 4 : 0), test::vertex_source(mesh, swapped ? 0 : 4)};
    const Solution solution = test::solve_field(mesh, sources);
    for (const SurfacePoint& at : {point_on_edge(mesh, 2, 7, mpq_class(1, 3)), point_at_vertex(mesh, 7)}) {
      EXPECT_EQ(solution.path(at).nearest.size(), 2u);
      EXPECT_EQ(solution.path(at).path.back().vertex, swapped ? 4u : 0u);
      check_path(mesh, sources, solution, at);
    }
  }
}

/// Nothing of the refined mesh shows, also where the path crosses faces with several hidden sources.
TEST(Path, PassesByHiddenSources) {
  const Mesh mesh(test::flat_grid(3, 3));
  std::vector<Source> sources{test::vertex_source(mesh, 0)};
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    sources.push_back({in_face(f, 1, 1, 1), 9});
    sources.push_back({in_face(f, 1, 1, 0), 9});
  }
  const Solution solution = test::solve_field(mesh, sources);
  EXPECT_EQ(solution.hidden().size(), sources.size() - 1);
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    for (const auto& at : {in_face(f, 1, 1, 1), in_face(f, 0, 1, 1), in_face(f, 1, 1, 0), in_face(f, 3, 1, 2), in_face(f, 1, 0, 0)})
      check_path(mesh, sources, solution, at);
  }
}

TEST(Path, OnTerrain) {
  const Mesh mesh(test::fractal_terrain(3, 3, 0.6, 21));
  const std::vector<Source> sources{test::vertex_source(mesh, 3, 0.25),
                                    {in_face(40, 1, 2, 3), 0},
                                    {in_face(40, 5, 1, 1), 0},
                                    {point_on_edge(mesh, 60, 61, mpq_class(2, 7)), 0.125}};
  const Solution solution = test::solve_field(mesh, sources);
  test::Random random(4);
  std::size_t longest = 0;
  for (int i = 0; i < 200; ++i) longest = std::max(longest, check_path(mesh, sources, solution, test::random_point(mesh, random)));
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) check_path(mesh, sources, solution, point_at_vertex(mesh, v));
  EXPECT_GT(longest, 6u);
}

}  // namespace
}  // namespace gvd::kernel
