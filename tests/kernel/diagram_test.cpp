#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>

#include "gvd/kernel/error.hpp"
#include "gvd/kernel/extract.hpp"
#include "gvd/kernel/solver.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "support/hand_waves.hpp"
#include "support/meshes.hpp"

namespace gvd::kernel {
namespace {

using test::HandWaves;
using Node = FacetTessellation::Node;
using Tess = FacetTessellation;
constexpr std::uint32_t kNoNode = Tess::Piece::kNoNode;

// ---- by hand: two triangles above and below their common edge ----

/// Vertices 0 = (0,0), 1 = (4,0), 2 = (2,3), 3 = (2,-3); face 0 = (0,1,2), face 1 = (1,0,3). Both faces have the frame: side 0 of
/// length 4, apex (1/2, 3/4).
class Kite : public ::testing::Test {
 protected:
  Kite() : mesh({{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, -3, 0}}, {{0, 1, 2}, {1, 0, 3}}}) {
    for (FaceId f = 0; f < 2; ++f) waves.push_back(std::make_unique<HandWaves>(mesh, f, std::array{0.5, 0.75}, 4.0));
    tess.resize(2);
  }

  /// A tessellation with one region.
  void one_region(FaceId f, std::uint32_t site) {
    for (std::uint8_t k = 0; k < 3; ++k) tess[f].outline.push_back({k, site, kNoNode, kNoNode});
  }
  /// Sites a (left) and b (right, along side 0) with a bisector from side 0 at t to corner 2.
  void two_regions(FaceId f, std::uint32_t a, std::uint32_t b, double t) {
    Node side{.kind = Node::Kind::side, .where = 0, .sites = {b, a}, .defining = {a, b, Tess::kNoSite}, .x = t, .y = 0.0, .t = t};
    Node corner{.kind = Node::Kind::corner, .where = 2, .sites = {a, b}, .defining = {}, .x = 0.5, .y = 0.75, .t = 0.0};
    tess[f].nodes = {side, corner};
    tess[f].arcs = {{a, b, 0, 1, false}};
    tess[f].outline = {{0, a, kNoNode, 0}, {0, b, 0, kNoNode}, {1, b, kNoNode, kNoNode}, {2, a, kNoNode, kNoNode}};
  }
  Diagram extract_all() {
    std::vector<BoundaryFacet> facets;
    for (FaceId f = 0; f < 2; ++f) {
      for (std::uint32_t i = 0; i < waves[f]->sites.size(); ++i) tess[f].representative.push_back(i);
      facets.push_back({f, waves[f].get(), &tess[f]});
    }
    return extract({mesh, mesh, sources, label_sets, vertex_labels, face_labels, facets, [&](WindowId w) { return origins[w]; }},
                   decisions);
  }

