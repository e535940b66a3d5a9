#include "gvd/io/polygon_triangulation.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <set>

using namespace gvd;
using io::PlanePoint;
using Rings = std::vector<std::vector<PlanePoint>>;

namespace {

double area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

double ring_area(const std::vector<PlanePoint>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) sum += area({0, 0}, ring[i], ring[(i + 1) % ring.size()]);
  return sum;
}

/// Checks that the triangles are positive, add up to the area of the rings, and have exactly the sides of the rings as their boundary.
void expect_triangulation(const Rings& rings) {
  std::vector<PlanePoint> points;
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> boundary;
  double expected = 0;
  for (const auto& ring : rings) {
    const auto first = static_cast<std::uint32_t>(points.size()), n = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t i = 0; i < n; ++i) boundary.insert({first + i, first + (i + 1) % n});
    points.insert(points.end(), ring.begin(), ring.end());
    expected += ring_area(ring);
  }
  double sum = 0;
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> open;
  for (const auto& t : io::triangulate_polygon(rings)) {
    const double a = area(points[t[0]], points[t[1]], points[t[2]]);
    EXPECT_GT(a, 0);
    sum += a;
    for (int k = 0; k < 3; ++k) open.insert({t[k], t[(k + 1) % 3]});
  }
  EXPECT_NEAR(sum, expected, 1e-12 * std::abs(expected));
  for (auto side = open.begin(); side != open.end();) {
    const auto twin = open.find({side->second, side->first});
    if (twin == open.end()) {
      ++side;
    } else {
      open.erase(twin);
      side = open.erase(side);
    }
  }
  EXPECT_EQ(open, boundary);
}

RC_GTEST_PROP(PolygonTriangulation, TilesStarShapedPolygons, ()) {
  const int n = *rc::gen::inRange(3, 60);
  std::vector<PlanePoint> ring;
  for (int i = 0; i < n; ++i) {
    const double r = *rc::gen::inRange(10, 1000) / 1000.0, angle = 2 * 3.14159265358979 * i / n;
    ring.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  expect_triangulation({ring});
}

TEST(PolygonTriangulation, TilesACombAndPointsOnStraightSides) {
  expect_triangulation({{{0, 0}, {6, 0}, {6, 3}, {5, 1}, {4, 3}, {3, 1}, {2, 3}, {1, 1}, {0, 3}}});
  expect_triangulation({{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}});
  expect_triangulation({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 3}}});
}

TEST(PolygonTriangulation, TilesPolygonsWithHoles) {
  const std::vector<PlanePoint> square = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  const auto hole = [](double x, double y) { return std::vector<PlanePoint>{{x, y}, {x, y + 1}, {x + 1, y + 1}, {x + 1, y}}; };
  expect_triangulation({square, hole(4, 4)});
  expect_triangulation({square, hole(1, 1), hole(6, 6), hole(3, 5), hole(7, 1)});
  expect_triangulation({square, hole(1, 4), hole(3, 4), hole(5, 4), hole(7, 4)});
}

TEST(PolygonTriangulation, EndsOnWhatIsNoPolygon) {
  EXPECT_TRUE(io::triangulate_polygon({}).empty());
  EXPECT_TRUE(io::triangulate_polygon({{{0, 0}, {1, 0}}}).empty());
  EXPECT_TRUE(io::triangulate_polygon({{{0, 0}, {1, 1}, {2, 2}, {3, 3}}}).empty());
  EXPECT_LE(io::triangulate_polygon({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}).size(), 2u);
  const double nan = std::nan("");
  EXPECT_TRUE(io::triangulate_polygon({{{nan, nan}, {nan, 0}, {0, nan}, {nan, nan}}}).empty());
}

}  // namespace
