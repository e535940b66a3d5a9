// Equalities that the kernel proves by names, not by numbers, on surfaces where a name alone would prove too much.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using test::MeshArrays;

/// A mountain of that height at (-5, 0) in a plane, on the way from (-10, 0), vertex 0, to (14, 0), vertex 1, all mirrored in the
/// line between them. Behind it, on that line, are the flat vertices 3 and 4: to either of them two ways are shortest, left and
/// right of the mountain.
MeshArrays mountain_between(double height) {
  MeshArrays mesh;
  mesh.points = {{-10, 0, 0}, {14, 0, 0}, {-5, 0, height}, {-2, 0, 0}, {0, 0, 0}};
  for (const double y : {1.0, -1.0})
    for (const auto& [px, py] : {std::pair{-10.0, 4.0}, {-6.0, 1.0}, {-5.0, 2.0}, {-4.0, 1.0}, {0.0, 4.0}, {4.0, 3.0}})
      mesh.points.push_back({px, y * py, 0});
  // Of the upper half a, b, c, ... = 5, 6, 7, ...; of the lower one six more. Faces over the line first.
  mesh.faces = {{0, 12, 6}, {2, 6, 12}, {2, 14, 8}, {3, 8, 14}, {4, 16, 10}, {16, 1, 10}};
  const std::vector<std::array<VertexId, 3>> upper = {{0, 6, 5},  {5, 6, 7}, {5, 7, 9}, {9, 7, 8}, {9, 8, 4},
                                                      {9, 4, 10}, {2, 7, 6}, {2, 8, 7}, {3, 4, 8}};
  for (const auto& f : upper) {
    const auto lower = [](VertexId v) { return v < 5 ? v : v + 6; };
    mesh.faces.push_back(f);
    mesh.faces.push_back({lower(f[0]), lower(f[2]), lower(f[1])});
  }
  return mesh;
}

// Left and right of a low mountain two windows of one source come to one flat vertex, over one distance, with images that doubles
// do not tell apart: they are two images all the same, and where the bisector of the sources crosses the line behind the mountain
// its conic changes.
TEST(Identities, TwoWaysToAFlatVertexAreNotOneImage) {
  for (const int bits : {10, 24, 28}) {
    SCOPED_TRACE(bits);
    const Mesh mesh(mountain_between(std::ldexp(1.0, -bits)));
    const auto solution = solve(mesh, {test::at_vertex(mesh, 0), test::at_vertex(mesh, 1)});
    ASSERT_TRUE(test::is_certified(solution));
    const Diagram& d = solution.diagram();
    EXPECT_EQ(d.break_points.size(), 9u);
    EXPECT_TRUE(std::any_of(d.break_points.begin(), d.break_points.end(),
                            [&](const auto& b) { return d.points[b.point].position[1] == 0; }));
  }
}

/// A flat sheet, 16 wide, with vertices 0 and 1 at the ends of a line across it, 2 and 3 mirror images in this line, and, above it,
/// a hole from x = `low` to `high` and, if `twice`, everything between x = 2 and x = 8 cut away.
MeshArrays sheet_with_holes(double low, double high, bool twice) {
  MeshArrays mesh;
  mesh.points = {{-8, 0, 0},  {8, 0, 0},  {0, 12, 0},   {0, -12, 0}, {0, 4, 0}, {low, 6, 0}, {high, 6, 0}, {(low + high) / 2, 7, 0},
                 {-8, 12, 0}, {8, 12, 0}, {-8, -12, 0}, {8, -12, 0}};
  mesh.faces = {{0, 1, 4}, {0, 4, 5}, {4, 6, 5}, {0, 5, 8}, {8, 5, 7}, {8, 7, 2}, {0, 10, 3}, {0, 3, 1}, {3, 11, 1}};
  const auto add = [&](std::initializer_list<std::array<VertexId, 3>> faces) { mesh.faces.insert(mesh.faces.end(), faces); };
  if (twice) {
    mesh.points.insert(mesh.points.end(), {{2, 6, 0}, {8, 7, 0}});
    add({{4, 12, 6}, {4, 1, 12}, {2, 12, 13}, {2, 13, 9}, {6, 12, 2}, {6, 2, 7}});
  } else {
    add({{4, 1, 6}, {2, 7, 9}, {7, 6, 9}, {9, 6, 1}});
  }
  return mesh;
}

// Two windows see the line on either side of a hole: one image, and the mirror image of the other source's. Each of them touches
// the wave that comes over the line wherever it sees it, whatever else has the same image; in the shadows of the holes the other
// source is nearer.
TEST(Identities, WindowsBesideAHoleHaveOneMirrorImage) {
  for (const bool twice : {false, true}) {
    SCOPED_TRACE(twice);
    const Mesh mesh(twice ? sheet_with_holes(-3, -1, true) : sheet_with_holes(-1, 1, false));
    const auto solution = solve(mesh, {test::at_vertex(mesh, 2), test::at_vertex(mesh, 3)});
    ASSERT_TRUE(test::is_certified(solution));
    const Diagram& d = solution.diagram();
    // Pieces of the line that the upper source sees past its holes.
    std::vector<std::pair<double, double>> along;
    for (const Arc& arc : d.arcs) {
      const Point &p = d.points[arc.node[0]].position, &q = d.points[arc.node[1]].position;
      if (arc.along_edge) along.push_back({std::min(p[0], q[0]), std::max(p[0], q[0])});
    }
    std::sort(along.begin(), along.end());
    const std::vector<std::pair<double, double>> expected = twice ? std::vector<std::pair<double, double>>{{-8, -6}, {-2, 4}}
                                                                  : std::vector<std::pair<double, double>>{{-8, -2}, {2, 8}};
    EXPECT_EQ(along, expected);
    EXPECT_GT(d.cells[1].area, 192);
  }
}

}  // namespace
}  // namespace gvd::kernel
