#include <array>
#include <cmath>

#include "fuzz/generators/family.hpp"
#include "fuzz/generators/grids.hpp"

namespace gvd::fuzz {
namespace {

using kernel::MeshArrays;
using kernel::Point;

/// A rectangle in the plane; inner vertices moved, those of the sides along their side.
MeshArrays flat(Draw& draw, std::uint32_t size) {
  const bool integer = draw.one_in(2);
  const double step = integer ? 4 : 1;
  const auto moved = [&](std::uint32_t i) {
    if (i == 0 || i == size) return i * step;
    return i * step + (integer ? draw.between(-1, 1) : draw.uniform(-0.3, 0.3));
  };
  return drawn_grid(draw, size, size, [&](auto i, auto j) { return Point{moved(i), moved(j), 0}; });
}

/// A plane that no axis is normal to, with integer coordinates: (x, y) -> (3 x, 3 y, a x + b y).
MeshArrays tilted(Draw& draw, std::uint32_t size) {
  const int a = draw.between(-4, 4), b = draw.between(-4, 4);
  return drawn_grid(draw, size, size, [&](auto i, auto j) {
    const int x = static_cast<int>(i) * 4 + (i == 0 || i == size ? 0 : draw.between(-1, 1));
    const int y = static_cast<int>(j) * 4 + (j == 0 || j == size ? 0 : draw.between(-1, 1));
    return Point{3.0 * x, 3.0 * y, double(a * x + b * y)};
  });
}

/// Columns that each rise or fall by a Pythagorean slope: folds along x = const of a plane with rational lengths.
MeshArrays folded(Draw& draw, std::uint32_t size) {
  constexpr std::array<std::array<double, 2>, 7> kSlopes = {{{1, 0}, {3, 4}, {4, 3}, {0, 2}, {5, 12}, {8, 15}, {12, 5}}};
  std::vector<double> x{0}, z{0};
  for (std::uint32_t i = 0; i < size; ++i) {
    const auto& slope = kSlopes[draw.below(kSlopes.size())];
    x.push_back(x.back() + slope[0]);
    z.push_back(z.back() + (draw.one_in(2) ? slope[1] : -slope[1]));
  }
  const double step = draw.between(1, 6);
  return drawn_grid(draw, size, size, [&](auto i, auto j) { return Point{x[i], step * j, z[i]}; });
}

MeshArrays staircase(Draw& draw, std::uint32_t size) {
  const double tread = draw.between(1, 3), rise = draw.between(1, 3);
  return drawn_grid(draw, size, size, [&](auto i, auto j) { return Point{tread * ((i + 1) / 2), double(j), rise * (i / 2)}; });
}

MeshArrays roof(Draw& draw, std::uint32_t size) {
  const double run = draw.between(1, 5), rise = draw.between(1, 5);
  return drawn_grid(draw, size, size, [&](auto i, auto j) {
    return Point{run * i, 2.0 * j, rise * (2 * i <= size ? i : size - i)};
  });
}

constexpr std::array<Family, 5> kFamilies = {{
    {"flat", flat, "a rectangle in the plane"},
    {"tilted", tilted, "a rectangle in a tilted plane, integers"},
    {"folded", folded, "a plane folded by Pythagorean slopes"},
    {"staircase", staircase, "steps"},
    {"roof", roof, "a gable roof"},
}};

}  // namespace

std::span<const Family> developable_families() { return kFamilies; }

}  // namespace gvd::fuzz
