#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gvd/robust/rational.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using test::ExactPoint2;
using test::Random;

/// The Voronoi diagram of points of a rectangle, clipped to it, from CGAL's Delaunay triangulation; all in rationals.
class PlanarVoronoi {
 public:
  using Vertex = std::pair<ExactPoint2, std::vector<SourceId>>;  ///< place, all nearest sources

  PlanarVoronoi(const std::vector<ExactPoint2>& sites, const ExactPoint2& high) : sites_(sites), high_(high) {
    for (SourceId s = 0; s < sites.size(); ++s)
      triangulation_.insert(Kernel::Point_2(field(sites[s][0]), field(sites[s][1])))->info() = s;
    find_vertices();
    find_edges();
  }

  /// Voronoi vertices inside the rectangle.
  const std::set<Vertex>& vertices() const { return vertices_; }
  /// Pairs of sources whose common Voronoi edge has a piece of positive length inside the rectangle.
  const std::set<std::array<SourceId, 2>>& dual() const { return dual_; }
  /// Points of the sides where an edge crosses the boundary (not in a vertex of the diagram).
  std::size_t side_meetings() const { return side_meetings_.size(); }
  /// Whether nothing happens exactly on the boundary but crossings of its sides.
  bool is_generic() const { return generic_; }

 private:
  using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
  using Base = CGAL::Triangulation_vertex_base_with_info_2<SourceId, Kernel>;
  using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Base>>;

  static CGAL::Gmpq field(const mpq_class& x) { return CGAL::Gmpq(x.get_mpq_t()); }
  bool inside(const ExactPoint2& p) const { return sgn(p[0]) > 0 && sgn(p[1]) > 0 && p[0] < high_[0] && p[1] < high_[1]; }
  bool on_boundary(const ExactPoint2& p) const {
    return !inside(p) && sgn(p[0]) >= 0 && sgn(p[1]) >= 0 && p[0] <= high_[0] && p[1] <= high_[1];
  }
  mpq_class squared(const ExactPoint2& p, SourceId s) const {
    return test::square(p[0] - sites_[s][0]) + test::square(p[1] - sites_[s][1]);
  }
  ExactPoint2 circumcentre(SourceId a, SourceId b, SourceId c) const {
    const ExactPoint2 u{sites_[b][0] - sites_[a][0], sites_[b][1] - sites_[a][1]},
        v{sites_[c][0] - sites_[a][0], sites_[c][1] - sites_[a][1]};
    const mpq_class d = 2 * (u[0] * v[1] - u[1] * v[0]), uu = u[0] * u[0] + u[1] * u[1], vv = v[0] * v[0] + v[1] * v[1];
    return {mpq_class(sites_[a][0] + (v[1] * uu - u[1] * vv) / d), mpq_class(sites_[a][1] + (u[0] * vv - v[0] * uu) / d)};
  }
  void find_vertices() {
    for (auto f = triangulation_.finite_faces_begin(); f != triangulation_.finite_faces_end(); ++f) {
      const SourceId a = f->vertex(0)->info();
      const ExactPoint2 centre = circumcentre(a, f->vertex(1)->info(), f->vertex(2)->info());
      generic_ = generic_ && !on_boundary(centre);
      if (!inside(centre)) continue;
      std::vector<SourceId> nearest;
      for (SourceId s = 0; s < sites_.size(); ++s)
        if (squared(centre, s) == squared(centre, a)) nearest.push_back(s);
      vertices_.insert({centre, nearest});
    }
  }
  /// The points of the bisector of a and b where no site is nearer, clipped to the rectangle: an interval of its parameter.
  void find_edges() {
    for (auto e = triangulation_.finite_edges_begin(); e != triangulation_.finite_edges_end(); ++e) {
      const SourceId a = e->first->vertex((e->second + 1) % 3)->info(), b = e->first->vertex((e->second + 2) % 3)->info();
      clip(std::min(a, b), std::max(a, b));
    }
  }
  void clip(SourceId a, SourceId b) {
    const ExactPoint2 &p = sites_[a], &q = sites_[b];
    const ExactPoint2 middle{mpq_class((p[0] + q[0]) / 2), mpq_class((p[1] + q[1]) / 2)},
        along{mpq_class(p[1] - q[1]), mpq_class(q[0] - p[0])};
    std::optional<mpq_class> low, high;
    bool low_is_side = false, high_is_side = false, empty = false;
    // Keeps the t with slope * t <= bound.
    const auto keep = [&](const mpq_class& slope, const mpq_class& bound, bool side) {
      if (sgn(slope) == 0) {
        empty = empty || sgn(bound) < 0 || (side && sgn(bound) == 0);
        return;
      }
      const mpq_class t = bound / slope;
      if (sgn(slope) > 0 && (!high || t < *high)) high = t, high_is_side = side;
      if (sgn(slope) < 0 && (!low || t > *low)) low = t, low_is_side = side;
    };
    for (std::size_t k = 0; k < 2; ++k) {
      keep(-along[k], middle[k], true);
      keep(along[k], high_[k] - middle[k], true);
    }
    for (SourceId s = 0; s < sites_.size(); ++s) {
      if (s == a || s == b) continue;
      // |x - a|^2 <= |x - s|^2 for x = middle + t along.
      mpq_class slope, bound;
      for (std::size_t k = 0; k < 2; ++k) {
        slope += 2 * (sites_[s][k] - p[k]) * along[k];
        bound += test::square(middle[k] - sites_[s][k]) - test::square(middle[k] - p[k]);
      }
      keep(slope, bound, false);
    }
    if (empty || !low || !high || *low >= *high) return;
    dual_.insert({a, b});
    const auto at = [&](const mpq_class& t) {
      return ExactPoint2{mpq_class(middle[0] + t * along[0]), mpq_class(middle[1] + t * along[1])};
    };
    if (low_is_side) side_meetings_.insert(at(*low));
    if (high_is_side) side_meetings_.insert(at(*high));
  }

