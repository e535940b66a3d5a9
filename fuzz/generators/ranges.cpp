#include <array>
#include <cmath>

#include "fuzz/generators/family.hpp"

namespace gvd::fuzz {
namespace {

using kernel::MeshArrays;

/// A mesh of one of the families that need no other.
MeshArrays other(Draw& draw, std::uint32_t size) {
  const std::array<std::span<const Family>, 3> groups = {terrain_families(), relief_families(), developable_families()};
  const auto& group = groups[draw.below(groups.size())];
  return group[draw.below(static_cast<std::uint32_t>(group.size()))].make(draw, size);
}

/// Coordinates like those of UTM: hundreds of thousands of metres east, millions north; the spacing is 10 to 30 m.
MeshArrays utm(Draw& draw, std::uint32_t size) {
  MeshArrays mesh = other(draw, size);
  const double east = 500000 + draw.between(-200000, 200000), north = 100000.0 * draw.between(1, 90), step = draw.between(10, 30);
  for (auto& p : mesh.points) p = {east + step * p[0], north + step * p[1], 1000 + step * p[2]};
  return mesh;
}

MeshArrays scaled(Draw& draw, std::uint32_t size) {
  MeshArrays mesh = other(draw, size);
  const int scale = draw.between(-300, 300);
  for (auto& p : mesh.points)
    for (double& x : p) x = std::ldexp(x, scale);
  return mesh;
}

constexpr std::array<Family, 2> kFamilies = {{
    {"utm", utm, "another family at coordinates as of UTM"},
    {"scaled", scaled, "another family times 2^-300 .. 2^300"},
}};

}  // namespace

std::span<const Family> range_families() { return kFamilies; }

}  // namespace gvd::fuzz
