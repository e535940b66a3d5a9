#pragma once

#include "equal_paths.hpp"
#include "laid_window.hpp"

/// Pairs of windows that tie on an edge in a way that only exact numbers tell, by construction.
namespace gvd::test {

struct TiedWindows {
  LaidWindow a, b;
  std::array<predicates::SpacePoint, 2> edge;
  predicates::EdgeTies::Kind kind;
  mpq_class t = 0;          ///< of the one tie, where that is the kind; where the ray begins
  bool is_contact = false;
  int exponent = 0;
};

/// Beside the source of a band strip, the edge along its last fold from `low` to `high`.
inline LaidWindow band_window(const FoldedBand& band, const Placement& place, int low, int high, bool source_on_edge, Random& random) {
  const std::size_t last = band.panels.size();
  return {BandStrip::build(band, place, {{last, low, false}, {last, high, true}}, source_on_edge, random).strip, {}};
}
inline predicates::SpacePoint point_of_band(const FoldedBand& band, const Placement& place, std::size_t column, int y) {
  int x = 0, z = 0;
  for (std::size_t i = 0; i < column; ++i) {
    x += band.panels[i].dx;
    z += band.panels[i].dz;
  }
  return place(x, y, z);
}
inline std::array<predicates::SpacePoint, 2> last_fold(const FoldedBand& band, const Placement& place, int low, int high) {
  return {point_of_band(band, place, band.panels.size(), low), point_of_band(band, place, band.panels.size(), high)};
}
/// Moved by whole numbers.
inline Placement moved(Placement place, double x, double y, double z) {
  const std::array<double, 3> by{x, y, z};
  for (std::size_t k = 0; k < 3; ++k) place.offset[k] += by[place.axis[k]];
  return place;
}

struct Split {
  FoldedBand near, rest;
  int x = 0, z = 0;  ///< where the second one begins
};
inline Split split_at(const FoldedBand& band, std::size_t column) {
  Split split;
  const auto at = band.panels.begin() + static_cast<long>(column);
  split.near.panels.assign(band.panels.begin(), at);
  split.rest.panels.assign(at, band.panels.end());
  for (const Panel& panel : split.near.panels) {
    split.x += panel.dx;
    split.z += panel.dz;
  }
  return split;
}
/// To the height y on the last column. Over one panel the end must be the upper corner, as the last one of the face.
inline LaidOut way_along(const FoldedBand& band, const Placement& place, int y, Random& random) {
  const std::size_t last = band.panels.size();
  return BandStrip::build(band, place, {{last, y, last == 1 || random.below(2) == 0}}, false, random).strip;
}

/// The same image through panels in another order.
template <FoldedBand (*family)(Random&)>
TiedWindows everywhere(Random& random) {
  const FoldedBand band = family(random);
  FoldedBand other = band;
  shuffle(other.panels, random);
  const Placement place = Placement::random(random);
  const int low = static_cast<int>(random.below(20)) - 10, high = low + 1 + static_cast<int>(random.below(9));
  return {band_window(band, place, low, high, false, random), band_window(other, place, low, high, false, random), last_fold(band, place, low, high),
          predicates::EdgeTies::Kind::everywhere, 0, false, place.exponent};
}

/// Images mirrored in the line at right angles to the edge in one of its ends.
template <FoldedBand (*family)(Random&)>
TiedWindows at_an_end(Random& random) {
  const FoldedBand band = family(random);
  FoldedBand other = band;
  shuffle(other.panels, random);
  const Placement place = Placement::random(random);
  const int length = 1 + static_cast<int>(random.below(9)), rise = (random.below(2) == 0 ? 1 : -1) * static_cast<int>(1 + random.below(12));
  const bool at_high = random.below(2) == 0;
  const int low = at_high ? rise - length : rise, mirrored = at_high ? -rise - length : -rise;
  return {band_window(band, place, low, low + length, random.below(2) == 0, random),
          band_window(other, moved(place, 0, 2 * rise, 0), mirrored, mirrored + length, random.below(2) == 0, random),
          last_fold(band, place, low, low + length), predicates::EdgeTies::Kind::points, at_high ? 1 : 0, false, place.exponent};
}

/// A wave and a relay on its way: they touch where the straight line through both meets the edge.
template <FoldedBand (*family)(Random&)>
TiedWindows contact(Random& random) {
  const FoldedBand band = family(random);
  const Placement place = Placement::random(random);
  const auto relay = band.marks[random.below(static_cast<std::uint32_t>(band.marks.size() - 1))], end = band.marks.back();
  const int slope = static_cast<int>(random.below(5)) - 2, y = slope * relay.multiple, hit = slope * end.multiple;
  const int below = static_cast<int>(random.below(5)), above = (below == 0 ? 1 : 0) + static_cast<int>(random.below(5));
  const Split split = split_at(band, relay.column);
  const int low = hit - below, high = hit + above;
  LaidWindow light = band_window(band, place, low, high, false, random),
             heavy = band_window(split.rest, moved(place, split.x, y, split.z), low - y, high - y, false, random);
  heavy.weight.legs = {way_along(split.near, place, y, random)};
  mpq_class t(below, below + above);
  t.canonicalize();
  const auto edge = last_fold(band, place, low, high);
  if (random.below(2) == 0) std::swap(light, heavy);
  return {light, heavy, edge, predicates::EdgeTies::Kind::points, t, true, place.exponent};
}

/// A wave and a relay on its way along a straight line of mesh edges at right angles to the folds: they tie from the relay on.
template <FoldedBand (*family)(Random&)>
TiedWindows along_the_edge(Random& random) {
  const FoldedBand band = family(random);
  const Placement place = Placement::random(random);
  const std::size_t last = band.panels.size();
  const Split split = split_at(band, 1 + random.below(static_cast<std::uint32_t>(last - 1)));
  const auto window = [&](const FoldedBand& b, const Placement& at) -> LaidWindow {
    const std::size_t n = b.panels.size();
    return {BandStrip::build(b, at, {{n - 1, 0, false}, {n, 0, false}}, false, random).strip, {}};
  };
  LaidWindow light = window(band, place), heavy = window(split.rest, moved(place, split.x, 0, split.z));
  heavy.weight.legs = {way_along(split.near, place, 0, random)};
  if (random.below(2) == 0) std::swap(light, heavy);
  return {light,
          heavy,
          {point_of_band(band, place, last - 1, 0), point_of_band(band, place, last, 0)},
          predicates::EdgeTies::Kind::ray,
          0,
          true,
          place.exponent};
}

/// A strip and its mirror image in a plane that holds the edge: x and y exchanged.
inline TiedWindows mirror_images_in_the_edge(Random& random) {
  LaidOut strip = rough_zigzag(random);
  while (strip.edge.empty()) strip = rough_zigzag(random);
  const std::size_t end = strip.corner.size() - 1, other = strip.edge.back()[random.below(2)];
  for (const std::size_t v : {end, other}) strip.corner[v][1] = strip.corner[v][0];
  LaidOut mirrored = strip;
  for (auto& p : mirrored.corner) std::swap(p[0], p[1]);
  return {{strip, {}}, {mirrored, {}}, {strip.corner[end], strip.corner[other]}, predicates::EdgeTies::Kind::everywhere};
}

struct TiedWindowsFamily {
  const char* name;
  TiedWindows (*make)(Random&);
  bool one_class;  ///< all faces of a strip are of one square class
};
inline constexpr std::array<TiedWindowsFamily, 23> kTiedWindowsFamilies = {{
    {"everywhere_integer_grid", everywhere<integer_grid>, true},
    {"everywhere_pythagorean_folds", everywhere<pythagorean_folds>, true},
    {"everywhere_coplanar_runs", everywhere<coplanar_runs>, true},
    {"everywhere_dependent_classes", everywhere<dependent_classes>, false},
    {"everywhere_repeated_blocks", everywhere<repeated_blocks>, false},
    {"everywhere_any_folds", everywhere<any_folds>, false},
    {"mirror_images_in_the_edge", mirror_images_in_the_edge, false},
    {"at_an_end_integer_grid", at_an_end<integer_grid>, true},
    {"at_an_end_pythagorean_folds", at_an_end<pythagorean_folds>, true},
    {"at_an_end_coplanar_runs", at_an_end<coplanar_runs>, true},
    {"at_an_end_dependent_classes", at_an_end<dependent_classes>, false},
    {"at_an_end_repeated_blocks", at_an_end<repeated_blocks>, false},
    {"at_an_end_any_folds", at_an_end<any_folds>, false},
    {"contact_integer_grid", contact<integer_grid>, true},
    {"contact_pythagorean_folds", contact<pythagorean_folds>, true},
    {"contact_coplanar_runs", contact<coplanar_runs>, true},
    {"contact_dependent_classes", contact<dependent_classes>, false},
    {"contact_repeated_blocks", contact<repeated_blocks>, false},
    {"contact_at_right_angles", contact<any_folds>, false},
    {"ray_integer_grid", along_the_edge<integer_grid>, true},
    {"ray_pythagorean_folds", along_the_edge<pythagorean_folds>, true},
    {"ray_coplanar_runs", along_the_edge<coplanar_runs>, true},
    {"ray_any_folds", along_the_edge<any_folds>, false}}};

}  // namespace gvd::test
