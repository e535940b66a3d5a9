#pragma once

#include "band_families.hpp"
#include "laid_path.hpp"
#include "turned_fan.hpp"
#include "zigzag.hpp"

/// Pairs of paths of one length by construction.
namespace gvd::test {

struct EqualPaths {
  LaidPath a, b;
  int exponent = 0;  ///< of the power of two by which both are scaled
};

/// A zigzag whose coordinates have 53 random bits: every face is of a square class of its own.
inline LaidOut rough_zigzag(Random& random) {
  return random_layout(1 + random.below(5), random, [](const predicates::SpacePoint& p) { return p; });
}
inline EqualPaths of_strips(const LaidOut& a, const LaidOut& b, int exponent = 0) { return {{0, {a}}, {0, {b}}, exponent}; }

/// Seen in a mirror that permutes the axes.
inline EqualPaths mirror_images(Random& random) {
  const LaidOut strip = rough_zigzag(random);
  LaidOut image = strip;
  Placement axes = Placement::random(random);
  std::array<double, 3> sign;
  for (double& s : sign) s = random.below(2) == 0 ? 1 : -1;
  for (auto& p : image.corner) p = {sign[0] * p[axes.axis[0]], sign[1] * p[axes.axis[1]], sign[2] * p[axes.axis[2]]};
  return of_strips(strip, image);
}

inline EqualPaths ways_back(Random& random) {
  const LaidOut strip = rough_zigzag(random);
  return of_strips(strip, turned_round(strip));
}

/// Along a band, to the height y on its last column.
inline LaidOut along(const FoldedBand& band, const Placement& place, int y, bool source_on_edge, Random& random) {
  return BandStrip::build(band, place, {{band.panels.size(), y, random.below(2) == 0}}, source_on_edge, random).strip;
}

/// Panels in another order.
template <FoldedBand (*family)(Random&), bool on_edge = false>
EqualPaths shuffled_panels(Random& random) {
  FoldedBand band = family(random), other = band;
  shuffle(other.panels, random);
  const Placement place = Placement::random(random);
  const int y = static_cast<int>(random.below(40)) - 20;
  return of_strips(along(band, place, y, on_edge, random), along(other, place, y, on_edge, random), place.exponent);
}

/// The grid points (x, y) and (y, x).
inline EqualPaths grid_points(Random& random) {
  const auto flat = [&](int width) {
    FoldedBand band;
    for (bool first = true; width > 0; first = false) {
      const int step = 1 + static_cast<int>(random.below(static_cast<std::uint32_t>(first ? width - 1 : width)));
      band.append({step, 0});
      width -= step;
    }
    return band;
  };
  const Placement place = Placement::random(random);
  const int x = 2 + static_cast<int>(random.below(15)), y = 2 + static_cast<int>(random.below(15));
  return of_strips(along(flat(x), place, y, false, random), along(flat(y), place, x, false, random), place.exponent);
}

/// (a sqrt 2 + b sqrt 5)^2 + y^2 = (c + d sqrt 10)^2 + z^2, ab = cd: equal only because sqrt 2 sqrt 5 = sqrt 10.
inline EqualPaths dependent_products(Random& random) {
  for (;;) {
    const auto some = [&] { return 1 + static_cast<int>(random.below(6)); };
    const int a = some(), b = some(), c = some();
    if (a * b % c != 0) continue;
    const int d = a * b / c, difference = c * c + 10 * d * d - 2 * a * a - 5 * b * b;  // y^2 - z^2
    for (int f = 1; f <= 40; ++f) {
      if (difference % f != 0 || (difference / f + f) % 2 != 0) continue;
      const int y = (difference / f + f) / 2, z = y - f;
      const Placement place = Placement::random(random);
      FoldedBand left, right;
      left.panels = {{a, a}, {b, 2 * b}};
      right.panels = {{c, 0}, {d, -3 * d}};
      shuffle(left.panels, random);
      return of_strips(along(left, place, y, false, random), along(right, place, z, false, random), place.exponent);
    }
  }
}

/// The angles of a fan in another order.
inline EqualPaths turned_fans(Random& random) {
  constexpr std::array<WholeVector, 5> kKinds{{{1, 2, 3}, {0, 1, 2}, {1, 3, 4}, {2, 3, 5}, {1, 2, 2}}};
  const predicates::SpacePoint centre{static_cast<double>(random.below(9)), 7, 1e7};
  for (;;) {
    const auto all = orbit(kKinds[random.below(5)]);
    const auto choice = dots_of(all);
    std::vector<int> dots(2 + random.below(4)), other;
    for (int& d : dots) d = choice[random.below(static_cast<std::uint32_t>(choice.size()))];
    other = dots;
    for (std::size_t k = other.size(); k > 1; --k) std::swap(other[k - 1], other[random.below(static_cast<std::uint32_t>(k))]);
    const auto spokes = spokes_with(all, dots, random), others = spokes_with(all, other, random);
    if (!spokes.empty() && !others.empty()) return of_strips(fan_strip(spokes, centre, 1), fan_strip(others, centre, 1));
  }
}

/// One straight line, whole and in two legs: roots of one radicand times squares of rationals.
inline EqualPaths sums_of_legs(Random& random) {
  const Placement place = Placement::random(random);
  std::vector<Panel> block;
  for (std::uint32_t i = 0; i < 2; ++i) block.push_back(any_panel(random));
  const int slope = static_cast<int>(random.below(9)) - 4, first = 1 + static_cast<int>(random.below(2)), second = 1 + static_cast<int>(random.below(2));
  const auto leg = [&](int times) { return along(repeated(block, times, random), place, slope * times, false, random); };
  return {{0, {leg(first), leg(second)}}, {0, {leg(first + second)}}, place.exponent};
}

struct EqualPathsFamily {
  const char* name;
  EqualPaths (*make)(Random&);
  bool one_class;  ///< all faces of a leg are of one square class
};
inline constexpr std::array<EqualPathsFamily, 12> kEqualPathsFamilies = {{{"integer_grid", grid_points, true},
                                                                         {"pythagorean_folds", shuffled_panels<pythagorean_folds>, true},
                                                                         {"coplanar_runs", shuffled_panels<coplanar_runs>, true},
                                                                         {"dependent_classes", shuffled_panels<dependent_classes>, false},
                                                                         {"dependent_products", dependent_products, false},
                                                                         {"repeated_blocks", shuffled_panels<repeated_blocks>, false},
                                                                         {"any_folds", shuffled_panels<any_folds>, false},
                                                                         {"sites_along_mesh_edges", shuffled_panels<any_folds, true>, false},
                                                                         {"mirror_images", mirror_images, false},
                                                                         {"ways_back", ways_back, false},
                                                                         {"turned_fans", turned_fans, false},
                                                                         {"sums_of_legs", sums_of_legs, false}}};

}  // namespace gvd::test
