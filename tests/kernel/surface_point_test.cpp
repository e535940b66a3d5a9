#include "gvd/kernel/surface_point.hpp"

#include <gtest/gtest.h>

#include "gvd/kernel/error.hpp"
#include "support/refusal.hpp"

namespace gvd::kernel {
namespace {

using test::refusal;

/// Face 1 is given the other way round; faces 0 and 2 outvote it. Vertex 5 is isolated.
Mesh strip() {
  return Mesh({{{0, 0, 0}, {2, 0, 0}, {0, 2, 1}, {2, 2, 1}, {4, 2, 0}, {9, 9, 9}}, {{0, 1, 2}, {1, 2, 3}, {1, 4, 3}}});
}

TEST(SurfacePoint, AtAVertex) {
  const Mesh mesh = strip();
  for (VertexId v = 0; v < 6; ++v) {
    const SurfacePoint at = point_at_vertex(mesh, v);
    EXPECT_EQ(exact_position(mesh, at), mesh.exact_point(v));
    EXPECT_EQ(locate(mesh, at).kind, Location::Kind::vertex);
    EXPECT_EQ(locate(mesh, at).vertex, v);
  }
  EXPECT_EQ(refusal([&] { point_at_vertex(mesh, 6); }), "vertex 6 does not exist (there are 6 vertices)");
}

TEST(SurfacePoint, OnAnEdge) {
  const Mesh mesh = strip();
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    for (HalfedgeId h = 3 * f; h < 3 * f + 3; ++h) {
      for (const bool forward : {true, false}) {
        const VertexId a = forward ? mesh.origin(h) : mesh.target(h), b = forward ? mesh.target(h) : mesh.origin(h);
        const SurfacePoint at = point_on_edge(mesh, a, b, mpq_class(1, 3));
        const ExactPoint p = mesh.exact_point(a), q = mesh.exact_point(b), found = exact_position(mesh, at);
        for (int i = 0; i < 3; ++i) EXPECT_EQ(found[i], p[i] + (q[i] - p[i]) / 3);
        const Location where = locate(mesh, at);
        EXPECT_EQ(where.kind, Location::Kind::edge);
        EXPECT_TRUE(where.halfedge == h || where.halfedge == mesh.twin(h));
        EXPECT_EQ(Mesh::face(where.halfedge), at.face);
        EXPECT_EQ(point_on_edge(mesh, a, b, 0).vertex, a);
        EXPECT_EQ(point_on_edge(mesh, a, b, 1).vertex, b);
      }
    }
  }
}

TEST(SurfacePoint, OnAnEdgeRefusals) {
  const Mesh mesh = strip();
  EXPECT_EQ(refusal([&] { point_on_edge(mesh, 0, 3, 0); }), "no edge joins vertices 0 and 3");
  EXPECT_EQ(refusal([&] { point_on_edge(mesh, 1, 1, 0); }), "no edge joins vertices 1 and 1");
  EXPECT_EQ(refusal([&] { point_on_edge(mesh, 5, 1, 0); }), "no edge joins vertices 5 and 1");
  EXPECT_EQ(refusal([&] { point_on_edge(mesh, 1, 5, 0); }), "no edge joins vertices 1 and 5");
  EXPECT_EQ(refusal([&] { point_on_edge(mesh, 7, 1, 0); }), "vertex 7 does not exist (there are 6 vertices)");
  EXPECT_EQ(refusal([&] { point_on_edge(mesh, 1, 8, 0); }), "vertex 8 does not exist (there are 6 vertices)");
  EXPECT_EQ(refusal([&] { point_on_edge(mesh, 0, 1, mpq_class(3, 2)); }), "the parameter 1.5 on edge 0-1 lies outside [0, 1]");
  EXPECT_EQ(refusal([&] { point_on_edge(mesh, 0, 1, mpq_class(-1, 4)); }), "the parameter -0.25 on edge 0-1 lies outside [0, 1]");
}

TEST(SurfacePoint, InAFaceTheCornersAreThoseOfTheInput) {
  const Mesh mesh = strip();
  ASSERT_TRUE(mesh.flipped(1));
  const std::array<std::array<VertexId, 3>, 3> given{{{0, 1, 2}, {1, 2, 3}, {1, 4, 3}}};
  for (FaceId f = 0; f < 3; ++f) {
    const ExactPoint found = exact_position(mesh, point_in_face(mesh, f, {mpq_class(2), mpq_class(3), mpq_class(5)}));
    for (int i = 0; i < 3; ++i) {
      const mpq_class expected =
          (2 * mesh.exact_point(given[f][0])[i] + 3 * mesh.exact_point(given[f][1])[i] + 5 * mesh.exact_point(given[f][2])[i]) / 10;
      EXPECT_EQ(found[i], expected);
    }
    EXPECT_EQ(point_in_face(mesh, f, {0, 0, mpq_class(1, 7)}).vertex, given[f][2]);
    EXPECT_EQ(point_in_face(mesh, f, {0, 4, 0}).vertex, given[f][1]);
    EXPECT_EQ(locate(mesh, point_in_face(mesh, f, {0, 4, 1})).kind, Location::Kind::edge);
    EXPECT_EQ(locate(mesh, point_in_face(mesh, f, {1, 4, 1})).kind, Location::Kind::face);
  }
}

TEST(SurfacePoint, InAFaceRefusals) {
  const Mesh mesh = strip();
  EXPECT_EQ(refusal([&] { point_in_face(mesh, 3, {1, 1, 1}); }), "face 3 does not exist (there are 3 faces)");
  EXPECT_EQ(refusal([&] { point_in_face(mesh, 1, {1, 1, -1}); }), "face 1: weight -1 of corner 2 is negative");
  EXPECT_EQ(refusal([&] { point_in_face(mesh, 0, {0, 0, 0}); }), "face 0: the weights of all corners are zero");
}

}  // namespace
}  // namespace gvd::kernel