  Mesh mesh;
  std::vector<std::unique_ptr<HandWaves>> waves;
  std::vector<FacetTessellation> tess;
  std::vector<DiagramSource> sources;
  std::vector<std::vector<SourceId>> label_sets{{0}, {1}, {0, 1}};
  std::vector<LabelSetId> vertex_labels, face_labels{kNone, kNone};
  std::vector<WindowOrigin> origins;
  predicates::Decisions decisions;
};

/// Sources in vertices 0 and 1: the bisector x = 2 crosses both faces.
class CrossedKite : public Kite {
 protected:
  CrossedKite() {
    sources = {{0, 0, false}, {1, 0, false}};
    vertex_labels = {0, 1, 2, 2};
    waves[0]->add_corner(0, 0, {0, 0});
    waves[0]->add_corner(1, 1, {1, 0});
    waves[1]->add_corner(0, 1, {0, 0});
    waves[1]->add_corner(1, 0, {1, 0});
    two_regions(0, 0, 1, 0.5);
    two_regions(1, 0, 1, 0.5);
  }
};

TEST_F(CrossedKite, OneEdgeCrossesTheCommonSide) {
  const Diagram d = extract_all();
  ASSERT_EQ(d.edges.size(), 1u);
  EXPECT_FALSE(d.edges[0].closed);
  EXPECT_EQ(d.edges[0].arcs.size(), 2u);
  EXPECT_EQ(d.points.size(), 3u);
  EXPECT_TRUE(d.vertices.empty());
  EXPECT_TRUE(d.break_points.empty());
  EXPECT_EQ(d.boundary_meetings.size(), 2u);
  std::set<Point> positions;
  for (const auto& p : d.points) positions.insert(p.position);
  EXPECT_EQ(positions, (std::set<Point>{{2, -3, 0}, {2, 0, 0}, {2, 3, 0}}));
  for (const auto& arc : d.arcs) EXPECT_EQ(arc.conic, Arc::Conic::line);
  ASSERT_EQ(d.dual.size(), 1u);
  EXPECT_EQ(d.dual[0].sources, (std::array<SourceId, 2>{0, 1}));
  EXPECT_EQ(d.pieces.size(), 4u);
  EXPECT_EQ(d.boundary_facets, 2u);
  for (const auto& cell : d.cells) {
    EXPECT_DOUBLE_EQ(cell.area, 6);
    EXPECT_EQ(cell.euler, 1);
    EXPECT_EQ(cell.neighbours.size(), 1u);
  }
  using predicates::Predicate;
  EXPECT_EQ(decisions(static_cast<std::size_t>(Predicate::edge_tie), robust::Stage::identity), 1u);
}

TEST_F(CrossedKite, SidesOfAnArcAreThoseSeenAlongIt) {
  const Diagram d = extract_all();
  for (const Arc& arc : d.arcs) {
    const Point &from = d.points[arc.node[0]].position, &to = d.points[arc.node[1]].position;
    const bool up = to[1] > from[1];
    EXPECT_EQ(arc.labels[0], up ? 0u : 1u);  // source 0 has x = 0
    EXPECT_EQ(arc.root[0], up ? 0u : 1u);
    for (std::size_t side = 0; side < 2; ++side) {  // images in the frame of the face
      const bool at_origin = (arc.root[side] == 0) == (arc.face == 0);
      EXPECT_EQ(arc.image[side][0].value, at_origin ? 0 : 4);
      EXPECT_EQ(arc.image[side][1].value, 0);
    }
  }
}

TEST_F(CrossedKite, PiecesHaveClosedOutlines) {
  const Diagram d = extract_all();
  for (const CellPiece& piece : d.pieces) {
    EXPECT_TRUE(piece.holes.empty());
    std::size_t arcs = 0;
    for (std::size_t i = 0; i < piece.outline.size(); ++i) {
      const auto& side = piece.outline[i];
      if (side.arc == kNone) continue;
      ++arcs;
      const Arc& arc = d.arcs[side.arc];
      EXPECT_EQ(side.from, arc.node[side.reversed ? 1 : 0]);
      EXPECT_EQ(piece.outline[(i + 1) % piece.outline.size()].from, arc.node[side.reversed ? 0 : 1]);
      EXPECT_EQ(piece.labels, arc.labels[side.reversed ? 1 : 0]);  // the piece lies on the left of its outline
    }
    EXPECT_EQ(arcs, 1u);
    EXPECT_EQ(piece.outline.size(), 3u);
  }
}

TEST_F(CrossedKite, EndsOpenAtAnUndecidedFacet) {
  tess[1] = {};
  tess[1].undecided = true;
  const Diagram d = extract_all();
  ASSERT_EQ(d.edges.size(), 1u);
  ASSERT_EQ(d.open_ends.size(), 1u);  // on the common side
  EXPECT_EQ(d.points[d.open_ends[0].point].position, (Point{2, 0, 0}));
  EXPECT_EQ(d.boundary_meetings.size(), 1u);
  EXPECT_EQ(d.undecided_faces, std::vector<FaceId>{1});
  EXPECT_EQ(d.face_label[1], kNone);
}

TEST_F(CrossedKite, FacetsThatContradictOneAnotherAreRefused) {
  two_regions(1, 0, 1, 0.25);
  waves[1] = std::make_unique<HandWaves>(mesh, 1, std::array{0.5, 0.75}, 4.0);
  waves[1]->add_window(kNone, 1, 7, 1, {-0.5, 0});
  waves[1]->add_window(kNone, 2, 8, 0, {1, 0});
  EXPECT_THROW(extract_all(), InternalError);
}

TEST_F(CrossedKite, ACornerWithoutAnArcBetweenDifferentLabelSetsIsRefused) {
  tess[0].arcs.clear();
  EXPECT_THROW(extract_all(), InternalError);
}

/// Sources in vertices 2 and 3, mirrored in the common side: it is itself the GVD edge.
class MirroredKite : public Kite {
 protected:
  MirroredKite() {
    sources = {{2, 0, false}, {3, 0, false}};
    vertex_labels = {2, 2, 0, 1};
    origins = {{kNone, 0}, {kNone, 3}};
    waves[0]->add_corner(2, 0, {0.5, 0.75});
    waves[0]->add_window(0, 0, 3, 1, {0.5, -0.75});
    waves[1]->add_corner(2, 1, {0.5, 0.75});
    waves[1]->add_window(1, 0, 2, 0, {0.5, -0.75});
    one_region(0, 0);
    one_region(1, 0);
  }
};

TEST_F(MirroredKite, AMeshEdgeIsTheGvdEdgeAndOwnedOnce) {
  const Diagram d = extract_all();
  ASSERT_EQ(d.edges.size(), 1u);
  ASSERT_EQ(d.arcs.size(), 1u);
  const Arc& arc = d.arcs[0];
  EXPECT_TRUE(arc.along_edge);
  EXPECT_EQ(arc.conic, Arc::Conic::line);
  EXPECT_EQ(arc.face, 0u);
  std::set<std::array<double, 2>> images;
  for (const auto& image : arc.image) images.insert({image[0].value, image[1].value});
  EXPECT_EQ(images, (std::set<std::array<double, 2>>{{2, 3}, {2, -3}}));
  EXPECT_EQ(d.boundary_meetings.size(), 2u);
  EXPECT_EQ(d.boundary_facets, 0u);
  EXPECT_EQ(d.face_label, (std::vector<LabelSetId>{0, 1}));
  EXPECT_TRUE(d.pieces.empty());
  EXPECT_DOUBLE_EQ(d.cells[0].area, 6);
  EXPECT_EQ(d.cells[0].neighbours, std::vector<SourceId>{1});
}

TEST_F(MirroredKite, WavesThatDoNotTieCannotMakeAnEdge) {
  waves[1] = std::make_unique<HandWaves>(mesh, 1, std::array{0.5, 0.75}, 4.0);
  waves[1]->add_corner(2, 1, {0.5, 0.8125});
  waves[1]->add_window(1, 0, 2, 0, {0.5, -0.75});
  EXPECT_THROW(extract_all(), InternalError);
}

// ---- solved ----

Diagram solve_diagram(const Mesh& mesh, const std::vector<Source>& sources, Status expected = Status::certified) {
  const Solution solution = solve(mesh, sources);
  EXPECT_EQ(solution.status(), expected);
  for (const auto& what : solution.decisions().undecided_list()) ADD_FAILURE() << what;
  return solution.diagram();
}

Source in_face(FaceId f, int a, int b, int c, double weight = 0) {
  const int sum = a + b + c;
  SurfacePoint at;
  at.face = f;
  at.bary = {mpq_class(a, sum), mpq_class(b, sum), mpq_class(c, sum)};
  for (auto& x : at.bary) x.canonicalize();
  return {at, weight};
}

double total_area(const Diagram& d) {
  double sum = 0;
  for (const Cell& cell : d.cells) sum += cell.area;
  for (const SharedRegion& region : d.shared) sum -= region.area * static_cast<double>(d.label_sets[region.labels].size() - 1);
  return sum;
}

class FlatGrid : public ::testing::TestWithParam<std::uint64_t> {};

/// In the plane every GVD edge is one straight line, whatever mesh lies under it; vertices are those of the planar diagram.
TEST_P(FlatGrid, IsThePlanarVoronoiDiagram) {
  const Mesh mesh(test::flat_grid(5, 5, test::Diagonal::alternating));
  test::Random random(GetParam());
  std::vector<Source> sources;
  std::vector<std::array<double, 2>> at;
  for (int i = 0; i < 6; ++i) {
    const int a = 1 + static_cast<int>(random.below(90)), b = 1 + static_cast<int>(random.below(90)),
              c = 1 + static_cast<int>(random.below(90));
    sources.push_back(in_face(random.below(mesh.face_count()), a, b, c));
    const ExactPoint p = exact_position(mesh, sources.back().at);
    at.push_back({p[0].get_d(), p[1].get_d()});
  }
  const Diagram d = solve_diagram(mesh, sources);
  EXPECT_TRUE(d.break_points.empty());
  EXPECT_NEAR(total_area(d), 25, 1e-12);
  const auto distance = [&](std::size_t i, const Point& p) { return std::hypot(p[0] - at[i][0], p[1] - at[i][1]); };
  // Independent: all circumcentres that no other source conflicts with.
  std::size_t expected = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = i + 1; j < at.size(); ++j) {
      for (std::size_t k = j + 1; k < at.size(); ++k) {
        const double bx = at[j][0] - at[i][0], by = at[j][1] - at[i][1], cx = at[k][0] - at[i][0], cy = at[k][1] - at[i][1];
        const double det = 2 * (bx * cy - by * cx);
        const Point p{at[i][0] + (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / det,
                      at[i][1] + (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / det, 0};
        bool free = p[0] > 0 && p[0] < 5 && p[1] > 0 && p[1] < 5;
        for (std::size_t l = 0; l < at.size(); ++l) free = free && (l == i || l == j || l == k || distance(l, p) > distance(i, p));
        if (!free) continue;
        ++expected;
        const std::vector<SourceId> triple{static_cast<SourceId>(i), static_cast<SourceId>(j), static_cast<SourceId>(k)};
        const auto found =
            std::find_if(d.vertices.begin(), d.vertices.end(), [&](const GvdVertex& v) { return v.sources == triple; });
        ASSERT_NE(found, d.vertices.end());
        EXPECT_NEAR(d.points[found->point].position[0], p[0], 1e-9);
        EXPECT_NEAR(d.points[found->point].position[1], p[1], 1e-9);
        EXPECT_EQ(d.points[found->point].position[2], 0);
        EXPECT_EQ(found->edges.size(), 3u);
      }
    }
  }
  EXPECT_EQ(d.vertices.size(), expected);
  for (const Cell& cell : d.cells) EXPECT_EQ(cell.euler, 1);
}
INSTANTIATE_TEST_SUITE_P(Seeds, FlatGrid, ::testing::Range<std::uint64_t>(1, 9));

TEST(Diagram, LeavesNoTraceOfSplitsInAFace) {
  const Mesh mesh({{{0, 0, 0}, {100, 0, 0}, {0, 80, 0}}, {{0, 1, 2}}});
  const Diagram d = solve_diagram(mesh, {in_face(0, 3, 1, 1), in_face(0, 1, 4, 1), in_face(0, 1, 1, 5), in_face(0, 7, 6, 8)});
  EXPECT_EQ(d.pieces.size(), 4u);
  EXPECT_TRUE(d.break_points.empty());
  EXPECT_EQ(d.points.size(), d.vertices.size() + d.boundary_meetings.size());
  std::size_t arcs = 0;
  for (const GvdEdge& edge : d.edges) arcs += edge.arcs.size();
  EXPECT_EQ(arcs, d.edges.size());
  EXPECT_NEAR(total_area(d), 4000, 1e-9);
  for (const DiagramPoint& p : d.points) EXPECT_EQ(p.face, 0u);
}

/// A closed convex-like surface without relays: a box pushed out to an ellipsoid, and shaken a little, so that nothing is
/// symmetric.
MeshArrays ellipsoid(std::uint32_t parts, const std::array<double, 3>& axes = {1, 1.3, 0.8}) {
  MeshArrays mesh = test::box({2, 2, 2}, {parts, parts, parts});
  test::Random random(20230217);
  for (Point& p : mesh.points) {
    for (double& x : p) x -= 1;
    const double norm = std::hypot(p[0], p[1], p[2]);
    for (std::size_t i = 0; i < 3; ++i) p[i] *= axes[i] / norm * random.uniform(1, 1.001);
  }
  return mesh;
}

/// The vertex furthest in a direction.
VertexId extreme(const Mesh& mesh, const Point& direction) {
  const auto along = [&](VertexId v) {
    const Point& p = mesh.point(v);
    return p[0] * direction[0] + p[1] * direction[1] + p[2] * direction[2];
  };
  VertexId best = 0;
  for (VertexId v = 1; v < mesh.vertex_count(); ++v)
    if (along(v) > along(best)) best = v;
  return best;
}

/// On a long thin closed surface a source at each end and one between: two closed edges, and a cell with a hole.
TEST(Diagram, ClosedEdgesWithoutAVertexAndACellWithAHole) {
  const Mesh mesh(ellipsoid(6, {0.5, 0.6, 5}));
  std::vector<Source> sources;
  for (const Point& direction : {Point{0.1, 0.2, -1}, Point{1, 0.3, 0.01}, Point{0.2, 0.1, 1}})
    sources.push_back({point_at_vertex(mesh, extreme(mesh, direction)), 0});
  const Diagram d = solve_diagram(mesh, sources);
  EXPECT_TRUE(d.vertices.empty());
  ASSERT_EQ(d.edges.size(), 2u);
  for (std::uint32_t e = 0; e < 2; ++e) {
    const GvdEdge& edge = d.edges[e];
    EXPECT_TRUE(edge.closed);
    EXPECT_EQ(edge.end[0], edge.end[1]);
    EXPECT_EQ(d.arcs[edge.arcs.front()].node[0], d.arcs[edge.arcs.back()].node[1]);
    for (const BreakPoint& b : d.break_points) {
      const bool smaller = d.points[b.point].position < d.points[edge.end[0]].position;
      EXPECT_FALSE(b.edge == e && smaller);
    }
  }
  EXPECT_FALSE(d.break_points.empty());
  EXPECT_EQ(d.cells[0].euler, 1);
  EXPECT_EQ(d.cells[1].euler, 0);
  EXPECT_EQ(d.cells[2].euler, 1);
}

/// The same mesh with vertices, faces and corners renumbered; `to[v]` is the new id of vertex v.
MeshArrays renumbered(const MeshArrays& mesh, std::uint64_t seed, std::vector<VertexId>& to) {
  test::Random random(seed);
  const auto shuffle = [&](auto& list) {
    for (std::size_t i = list.size(); i-- > 1;) std::swap(list[i], list[random.below(static_cast<std::uint32_t>(i + 1))]);
  };
  to.resize(mesh.points.size());
  std::iota(to.begin(), to.end(), 0u);
  shuffle(to);
  MeshArrays out = mesh;
  for (std::size_t v = 0; v < to.size(); ++v) out.points[to[v]] = mesh.points[v];
  for (auto& face : out.faces) {
    for (auto& v : face) v = to[v];
    std::rotate(face.begin(), face.begin() + random.below(3), face.end());
  }
  shuffle(out.faces);
  return out;
}

class Invariance : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Invariance, RenumberingAndTurningFacesDoNotChangeTheCanonicalForm) {
  const MeshArrays arrays = test::random_terrain(8, 0.5, GetParam());
  const Mesh mesh(arrays);
  std::vector<VertexId> to;
  const Mesh other(renumbered(arrays, GetParam() + 100, to));
  const std::vector<VertexId> at{5, 17, 40, 63, 70};
  std::vector<Source> sources, other_sources;
  CanonicalNames names;
  for (SourceId s = 0; s < at.size(); ++s) {
    sources.push_back({point_at_vertex(mesh, at[s]), 0});
    const SourceId reversed = static_cast<SourceId>(at.size() - 1 - s);
    other_sources.push_back({point_at_vertex(other, to[at[reversed]]), 0});
    names.source.push_back(reversed);
  }
  EXPECT_EQ(canonical(solve_diagram(mesh, sources)), canonical(solve_diagram(other, other_sources), names));
}
std::vector<Source> at_vertices(const Mesh& mesh, std::uint64_t seed, std::size_t count) {
  test::Random random(seed);
  std::vector<Source> sources;
  std::set<VertexId> used;
  while (sources.size() < count) {
    const VertexId v = random.below(mesh.vertex_count());
    if (used.insert(v).second) sources.push_back({point_at_vertex(mesh, v), 0});
  }
  return sources;
}

