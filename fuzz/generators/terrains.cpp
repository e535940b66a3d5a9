#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "fuzz/generators/family.hpp"
#include "fuzz/generators/grids.hpp"

namespace gvd::fuzz {
namespace {

using kernel::MeshArrays;
using kernel::Point;

/// Few integer heights: exact ties and flat places abound.
MeshArrays integer_tin(Draw& draw, std::uint32_t size) {
  const int levels = draw.between(2, 6);
  return drawn_grid(draw, size, size, [&](auto i, auto j) {
    return Point{double(i), double(j), double(draw.between(0, levels - 1))};
  });
}

MeshArrays floating_tin(Draw& draw, std::uint32_t size) {
  const double relief = std::ldexp(1.0, draw.between(-4, 3)), jitter = draw.uniform(0, 0.3);
  return drawn_grid(draw, size, size, [&](auto i, auto j) {
    return Point{i + draw.uniform(-jitter, jitter), j + draw.uniform(-jitter, jitter), relief * draw.unit()};
  });
}

/// Heights and jitter of all exponents, put together from bits.
MeshArrays bitwise_tin(Draw& draw, std::uint32_t size) {
  const int low = draw.between(-60, -2), high = draw.between(-2, 2);
  return drawn_grid(draw, size, size, [&](auto i, auto j) {
    return Point{i + draw.bit_double(low - 4, -3), j + draw.bit_double(low - 4, -3), draw.bit_double(low, high)};
  });
}

using Side = std::pair<std::uint32_t, std::uint32_t>;

double turn(const MeshArrays& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Point &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/// Flips the side opposite corner k of face f if the two faces make a strictly convex quadrilateral in plan.
void flip(MeshArrays& mesh, std::size_t f, std::size_t k) {
  const std::uint32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3], c = mesh.faces[f][(k + 2) % 3];
  for (std::size_t g = 0; g < mesh.faces.size(); ++g)
    for (std::size_t l = 0; l < 3; ++l) {
      auto& other = mesh.faces[g];
      if (other[(l + 1) % 3] != c || other[(l + 2) % 3] != b) continue;
      const std::uint32_t d = other[l];
      if (turn(mesh, a, b, d) <= 0 || turn(mesh, a, d, c) <= 0) return;
      mesh.faces[f] = {a, b, d};
      other = {a, d, c};
      return;
    }
}

/// Points of a small lattice inserted one by one into a square, with flips drawn in between: vertices of any degree, thin faces.
MeshArrays irregular_tin(Draw& draw, std::uint32_t size) {
  const int side = static_cast<int>(3 * size), levels = draw.between(1, 9);
  const auto height = [&] { return double(draw.between(0, levels - 1)); };
  MeshArrays mesh;
  const double s = side;
  mesh.points = {{0, 0, height()}, {s, 0, height()}, {s, s, height()}, {0, s, height()}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  for (std::uint32_t n = 0; n < size * size; ++n) {
    const auto id = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({double(draw.between(1, side - 1)), double(draw.between(1, side - 1)), height()});
    std::size_t inside = mesh.faces.size();
    for (std::size_t f = 0; f < mesh.faces.size() && inside == mesh.faces.size(); ++f) {
      const auto [a, b, c] = mesh.faces[f];
      if (turn(mesh, a, b, id) > 0 && turn(mesh, b, c, id) > 0 && turn(mesh, c, a, id) > 0) inside = f;
    }
    if (inside == mesh.faces.size()) {  // on a side or a vertex
      mesh.points.pop_back();
      continue;
    }
    const auto [a, b, c] = mesh.faces[inside];
    mesh.faces[inside] = {a, b, id};
    mesh.faces.push_back({b, c, id});
    mesh.faces.push_back({c, a, id});
    for (int k = 0; k < 4; ++k) flip(mesh, draw.below(static_cast<std::uint32_t>(mesh.faces.size())), draw.below(3));
  }
  return mesh;
}

constexpr std::array<Family, 4> kFamilies = {{
    {"integer_tin", integer_tin, "a grid with few integer heights"},
    {"irregular_tin", irregular_tin, "lattice points inserted into a square, with flips"},
    {"floating_tin", floating_tin, "a jittered grid with random heights"},
    {"bitwise_tin", bitwise_tin, "a grid jittered by doubles of all exponents"},
}};

}  // namespace

std::span<const Family> terrain_families() { return kFamilies; }

}  // namespace gvd::fuzz
