#include <algorithm>
#include <array>
#include <cmath>

#include "fuzz/generators/family.hpp"
#include "fuzz/generators/grids.hpp"

namespace gvd::fuzz {
namespace {

using kernel::MeshArrays;
using kernel::Point;

/// Terraces: the greatest of a few integer planes, so that many neighbours are coplanar.
MeshArrays coplanar_patches(Draw& draw, std::uint32_t size) {
  std::array<std::array<int, 3>, 3> planes{};
  for (auto& plane : planes)
    plane = {draw.between(-2, 2), draw.between(-2, 2), draw.between(-static_cast<int>(size), static_cast<int>(size))};
  return drawn_grid(draw, size, size, [&](auto i, auto j) {
    int z = -1000;
    for (const auto& plane : planes) z = std::max(z, plane[0] * static_cast<int>(i) + plane[1] * static_cast<int>(j) + plane[2]);
    return Point{double(i), double(j), double(z)};
  });
}

/// A fan of rings round an apex: convex, flat or a saddle by the height of its rings.
MeshArrays cone(Draw& draw, std::uint32_t size) {
  const std::uint32_t spokes = 3 + draw.below(6), rings = std::max(1u, size / 2);
  const double slope = draw.between(-8, 8);
  MeshArrays mesh;
  mesh.points.push_back({0, 0, 0});
  for (std::uint32_t r = 1; r <= rings; ++r)
    for (std::uint32_t s = 0; s < spokes; ++s) {
      const double angle = 6.283185307179586 * s / spokes;
      // Whole numbers, so that the case does not depend on the last bit of a cosine.
      mesh.points.push_back({std::round(64 * r * std::cos(angle)), std::round(64 * r * std::sin(angle)), 16 * slope * r});
    }
  const auto at = [&](std::uint32_t r, std::uint32_t s) { return 1 + (r - 1) * spokes + s % spokes; };
  for (std::uint32_t s = 0; s < spokes; ++s) {
    mesh.faces.push_back({0, at(1, s), at(1, s + 1)});
    for (std::uint32_t r = 1; r < rings; ++r) {
      mesh.faces.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      mesh.faces.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
  }
  return mesh;
}

/// A nearly flat grid with a few high peaks.
MeshArrays spikes(Draw& draw, std::uint32_t size) {
  const double height = std::ldexp(1.0, draw.between(1, 12));
  return drawn_grid(draw, size, size, [&](auto i, auto j) {
    return Point{double(i), double(j), draw.one_in(6) ? height * draw.uniform(0.5, 1) : draw.uniform(0, 0.1)};
  });
}

/// Every second vertex up or down, ridges between those with eight faces: these are saddles.
MeshArrays valleys(Draw& draw, std::uint32_t size) {
  const int height = draw.between(1, 4);
  const bool integer = draw.one_in(2);
  return drawn_grid(
      draw, size, size,
      [&](auto i, auto j) {
        const double z = (i % 2 == 0 ? 1 : -1) * (j % 2 == 0 ? 1 : -1) * height;
        return integer ? Point{double(i), double(j), z}
                       : Point{i + draw.uniform(-0.2, 0.2), j + draw.uniform(-0.2, 0.2), z * draw.uniform(0.8, 1)};
      },
      Diagonals::even);
}

constexpr std::array<Family, 4> kFamilies = {{
    {"coplanar_patches", coplanar_patches, "the greatest of three integer planes"},
    {"cone", cone, "rings round an apex"},
    {"spikes", spikes, "peaks up to 4096 high on a plain"},
    {"valleys", valleys, "vertices up and down in turn: saddles"},
}};

}  // namespace

std::span<const Family> relief_families() { return kFamilies; }

}  // namespace gvd::fuzz