  std::vector<ExactPoint2> sites_;
  ExactPoint2 high_;
  Triangulation triangulation_;
  std::set<Vertex> vertices_;
  std::set<std::array<SourceId, 2>> dual_;
  std::set<ExactPoint2> side_meetings_;
  bool generic_ = true;
};

/// `placed` is the image of the mesh `flat` of the rectangle [0, high] under `place`, an isometry with rational coefficients.
void expect_planar_voronoi(const test::MeshArrays& flat, const test::MeshArrays& placed, const ExactPoint2& high,
                           const std::function<ExactPoint(const ExactPoint2&)>& place, const std::vector<Source>& sources,
                           const std::string& what) {
  SCOPED_TRACE(what);
  const Mesh plane(flat), mesh(placed);
  std::vector<ExactPoint2> sites;
  for (const Source& s : sources) {
    const ExactPoint p = exact_position(plane, s.at);
    sites.push_back({p[0], p[1]});
  }
  const PlanarVoronoi truth(sites, high);
  const auto solution = solve(mesh, sources);
  EXPECT_TRUE(test::is_certified(solution));
  if (solution.status() != Status::certified) return;
  const Diagram& diagram = solution.diagram();

  std::set<std::array<SourceId, 2>> dual;
  for (const DualEdge& e : diagram.dual) dual.insert(e.sources);
  EXPECT_EQ(dual, truth.dual());

  // Correctly rounded coordinates, and the sources at each vertex; what lies on the boundary is counted below.
  using Rounded = std::pair<Point, std::vector<SourceId>>;
  std::set<Rounded> expected, found;
  for (const auto& [centre, nearest] : truth.vertices()) {
    Point rounded;
    const ExactPoint exact = place(centre);
    for (std::size_t k = 0; k < 3; ++k) rounded[k] = robust::RootSum(exact[k]).rounded();
    expected.insert({rounded, nearest});
  }
  std::size_t on_boundary = 0;
  for (const GvdVertex& v : diagram.vertices) {
    if (v.on_boundary) {
      ++on_boundary;
      continue;
    }
    EXPECT_EQ(v.edges.size(), v.sources.size());
    found.insert({diagram.points[v.point].position, v.sources});
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(diagram.break_points.size(), 0u);
  for (const Arc& arc : diagram.arcs) EXPECT_EQ(arc.conic, Arc::Conic::line);
  if (truth.is_generic()) {
    EXPECT_EQ(on_boundary, 0u);
    EXPECT_EQ(diagram.boundary_meetings.size(), truth.side_meetings());
    EXPECT_EQ(diagram.edges.size(), truth.dual().size());
  }
  for (const Cell& cell : diagram.cells) EXPECT_EQ(cell.euler, 1);
}

/// Distinct sources at vertices and inside faces.
std::vector<Source> random_sources(const Mesh& mesh, Random& random, std::uint32_t count, bool at_vertices) {
  std::vector<Source> sources;
  std::set<ExactPoint> taken;
  while (sources.size() < count) {
    Source s = at_vertices || random.below(3) == 0 ? test::at_vertex(mesh, random.below(mesh.vertex_count()))
                                                   : test::inside_face(mesh, random.below(mesh.face_count()), random);
    if (taken.insert(exact_position(mesh, s.at)).second) sources.push_back(std::move(s));
  }
  return sources;
}

ExactPoint level(const ExactPoint2& p) { return {p[0], p[1], 0}; }

TEST(PlanarVoronoi, JitteredGrids) {
  Random random(31);
  for (std::uint32_t round = 0; round < 6; ++round) {
    const auto mesh = test::jittered_grid(7, 6, 0.29, 800 + round);
    const auto sources = random_sources(Mesh(mesh), random, 3 + 3 * round, false);
    expect_planar_voronoi(mesh, mesh, {7, 6}, level, sources, "round " + std::to_string(round));
  }
}

TEST(PlanarVoronoi, IntegerGrids) {
  Random random(32);
  for (std::uint32_t round = 0; round < 4; ++round) {
    const auto mesh = test::flat_grid(6, 6, test::Diagonal::alternating);
    const auto sources = random_sources(Mesh(mesh), random, 3 + 2 * round, false);
    expect_planar_voronoi(mesh, mesh, {6, 6}, level, sources, "round " + std::to_string(round));
  }
}

TEST(PlanarVoronoi, LatticeSources) {
  // Sources on a lattice: four cocircular round every vertex, edges along mesh edges and through mesh vertices.
  for (const std::uint32_t step : {2u, 3u}) {
    const auto mesh = test::flat_grid(2 * step, 2 * step);
    std::vector<Source> sources;
    for (std::uint32_t j = 0; j <= 2; ++j)
      for (std::uint32_t i = 0; i <= 2; ++i) sources.push_back(test::at_vertex(Mesh(mesh), j * step * (2 * step + 1) + i * step));
    expect_planar_voronoi(mesh, mesh, {2 * step, 2 * step}, level, sources, "step " + std::to_string(step));
  }
}

TEST(PlanarVoronoi, RandomLatticeSources) {
  Random random(33);
  for (std::uint32_t round = 0; round < 4; ++round) {
    const auto mesh = test::flat_grid(6, 5);
    const auto sources = random_sources(Mesh(mesh), random, 4 + 2 * round, true);
    expect_planar_voronoi(mesh, mesh, {6, 5}, level, sources, "round " + std::to_string(round));
  }
}

TEST(PlanarVoronoi, TiltedPlane) {
  // Turned about the x axis by the angle of 3-4-5.
  Random random(34);
  for (std::uint32_t round = 0; round < 4; ++round) {
    auto flat = test::flat_grid(6, 3, test::Diagonal::alternating);
    auto placed = flat;
    for (std::size_t v = 0; v < flat.points.size(); ++v) {
      placed.points[v] = {flat.points[v][0], 3 * flat.points[v][1], 4 * flat.points[v][1]};
      flat.points[v][1] *= 5;
    }
    const auto sources = random_sources(Mesh(flat), random, 4 + 2 * round, false);
    expect_planar_voronoi(
        flat, placed, {6, 15},
        [](const ExactPoint2& p) {
          return ExactPoint{p[0], mpq_class(p[1] * 3 / 5), mpq_class(p[1] * 4 / 5)};
        },
        sources, "round " + std::to_string(round));
  }
}

}  // namespace
}  // namespace gvd::kernel
