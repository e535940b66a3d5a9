#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "gvd/robust/mpfr_float.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using robust::exact_rational;
using robust::Mpfr;
using robust::RootSum;
using robust::Sign;
using test::at_vertex;
using test::ExactPoint2;
using test::inside_edge;
using test::inside_face;
using test::Random;
using test::square;

ExactPoint2 xy(const ExactPoint& p) { return {p[0], p[1]}; }

/// A surface that unfolds to a convex part of the plane: `flat` gives the place of each vertex there. Sources may lie anywhere.
void expect_planar(const test::MeshArrays& arrays, const test::MeshArrays& flat, const std::vector<Source>& sources,
                   const std::string& what) {
  const Mesh mesh(arrays), plane(flat);
  test::expect_truth(
      mesh, sources,
      [&](VertexId v, std::size_t s) {
        return test::planar_distance(xy(plane.exact_point(v)), xy(exact_position(plane, sources[s].at)));
      },
      what);
}

/// One to six sources of every kind; weights are multiples of 1/4 if wanted.
std::vector<Source> mixed_sources(const Mesh& mesh, Random& random, bool weighted) {
  std::vector<Source> sources;
  const std::uint32_t count = 1 + random.below(6);
  for (std::uint32_t i = 0; i < count; ++i) {
    sources.push_back(random_source(mesh, random, weighted ? 0.25 * random.below(9) : 0));
  }
  return sources;
}

TEST(PlanarDistances, IntegerGrid) {
  Random random(1);
  for (const auto diagonal : {test::Diagonal::rising, test::Diagonal::falling, test::Diagonal::alternating}) {
    const auto arrays = test::flat_grid(9, 7, diagonal);
    const Mesh mesh(arrays);
    for (int round = 0; round < 4; ++round) {
      expect_planar(arrays, arrays, mixed_sources(mesh, random, false), "mixed " + std::to_string(round));
      std::vector<Source> lattice;
      for (int i = 0; i < 6; ++i) lattice.push_back(at_vertex(mesh, random.below(mesh.vertex_count())));
      expect_planar(arrays, arrays, lattice, "lattice " + std::to_string(round));
    }
  }
}

TEST(PlanarDistances, JitteredGrid) {
  Random random(2);
  for (int round = 0; round < 6; ++round) {
    const auto arrays = test::jittered_grid(8, 8, 0.29, 100 + round);
    expect_planar(arrays, arrays, mixed_sources(Mesh(arrays), random, false), "round " + std::to_string(round));
  }
}

TEST(PlanarDistances, WeightsAndHiddenSources) {
  Random random(3);
  for (int round = 0; round < 8; ++round) {
    const auto arrays = round % 2 == 0 ? test::flat_grid(8, 8) : test::jittered_grid(8, 8, 0.25, 200 + round);
    expect_planar(arrays, arrays, mixed_sources(Mesh(arrays), random, true), "round " + std::to_string(round));
  }
  // Five from the first source: a weight of 5 ties there and along the ray behind, one of 5.5 is hidden, 4.75 is not.
  const auto arrays = test::flat_grid(9, 9);
  const Mesh mesh(arrays);
  for (const double weight : {4.75, 5.0, 5.5}) {
    const std::vector<Source> sources = {at_vertex(mesh, 0), at_vertex(mesh, 4 * 10 + 3, weight)};
    expect_planar(arrays, arrays, sources, "weight " + std::to_string(weight));
    const auto solution = solve(mesh, sources, test::distances_only());
    EXPECT_EQ(solution.hidden().size(), weight > 5 ? 1u : 0u);
    EXPECT_EQ(solution.nearest(4 * 10 + 3).size(), weight == 5 ? 2u : 1u);
  }
}

TEST(PlanarDistances, MirroredSourcesTie) {
  const auto arrays = test::flat_grid(8, 6);
  const Mesh mesh(arrays);
  const std::vector<Source> sources = {at_vertex(mesh, 2 * 9 + 1), at_vertex(mesh, 2 * 9 + 7)};
  expect_planar(arrays, arrays, sources, "mirrored");
  const auto solution = solve(mesh, sources, test::distances_only());
  EXPECT_EQ(solution.summary().ties, 7u);
  for (VertexId j = 0; j <= 6; ++j) EXPECT_EQ(solution.nearest(j * 9 + 4).size(), 2u);
}

