#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include "gvd/kernel/error.hpp"
#include "gvd/robust/rational.hpp"
#include "gvd/robust/root_sum.hpp"
#include "support/surface_points.hpp"

namespace gvd::kernel {
namespace {

using robust::RootSum;
using test::in_face;

mpq_class squared_distance(const ExactPoint& a, const ExactPoint& b) {
  mpq_class sum;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

struct Truth {
  double distance;
  std::vector<SourceId> nearest;
};
/// On a convex flat surface.
Truth planar_truth(const Mesh& mesh, const std::vector<Source>& sources, const SurfacePoint& at) {
  const ExactPoint p = exact_position(mesh, at);
  std::vector<RootSum> distance;
  for (const Source& s : sources)
    distance.push_back(RootSum(mpq_class(s.weight)) + RootSum(1, squared_distance(exact_position(mesh, s.at), p)));
  std::size_t least = 0;
  for (std::size_t i = 1; i < sources.size(); ++i)
    if (compare(distance[i], distance[least]) == robust::Sign::negative) least = i;
  Truth truth{distance[least].rounded(), {}};
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (compare(distance[i], distance[least]) == robust::Sign::zero) truth.nearest.push_back(static_cast<SourceId>(i));
  return truth;
}

void expect_planar(const Mesh& mesh, const std::vector<Source>& sources, const Solution& solution, const SurfacePoint& at) {
  const Truth truth = planar_truth(mesh, sources, at);
  const PointAnswer answer = solution.query(at);
  EXPECT_FALSE(answer.undecided);
  EXPECT_EQ(answer.distance, truth.distance);
  EXPECT_EQ(answer.nearest, truth.nearest);
  EXPECT_LE(answer.enclosure.low, truth.distance);
  EXPECT_GE(answer.enclosure.high, truth.distance);
  EXPECT_EQ(answer.enclosure.value, answer.distance);
}

TEST(Query, FlatGridIsThePlane) {
  for (const auto diagonal : {test::Diagonal::rising, test::Diagonal::alternating}) {
    const Mesh mesh(test::flat_grid(4, 4, diagonal));
    // Two in one face, one on an edge of that face, one at a vertex, one on the boundary.
    const std::vector<Source> sources{{in_face(9, 1, 2, 1), 0},
                                      {in_face(9, 3, 1, 2), 0},
                                      {in_face(9, 1, 1, 0), 0},
                                      test::vertex_source(mesh, 24),
                                      {point_on_edge(mesh, 0, 1, mpq_class(1, 3)), 0}};
    const Solution solution = test::solve_field(mesh, sources);
    ASSERT_EQ(solution.status(), Status::certified);
    for (FaceId f = 0; f < mesh.face_count(); ++f)
      for (int a = 0; a <= 4; ++a)
        for (int b = 0; a + b <= 4; ++b) expect_planar(mesh, sources, solution, in_face(f, a, b, 4 - a - b));
  }
}

TEST(Query, WeightsCount) {
  const Mesh mesh(test::flat_grid(3, 3));
  const std::vector<Source> sources{{in_face(0, 1, 1, 1), 0.75}, {in_face(17, 1, 1, 1), 0}, {in_face(16, 1, 2, 1), 1}};
  const Solution solution = test::solve_field(mesh, sources);
  ASSERT_EQ(solution.hidden().size(), 1u);
  test::Random random(7);
  for (int i = 0; i < 100; ++i) expect_planar(mesh, sources, solution, test::random_point(mesh, random));
  for (const Source& s : sources) expect_planar(mesh, sources, solution, s.at);
}

TEST(Query, TiesNameAllSources) {
  const Mesh mesh(test::flat_grid(4, 2));
  const std::vector<Source> sources{test::vertex_source(mesh, 0), test::vertex_source(mesh, 4), {point_at_vertex(mesh, 4), 0}};
  const Solution solution = test::solve_field(mesh, sources);
  const SurfacePoint middle = point_on_edge(mesh, 2, 7, mpq_class(1, 3));
  EXPECT_EQ(solution.query(middle).nearest, (std::vector<SourceId>{0, 1, 2}));
  expect_planar(mesh, sources, solution, middle);
  // A hair beside it.
  const mpq_class tiny = robust::power_of_two(-200);
  const SurfacePoint beside = in_face(middle.face, middle.bary[0] + tiny, middle.bary[1] + 2 * tiny, middle.bary[2] + 3 * tiny);
  expect_planar(mesh, sources, solution, beside);
  EXPECT_LT(solution.query(beside).nearest.size(), 3u);
}

/// The point of a mesh in the plane z = 0.
SurfacePoint on_plane(const Mesh& mesh, const mpq_class& x, const mpq_class& y) {
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    std::array<mpq_class, 3> weight;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const ExactPoint p = mesh.exact_point(mesh.origin(3 * f + (k + 1) % 3)), q = mesh.exact_point(mesh.origin(3 * f + (k + 2) % 3));
      weight[k] = (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x);
    }
    if (std::all_of(weight.begin(), weight.end(), [](const mpq_class& w) { return w >= 0; })) return in_face(f, weight[0], weight[1], weight[2]);
  }
  throw std::logic_error("not a point of the mesh");
}

// Two sources as far, one through many faces, the other through few, so that the errors of the two differ: nearly halfway between two doubles one of them is rounded sooner.
TEST(Query, NearlyHalfwayBetweenTwoDoubles) {
  const Mesh mesh(test::flat_grid(20, 1));
  const mpq_class x(21, 2), y(1, 8), half_ulp = robust::power_of_two(-50);
  const SurfacePoint at = on_plane(mesh, x, y);
  for (const bool swapped : {false, true}) {
    for (int bits = 80; bits < 125; ++bits) {
      for (const int side : {1, -1}) {
        const mpq_class distance = 9 + half_ulp + side * robust::power_of_two(-bits);
        const Source few{on_plane(mesh, x + distance - 8, y), 8}, many{on_plane(mesh, x - distance, y), 0};
        const Solution solution = swapped ? test::solve_field(mesh, {many, few}) : test::solve_field(mesh, {few, many});
        const PointAnswer answer = solution.query(at);
        ASSERT_FALSE(answer.undecided);
        EXPECT_EQ(answer.distance, side > 0 ? std::nextafter(9.0, 10.0) : 9.0) << bits;
        EXPECT_EQ(answer.nearest, (std::vector<SourceId>{0, 1})) << bits;
      }
    }
  }
}

// Beside the rays that bound what a source sees past a hole, by less than pairs of doubles tell.
TEST(Query, JustInTheShadowOrNot) {
  const Mesh mesh(test::plane_with_hole(6, 4, 2, 4, 1, 3));
  const auto vertex_at = [&](double x, double y) {
    VertexId v = 0;
    while (mesh.point(v)[0] != x || mesh.point(v)[1] != y) ++v;
    return v;
  };
  struct Ray {
    Point source, corner;
    std::array<mpq_class, 2> at, into_shadow;
  };
  const std::vector<Ray> rays{{{0, 0, 0}, {4, 1, 0}, {5, mpq_class(5, 4)}, {0, 1}},
                              {{0, 0, 0}, {2, 3, 0}, {mpq_class(5, 2), mpq_class(15, 4)}, {1, 0}},
                              {{6, 4, 0}, {2, 3, 0}, {1, mpq_class(11, 4)}, {0, -1}},
                              {{6, 4, 0}, {4, 1, 0}, {mpq_class(7, 2), mpq_class(1, 4)}, {-1, 0}}};
  for (const Ray& ray : rays) {
    const VertexId source = vertex_at(ray.source[0], ray.source[1]), corner = vertex_at(ray.corner[0], ray.corner[1]);
    const Solution solution = test::solve_field(mesh, {test::vertex_source(mesh, source)});
    for (const int bits : {40, 100, 120, 200}) {
      for (const int side : {1, -1}) {
        const mpq_class step = side * robust::power_of_two(-bits);
        const SurfacePoint at = on_plane(mesh, ray.at[0] + step * ray.into_shadow[0], ray.at[1] + step * ray.into_shadow[1]);
        const auto length = [&](const ExactPoint& p, const ExactPoint& q) { return RootSum(1, squared_distance(p, q)); };
        const ExactPoint from = mesh.exact_point(source), over = mesh.exact_point(corner), to = exact_position(mesh, at);
        const PointAnswer answer = solution.query(at);
        ASSERT_FALSE(answer.undecided);
        EXPECT_EQ(answer.distance, (side > 0 ? length(from, over) + length(over, to) : length(from, to)).rounded());
        const auto path = solution.path(at).path;
        EXPECT_EQ(std::any_of(path.begin(), path.end(), [&](const PathPoint& p) { return p.vertex == corner; }), side > 0) << bits;
      }
    }
  }
}

TEST(Query, UnitCubeInClosedForm) {
  const Mesh mesh(test::cube(2));
  const Solution solution = test::solve_field(mesh, {test::vertex_source(mesh, 0)});
  ASSERT_EQ(solution.status(), Status::certified);
  test::Random random(3);
  int far = 0;
  for (int i = 0; i < 400; ++i) {
    const SurfacePoint at = test::random_point(mesh, random);
    const ExactPoint p = exact_position(mesh, at);
    std::optional<RootSum> truth;
    for (std::size_t k = 0; k < 3; ++k) {
      const mpq_class &x = p[k], &y = p[(k + 1) % 3], &z = p[(k + 2) % 3];
      std::vector<mpq_class> squares;
      if (x == 0) squares = {y * y + z * z};
      if (x == 1) squares = {(1 + y) * (1 + y) + z * z, (1 + z) * (1 + z) + y * y}, ++far;
      for (const mpq_class& square : squares) {
        const RootSum distance(1, square);
        if (!truth || compare(distance, *truth) == robust::Sign::negative) truth = distance;
      }
    }
    EXPECT_EQ(solution.query(at).distance, truth->rounded());
  }
  EXPECT_GT(far, 100);
  const SurfacePoint opposite = point_at_vertex(mesh, [&] {
    VertexId v = 0;
    while (mesh.point(v) != Point{1, 1, 1}) ++v;
    return v;
  }());
  EXPECT_EQ(solution.query(opposite).distance, std::sqrt(5.0));
}

class QueryTerrain : public testing::Test {
 protected:
  QueryTerrain() : mesh(test::random_terrain(4, 2, 11)) {
    sources = {test::vertex_source(mesh, 3),
               {in_face(20, 1, 2, 3), 0},
               {in_face(20, 5, 1, 1), 0},
               {point_on_edge(mesh, 17, 18, mpq_class(2, 7)), 0}};
  }
  Mesh mesh;
  std::vector<Source> sources;
};

TEST_F(QueryTerrain, AgreesWithTheDistancesOfVertices) {
  const Solution solution = test::solve_field(mesh, sources);
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      SurfacePoint at;
      at.face = f;
      at.bary[k] = 1;
      const VertexId v = mesh.origin(static_cast<HalfedgeId>(3 * f + k));
      const PointAnswer answer = solution.query(at);
      EXPECT_EQ(answer.distance, solution.distance(v));
      EXPECT_TRUE(std::ranges::equal(answer.nearest, solution.nearest(v)));
    }
  }
  for (SourceId s = 0; s < sources.size(); ++s) {
    EXPECT_EQ(solution.query(sources[s].at).distance, 0);
    EXPECT_EQ(solution.query(sources[s].at).nearest, std::vector<SourceId>{s});
  }
}

