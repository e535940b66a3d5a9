#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gvd.h"
#include "gvd/predicates/strip_window.hpp"
#include "support/planar_strips.hpp"

namespace gvd::predicates {
namespace {

using test::FoldedStrip;
using test::Random;

std::array<double, 9> flat(const FaceCorners& c) {
  return {c[0][0], c[0][1], c[0][2], c[1][0], c[1][1], c[1][2], c[2][0], c[2][1], c[2][2]};
}
std::array<double, 3> flat(const FacePoint& p) { return {p.weight[0].get_d(), p.weight[1].get_d(), p.weight[2].get_d()}; }

gvd_strip* c_strip(const FoldedStrip& folded) {
  gvd_strip* strip = nullptr;
  EXPECT_EQ(gvd_strip_create(flat(test::in_space(folded.faces[0])).data(), flat(folded.source).data(), &strip), GVD_OK);
  for (std::size_t i = 1; i < folded.faces.size(); ++i)
    EXPECT_EQ(gvd_strip_cross(strip, flat(test::in_space(folded.faces[i])).data()), GVD_OK);
  return strip;
}

// The C functions say what the C++ ones say.
TEST(CInterface, SaysTheSameAsTheCxxFunctions) {
  Random random(11);
  for (int round = 0; round < 60; ++round) {
    const FoldedStrip first = test::random_strip(1 + random.below(6), random), second = test::random_strip(1 + random.below(6), random);
    const FaceStrip a = first.described(), b = second.described();
    gvd_strip *ca = c_strip(first), *cb = c_strip(second);
    ASSERT_EQ(gvd_strip_vertex_count(ca), a.vertex_count());
    for (std::size_t v = 3; v < a.vertex_count(); ++v) {
      gvd_decision d;
      ASSERT_EQ(gvd_ray_side(ca, 0, v, &d), GVD_OK);
      const Decision expected = ray_side(a, 0, v);
      EXPECT_EQ(d.sign, static_cast<int>(*expected.sign));
      EXPECT_EQ(d.stage, static_cast<int>(expected.stage));
    }
    gvd_cone cone;
    ASSERT_EQ(gvd_cone_of(ca, &cone), GVD_OK);
    EXPECT_EQ(cone.sight == GVD_SEES_INTERVAL, cone_of(a).sight == ConeDecision::Sight::interval);
    gvd_path *pa = nullptr, *pb = nullptr;
    const std::array<double, 3> end{1, 2, 3};
    ASSERT_EQ(gvd_path_create(0.5, &pa), GVD_OK);
    ASSERT_EQ(gvd_path_create(0, &pb), GVD_OK);
    ASSERT_EQ(gvd_path_add_leg(pa, ca, end.data()), GVD_OK);
    ASSERT_EQ(gvd_path_add_leg(pb, cb, end.data()), GVD_OK);
    gvd_strip_free(ca);  // it has been copied
    const Path xa{mpq_class(1, 2), {Leg(a, {{1, 2, 3}})}}, xb{0, {Leg(b, {{1, 2, 3}})}};
    gvd_decision d;
    ASSERT_EQ(gvd_compare_lengths(pa, pb, &d), GVD_OK);
    EXPECT_EQ(d.sign, static_cast<int>(*compare_lengths(xa, xb).sign));
    double value;
    gvd_stage stage;
    ASSERT_EQ(gvd_rounded_length(pa, &value, &stage), GVD_OK);
    EXPECT_EQ(value, rounded_length(xa).value);
    gvd_enclosure e;
    ASSERT_EQ(gvd_length(pa, &e), GVD_OK);
    EXPECT_LE(e.lower, value);
    EXPECT_GE(e.upper, value);
    gvd_window *wa = nullptr, *wb = nullptr;
    ASSERT_EQ(gvd_window_create(cb, nullptr, nullptr, &wa), GVD_OK);
    ASSERT_EQ(gvd_window_create(cb, pa, nullptr, &wb), GVD_OK);
    const auto corners = b.last_face();
    const std::array<double, 6> edge{corners[0][0], corners[0][1], corners[0][2], corners[1][0], corners[1][1], corners[1][2]};
    gvd_edge_ties ties;
    ASSERT_EQ(gvd_ties_on_edge(wa, wb, edge.data(), &ties), GVD_OK);
    EXPECT_EQ(ties.kind, GVD_TIES_NONE);  // the same image with more weight
    EXPECT_EQ(ties.a_is_nearer, 1);
    gvd_conflict_verdict verdict;
    ASSERT_EQ(gvd_conflict(flat(corners).data(), wa, wa, wa, wb, &verdict, &stage), GVD_OK);
    EXPECT_EQ(verdict, GVD_NO_VERTEX);
    gvd_window_free(wa);
    gvd_window_free(wb);
    gvd_path_free(pa);
    gvd_path_free(pb);
    gvd_strip_free(cb);
  }
}

TEST(CInterface, RefusesWithoutAnException) {
  gvd_strip* strip = nullptr;
  const double line[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, face[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, centre[3] = {1, 1, 1}, bad[3] = {NAN, 1, 1};
  EXPECT_EQ(gvd_strip_create(line, centre, &strip), GVD_INVALID_ARGUMENT);
  EXPECT_EQ(gvd_strip_create(face, bad, &strip), GVD_INVALID_ARGUMENT);
  EXPECT_EQ(gvd_strip_create(nullptr, centre, &strip), GVD_INVALID_ARGUMENT);
  EXPECT_EQ(strip, nullptr);
  ASSERT_EQ(gvd_strip_create(face, centre, &strip), GVD_OK);
  EXPECT_EQ(gvd_strip_cross(strip, line), GVD_INVALID_ARGUMENT);
  const uint32_t face_ids[3] = {0, 1, 7};
  EXPECT_EQ(gvd_strip_cross_indexed(strip, face, 3, face_ids), GVD_INVALID_ARGUMENT);
  EXPECT_EQ(gvd_strip_vertex_count(strip), 3u);
  gvd_cone cone;
  EXPECT_EQ(gvd_cone_of(strip, &cone), GVD_INVALID_ARGUMENT);
  gvd_window* window = nullptr;
  const std::size_t bounds[2] = {0, 9};
  EXPECT_EQ(gvd_window_create(strip, nullptr, bounds, &window), GVD_INVALID_ARGUMENT);
  gvd_path* path = nullptr;
  EXPECT_EQ(gvd_path_create(INFINITY, &path), GVD_INVALID_ARGUMENT);
  EXPECT_EQ(gvd_strip_vertex_count(nullptr), 0u);
  gvd_strip_free(strip);
  gvd_strip_free(nullptr);
  EXPECT_STREQ(gvd_stage_name(GVD_ALGEBRA), "algebra");
  EXPECT_STREQ(gvd_stage_name(static_cast<gvd_stage>(77)), "");
}

/// Two triangles below an edge of a facet, with a source at the far corner of each.
struct TwoBelow {
  static constexpr double kVertices[15] = {-2, 0, 0, 2, 0, 0, 0, 4, 0, -1, -4, 0, 1, -4, 0};
  static constexpr uint32_t kFacet[3] = {0, 1, 2}, kLeft[3] = {0, 3, 1}, kRight[3] = {0, 4, 1};
  static constexpr double kSecondCorner[3] = {0, 1, 0}, kFacetCorners[9] = {-2, 0, 0, 2, 0, 0, 0, 4, 0};

  static gvd_strip* strip(const uint32_t face[3]) {
    gvd_strip* result = nullptr;
    EXPECT_EQ(gvd_strip_create_indexed(kVertices, 5, face, kSecondCorner, &result), GVD_OK);
    EXPECT_EQ(gvd_strip_cross_indexed(result, kVertices, 5, kFacet), GVD_OK);
    return result;
  }
};

TEST(CInterface, TiesAndConflictsOfWindowsWithCones) {
  gvd_strip *left = TwoBelow::strip(TwoBelow::kLeft), *right = TwoBelow::strip(TwoBelow::kRight), *copy = nullptr;
  ASSERT_EQ(gvd_strip_copy(left, &copy), GVD_OK);
  EXPECT_EQ(gvd_strip_vertex_count(copy), 4u);
  gvd_strip_free(left);
  const size_t bounds[2] = {0, 2};  // the ends of the edge
  gvd_window *a = nullptr, *b = nullptr;
  ASSERT_EQ(gvd_window_create(copy, nullptr, bounds, &a), GVD_OK);
  ASSERT_EQ(gvd_window_create(right, nullptr, nullptr, &b), GVD_OK);
  const double edge[6] = {-2, 0, 0, 2, 0, 0};
  gvd_edge_ties ties;
  ASSERT_EQ(gvd_ties_on_edge(a, b, edge, &ties), GVD_OK);
  EXPECT_EQ(ties.kind, GVD_TIES_POINTS);
  ASSERT_EQ(ties.count, 1);
  EXPECT_LE(ties.ties[0].t.lower, 0.5);
  EXPECT_GE(ties.ties[0].t.upper, 0.5);
  EXPECT_NEAR(ties.ties[0].t.upper, ties.ties[0].t.lower, 1e-12);
  EXPECT_EQ(ties.ties[0].a_before, 1);
  EXPECT_EQ(ties.ties[0].is_contact, 0);
  gvd_conflict_verdict verdict;
  gvd_stage stage;
  EXPECT_EQ(gvd_conflict(TwoBelow::kFacetCorners, a, b, b, a, &verdict, &stage), GVD_OK);
  EXPECT_EQ(verdict, GVD_NO_VERTEX) << "two of the three are one";
  gvd_window_free(a);
  gvd_window_free(b);
  gvd_window_free(nullptr);
  gvd_path_free(nullptr);
  gvd_strip_free(right);
  gvd_strip_free(copy);
}

TEST(CInterface, NullIsRefusedWhereverItStands) {
  gvd_strip* strip = TwoBelow::strip(TwoBelow::kLeft);
  gvd_path* path = nullptr;
  gvd_window* window = nullptr;
  ASSERT_EQ(gvd_path_create(1, &path), GVD_OK);
  ASSERT_EQ(gvd_window_create(strip, path, nullptr, &window), GVD_OK);
  const double *corners = TwoBelow::kFacetCorners, *weights = TwoBelow::kSecondCorner, *vertices = TwoBelow::kVertices;
  const uint32_t* face = TwoBelow::kFacet;
  gvd_decision d;
  gvd_cone cone;
  gvd_enclosure e;
  gvd_edge_ties ties;
  gvd_conflict_verdict verdict;
  gvd_stage stage;
  double value;
  gvd_strip* made = nullptr;
  const std::vector<gvd_status> all = {
      gvd_strip_create(nullptr, weights, &made), gvd_strip_create(corners, nullptr, &made), gvd_strip_create(corners, weights, nullptr),
      gvd_strip_create_indexed(nullptr, 5, face, weights, &made), gvd_strip_create_indexed(vertices, 5, nullptr, weights, &made),
      gvd_strip_create_indexed(vertices, 5, face, nullptr, &made), gvd_strip_create_indexed(vertices, 5, face, weights, nullptr),
      gvd_strip_copy(nullptr, &made), gvd_strip_copy(strip, nullptr), gvd_strip_cross(nullptr, corners), gvd_strip_cross(strip, nullptr),
      gvd_strip_cross_indexed(nullptr, vertices, 5, face), gvd_strip_cross_indexed(strip, nullptr, 5, face),
      gvd_strip_cross_indexed(strip, vertices, 5, nullptr), gvd_ray_side(nullptr, 0, 2, &d), gvd_ray_side(strip, 0, 2, nullptr),
      gvd_cone_of(nullptr, &cone), gvd_cone_of(strip, nullptr), gvd_path_create(0, nullptr), gvd_path_add_leg(nullptr, strip, weights),
      gvd_path_add_leg(path, nullptr, weights), gvd_path_add_leg(path, strip, nullptr), gvd_compare_lengths(nullptr, path, &d),
      gvd_compare_lengths(path, nullptr, &d), gvd_compare_lengths(path, path, nullptr), gvd_length(nullptr, &e), gvd_length(path, nullptr),
      gvd_rounded_length(nullptr, &value, &stage), gvd_rounded_length(path, nullptr, &stage), gvd_rounded_length(path, &value, nullptr),
      gvd_window_create(nullptr, path, nullptr, &window), gvd_window_create(strip, path, nullptr, nullptr),
      gvd_ties_on_edge(nullptr, window, corners, &ties), gvd_ties_on_edge(window, nullptr, corners, &ties),
      gvd_ties_on_edge(window, window, nullptr, &ties), gvd_ties_on_edge(window, window, corners, nullptr),
      gvd_conflict(nullptr, window, window, window, window, &verdict, &stage), gvd_conflict(corners, nullptr, window, window, window, &verdict, &stage),
      gvd_conflict(corners, window, nullptr, window, window, &verdict, &stage), gvd_conflict(corners, window, window, nullptr, window, &verdict, &stage),
      gvd_conflict(corners, window, window, window, nullptr, &verdict, &stage), gvd_conflict(corners, window, window, window, window, nullptr, &stage),
      gvd_conflict(corners, window, window, window, window, &verdict, nullptr)};
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], GVD_INVALID_ARGUMENT) << i;
  EXPECT_EQ(made, nullptr);
  gvd_window_free(window);
  gvd_path_free(path);
  gvd_strip_free(strip);
}

}  // namespace
}  // namespace gvd::predicates