TEST(PlanarDistances, CoincidentSourcesAreBothListed) {
  const auto arrays = test::flat_grid(4, 4);
  const Mesh mesh(arrays);
  // The middle of the diagonal of square (1, 1), once from either side; and another source.
  const Source on_edge{point_on_edge(mesh, 6, 12, mpq_class(1, 2)), 0};
  const Source in_face{point_in_face(mesh, 11, {mpq_class(1), mpq_class(1), mpq_class(0)}), 0};
  const std::vector<Source> sources = {on_edge, in_face, at_vertex(mesh, 24)};
  ASSERT_EQ(exact_position(mesh, on_edge.at), exact_position(mesh, in_face.at));
  expect_planar(arrays, arrays, sources, "coincident");
  EXPECT_EQ(solve(mesh, sources, test::distances_only()).duplicates().size(), 1u);
}

TEST(PlanarDistances, TiltedPlane) {
  // (x, y) -> (x, y, 2 x + 2 y): squared lengths are 5 dx^2 + 5 dy^2 + 8 dx dy.
  auto arrays = test::flat_grid(7, 7, test::Diagonal::alternating);
  for (auto& p : arrays.points) p[2] = 2 * p[0] + 2 * p[1];
  const Mesh mesh(arrays);
  Random random(5);
  // The tilted square is a rhombus: convex, so all distances are straight.
  for (int round = 0; round < 4; ++round) {
    const auto sources = mixed_sources(mesh, random, round % 2 == 1);
    test::expect_truth(mesh, sources, [&](VertexId v, std::size_t s) {
      const ExactPoint a = mesh.exact_point(v), b = exact_position(mesh, sources[s].at);
      return RootSum(1, square(a[0] - b[0]) + square(a[1] - b[1]) + square(a[2] - b[2]));
    });
  }
}

TEST(DevelopableDistances, StaircaseAndRoof) {
  Random random(7);
  for (int round = 0; round < 4; ++round) {
    const auto stairs = test::staircase(4, 5);
    expect_planar(stairs, test::flat_grid(8, 5), mixed_sources(Mesh(stairs), random, round > 1),
                  "staircase " + std::to_string(round));
    // Slopes of 3-4-5: every column is 5 wide when rolled out.
    const auto roof = test::roof(3, 6, 12, 9);
    auto flat = test::flat_grid(6, 6);
    for (auto& p : flat.points) p[0] *= 5;
    expect_planar(roof, flat, mixed_sources(Mesh(roof), random, round > 1), "roof " + std::to_string(round));
  }
}

/// The squared distances over the surface of a box of a corner at the origin from a point: over its three faces, or unfolded over
/// every sensible sequence of faces to a face that the corner does not touch.
std::vector<mpq_class> box_unfoldings(const std::array<mpq_class, 3>& size, const ExactPoint& p) {
  if (p[0] == 0 || p[1] == 0 || p[2] == 0) return {square(p[0]) + square(p[1]) + square(p[2])};
  std::vector<mpq_class> squares;
  for (std::size_t k = 0; k < 3; ++k) {
    if (p[k] != size[k]) continue;
    for (const auto [u, v] : {std::array<std::size_t, 2>{(k + 1) % 3, (k + 2) % 3}, {(k + 2) % 3, (k + 1) % 3}}) {
      squares.push_back(square(p[u]) + square(size[k] + p[v]));                      // up the face v = 0
      squares.push_back(square(size[u] + p[v]) + square(size[k] + size[u] - p[u]));  // and round by the face u = size
      squares.push_back(square(size[u] + size[k] + size[u] - p[u]) + square(p[v]));  // along k = 0, up the face u = size
    }
  }
  return squares;
}