TEST_F(QueryTerrain, IsTheSameFromBothSidesOfAnEdge) {
  const Solution solution = test::solve_field(mesh, sources);
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    const HalfedgeId t = mesh.twin(h);
    if (t == kNone || t < h) continue;
    for (const mpq_class& s : {mpq_class(1, 3), mpq_class(2, 7)}) {
      SurfacePoint here, there;
      here.face = Mesh::face(h);
      here.bary[h % 3] = there.bary[Mesh::next(t) % 3] = 1 - s;
      here.bary[Mesh::next(h) % 3] = there.bary[t % 3] = s;
      there.face = Mesh::face(t);
      const PointAnswer a = solution.query(here), b = solution.query(there);
      EXPECT_FALSE(a.undecided);
      EXPECT_EQ(a.distance, b.distance);
      EXPECT_EQ(a.nearest, b.nearest);
    }
  }
}

/// Two sources mirrored in the plane x = 2: beside it one is nearer by 2^-190, in faces of several square classes.
TEST(Query, TellsWhatDoublesCannot) {
  test::Random heights(8);
  double z[3][5];
  for (auto& row : z)
    for (double& height : row) height = heights.uniform();
  const auto height = [&](std::uint32_t i, std::uint32_t j) { return z[i < 2 ? 2 - i : i - 2][j]; };
  const Mesh mesh(test::grid(4, 4, height, test::Diagonal::alternating));
  const Solution solution = test::solve_field(mesh, {test::vertex_source(mesh, 1), test::vertex_source(mesh, 3)});
  const mpq_class tiny = robust::power_of_two(-190);
  int decided = 0;
  for (std::uint32_t j = 0; j < 4; ++j) {
    const SurfacePoint middle = point_on_edge(mesh, 5 * j + 2, 5 * j + 7, mpq_class(1, 3));
    const PointAnswer tie = solution.query(middle);
    EXPECT_EQ(tie.nearest, (std::vector<SourceId>{0, 1}));
    SurfacePoint beside = middle;
    for (std::size_t k = 0; k < 3; ++k) beside.bary[k] = sgn(middle.bary[k]) == 0 ? tiny : mpq_class(middle.bary[k] - tiny / 2);
    const PointAnswer answer = solution.query(beside);
    if (answer.undecided) continue;  // it stands on a vertex of the middle, where the tie is not proved
    ++decided;
    EXPECT_EQ(answer.distance, tie.distance);
    EXPECT_EQ(answer.nearest, std::vector<SourceId>{exact_position(mesh, beside)[0] < 2 ? 0u : 1u});
  }
  EXPECT_GE(decided, 1);
}

