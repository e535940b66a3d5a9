#include <array>
#include <cmath>

#include "fuzz/generators/family.hpp"
#include "fuzz/generators/grids.hpp"

namespace gvd::fuzz {
namespace {

using kernel::MeshArrays;
using kernel::Point;

/// A terrain pressed flat along y: aspects up to 2^30, about 1e9.
MeshArrays slivers(Draw& draw, std::uint32_t size) {
  const int press = draw.between(4, 30);
  const bool integer = draw.one_in(2);
  return drawn_grid(draw, size, size, [&](auto i, auto j) {
    const double z = integer ? draw.between(0, 1) : draw.unit();
    return Point{double(i), std::ldexp(integer ? j : j + draw.uniform(-0.3, 0.3), -press), std::ldexp(z, -draw.between(0, press))};
  });
}

/// A fan of needles: a far apex over a finely divided side, and a second fan below it.
MeshArrays needles(Draw& draw, std::uint32_t size) {
  MeshArrays mesh;
  const double far = std::ldexp(1.0, draw.between(2, 28));
  mesh.points = {{draw.uniform(0, 1), far, draw.uniform(0, 1)}, {draw.uniform(0, 1), -far, draw.uniform(0, 1)}};
  const std::uint32_t parts = 2 * size;
  for (std::uint32_t i = 0; i <= parts; ++i) mesh.points.push_back({double(i), draw.uniform(0, 0.5), draw.uniform(0, 1)});
  for (std::uint32_t i = 0; i < parts; ++i) {
    mesh.faces.push_back({0, 3 + i, 2 + i});
    mesh.faces.push_back({1, 2 + i, 3 + i});
  }
  return mesh;
}

/// A plane, tilted by doubles, whose vertices are off it by up to an ulp.
MeshArrays nearly_coplanar(Draw& draw, std::uint32_t size) {
  const double a = draw.uniform(-1, 1), b = draw.uniform(-1, 1);
  return drawn_grid(draw, size, size, [&](auto i, auto j) {
    const double x = i + draw.uniform(-0.3, 0.3), y = j + draw.uniform(-0.3, 0.3);
    return Point{x, y, draw.nudged(3 + a * x + b * y, 1)};
  });
}

/// An integer terrain whose heights are off by an ulp here and there.
MeshArrays nearly_integer(Draw& draw, std::uint32_t size) {
  return drawn_grid(draw, size, size, [&](auto i, auto j) {
    return Point{double(i), double(j), draw.nudged(1.0 + draw.between(0, 1), draw.one_in(3) ? 1 : 0)};
  });
}

constexpr std::array<Family, 4> kFamilies = {{
    {"slivers", slivers, "faces of aspect up to 1e9"},
    {"needles", needles, "fans of needles on both sides of a line"},
    {"nearly_coplanar", nearly_coplanar, "a tilted plane, vertices up to an ulp off"},
    {"nearly_integer", nearly_integer, "integer heights, some an ulp off"},
}};

}  // namespace

std::span<const Family> thin_families() { return kFamilies; }

}  // namespace gvd::fuzz