void expect_box(const std::array<double, 3>& size, const std::array<std::uint32_t, 3>& parts) {
  const Mesh mesh(test::box(size, parts));
  const std::array<mpq_class, 3> extent = {exact_rational(size[0]), exact_rational(size[1]), exact_rational(size[2])};
  std::vector<VertexId> corners;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const Point& p = mesh.point(v);
    bool corner = true;
    for (std::size_t k = 0; k < 3; ++k) corner = corner && (p[k] == 0 || p[k] == size[k]);
    if (corner) corners.push_back(v);
  }
  ASSERT_EQ(corners.size(), 8u);
  const auto truth = [&](VertexId v, VertexId corner) {
    ExactPoint p = mesh.exact_point(v), c = mesh.exact_point(corner);
    for (std::size_t k = 0; k < 3; ++k)
      if (c[k] != 0) p[k] = extent[k] - p[k];
    const auto squares = box_unfoldings(extent, p);
    return RootSum(1, *std::min_element(squares.begin(), squares.end()));
  };
  for (const std::vector<VertexId>& chosen : {std::vector<VertexId>{corners[0]}, {corners[7]}, {corners[1], corners[6]}, corners}) {
    std::vector<Source> sources;
    for (const VertexId v : chosen) sources.push_back(at_vertex(mesh, v));
    test::expect_truth(
        mesh, sources, [&](VertexId v, std::size_t s) { return truth(v, chosen[s]); }, std::to_string(chosen.size()) + " corners");
  }
}

TEST(BoxDistances, CubeCorners) {
  for (const std::uint32_t n : {1u, 2u, 4u}) expect_box({1, 1, 1}, {n, n, n});
  expect_box({1, 1, 1}, {8, 2, 4});
}

TEST(BoxDistances, BoxCorners) {
  expect_box({1, 2, 5}, {1, 2, 5});
  expect_box({3, 1, 2}, {6, 2, 3});
  expect_box({7, 5, 1}, {7, 5, 1});
}

/// Angles and lengths round the apex of a fan, in MPFR.
class Fan {
 public:
  explicit Fan(const Mesh& mesh) {
    const VertexId n = mesh.vertex_count() - 1;
    for (VertexId i = 0; i < n; ++i) {
      const ExactPoint o = mesh.exact_point(0), a = mesh.exact_point(1 + i), b = mesh.exact_point(1 + (i + 1) % n);
      mpq_class dot, aa, bb;
      for (std::size_t k = 0; k < 3; ++k)
        dot += (a[k] - o[k]) * (b[k] - o[k]), aa += square(a[k] - o[k]), bb += square(b[k] - o[k]);
      const Mpfr sine = sqrt(Mpfr(mpq_class(aa * bb - dot * dot), kBits)), cosine(dot, kBits);
      Mpfr angle(0.0, kBits);
      mpfr_atan2(angle.get(), sine.get(), cosine.get(), MPFR_RNDN);
      angle_.push_back(angle);
      radius_.push_back(sqrt(Mpfr(aa, kBits)));
    }
  }
  /// From rim vertex i to rim vertex j (ids of the mesh): straight on the nearer side if that turns by less than half a turn, else
  /// over the apex.
  double distance(VertexId i, VertexId j) const {
    if (i == j) return 0;
    if (i == 0 || j == 0) return radius_[i + j - 1].to_double();
    Mpfr forth(0.0, kBits), back(0.0, kBits), pi(0.0, kBits);
    for (VertexId k = 0; k < angle_.size(); ++k) {
      const bool between = k + 1 >= std::min(i, j) && k + 1 < std::max(i, j);
      (between ? forth : back) = (between ? forth : back) + angle_[k];
    }
    mpfr_const_pi(pi.get(), MPFR_RNDN);
    Mpfr turn = forth < back ? forth : back;
    const Mpfr &a = radius_[i - 1], &b = radius_[j - 1];
    if (turn > pi) return (a + b).to_double();
    mpfr_cos(turn.get(), turn.get(), MPFR_RNDN);
    return sqrt(a * a + b * b - Mpfr(2.0, kBits) * a * b * turn).to_double();
  }

 private:
  static constexpr int kBits = 512;
  std::vector<Mpfr> angle_, radius_;
};

void expect_fan(const test::MeshArrays& arrays) {
  const Mesh mesh(arrays);
  const Fan fan(mesh);
  for (VertexId s = 0; s < mesh.vertex_count(); ++s) {
    const auto solution = solve(mesh, {at_vertex(mesh, s)}, test::distances_only());
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(solution.distance(v), fan.distance(s, v)) << s << " to " << v;
  }
}

