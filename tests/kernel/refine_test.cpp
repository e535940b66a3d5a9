#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <ctime>
#include <random>
#include <set>

#include "gvd/kernel/error.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "support/meshes.hpp"

namespace gvd::kernel {
namespace {

ExactPoint cross(const ExactPoint& d, const ExactPoint& e) {
  return {d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]};
}

ExactPoint minus(const ExactPoint& a, const ExactPoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Twice the vector area.
ExactPoint area(const Mesh& mesh, FaceId f) {
  const ExactPoint a = mesh.exact_point(mesh.origin(3 * f)), b = mesh.exact_point(mesh.origin(3 * f + 1)),
                   c = mesh.exact_point(mesh.origin(3 * f + 2));
  return cross(minus(b, a), minus(c, a));
}

std::int64_t euler(const Mesh& mesh) {
  std::int64_t vertices = 0, edges = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) vertices += !mesh.is_isolated(v);
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) edges += mesh.twin(h) == kNone || h < mesh.twin(h);
  return vertices - edges + mesh.face_count();
}

void check_links(const Mesh& mesh) {
  std::vector<int> degree(mesh.vertex_count());
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    ++degree[mesh.origin(h)];
    const HalfedgeId t = mesh.twin(h);
    if (t == kNone) continue;
    ASSERT_EQ(mesh.twin(t), h);
    ASSERT_EQ(mesh.origin(t), mesh.target(h));
    ASSERT_EQ(mesh.target(t), mesh.origin(h));
    ASSERT_EQ(mesh.is_artificial(t), mesh.is_artificial(h));
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    int met = 0;
    mesh.for_each_outgoing(v, [&](HalfedgeId h) {
      ++met;
      EXPECT_EQ(mesh.origin(h), v);
    });
    ASSERT_EQ(met, degree[v]) << "vertex " << v;
  }
}

/// The parts of each input face have its normal direction and its area; so they are a partition, given that the links are right.
void check_parts(const Mesh& given, const Mesh& refined) {
  std::vector<ExactPoint> sum(given.face_count());
  for (FaceId f = 0; f < refined.face_count(); ++f) {
    const FaceId whole = refined.input_face(f);
    ASSERT_LT(whole, given.face_count());
    const ExactPoint part = area(refined, f), all = area(given, whole);
    EXPECT_EQ(cross(part, all), (ExactPoint{0, 0, 0}));
    EXPECT_GT(part[0] * all[0] + part[1] * all[1] + part[2] * all[2], 0) << "part " << f << " of face " << whole;
    EXPECT_EQ(refined.flipped(f), given.flipped(whole));
    for (int i = 0; i < 3; ++i) sum[whole][i] += part[i];
  }
  for (FaceId f = 0; f < given.face_count(); ++f) ASSERT_EQ(sum[f], area(given, f)) << "face " << f;
}

/// Artificial are exactly the edges between parts of one input face.
void check_artificial(const Mesh& refined) {
  for (HalfedgeId h = 0; h < refined.halfedge_count(); ++h) {
    const HalfedgeId t = refined.twin(h);
    const bool inside = t != kNone && refined.input_face(Mesh::face(h)) == refined.input_face(Mesh::face(t));
    ASSERT_EQ(refined.is_artificial(h), inside) << "half-edge " << h;
  }
}

void check_rounding(const Mesh& refined) {
  for (VertexId v = 0; v < refined.vertex_count(); ++v) {
    const ExactPoint p = refined.exact_point(v);
    for (int i = 0; i < 3; ++i) {
      const double d = refined.point(v)[i];
      const mpq_class error = abs(p[i] - mpq_class(d));
      EXPECT_LE(error, abs(p[i] - mpq_class(std::nextafter(d, INFINITY))));
      EXPECT_LE(error, abs(p[i] - mpq_class(std::nextafter(d, -INFINITY))));
    }
  }
}

void check_refinement(const Mesh& given, const std::vector<Source>& sources, const Mesh& refined, const RefinedSources& where) {
  check_links(refined);
  check_parts(given, refined);
  check_artificial(refined);
  check_rounding(refined);
  EXPECT_EQ(euler(refined), euler(given));
  ASSERT_EQ(where.vertex.size(), sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    EXPECT_EQ(refined.exact_point(where.vertex[i]), exact_position(given, sources[i].at)) << "source " << i;
    EXPECT_EQ(where.weight[i], sources[i].weight);
  }
}