/// The truth by another way: the point as a source, the sources as vertices.
TEST_F(QueryTerrain, IsSymmetric) {
  const Solution solution = test::solve_field(mesh, sources);
  test::Random random(5);
  for (int i = 0; i < 30; ++i) {
    const SurfacePoint at = test::random_point(mesh, random);
    const PointAnswer answer = solution.query(at);
    const Solution back = test::solve_field(mesh, {{at, 0}});
    Truth truth{std::numeric_limits<double>::infinity(), {}};
    for (SourceId s = 0; s < sources.size(); ++s) {
      const double distance = back.query(sources[s].at).distance;
      if (distance < truth.distance) truth = {distance, {s}};
    }
    EXPECT_EQ(answer.distance, truth.distance);
    EXPECT_EQ(answer.nearest, truth.nearest);
    EXPECT_FALSE(answer.undecided);
  }
}

TEST_F(QueryTerrain, GrowsNoFasterThanTheWay) {
  const Solution solution = test::solve_field(mesh, sources);
  test::Random random(9);
  const auto position = [&](const SurfacePoint& at) {
    const ExactPoint p = exact_position(mesh, at);
    return Point{p[0].get_d(), p[1].get_d(), p[2].get_d()};
  };
  for (int i = 0; i < 300; ++i) {
    const SurfacePoint p = test::random_point(mesh, random);
    SurfacePoint q = test::random_point(mesh, random);
    q.face = p.face;
    EXPECT_LE(std::fabs(solution.query(p).distance - solution.query(q).distance),
              test::straight_distance(position(p), position(q)) + 1e-14);
  }
}

