#include "gvd/kernel/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "gvd/kernel/error.hpp"
#include "support/meshes.hpp"

namespace gvd::kernel {
namespace {

std::string refusal(const MeshArrays& arrays) {
  try {
    Mesh mesh(arrays);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// The laws of half-edges, counted independently with a map of directed edges.
void expect_consistent(const Mesh& mesh) {
  std::map<std::pair<VertexId, VertexId>, HalfedgeId> directed;
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    const auto [it, fresh] = directed.try_emplace({mesh.origin(h), mesh.target(h)}, h);
    EXPECT_TRUE(fresh) << "directed edge " << mesh.origin(h) << "->" << mesh.target(h) << " twice";
  }
  std::vector<std::size_t> degree(mesh.vertex_count(), 0);
  std::vector<bool> on_boundary(mesh.vertex_count(), false);
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    const auto other = directed.find({mesh.target(h), mesh.origin(h)});
    EXPECT_EQ(mesh.twin(h), other == directed.end() ? kNone : other->second);
    EXPECT_EQ(mesh.apex(h), mesh.target(Mesh::next(h)));
    ++degree[mesh.origin(h)];
    if (mesh.twin(h) == kNone) on_boundary[mesh.origin(h)] = on_boundary[mesh.target(h)] = true;
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    std::set<HalfedgeId> seen;
    HalfedgeId previous = kNone;
    mesh.for_each_outgoing(v, [&](HalfedgeId h) {
      EXPECT_EQ(mesh.origin(h), v);
      if (previous != kNone) {
        EXPECT_EQ(mesh.twin(Mesh::prev(previous)), h);
      }
      seen.insert(h);
      previous = h;
    });
    EXPECT_EQ(seen.size(), degree[v]);
    EXPECT_EQ(mesh.is_isolated(v), degree[v] == 0);
    EXPECT_EQ(mesh.is_boundary(v), on_boundary[v]);
  }
}

TEST(Mesh, HalfedgesOfOneTriangle) {
  const Mesh mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  EXPECT_EQ(mesh.vertex_count(), 3u);
  EXPECT_EQ(mesh.face_count(), 1u);
  EXPECT_EQ(mesh.origin(1), 1u);
  EXPECT_EQ(mesh.target(1), 2u);
  EXPECT_EQ(mesh.apex(1), 0u);
  EXPECT_EQ(mesh.twin(0), kNone);
  EXPECT_EQ(Mesh::next(2), 0u);
  EXPECT_EQ(Mesh::prev(0), 2u);
  expect_consistent(mesh);
}

TEST(Mesh, LawsHoldOnAllShapes) {
  for (const MeshArrays& arrays :
       {test::flat_grid(5, 3), test::flat_grid(4, 4, test::Diagonal::alternating), test::flat_grid(3, 3, test::Diagonal::falling),
        test::cube(4), test::box({3, 2, 1}, {3, 2, 1}), test::cone(7, 1, 2), test::saddle_fan(4, 0.5), test::integer_saddle(1),
        test::plane_with_hole(6, 5, 2, 4, 1, 3), test::random_terrain(8, 2, 1), test::integer_terrain(8, 3, 1),
        test::staircase(3, 2), test::roof(4, 3, 4, 3), test::fractal_terrain(4, 8, 0.6, 1)}) {
    const Mesh mesh(arrays);
    EXPECT_EQ(mesh.flipped_count(), 0u);
    expect_consistent(mesh);
    for (FaceId f = 0; f < mesh.face_count(); ++f) EXPECT_EQ(mesh.origin(3 * f), arrays.faces[f][0]);
  }
}

TEST(Mesh, KeepsIdsAndPointsAndSaysWhichFacesItTurned) {
  test::Random random(7);
  for (int round = 0; round < 50; ++round) {
    MeshArrays arrays = test::random_terrain(6, 1, 3);
    std::vector<bool> turned(arrays.faces.size());
    for (std::size_t f = 0; f < turned.size(); ++f) {
      if (!(turned[f] = random.below(3) == 0)) continue;
      std::swap(arrays.faces[f][1], arrays.faces[f][2]);
    }
    const Mesh mesh(arrays);
    expect_consistent(mesh);
    EXPECT_EQ(mesh.flipped_count(), static_cast<std::uint32_t>(std::count(turned.begin(), turned.end(), true)));
    for (FaceId f = 0; f < mesh.face_count(); ++f) {
      EXPECT_EQ(mesh.flipped(f), turned[f]);
      EXPECT_EQ(mesh.origin(3 * f), arrays.faces[f][0]);
      EXPECT_EQ(mesh.origin(3 * f + 1), arrays.faces[f][turned[f] ? 2 : 1]);
      EXPECT_EQ(mesh.origin(3 * f + 2), arrays.faces[f][turned[f] ? 1 : 2]);
      EXPECT_EQ(mesh.input_face(f), f);
    }
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(mesh.point(v), arrays.points[v]);
  }
}

TEST(Mesh, MajorityDecidesPerComponentAndTheLowestFaceOnADraw) {
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}, {7, 0, 0}};
  const Mesh draw({points, {{0, 2, 1}, {0, 2, 3}}});
  EXPECT_FALSE(draw.flipped(0));
  EXPECT_TRUE(draw.flipped(1));
  const Mesh two({points, {{0, 2, 1}, {4, 6, 5}, {4, 6, 7}, {5, 8, 6}, {0, 2, 3}}});
  EXPECT_FALSE(two.flipped(0));
  EXPECT_TRUE(two.flipped(1));  // faces 2 and 3 of its component are counter-clockwise
  EXPECT_FALSE(two.flipped(2));
  EXPECT_FALSE(two.flipped(3));
  EXPECT_TRUE(two.flipped(4));
}