/// Turning the axes round and scaling by a power of two changes the coordinates alone, bit for bit.
TEST_P(Invariance, TurningAxesAndScalingMovesTheCoordinatesExactly) {
  const MeshArrays arrays = ellipsoid(6);
  const auto moved = [](const Point& p) { return Point{p[1] * 0.125, p[2] * 0.125, p[0] * 0.125}; };
  MeshArrays other_arrays = arrays;
  for (Point& p : other_arrays.points) p = moved(p);
  const Mesh mesh(arrays), other(other_arrays);
  Diagram d = solve_diagram(mesh, at_vertices(mesh, GetParam(), 7));
  ASSERT_GT(d.vertices.size(), 5u);
  for (DiagramPoint& p : d.points) p.position = moved(p.position);
  EXPECT_EQ(canonical(d), canonical(solve_diagram(other, at_vertices(other, GetParam(), 7))));
}

TEST_P(Invariance, RenumberingAClosedSurface) {
  const MeshArrays arrays = ellipsoid(6);
  std::vector<VertexId> to;
  const Mesh mesh(arrays), other(renumbered(arrays, GetParam(), to));
  const std::vector<Source> sources = at_vertices(mesh, GetParam(), 7);
  std::vector<Source> other_sources;
  for (const Source& source : sources) other_sources.push_back({point_at_vertex(other, to[source.at.vertex]), 0});
  const Diagram d = solve_diagram(mesh, sources);
  EXPECT_EQ(canonical(d), canonical(solve_diagram(other, other_sources)));
  double area = 0;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    std::array<double, 3> u{}, v{};
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = mesh.point(mesh.target(3 * f))[i] - mesh.point(mesh.origin(3 * f))[i];
      v[i] = mesh.point(mesh.apex(3 * f))[i] - mesh.point(mesh.origin(3 * f))[i];
    }
    area += 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  }
  EXPECT_NEAR(total_area(d), area, 1e-11);
  // On a sphere of cells that are discs: V - E + F = 2.
  for (const Cell& cell : d.cells) EXPECT_EQ(cell.euler, 1);
  EXPECT_EQ(static_cast<int>(d.vertices.size()) - static_cast<int>(d.edges.size()) + static_cast<int>(d.cells.size()), 2);
}