Mesh triangle() { return Mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}); }

/// Two faces that share edge 1-2; the second is given the other way round.
Mesh fold() { return Mesh({{{0, 0, 0}, {3, 0, 1}, {0, 3, 1}, {3, 3, 7}}, {{0, 1, 2}, {1, 2, 3}}}); }

Mesh tetrahedron() {
  return Mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.2, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
}

/// A grid of n x n squares with heights, each cut into two faces.
Mesh terrain(std::uint32_t n) {
  std::mt19937 random(7);
  return Mesh(test::grid(n, n, [&](auto, auto) { return double(random() % 1000) / 700; }, test::Diagonal::falling));
}

SurfacePoint inside(FaceId face, int w0, int w1, int w2) {
  SurfacePoint at;
  at.face = face;
  const int sum = w0 + w1 + w2;
  at.bary = {mpq_class(w0, sum), mpq_class(w1, sum), mpq_class(w2, sum)};
  for (auto& b : at.bary) b.canonicalize();
  return at;
}

TEST(Refine, NoSourceLeavesTheMeshAsItIs) {
  const Mesh mesh = fold();
  RefinedSources where;
  const Mesh refined = refine(mesh, {}, where);
  EXPECT_EQ(refined.vertex_count(), mesh.vertex_count());
  EXPECT_EQ(refined.face_count(), mesh.face_count());
  EXPECT_TRUE(where.vertex.empty());
}

TEST(Refine, SourcesAtVerticesAddNothing) {
  const Mesh mesh = fold();
  const std::vector<Source> sources{{point_at_vertex(mesh, 3), 0}, {inside(0, 1, 0, 0), 2.5}};
  RefinedSources where;
  const Mesh refined = refine(mesh, sources, where);
  EXPECT_EQ(where.vertex, (std::vector<VertexId>{3, 0}));
  EXPECT_EQ(where.weight, (std::vector<double>{0, 2.5}));
  EXPECT_EQ(refined.face_count(), 2u);
}

TEST(Refine, IsolatedVertexIsASource) {
  const Mesh mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, {{0, 1, 2}}});
  RefinedSources where;
  refine(mesh, {{point_at_vertex(mesh, 3), 0}}, where);
  EXPECT_EQ(where.vertex, (std::vector<VertexId>{3}));
}

TEST(Refine, InsideAFaceMakesThreeParts) {
  const Mesh mesh = triangle();
  const std::vector<Source> sources{{inside(0, 1, 1, 1), 0}};
  RefinedSources where;
  const Mesh refined = refine(mesh, sources, where);
  EXPECT_EQ(refined.face_count(), 3u);
  EXPECT_EQ(where.vertex, (std::vector<VertexId>{3}));
  EXPECT_EQ(refined.exact_point(3), (ExactPoint{mpq_class(1, 3), mpq_class(1, 3), 0}));
  EXPECT_EQ(refined.point(3), (Point{1.0 / 3, 1.0 / 3, 0}));
  EXPECT_FALSE(refined.is_representable(3));
  EXPECT_FALSE(refined.is_boundary(3));
  check_refinement(mesh, sources, refined, where);
}

TEST(Refine, InsideAnInnerEdgeMakesFourParts) {
  const Mesh mesh = fold();
  const std::vector<Source> sources{{point_on_edge(mesh, 1, 2, mpq_class(1, 3)), 0}};
  RefinedSources where;
  const Mesh refined = refine(mesh, sources, where);
  EXPECT_EQ(refined.face_count(), 4u);
  EXPECT_EQ(refined.exact_point(4), (ExactPoint{2, 1, 1}));
  check_refinement(mesh, sources, refined, where);
}

TEST(Refine, InsideABoundaryEdgeMakesTwoParts) {
  const Mesh mesh = triangle();
  const std::vector<Source> sources{{point_on_edge(mesh, 2, 1, mpq_class(1, 4)), 0}};
  RefinedSources where;
  const Mesh refined = refine(mesh, sources, where);
  EXPECT_EQ(refined.face_count(), 2u);
  EXPECT_EQ(refined.exact_point(3), (ExactPoint{mpq_class(1, 4), mpq_class(3, 4), 0}));
  EXPECT_TRUE(refined.is_boundary(3));
  check_refinement(mesh, sources, refined, where);
}