TEST(Query, SaysWhatCannotBeReached) {
  MeshArrays arrays = test::flat_grid(1, 1);
  for (const Point& p : std::vector<Point>(arrays.points)) arrays.points.push_back({p[0] + 5, p[1], 0});
  arrays.points.push_back({9, 9, 9});
  arrays.faces.push_back({4, 5, 7});
  arrays.faces.push_back({4, 7, 6});
  const Mesh mesh(std::move(arrays));
  const Solution solution = test::solve_field(mesh, {test::vertex_source(mesh, 0)});
  for (const SurfacePoint& at : {in_face(2, 1, 1, 1), point_at_vertex(mesh, 5), point_at_vertex(mesh, 8)}) {
    const PointAnswer answer = solution.path(at);
    EXPECT_EQ(answer.distance, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(answer.nearest.empty());
    EXPECT_TRUE(answer.path.empty());
    EXPECT_FALSE(answer.undecided);
  }
  EXPECT_EQ(solution.query(in_face(1, 1, 1, 1)).nearest, std::vector<SourceId>{0});
  EXPECT_EQ(test::solve_field(mesh, {test::vertex_source(mesh, 8, 2)}).query(point_at_vertex(mesh, 8)).distance, 2);
  SurfacePoint outside = in_face(0, 1, 1, 1);
  outside.bary[0] = -1;
  EXPECT_THROW(solution.query(outside), InputError);
}

/// In face 3, with the corners 1, 5 and 4, of which the last one bounds what is seen of the face.
void expect_bends_beside_ray(const Mesh& mesh, const Solution& solution) {
  constexpr VertexId kCorner = 4;
  const std::map<VertexId, int> sign{{1, -1}, {5, 1}, {kCorner, 0}};
  for (const int bits : {10, 60, 150, 300}) {
    for (const int side : {1, -1}) {
      std::array<mpq_class, 3> weight;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const VertexId v = mesh.origin(9 + k);
        weight[k] = (v == kCorner ? mpq_class(1, 2) : mpq_class(1, 4)) + side * sign.at(v) * robust::power_of_two(-bits);
      }
      const PointAnswer answer = solution.path(point_in_face(mesh, 3, weight));
      EXPECT_FALSE(answer.undecided);
      const bool bends = std::any_of(answer.path.begin(), answer.path.end(), [&](const PathPoint& p) { return p.vertex == kCorner; });
      EXPECT_EQ(bends, side > 0) << bits;
      EXPECT_NEAR(answer.distance, 1.25 * std::sqrt(2.0), 0.01);
    }
  }
}

// A point a hair beside the ray that bounds what a window sees past a corner: the path bends there, or it does not, and double-doubles cannot tell.
TEST(Path, BesideABoundaryRay) {
  for (const double mirror : {1, -1}) {
    const double x = mirror, two = 2 * mirror;
    const Mesh mesh({{{0, 0, 0}, {x, 0, 0}, {two, 0, 0}, {0, 1, 0}, {x, 1, 0}, {two, 1, 0}, {0, 2, 0}, {x, 2, 0}},
                     {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}}});
    expect_bends_beside_ray(mesh, test::solve_field(mesh, {test::vertex_source(mesh, 6)}));
  }
}

}  // namespace
}  // namespace gvd::kernel