TEST(FanDistances, Cones) {
  // The unfolded rims stay convex, so that chords stay inside.
  expect_fan(test::cone(5, 1, 0.5));
  expect_fan(test::cone(9, 2, 3));
  expect_fan(test::cone(16, 1, 0.125));
}

TEST(FanDistances, Saddles) {
  expect_fan(test::saddle_fan(3, 0.3));
  expect_fan(test::saddle_fan(4, 0.75));
  expect_fan(test::saddle_fan(6, 0.5));
}

/// Shortest paths round an open rectangle of the plane by its corners, as exact sums of roots.
class HoledPlane {
 public:
  HoledPlane(long x0, long x1, long y0, long y1) : low_{x0, y0}, high_{x1, y1} {
    corners_ = {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
  }
  RootSum distance(const ExactPoint2& a, const ExactPoint2& b) const {
    if (!crosses(a, b)) return test::planar_distance(a, b);
    RootSum best;
    bool found = false;
    for (std::size_t first = 0; first < 4; ++first) {
      if (crosses(a, corners_[first])) continue;
      for (const std::size_t step : {1u, 3u}) {
        RootSum length = test::planar_distance(a, corners_[first]);
        for (std::size_t i = 0, c = first; i < 3; ++i) {
          if (!crosses(corners_[c], b)) {
            const RootSum whole = length + test::planar_distance(corners_[c], b);
            if (!found || compare(whole, best) == Sign::negative) best = whole;
            found = true;
          }
          const std::size_t next = (c + step) % 4;
          length += test::planar_distance(corners_[c], corners_[next]);
          c = next;
        }
      }
    }
    EXPECT_TRUE(found);
    return best;
  }

 private:
  /// Whether the segment meets the open rectangle: clip its parameter interval.
  bool crosses(const ExactPoint2& a, const ExactPoint2& b) const {
    mpq_class from = 0, to = 1;
    for (std::size_t k = 0; k < 2; ++k) {
      const mpq_class d = b[k] - a[k];
      if (d == 0) {
        if (a[k] <= low_[k] || a[k] >= high_[k]) return false;
        continue;
      }
      mpq_class t0 = (low_[k] - a[k]) / d, t1 = (high_[k] - a[k]) / d;
      if (t1 < t0) std::swap(t0, t1);
      from = std::max(from, t0);
      to = std::min(to, t1);
    }
    return from < to;
  }
  ExactPoint2 low_, high_;
  std::array<ExactPoint2, 4> corners_;
};

TEST(HoleDistances, RectangleInAPlane) {
  Random random(11);
  const Mesh mesh(test::plane_with_hole(10, 8, 3, 6, 2, 5));
  const HoledPlane plane(3, 6, 2, 5);
  for (int round = 0; round < 6; ++round) {
    const auto sources = mixed_sources(mesh, random, round % 2 == 1);
    test::expect_truth(
        mesh, sources,
        [&](VertexId v, std::size_t s) { return plane.distance(xy(mesh.exact_point(v)), xy(exact_position(mesh, sources[s].at))); },
        "round " + std::to_string(round));
  }
}

TEST(HoleDistances, SymmetricSourcesAreRelayedTogether) {
  // The two sources mirror each other in the axis of the hole and of the grid.
  const Mesh mesh(test::plane_with_hole(9, 8, 3, 6, 3, 5));
  const HoledPlane plane(3, 6, 3, 5);
  std::vector<Source> sources;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.point(v) == Point{2, 1, 0} || mesh.point(v) == Point{7, 1, 0}) sources.push_back(at_vertex(mesh, v));
  ASSERT_EQ(sources.size(), 2u);
  test::expect_truth(mesh, sources, [&](VertexId v, std::size_t s) {
    return plane.distance(xy(mesh.exact_point(v)), xy(exact_position(mesh, sources[s].at)));
  });
}