TEST(Refine, ThePointOfAnEdgeIsOneVertexWhicheverFaceNamesIt) {
  const Mesh mesh = fold();
  const FaceId second = 1;
  SurfacePoint other;  // the same point, as a point of the other face
  other.face = second;
  for (HalfedgeId h = 3; h < 6; ++h) {
    if (mesh.origin(h) == 1) other.bary[h % 3] = mpq_class(2, 3);
    if (mesh.origin(h) == 2) other.bary[h % 3] = mpq_class(1, 3);
  }
  const std::vector<Source> sources{{point_on_edge(mesh, 1, 2, mpq_class(1, 3)), 0},
                                    {other, 1},
                                    {point_on_edge(mesh, 2, 1, mpq_class(2, 3)), 2},
                                    {point_at_vertex(mesh, 0), 3},
                                    {inside(0, 1, 0, 0), 0}};
  RefinedSources where;
  const Mesh refined = refine(mesh, sources, where);
  EXPECT_EQ(where.vertex, (std::vector<VertexId>{4, 4, 4, 0, 0}));
  EXPECT_EQ(where.duplicates, (std::vector<std::array<SourceId, 2>>{{1, 0}, {2, 0}, {4, 3}}));
  EXPECT_EQ(refined.face_count(), 4u);
  check_refinement(mesh, sources, refined, where);
}

TEST(Refine, PointsOnTheEdgesThatEarlierSourcesMade) {
  const Mesh mesh = triangle();
  // The second lies between the first and corner 0, the third between the first and the second, the fourth is the second again, the
  // fifth lies on the line from the first to a side's middle point, which is the sixth.
  const std::vector<Source> sources{{inside(0, 1, 1, 1), 0}, {inside(0, 2, 1, 1), 0}, {inside(0, 5, 3, 3), 0},
                                    {inside(0, 4, 2, 2), 0}, {inside(0, 1, 3, 3), 0}, {inside(0, 0, 1, 1), 0},
                                    {inside(0, 1, 5, 5), 0}, {inside(0, 1, 0, 1), 0}, {inside(0, 1, 0, 3), 0}};
  RefinedSources where;
  const Mesh refined = refine(mesh, sources, where);
  EXPECT_EQ(where.duplicates, (std::vector<std::array<SourceId, 2>>{{3, 1}}));
  EXPECT_EQ(refined.vertex_count(), 3u + 8u);
  EXPECT_EQ(where.vertex[3], where.vertex[1]);
  check_refinement(mesh, sources, refined, where);
}

TEST(Refine, ARefinedMeshCanBeRefinedAgain) {
  const Mesh mesh = fold();
  RefinedSources where;
  const std::vector<Source> first{{inside(0, 1, 2, 3), 0}, {point_on_edge(mesh, 1, 2, mpq_class(1, 7)), 0}};
  const Mesh once = refine(mesh, first, where);
  std::vector<Source> second;
  for (FaceId f = 0; f < once.face_count(); ++f) second.push_back({inside(f, 1, 1, 2), 0});
  const Mesh twice = refine(once, second, where);
  EXPECT_EQ(twice.input_vertex_count(), mesh.vertex_count());
  EXPECT_EQ(twice.vertex_count(), once.vertex_count() + second.size());
  check_links(twice);
  check_parts(mesh, twice);
  check_artificial(twice);
  for (std::size_t i = 0; i < second.size(); ++i) EXPECT_EQ(twice.exact_point(where.vertex[i]), exact_position(once, second[i].at));
}

