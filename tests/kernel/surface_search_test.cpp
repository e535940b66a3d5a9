#include "gvd/kernel/surface_search.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gvd/kernel/error.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "support/meshes.hpp"
#include "support/nearest_reference.hpp"
#include "support/refusal.hpp"

namespace gvd::kernel {
namespace {

using gvd::test::expect_nearest;
using gvd::test::refusal;

Mesh grid(std::uint32_t n, unsigned seed, double scale = 1) {
  std::mt19937 random(seed);
  return Mesh(test::grid(n, n, [&](auto, auto) { return (random() % 5) * scale; }, test::Diagonal::falling, scale));
}

TEST(Nearest, TheSevenRegionsOfATriangle) {
  const Mesh mesh({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}});
  const SurfaceSearch search(mesh);
  const auto at = [&](double x, double y) { return exact_position(mesh, search.nearest({x, y, 3}).at); };
  EXPECT_EQ(at(1, 1), (ExactPoint{1, 1, 0}));
  EXPECT_EQ(at(-1, -2), (ExactPoint{0, 0, 0}));
  EXPECT_EQ(at(9, 1), (ExactPoint{4, 0, 0}));
  EXPECT_EQ(at(-1, 9), (ExactPoint{0, 4, 0}));
  EXPECT_EQ(at(1, -5), (ExactPoint{1, 0, 0}));
  EXPECT_EQ(at(-5, 3), (ExactPoint{0, 3, 0}));
  EXPECT_EQ(at(3, 4), (ExactPoint{mpq_class(3, 2), mpq_class(5, 2), 0}));
  EXPECT_EQ(search.nearest({1, 1, 3}).distance, 3);
  EXPECT_EQ(search.nearest({1, 1, 3}).squared_distance, 9);
  EXPECT_EQ(search.nearest({8, 0, 3}).distance, 5);
  EXPECT_EQ(search.nearest({8, 0, 3}).at.vertex, 1u);
}

TEST(Nearest, ATieGivesTheLowestFace) {
  // Two parallel triangles, the point half-way and one ulp off.
  const Mesh mesh({{{0, 0, 2}, {4, 0, 2}, {0, 4, 2}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}, {3, 4, 5}}});
  EXPECT_EQ(SurfaceSearch(mesh).nearest({1, 1, 1}).at.face, 0u);
  EXPECT_EQ(SurfaceSearch(mesh).nearest({1, 1, 0x1.fffffffffffffp-1}).at.face, 1u);
  EXPECT_EQ(SurfaceSearch(mesh).nearest({1, 1, 0x1.0000000000001p0}).at.face, 0u);
}

TEST(Nearest, AgreesWithBruteForce) {
  std::mt19937 random(11);
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Mesh mesh = grid(6, seed);
    const SurfaceSearch search(mesh);
    for (int i = 0; i < 60; ++i) {
      // Quarters: many are ties.
      const auto draw = [&] { return double(random() % 40) / 4 - 2; };
      expect_nearest(mesh, search, {draw(), draw(), draw()});
    }
  }
}

TEST(Nearest, AgreesWithBruteForceAtAnyScale) {
  for (const double scale : {0x1p-1060, 0x1p-540, 0x1.8p-500, 0x1p505, 0x1p520, 0x1p1020}) {
    const Mesh mesh = grid(3, 4, scale);
    const SurfaceSearch search(mesh);
    std::mt19937 random(12);
    for (int i = 0; i < 10; ++i) {
      const auto draw = [&] { return (double(random() % 16) / 2 - 2) * scale; };
      expect_nearest(mesh, search, {draw(), draw(), draw()});
    }
  }
}

RC_GTEST_PROP(Nearest, PointsOfTheSurfaceAreAtDistanceZero, ()) {
  const Mesh mesh = grid(5, 9);
  const FaceId face = *rc::gen::inRange<FaceId>(0, mesh.face_count());
  SurfacePoint at;
  at.face = face;
  at.bary[1] = mpq_class(*rc::gen::inRange(0, 9), 16);
  at.bary[2] = mpq_class(*rc::gen::inRange(0, 8), 16);
  at.bary[1].canonicalize();
  at.bary[2].canonicalize();
  at.bary[0] = 1 - at.bary[1] - at.bary[2];
  const ExactPoint p = exact_position(mesh, at);  // dyadic: doubles hold it
  const NearestPoint found = SurfaceSearch(mesh).nearest({p[0].get_d(), p[1].get_d(), p[2].get_d()});
  RC_ASSERT(found.squared_distance == 0);
  RC_ASSERT(found.distance == 0.0);
  RC_ASSERT(exact_position(mesh, found.at) == p);
}

TEST(Nearest, RefusesWhatIsNotFinite) {
  const Mesh mesh = grid(1, 1);
  EXPECT_EQ(refusal([&] { SurfaceSearch(mesh).nearest({0, INFINITY, 0}); }), "the coordinate inf is not finite");
  EXPECT_EQ(refusal([&] { SurfaceSearch(mesh).nearest({NAN, 0, 0}); }), "the coordinate nan is not finite");
}

