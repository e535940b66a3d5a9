#pragma once

#include <algorithm>

#include "folded_band.hpp"

/// Folded bands by the square classes of their widths. Every one has at least three marks at different columns.
namespace gvd::test {

inline void shuffle(std::vector<Panel>& panels, Random& random) {
  for (std::size_t k = panels.size(); k > 1; --k) std::swap(panels[k - 1], panels[random.below(static_cast<std::uint32_t>(k))]);
}
/// Rising or falling.
inline Panel either_way(Panel panel, Random& random) { return random.below(2) == 0 ? panel : Panel{panel.dx, -panel.dz}; }

/// A plane, no folds.
inline FoldedBand integer_grid(Random& random) {
  FoldedBand band;
  for (int at = 0, i = 0, n = 3 + static_cast<int>(random.below(3)); i < n; ++i) {
    const int width = 1 + static_cast<int>(random.below(3));
    band.append({width, 0});
    band.mark(at += width);
  }
  return band;
}

/// Rational widths.
inline FoldedBand pythagorean_folds(Random& random) {
  constexpr std::array<std::array<int, 3>, 6> kTriples{{{3, 4, 5}, {4, 3, 5}, {5, 12, 13}, {12, 5, 13}, {8, 15, 17}, {7, 0, 7}}};
  FoldedBand band;
  for (int at = 0, i = 0, n = 3 + static_cast<int>(random.below(3)); i < n; ++i) {
    const auto& t = kTriples[random.below(6)];
    band.append(either_way({t[0], t[1]}, random));
    band.mark(at += t[2]);
  }
  return band;
}

/// Runs of coplanar panels that rise or fall alike: one square class that is none of the rationals.
inline FoldedBand coplanar_runs(Random& random) {
  constexpr std::array<Panel, 5> kSlopes{{{1, 1}, {1, 2}, {3, 1}, {2, 3}, {1, 4}}};
  const Panel slope = kSlopes[random.below(5)];
  FoldedBand band;
  for (int at = 0, run = 0; run < 2; ++run) {
    const Panel way = either_way(slope, random);
    for (int i = 0, n = 2 + static_cast<int>(random.below(2)); i < n; ++i) {
      const int width = 1 + static_cast<int>(random.below(3));
      band.append({width * way.dx, width * way.dz});
      band.mark(at += width);
    }
  }
  return band;
}

/// The same panels again and again, in another order each time: only the ends of blocks are commensurable.
inline FoldedBand repeated(std::vector<Panel> block, int times, Random& random) {
  FoldedBand band;
  for (int i = 1; i <= times; ++i) {
    shuffle(block, random);
    for (const Panel& panel : block) band.append(either_way(panel, random));
    band.mark(i);
  }
  return band;
}

/// Widths of the classes 2, 5 and 10, the product of both.
inline FoldedBand dependent_classes(Random& random) {
  std::vector<Panel> block{{1, 1}, {1, 2}, {1, 3}};
  for (Panel& panel : block) {
    const int k = 1 + static_cast<int>(random.below(3));
    panel = {k * panel.dx, k * panel.dz};
  }
  return repeated(block, 3, random);
}

inline Panel any_panel(Random& random) { return {1 + static_cast<int>(random.below(20)), static_cast<int>(random.below(21))}; }

/// Blocks of a few widths of any classes.
inline FoldedBand repeated_blocks(Random& random) {
  std::vector<Panel> block;
  for (std::uint32_t i = 0, n = 2 + random.below(2); i < n; ++i) block.push_back(any_panel(random));
  return repeated(block, 3, random);
}

/// Panels of any classes. Only what lies at right angles to the folds is known to be straight: marks have no multiple.
inline FoldedBand any_folds(Random& random) {
  FoldedBand band;
  for (std::uint32_t i = 0, n = 3 + random.below(3); i < n; ++i) {
    band.append(any_panel(random));
    band.mark(0);
  }
  return band;
}

struct BandFamily {
  const char* name;
  FoldedBand (*make)(Random&);
  bool one_class;  ///< all faces of a strip are of one square class
};
inline constexpr std::array<BandFamily, 6> kBandFamilies = {{{"integer_grid", integer_grid, true},
                                                             {"pythagorean_folds", pythagorean_folds, true},
                                                             {"coplanar_runs", coplanar_runs, true},
                                                             {"dependent_classes", dependent_classes, false},
                                                             {"repeated_blocks", repeated_blocks, false},
                                                             {"along_mesh_edges", any_folds, false}}};

}  // namespace gvd::test