/// Independent of how a point was built: it is as far from both images of each arc, and on the plane of its face.
TEST_P(Invariance, ArcEndsSatisfyTheirConic) {
  const Mesh mesh(ellipsoid(5));
  const Diagram d = solve_diagram(mesh, at_vertices(mesh, GetParam(), 6));
  std::size_t checked = 0;
  for (const Arc& arc : d.arcs) {
    const Point &a = mesh.point(mesh.origin(3 * arc.face)), &b = mesh.point(mesh.target(3 * arc.face)),
                &c = mesh.point(mesh.apex(3 * arc.face));
    // The frame of the face, from coordinates alone.
    std::array<double, 3> u{}, v{}, p{};
    for (const std::uint32_t node : arc.node) {
      double uu = 0, uv = 0, up = 0, vp = 0, vv = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
        p[i] = d.points[node].position[i] - a[i];
        uu += u[i] * u[i], uv += u[i] * v[i], up += u[i] * p[i], vp += v[i] * p[i], vv += v[i] * v[i];
      }
      const double x = up / std::sqrt(uu), y = (vp - uv * up / uu) / std::sqrt(vv - uv * uv / uu);
      std::array<double, 2> distance{};
      for (std::size_t side = 0; side < 2; ++side)
        distance[side] = arc.weight[side].value + std::hypot(x - arc.image[side][0].value, y - arc.image[side][1].value);
      EXPECT_NEAR(distance[0], distance[1], 1e-12);
      ++checked;
    }
  }
  EXPECT_GT(checked, 100u);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Invariance, ::testing::Range<std::uint64_t>(1, 6));

TEST(Diagram, ThreadsDoNotChangeAnything) {
  const Mesh mesh(test::random_terrain(8, 0.5, 11));
  std::vector<Source> sources;
  for (const VertexId v : {3u, 20u, 44u, 66u}) sources.push_back({point_at_vertex(mesh, v), 0});
  SolveOptions one, four;
  four.threads = 4;
  const Solution a = solve(mesh, sources, one), b = solve(mesh, sources, four);
  EXPECT_EQ(canonical(a.diagram()), canonical(b.diagram()));
  ASSERT_EQ(a.diagram().points.size(), b.diagram().points.size());
  for (std::size_t i = 0; i < a.diagram().points.size(); ++i)
    EXPECT_EQ(a.diagram().points[i].position, b.diagram().points[i].position);
}

}  // namespace
}  // namespace gvd::kernel
