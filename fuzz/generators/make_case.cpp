#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "fuzz/generators/family.hpp"
#include "gvd/kernel/error.hpp"

namespace gvd::fuzz {
namespace {

template <class Table>
const auto& chosen(const Table& table, const std::string& name, Draw& draw) {
  const std::uint32_t drawn = draw.below(static_cast<std::uint32_t>(table.size()));
  if (name.empty()) return table[drawn];
  for (const auto& entry : table)
    if (name == entry.name) return entry;
  throw std::invalid_argument("nothing is called '" + name + "'");
}

/// Small meshes mostly: what a case costs grows with the mesh, and most faults show on few faces. About 28 faces on average.
std::uint32_t drawn_size(Draw& draw) {
  constexpr std::array<std::uint32_t, 20> kUsual = {2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 5, 5, 5, 6, 6};
  return draw.one_in(40) ? 7 + draw.below(4) : kUsual[draw.below(kUsual.size())];
}
/// A hundred sources on a small mesh cost as much as hundreds of other cases.
std::uint32_t drawn_sources(Draw& draw) {
  const std::uint32_t rare = draw.below(2000);
  if (rare == 0) return 100 + draw.below(100);
  if (rare < 8) return 20 + draw.below(30);
  return 1 + draw.below(draw.one_in(4) ? 9 : 4);
}

/// The longest difference of coordinates, as a power of two: weights are of that order.
int extent_exponent(const kernel::MeshArrays& mesh) {
  double least = 1e308;
  double most = -1e308;
  for (const auto& face : mesh.faces)
    for (const auto v : face) {
      least = std::min(least, mesh.points[v][0]);
      most = std::max(most, mesh.points[v][0]);
    }
  return std::ilogb(std::max(most - least, 1e-300));
}

void add_weights(Draw& draw, Case& c) {
  const int exponent = extent_exponent(c.mesh) - 2;
  const bool integer = draw.one_in(2);
  for (Place& place : c.sources)
    if (!draw.one_in(3)) place.weight = std::ldexp(integer ? draw.between(1, 3) : std::fabs(draw.bit_double(-2, 0)), exponent);
}

}  // namespace

std::span<const Family> families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> list;
    for (const auto& group :
         {terrain_families(), developable_families(), relief_families(), topology_families(), thin_families(), range_families()})
      list.insert(list.end(), group.begin(), group.end());
    return list;
  }();
  return all;
}

Case make_case(std::uint64_t seed, const Wish& wish) {
  Draw draw(mixed_seed(seed, kGeneratorVersion));
  const Family& family = chosen(families(), wish.family, draw);
  const Pattern& pattern = chosen(patterns(), wish.pattern, draw);
  const std::uint32_t drawn = drawn_size(draw), size = wish.size != 0 ? wish.size : drawn;
  const std::uint32_t drawn_count = drawn_sources(draw), count = wish.sources != 0 ? wish.sources : drawn_count;
  const bool drawn_weighted = draw.one_in(4), weighted = wish.weighted < 0 ? drawn_weighted : wish.weighted == 1;
  constexpr int kMostAttempts = 100;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    Case c{family.make(draw, size), {}, family.name};
    if (c.mesh.faces.empty()) continue;
    c.sources = pattern.lay(draw, c.mesh, count);
    if (weighted) add_weights(draw, c);
    if (is_valid(c)) return c;
  }
  throw InternalError("family " + std::string(family.name) + " makes no valid mesh");
}

}  // namespace gvd::fuzz