TEST(UnreachableDistances, OtherComponentsAndIsolatedVertices) {
  auto arrays = test::flat_grid(3, 3);
  const auto size = static_cast<std::uint32_t>(arrays.points.size());
  const auto other = test::flat_grid(2, 2);
  for (Point p : other.points) arrays.points.push_back({p[0] + 10, p[1], 0});
  for (const auto& f : other.faces) arrays.faces.push_back({f[0] + size, f[1] + size, f[2] + size});
  arrays.points.push_back({5, 5, 5});
  const Mesh mesh(arrays);
  const auto solution = solve(mesh, {at_vertex(mesh, 0), at_vertex(mesh, 5)});
  EXPECT_TRUE(test::is_certified(solution));
  EXPECT_EQ(solution.summary().unreachable_vertices, 10u);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(std::isinf(solution.distance(v)), v >= size);
    EXPECT_EQ(solution.nearest(v).empty(), v >= size);
  }
}

/// A rectangle whose sides and diagonal are (x, y, h), cut by the other diagonal.
void expect_midpoint(const mpz_class& x, const mpz_class& y, const mpz_class& h, double expected) {
  ASSERT_EQ(mpz_class(x * x + y * y), mpz_class(h * h));
  ASSERT_EQ(mpz_sizeinbase(h.get_mpz_t(), 2), 54u);
  ASSERT_EQ(mpz_odd_p(h.get_mpz_t()), 1);
  const double w = x.get_d(), d = y.get_d();
  ASSERT_EQ(x, mpz_class(w));
  ASSERT_EQ(y, mpz_class(d));
  const Mesh mesh({{{0, 0, 0}, {w, 0, 0}, {w, d, 0}, {0, d, 0}}, {{0, 1, 3}, {1, 2, 3}}});
  const auto solution = solve(mesh, {at_vertex(mesh, 0)}, test::distances_only());
  EXPECT_TRUE(test::is_certified(solution));
  EXPECT_EQ(solution.distance(2), expected);
  EXPECT_EQ(solve(mesh, {at_vertex(mesh, 2)}, test::distances_only()).distance(0), expected);
  // A weight moves the sum off the midpoint.
  const double weight = 0x1p53;
  EXPECT_EQ(solve(mesh, {at_vertex(mesh, 0, weight)}, test::distances_only()).distance(2),
            RootSum(mpq_class(h + mpz_class(weight))).rounded());
}

TEST(RoundingMidpoint, PythagoreanHypotenuseOf54Bits) {
  // h = m^2 + n^2 is odd and 1 modulo 4, so the even neighbour is below; three times a smaller one is 3 modulo 4: above.
  const mpz_class n = 47'000'000, m = 2 * n + 1;
  const mpz_class h = m * m + n * n;
  expect_midpoint(m * m - n * n, 2 * m * n, h, mpz_class(h - 1).get_d());
  const mpz_class k = 28'000'000, l = 2 * k + 1, g = 3 * (l * l + k * k);
  expect_midpoint(3 * (l * l - k * k), 6 * l * k, g, mpz_class(g + 1).get_d());
}

/// A fan of so many faces round a corner of 175 degrees: the straight line between its ends crosses them all.
TEST(ManyFaces, AStraightLineCrossesMoreThan65535OfOneVertex) {
  constexpr std::uint32_t kFaces = 66'000;
  test::MeshArrays fan{{{0, 0, 0}}, {}};
  for (std::uint32_t i = 0; i <= kFaces; ++i) {
    const double angle = 175.0 / 180 * 3.14159265358979 * i / kFaces;
    fan.points.push_back({std::cos(angle), std::sin(angle), 0});
    if (i > 0) fan.faces.push_back({0, i, i + 1});
  }
  const Mesh mesh(fan);
  const VertexId last = kFaces + 1;
  const auto solution = solve(mesh, {at_vertex(mesh, 1)}, test::distances_only());
  ASSERT_TRUE(test::is_certified(solution));
  const ExactPoint p = mesh.exact_point(1), q = mesh.exact_point(last);
  const mpq_class x = q[0] - p[0], y = q[1] - p[1];
  EXPECT_EQ(solution.distance(last), RootSum(1, mpq_class(x * x + y * y)).rounded());
}

}  // namespace
}  // namespace gvd::kernel