TEST(Mesh, IsolatedVerticesStay) {
  const Mesh mesh({{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 7, 7}}, {{1, 2, 3}}});
  EXPECT_TRUE(mesh.is_isolated(0));
  EXPECT_FALSE(mesh.is_isolated(1));
  EXPECT_TRUE(mesh.is_isolated(4));
  EXPECT_FALSE(mesh.is_boundary(0));
  EXPECT_EQ(mesh.vertex_count(), 5u);
}

TEST(Mesh, ExactPointIsTheDouble) {
  const Mesh mesh({{{0.1, 0x1p-1074, 1e300}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  const ExactPoint p = mesh.exact_point(0);
  EXPECT_EQ(p[0], mpq_class("3602879701896397/36028797018963968"));
  EXPECT_EQ(p[1], mpq_class(1) / (mpq_class(mpz_class(1) << 1074)));
  EXPECT_EQ(p[2].get_d(), 1e300);
  EXPECT_TRUE(mesh.is_representable(2));
}

TEST(MeshRefusal, Empty) {
  EXPECT_EQ(refusal({}), "the mesh has no faces");
  EXPECT_EQ(refusal({{{0, 0, 0}}, {}}), "the mesh has no faces");
}

TEST(MeshRefusal, NotFinite) {
  for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    for (std::size_t k = 0; k < 3; ++k) {
      MeshArrays arrays = test::flat_grid(2, 2);
      arrays.points[5][k] = bad;
      EXPECT_EQ(refusal(arrays), "vertex 5: coordinate is not finite");
    }
  }
}

TEST(MeshRefusal, Indices) {
  MeshArrays arrays = test::flat_grid(2, 2);
  arrays.faces[3][1] = 9;
  EXPECT_EQ(refusal(arrays), "face 3: vertex 9 does not exist (there are 9 vertices)");
  arrays.faces[3][1] = kNone;
  EXPECT_EQ(refusal(arrays), "face 3: vertex 4294967295 does not exist (there are 9 vertices)");
}

TEST(MeshRefusal, RepeatedVertex) {
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
    MeshArrays arrays = test::flat_grid(2, 2);
    arrays.faces[6][a] = arrays.faces[6][b] = 4;
    EXPECT_EQ(refusal(arrays), "face 6: repeated vertex 4");
  }
}

TEST(MeshRefusal, ZeroArea) {
  EXPECT_EQ(refusal({{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}, {{0, 1, 2}}}), "face 0: zero area (vertices 0, 1, 2 are collinear)");
  EXPECT_EQ(refusal({{{1, 1, 1}, {1, 2, 3}, {1, 1, 1}}, {{1, 0, 2}}}), "face 0: zero area (vertices 1, 0, 2 are collinear)");
}

/// Area is decided exactly: one unit in the last place beside the line is a face, on it is none.
TEST(MeshRefusal, ZeroAreaIsExact) {
  const double x = 0.1, y = 0.3;
  const MeshArrays line = {{{0, 0, 0}, {x, y, 1}, {2 * x, 2 * y, 2}}, {{0, 1, 2}}};
  EXPECT_EQ(refusal(line), "face 0: zero area (vertices 0, 1, 2 are collinear)");
  for (const double to : {-9.0, 9.0}) {
    for (std::size_t v = 1; v < 3; ++v) {
      for (std::size_t k = 0; k < 3; ++k) {
        MeshArrays beside = line;
        beside.points[v][k] = std::nextafter(beside.points[v][k], to);
        EXPECT_EQ(refusal(beside), "accepted");
      }
    }
  }
}

TEST(MeshRefusal, ZeroAreaAtExtremeScales) {
  const double tiny = 0x1p-1074, huge = std::numeric_limits<double>::max();
  EXPECT_EQ(refusal({{{0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}}, {{0, 1, 2}}}), "accepted");
  EXPECT_EQ(refusal({{{0, 0, 0}, {tiny, 0, 0}, {3 * tiny, 0, 0}}, {{0, 1, 2}}}),
            "face 0: zero area (vertices 0, 1, 2 are collinear)");
  EXPECT_EQ(refusal({{{-huge, 0, 0}, {huge, 0, 0}, {0, huge, 0}}, {{0, 1, 2}}}), "accepted");
  EXPECT_EQ(refusal({{{-huge, -huge, 0}, {huge, huge, 0}, {1, 1, 0}}, {{0, 1, 2}}}),
            "face 0: zero area (vertices 0, 1, 2 are collinear)");
}

TEST(MeshRefusal, CrowdedEdge) {
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
  EXPECT_EQ(refusal({points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}), "edge 0-1: three faces 0, 1, 2");
  EXPECT_EQ(refusal({points, {{2, 0, 1}, {3, 1, 0}, {0, 1, 4}, {1, 5, 0}}}), "edge 0-1: 4 faces 0, 1, 2, 3");
}

TEST(MeshRefusal, SeveralFans) {
  const std::vector<Point> points = {{1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, 1, 5}, {0, -1, 5}};
  EXPECT_EQ(refusal({points, {{2, 0, 1}, {3, 4, 2}}}), "vertex 2: its faces form two fans (faces 0 and 1)");
  EXPECT_EQ(refusal({points, {{2, 0, 1}, {3, 4, 2}, {5, 2, 6}}}), "vertex 2: its faces form 3 fans (faces 0, 1 and 2)");
  // Two closed fans: two tetrahedra that share vertex 0.
  MeshArrays pinched = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                        {{1, 2, 3}, {0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {4, 6, 5}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}}};
  EXPECT_EQ(refusal(pinched), "vertex 0: its faces form two fans (faces 1 and 5)");
}

TEST(MeshRefusal, NotOrientable) {
  MeshArrays band;  // a Moebius band of five faces
  for (std::uint32_t i = 0; i < 5; ++i) {
    band.points.push_back({double(i), double(i * i), double(i * i * i)});
    band.faces.push_back({i, (i + 1) % 5, (i + 2) % 5});
  }
  EXPECT_EQ(refusal(band), "faces 2 and 3: not orientable (a band of faces across edge 3-4 comes back turned over)");
}

}  // namespace
}  // namespace gvd::kernel