/// Small coordinates on purpose: they meet vertices, edges, artificial edges and each other all the time.
RC_GTEST_PROP(Refine, RandomCoarsePointsOnSmallMeshes, ()) {
  const Mesh mesh = *rc::gen::element(0, 1, 2) == 0 ? tetrahedron() : *rc::gen::element(0, 1) == 0 ? fold() : terrain(2);
  const int count = *rc::gen::inRange(1, 30);
  std::vector<Source> sources;
  std::set<ExactPoint> places;
  std::size_t new_places = 0;
  for (int i = 0; i < count; ++i) {
    const FaceId face = *rc::gen::inRange<FaceId>(0, mesh.face_count());
    const int size = *rc::gen::element(1, 2, 3, 4, 6, 12);
    const int w0 = *rc::gen::inRange(0, size + 1), w1 = *rc::gen::inRange(0, size - w0 + 1);
    const Source source{inside(face, w0, w1, size - w0 - w1), double(i)};
    if (places.insert(exact_position(mesh, source.at)).second) {
      new_places += locate(mesh, source.at).kind != Location::Kind::vertex;
    }
    sources.push_back(source);
  }
  RefinedSources where;
  const Mesh refined = refine(mesh, sources, where);
  check_refinement(mesh, sources, refined, where);
  RC_ASSERT(refined.vertex_count() == mesh.vertex_count() + new_places);
  RC_ASSERT(where.duplicates.size() == sources.size() - places.size());
  RC_ASSERT(!::testing::Test::HasFailure());
}

TEST(Refine, ManyPointsInOneFace) {
  const Mesh mesh = fold();
  std::mt19937 random(3);
  std::vector<Source> sources;
  for (int i = 0; i < 400; ++i) {
    const int w0 = int(random() % 1000), w1 = int(random() % 1000), w2 = 1 + int(random() % 1000);
    sources.push_back({inside(0, w0, w1, w2), 0});
  }
  RefinedSources where;
  const Mesh refined = refine(mesh, sources, where);
  check_refinement(mesh, sources, refined, where);
}

TEST(Refine, RefusesWhatIsNoSource) {
  const Mesh mesh = triangle();
  RefinedSources where;
  const auto message = [&](Source bad) -> std::string {
    try {
      refine(mesh, {{point_at_vertex(mesh, 0), 0}, bad}, where);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({inside(0, 1, 1, 1), -1}), "source 1: the weight -1 is not a finite number >= 0");
  EXPECT_EQ(message({inside(0, 1, 1, 1), INFINITY}), "source 1: the weight inf is not a finite number >= 0");
  EXPECT_EQ(message({inside(0, 1, 1, 1), NAN}), "source 1: the weight nan is not a finite number >= 0");
  EXPECT_EQ(message({inside(1, 1, 1, 1), 0}), "source 1: face 1 does not exist (there are 1 faces)");
  EXPECT_EQ(message({inside(0, 3, -1, 1), 0}), "source 1: face 0: barycentric coordinate 1 is negative");
  SurfacePoint half = inside(0, 1, 1, 1);
  half.bary[0] = 0;
  EXPECT_EQ(message({half, 0}), "source 1: face 0: barycentric coordinates do not add up to 1");
  SurfacePoint liar = inside(0, 1, 0, 0);
  liar.vertex = 2;
  EXPECT_EQ(message({liar, 0}), "source 1: a surface point of face 0 claims to be vertex 2, which it is not");
  EXPECT_EQ(message({SurfacePoint{}, 0}), "source 1: a surface point names neither a face nor a vertex");
}

TEST(Refine, AThousandSourcesAreCheap) {
  const Mesh mesh = terrain(92);  // 16,928 faces
  std::mt19937 random(5);
  std::vector<Source> sources;
  for (int i = 0; i < 1000; ++i) {
    const mpq_class x(random() % (1 << 20) * 2 + 1, 1 << 22), y(random() % (1 << 20) * 2 + 1, 1 << 22);
    sources.push_back({{FaceId(random() % mesh.face_count()), kNone, {1 - x - y, x, y}}, 0});
    for (auto& b : sources.back().at.bary) b.canonicalize();
  }
  RefinedSources where;
  const std::clock_t start = std::clock();
  const Mesh refined = refine(mesh, sources, where);
  const double ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  RecordProperty("milliseconds", std::to_string(ms));
  EXPECT_EQ(refined.vertex_count(), mesh.vertex_count() + 1000);
  EXPECT_LT(ms, 1000);  // it takes about 10; the bound only tells a quadratic algorithm
}

}  // namespace
}  // namespace gvd::kernel
