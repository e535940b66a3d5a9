// Worst cases of finding surface points: points as far from two faces, feet on the border of a face and vertical lines through edges by construction, and their
// nearest neighbours. Every answer is compared with brute force.
#include "support/nearest_reference.hpp"
#include "support/refusal.hpp"
#include "support/zero_cases.hpp"

namespace gvd::kernel {
namespace {

using predicates::Predicate;
using namespace gvd::test;

int whole(int low, int high, Random& random) { return low + static_cast<int>(random.below(static_cast<std::uint32_t>(high - low + 1))); }
Point cross(const Point& a, const Point& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Whole corners, no degenerate triangle.
std::array<Point, 3> triangle(int low, int high, Random& random) {
  for (;;) {
    std::array<Point, 3> t;
    for (Point& p : t) p = {double(whole(low, high, random)), double(whole(-9, 9, random)), double(whole(-9, 9, random))};
    if (cross(minus(t[1], t[0]), minus(t[2], t[0])) != Point{0, 0, 0}) return t;
  }
}

/// Two triangles, mirror images in a plane across an axis, and a point of that plane; then one off it. In front of the plane is the one that is in front.
void mirror_images(Random& random) {
  const auto front = triangle(1, 9, random);
  const double mirror = whole(-40, 40, random);
  const std::size_t axis = random.below(3);
  const auto place = [&](const Point& p, double sign) {
    Point q{mirror + sign * p[0], p[1], p[2]};
    std::swap(q[0], q[axis]);
    return q;
  };
  MeshArrays arrays;
  const FaceId in_front = random.below(2);
  for (FaceId f = 0; f < 2; ++f)
    for (const Point& p : front) arrays.points.push_back(place(p, f == in_front ? 1 : -1));
  arrays.faces = {{0, 1, 2}, {3, 4, 5}};
  const Mesh mesh(arrays);
  const SurfaceSearch search(mesh);
  Point p = place({0, whole(-20, 20, random) / 4.0, whole(-20, 20, random) / 4.0}, 1);
  EXPECT_EQ(search.nearest(p).at.face, 0u);
  expect_nearest(mesh, search, p);
  for (const double to : {HUGE_VAL, -HUGE_VAL}) {
    Point off = p;
    off[axis] = std::nextafter(p[axis], to);
    EXPECT_EQ(search.nearest(off).at.face, to > 0 ? in_front : 1 - in_front);
    expect_nearest(mesh, search, off);
  }
}

/// A point straight above one of an edge of a face, in the face's sense of straight: its foot is on the edge, a hair to one side it is within the face.
/// Another face may share the edge.
void feet_on_an_edge(Random& random) {
  const auto t = triangle(-9, 9, random);
  const Point along = minus(t[1], t[0]), normal = cross(along, minus(t[2], t[0])), inwards = cross(normal, along);
  const double part = whole(0, 8, random) / 8.0, height = whole(-8, 8, random) / 8.0;
  const auto at = [&](double in) {
    Point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = t[0][k] + part * along[k] + height * normal[k] + in * inwards[k];
    return p;
  };
  MeshArrays arrays{{t[0], t[1], t[2]}, {{0, 1, 2}}};
  if (random.below(2) == 0) {
    const auto other = triangle(-9, 9, random)[2];
    if (cross(along, minus(other, t[0])) != Point{0, 0, 0} && other != t[2]) {
      arrays.points.push_back(other);
      arrays.faces.push_back({1, 0, 3});
    }
  }
  const Mesh mesh(arrays);
  const SurfaceSearch search(mesh);
  expect_nearest(mesh, search, at(0));
  expect_nearest(mesh, search, at(0x1p-20));  // exactly that much: products of whole numbers below 2^25
  expect_nearest(mesh, search, at(-0x1p-20));
  if (mesh.face_count() == 1) {
    EXPECT_EQ(search.nearest(at(0)).at.bary[2], 0);
    EXPECT_EQ(search.nearest(at(-0x1p-20)).at.bary[2], 0);
    EXPECT_GT(search.nearest(at(0x1p-20)).at.bary[2], 0);
  }
  Point near = at(0);
  nudge(near, random);
  expect_nearest(mesh, search, near);
}

/// A vertical line through an edge of a terrain; then one an ulp to either side, which meets the face there, or misses the surface beyond its border.
void lines_through_edges(Random& random) {
  constexpr int kSize = 3;
  const MeshArrays arrays = grid(kSize, kSize, [&](auto, auto) { return double(random.below(9)); });
  const Mesh mesh(arrays);
  const SurfaceSearch search(mesh);
  const int i = whole(0, kSize - 1, random), j = whole(0, kSize - 1, random), kind = whole(0, 2, random);
  const double part = whole(1, 4095, random) / 4096.0;
  const double x = kind == 1 ? i : i + part, y = kind == 0 ? j : j + part;  // bottom, left, diagonal of a square
  const auto expect_hit = [&](double to_y, std::optional<FaceId> face, Location::Kind where) {
    const double to_x = kind == 1 ? (to_y > y ? std::nextafter(x, -9.0) : to_y < y ? std::nextafter(x, 9.0) : x) : x;
    const double at_y = kind == 1 ? y : to_y;
    if (!face) {
      EXPECT_NE(refusal([&] { search.drop(to_x, at_y); }).find("misses"), std::string::npos);
      return;
    }
    const SurfacePoint hit = search.drop(to_x, at_y);
    const ExactPoint p = exact_position(mesh, hit);
    EXPECT_EQ(p[0], to_x);
    EXPECT_EQ(p[1], at_y);
    EXPECT_EQ(locate(mesh, hit).kind, where);
    EXPECT_EQ(hit.face, *face);
  };
  // Faces of square (i, j): 2 s below its diagonal, 2 s + 1 above. On the left or above the edge, and on the other side.
  const auto square = [&](int a, int b) -> std::optional<FaceId> {
    return a < 0 || b < 0 ? std::nullopt : std::optional(static_cast<FaceId>(2 * (b * kSize + a)));
  };
  const FaceId own = *square(i, j);
  const auto beside = kind == 0 ? square(i, j - 1) : square(i - 1, j);
  const std::optional<FaceId> above = kind == 0 ? own : kind == 1 ? beside : std::optional(own + 1);
  const std::optional<FaceId> below = kind == 0 ? (beside ? std::optional(*beside + 1) : std::nullopt) : kind == 1 ? std::optional(own + 1) : own;
  expect_hit(y, above && below ? std::min(*above, *below) : above ? above : below, Location::Kind::edge);
  expect_hit(std::nextafter(y, 9.0), above, Location::Kind::face);
  expect_hit(std::nextafter(y, -9.0), below, Location::Kind::face);
}

class SurfaceZeros : public testing::TestWithParam<ZeroShare> {};

TEST_P(SurfaceZeros, AndTheirNeighbours) {
  ASSERT_EQ(GetParam().predicate, Predicate::source_location);
  Random random(GetParam().seed());
  for (std::uint64_t round = 0; round < GetParam().cases(); ++round) {
    switch (round % 3) {
      case 0: mirror_images(random); break;
      case 1: feet_on_an_edge(random); break;
      default: lines_through_edges(random); break;
    }
    if (HasFailure()) FAIL() << "round " << round;
  }
}

INSTANTIATE_TEST_SUITE_P(Shares, SurfaceZeros, testing::ValuesIn(shares_of(ZeroTest::surface)), [](const auto& share) { return share.param.name(); });

}  // namespace
}  // namespace gvd::kernel