TEST(Drop, OntoFacesEdgesAndVertices) {
  const Mesh mesh = grid(4, 5);
  const SurfaceSearch search(mesh);
  for (double y = 0; y <= 4; y += 0.25) {
    for (double x = 0; x <= 4; x += 0.25) {
      const SurfacePoint at = search.drop(x, y);
      const ExactPoint p = exact_position(mesh, at);
      EXPECT_EQ(p[0], x);
      EXPECT_EQ(p[1], y);
      const bool corner = x == std::floor(x) && y == std::floor(y);
      EXPECT_EQ(at.vertex != kNone, corner);
    }
  }
}

TEST(Drop, JustBesideTheSurfaceMisses) {
  const Mesh mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  const SurfaceSearch search(mesh);
  EXPECT_EQ(refusal([&] { search.drop(0.5, 0.5); }), "accepted");
  EXPECT_EQ(refusal([&] { search.drop(0.5, std::nextafter(0.5, 1)); }),
            "the vertical line at (0.5, 0.5000000000000001) misses the surface");
  EXPECT_EQ(refusal([&] { search.drop(7, 0); }), "the vertical line at (7, 0) misses the surface");
  EXPECT_EQ(refusal([&] { search.drop(NAN, 0); }), "the coordinate nan is not finite");
}

TEST(Drop, SeveralPointsAreRefused) {
  // Three sheets, one above the other.
  MeshArrays arrays;
  for (int i = 0; i < 3; ++i) {
    const auto v = static_cast<std::uint32_t>(arrays.points.size());
    for (const Point& p : {Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}}) arrays.points.push_back({p[0], p[1], double(i)});
    arrays.faces.push_back({v, v + 1, v + 2});
  }
  const Mesh mesh(std::move(arrays));
  EXPECT_EQ(refusal([&] { SurfaceSearch(mesh).drop(0.25, 0.25); }),
            "the vertical line at (0.25, 0.25) meets the surface at several points (faces 0, 1, 2)");
}

TEST(Drop, TouchingSheetsThatAreNotConnectedAreSeveralPoints) {
  const Mesh mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 5}}, {{0, 1, 2}, {3, 4, 5}}});
  EXPECT_EQ(refusal([&] { SurfaceSearch(mesh).drop(0.5, 0); }),
            "the vertical line at (0.5, 0) meets the surface at several points (faces 0, 1)");
}

/// A step: floor, a vertical wall over x = 1, and a roof.
Mesh step() {
  return Mesh({{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}, {2, 0, 1}},
               {{0, 2, 1}, {2, 3, 1}, {2, 4, 3}, {4, 5, 3}, {4, 6, 5}}});
}

TEST(Drop, VerticalFaces) {
  const Mesh mesh = step();
  const SurfaceSearch search(mesh);
  EXPECT_EQ(refusal([&] { search.drop(0.5, 0.5); }), "accepted");
  EXPECT_EQ(refusal([&] { search.drop(1.5, 0.25); }), "accepted");
  EXPECT_EQ(refusal([&] { search.drop(1, 0.5); }), "the vertical line at (1, 0.5) runs along face 2, which is vertical");
  EXPECT_EQ(refusal([&] { search.drop(1, 0); }), "the vertical line at (1, 0) runs along face 2, which is vertical");
}

TEST(Drop, AVerticalFaceTouchedAtACornerIsOnePoint) {
  const Mesh mesh({{{0, 0, 5}, {1, 1, 0}, {2, 2, 3}}, {{0, 1, 2}}});
  const SurfaceSearch search(mesh);
  EXPECT_EQ(search.drop(0, 0).vertex, 0u);
  EXPECT_EQ(search.drop(2, 2).vertex, 2u);
  EXPECT_EQ(refusal([&] { search.drop(1, 1); }), "the vertical line at (1, 1) runs along face 0, which is vertical");
  EXPECT_EQ(refusal([&] { search.drop(0.5, 0.5); }), "the vertical line at (0.5, 0.5) runs along face 0, which is vertical");
  EXPECT_EQ(refusal([&] { search.drop(3, 3); }), "the vertical line at (3, 3) misses the surface");
  EXPECT_EQ(refusal([&] { search.drop(0.5, 0.75); }), "the vertical line at (0.5, 0.75) misses the surface");
}

TEST(Drop, AVerticalEdgeIsRefused) {
  const Mesh mesh({{{0, 0, 0}, {0, 0, 4}, {2, 2, 3}}, {{0, 1, 2}}});
  const SurfaceSearch search(mesh);
  EXPECT_EQ(refusal([&] { search.drop(0, 0); }), "the vertical line at (0, 0) runs along face 0, which is vertical");
  EXPECT_EQ(search.drop(2, 2).vertex, 2u);
}

}  // namespace
}  // namespace gvd::kernel
