#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "gvd/io/mesh_reader.hpp"
#include "gvd/kernel/random_sources.hpp"
#include "gvd/kernel/solver.hpp"

namespace gvd::kernel {
namespace {

using robust::Stage;

double area(const Mesh& mesh, FaceId f) {
  const Point &a = mesh.point(mesh.origin(3 * f)), &b = mesh.point(mesh.origin(3 * f + 1)), &c = mesh.point(mesh.origin(3 * f + 2));
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2], vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  return std::hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
}

/// The article's terrain with 30 random sources; the folder is not part of the repository.
class StHelens : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const char* const folder = std::getenv("GVD_TEST_DATA");
    if (folder == nullptr) return;
    const auto path = std::filesystem::path(folder) / "st_helens_tin.vtk";
    if (!std::filesystem::exists(path)) return;
    mesh_.emplace(io::read_mesh(path));
    SolveOptions options;
    options.threads = 2;
    solution_.emplace(solve(*mesh_, random_surface_sources(*mesh_, kSources, 1), options));
  }
  static void TearDownTestSuite() { solution_.reset(), mesh_.reset(); }
  void SetUp() override {
    if (!mesh_) GTEST_SKIP() << "st_helens_tin.vtk is not in $GVD_TEST_DATA";
    ASSERT_TRUE(is_complete(solution_->status()));
  }

  static constexpr std::uint64_t kSources = 30;
  inline static std::optional<Mesh> mesh_;
  inline static std::optional<Solution> solution_;
};

TEST_F(StHelens, IsCertified) {
  EXPECT_EQ(solution_->status(), Status::certified);
  EXPECT_TRUE(solution_->decisions().undecided_list().empty());
  EXPECT_TRUE(solution_->diagram().undecided_faces.empty());
  EXPECT_TRUE(solution_->diagram().open_ends.empty());
}

TEST_F(StHelens, CountsArePlausible) {
  const Summary& s = solution_->summary();
  EXPECT_EQ(s.sources, kSources);
  EXPECT_EQ(s.components, 1u);
  EXPECT_EQ(s.unreachable_vertices, 0u);
  EXPECT_EQ(s.cells, kSources);
  EXPECT_EQ(s.ties, 0u);
  EXPECT_LT(s.windows_kept, s.windows_propagated);
  EXPECT_GT(s.windows_kept, s.windows_propagated * 9 / 10);
  // A planar graph with vertices of degree three, and about six neighbours a cell less those of the boundary.
  EXPECT_GE(s.gvd_vertices, kSources / 2);
  EXPECT_LE(s.gvd_vertices, 2 * kSources);
  EXPECT_GE(s.gvd_edges, s.gvd_vertices);
  EXPECT_LE(s.gvd_edges, 3 * kSources);
  EXPECT_LE(s.dual_edges, s.gvd_edges);
  EXPECT_GE(s.dual_edges, kSources - 1);
  EXPECT_GT(s.break_points, 100u);
  EXPECT_GT(s.boundary_facets, 500u);
  EXPECT_LT(s.boundary_facets, 17222u / 4);
}

TEST_F(StHelens, CellsCoverTheSurface) {
  double surface = 0, cells = 0;
  for (FaceId f = 0; f < mesh_->face_count(); ++f) surface += area(*mesh_, f);
  for (const Cell& cell : solution_->diagram().cells) {
    EXPECT_GT(cell.area, 0);
    cells += cell.area;
  }
  for (const SharedRegion& region : solution_->diagram().shared) cells -= region.area;
  EXPECT_NEAR(cells / surface, 1, 1e-9);
}

TEST_F(StHelens, EulerCharacteristicOfTheWhole) {
  // The closed cells count what they share more than once: an open edge (characteristic -1) twice, a closed edge (0) twice, a point
  // as often as cells meet there. Taking away the surplus must leave the characteristic of the surface, a disc.
  const Diagram& d = solution_->diagram();
  std::int64_t sum = 0;
  for (const Cell& cell : d.cells) sum += cell.euler;
  for (const GvdEdge& e : d.edges) sum += e.closed ? 0 : 1;
  for (const GvdVertex& v : d.vertices) sum -= static_cast<std::int64_t>(v.edges.size()) - (v.on_boundary ? 0 : 1);
  sum -= static_cast<std::int64_t>(d.boundary_meetings.size());
  EXPECT_EQ(sum, 1);
}

TEST_F(StHelens, IdentityAndFilterDecide) {
  const auto& d = solution_->decisions();
  double cheap = 0, all = 0;
  for (std::size_t p = 0; p < predicates::kPredicateCount; ++p) {
    if (static_cast<predicates::Predicate>(p) == predicates::Predicate::rounding) continue;
    for (std::size_t s = 0; s < robust::kStageCount; ++s) {
      const auto stage = static_cast<Stage>(s);
      const auto count = static_cast<double>(d(p, stage));
      all += count;
      if (stage == Stage::identity || stage == Stage::filter) cheap += count;
    }
  }
  EXPECT_GT(all, 5e5);
  EXPECT_GT(cheap / all, 0.99999);
}

}  // namespace
}  // namespace gvd::kernel
