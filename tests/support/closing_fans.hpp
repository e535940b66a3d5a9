#pragma once

#include "gvd/predicates/angle_sum.hpp"
#include "turned_fan.hpp"

/// Fans whose angles add up to 2 pi or pi exactly, by construction.
namespace gvd::test {

using Spoke = std::array<double, 3>;
struct ClosingFan {
  std::vector<std::array<Spoke, 2>> corners;  ///< sides of each angle
  int quarter_turns;
};

/// Whole directions of the plane, counter-clockwise all round, each less than pi from the next one.
inline std::vector<std::array<int, 2>> directions_round(Random& random) {
  std::vector<std::array<int, 2>> list;
  const auto between = [&](int low, int high) { return low + static_cast<int>(random.below(static_cast<std::uint32_t>(high - low + 1))); };
  // One in each quarter or on its first axis.
  list.push_back({between(1, 9), between(0, 9)});
  list.push_back({-between(0, 9), between(1, 9)});
  list.push_back({-between(1, 9), -between(0, 9)});
  list.push_back({between(0, 9), -between(1, 9)});
  return list;
}

/// A closed fan of the images of directions of the plane.
template <class Image>
ClosingFan closed_fan(Random& random, const Image& image) {
  const auto directions = directions_round(random);
  ClosingFan fan{{}, 4};
  for (std::size_t i = 0; i < directions.size(); ++i) fan.corners.push_back({image(directions[i]), image(directions[(i + 1) % directions.size()])});
  return fan;
}

inline ClosingFan grid_fan(Random& random) {
  return closed_fan(random, [](const auto& d) { return Spoke{static_cast<double>(d[0]), static_cast<double>(d[1]), 0}; });
}
/// In a plane whose faces are of any one square class.
inline ClosingFan coplanar_fan(Random& random) {
  const int a = static_cast<int>(random.below(13)) - 6, b = static_cast<int>(random.below(13)) - 6;
  return closed_fan(random, [&](const auto& d) { return Spoke{double(d[0]), double(d[1]), double(a * d[0] + b * d[1])}; });
}
inline ClosingFan pythagorean_fan(Random& random) {
  return closed_fan(random, [](const auto& d) { return Spoke{3.0 * d[0], double(d[1]), 4.0 * d[0]}; });
}
/// Two half planes of two classes that meet in a fold; `half`: one of them, half a turn.
template <bool half>
ClosingFan folded_fan(Random& random) {
  const auto slope = [&] { return static_cast<double>(random.below(33)) / 8 - 2; };
  const double left = slope(), right = slope();
  ClosingFan fan{{}, half ? 2 : 4};
  const auto spoke = [&](double x, double y) { return Spoke{x, y, x < 0 ? left * x : right * x}; };
  const auto turn = [&](double side) {
    std::vector<Spoke> spokes{spoke(0, side * (1 + random.below(9)))};
    for (const double y : {1.0, -1.0}) spokes.push_back(spoke(-side * (1 + random.below(9)), side * y * random.below(9)));
    spokes.push_back(spoke(0, -side * (1 + random.below(9))));
    if (random.below(2) == 0) spokes.erase(spokes.begin() + 1);
    for (std::size_t i = 0; i + 1 < spokes.size(); ++i) fan.corners.push_back({spokes[i], spokes[i + 1]});
  };
  turn(1);
  if (!half) turn(-1);
  return fan;
}
/// Pairs of angles that add up to pi, each pair of a class of its own, in any order.
inline ClosingFan supplementary_fan(Random& random) {
  constexpr std::array<WholeVector, 4> kKinds{{{1, 2, 3}, {1, 3, 4}, {2, 3, 5}, {1, 2, 2}}};
  const auto all = orbit(kKinds[random.below(4)]);
  const auto choice = dots_of(all);
  const std::uint32_t pairs = 1 + random.below(2);
  std::vector<int> dots;
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const int d = choice[random.below(static_cast<std::uint32_t>(choice.size()))];
    dots.insert(dots.end(), {d, -d});
  }
  for (std::size_t k = dots.size(); k > 1; --k) std::swap(dots[k - 1], dots[random.below(static_cast<std::uint32_t>(k))]);
  ClosingFan fan{{}, 2 * static_cast<int>(pairs)};
  for (const int d : dots) {
    std::vector<WholeVector> pair;
    while (pair.empty()) pair = spokes_with(all, {d}, random);
    const auto spoke = [](const WholeVector& w) { return Spoke{double(w[0]), double(w[1]), double(w[2])}; };
    fan.corners.push_back({spoke(pair[0]), spoke(pair[1])});
  }
  return fan;
}
/// Right angles of two parts each, tangents k sqrt(c) and 1 / (k sqrt(c)), c = 2, 3, 5, 6: 2, 3 and 6 are dependent.
inline ClosingFan dependent_fan(Random& random) {
  // Tangent |d x e| / d.e of (1, 0, 0) and a vector (x, y, z): sqrt(y^2 + z^2) / x.
  struct Height {
    int y, z, c, factor;  // y^2 + z^2 = c factor^2
  };
  constexpr std::array<Height, 4> kHeights{{{1, 1, 2, 1}, {1, 2, 5, 1}, {1, 3, 10, 1}, {3, 3, 2, 3}}};
  ClosingFan fan{{}, random.below(2) == 0 ? 2 : 4};
  for (int i = 0; i < fan.quarter_turns; ++i) {
    const Height h = kHeights[random.below(4)];
    const int x = 1 + static_cast<int>(random.below(5)), n = h.c * h.factor * h.factor;
    fan.corners.push_back({Spoke{1, 0, 0}, Spoke{double(x), double(h.y), double(h.z)}});  // tangent sqrt(n) / x
    fan.corners.push_back({Spoke{0, 1, 0}, Spoke{double(x * h.y), double(n), double(x * h.z)}});  // x sqrt(n) / n
  }
  return fan;
}

struct FanFamily {
  const char* name;
  ClosingFan (*make)(Random&);
  bool several_roots;  ///< neighbours too may have several independent roots, which algebra leaves to MPFR
};
inline constexpr std::array<FanFamily, 7> kFanFamilies = {{{"integer_grid", grid_fan, false},
                                                           {"coplanar_runs", coplanar_fan, true},
                                                           {"pythagorean_folds", pythagorean_fan, false},
                                                           {"two_half_planes", folded_fan<false>, true},
                                                           {"half_turns", folded_fan<true>, true},
                                                           {"supplementary_angles", supplementary_fan, false},
                                                           {"dependent_classes", dependent_fan, false}}};

}  // namespace gvd::test
