#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "gvd/kernel/surface_point.hpp"
#include "gvd/kernel/surface_search.hpp"

/// The surface point nearest to a point in space by trying all faces, exactly.
namespace gvd::test {

using kernel::ExactPoint;

inline mpq_class squared(const ExactPoint& a, const ExactPoint& b) {
  mpq_class sum = 0;
  for (int i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

inline mpq_class dot(const ExactPoint& a, const ExactPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Squared distance of p from a segment.
inline mpq_class from_segment(const ExactPoint& a, const ExactPoint& b, const ExactPoint& p) {
  const ExactPoint d{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, e{p[0] - a[0], p[1] - a[1], p[2] - a[2]};
  mpq_class t = dot(d, e) / dot(d, d);
  t = std::clamp(t, mpq_class(0), mpq_class(1));
  return squared({a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]}, p);
}

/// Squared distance from a triangle, another way: from the plane if the foot lies in the triangle, else from the nearest side.
inline mpq_class from_triangle(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& p) {
  const auto cross = [](const ExactPoint& o, const ExactPoint& u, const ExactPoint& v) {
    const ExactPoint d{u[0] - o[0], u[1] - o[1], u[2] - o[2]}, e{v[0] - o[0], v[1] - o[1], v[2] - o[2]};
    return ExactPoint{d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]};
  };
  const ExactPoint n = cross(a, b, c);
  const ExactPoint e{p[0] - a[0], p[1] - a[1], p[2] - a[2]};
  const mpq_class height = dot(n, e), nn = dot(n, n);
  if (dot(cross(a, b, p), n) >= 0 && dot(cross(b, c, p), n) >= 0 && dot(cross(c, a, p), n) >= 0) return height * height / nn;
  return std::min({from_segment(a, b, p), from_segment(b, c, p), from_segment(c, a, p)});
}

/// The nearest face by trying all, exactly.
inline std::pair<mpq_class, kernel::FaceId> brute_force(const kernel::Mesh& mesh, const kernel::Point& point) {
  const ExactPoint p{mpq_class(point[0]), mpq_class(point[1]), mpq_class(point[2])};
  std::pair<mpq_class, kernel::FaceId> best{0, kernel::kNone};
  for (kernel::FaceId f = 0; f < mesh.face_count(); ++f) {
    const mpq_class d = from_triangle(mesh.exact_point(mesh.origin(3 * f)), mesh.exact_point(mesh.origin(3 * f + 1)),
                                      mesh.exact_point(mesh.origin(3 * f + 2)), p);
    if (best.second == kernel::kNone || d < best.first) best = {d, f};
  }
  return best;
}

inline void expect_nearest(const kernel::Mesh& mesh, const kernel::SurfaceSearch& search, const kernel::Point& p) {
  const kernel::NearestPoint found = search.nearest(p);
  const auto [expected, face] = brute_force(mesh, p);
  EXPECT_EQ(found.squared_distance, expected);
  EXPECT_EQ(found.at.face, face);
  EXPECT_EQ(squared(exact_position(mesh, found.at), {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}), expected);
  EXPECT_EQ(found.at.vertex, locate(mesh, found.at).vertex);
  // The root is the nearest double: its square is between those of the midpoints to its neighbours.
  const mpq_class d(found.distance), below(std::nextafter(found.distance, -1.0)), above(std::nextafter(found.distance, INFINITY));
  EXPECT_LE(expected * 4, (d + above) * (d + above));
  if (found.distance > 0) {
    EXPECT_GE(expected * 4, (d + below) * (d + below));
  }
}

}  // namespace gvd::test
