#pragma once

#include "band_families.hpp"
#include "real.hpp"
#include "worst_case_tally.hpp"

/// Strips with two vertices in line with the source by construction.
namespace gvd::test {

struct InLine {
  LaidOut strip;
  std::size_t through, v;
  std::array<std::size_t, 2> end;  ///< the edge at the end

  /// The strip with one face more: over the edge at its end.
  LaidOut extended() const {
    LaidOut longer = strip;
    const std::size_t last = strip.corner.size() - 1;
    const auto& before = strip.edge.back();
    const std::size_t gone = end[0] == last ? before[0] : before[1];
    predicates::SpacePoint beyond;
    for (std::size_t i = 0; i < 3; ++i) beyond[i] = strip.corner[end[0]][i] + strip.corner[end[1]][i] - strip.corner[gone][i];
    longer.edge.push_back(end);
    longer.corner.push_back(beyond);
    return longer;
  }
};

/// Per column, about where the line of so much a mark passes.
inline std::vector<int> along_line(const FoldedBand& band, int slope) {
  std::vector<double> x{0};
  for (const Panel& panel : band.panels) x.push_back(x.back() + std::hypot(panel.dx, panel.dz));
  const auto& last = band.marks.back();
  std::vector<int> y;
  for (const double at : x) y.push_back(static_cast<int>(std::lround(slope * last.multiple * at / x[last.column])));
  return y;
}

inline InLine in_line(const BandFamily& family, Random& random) {
  const FoldedBand band = family.make(random);
  const int slope = static_cast<int>(random.below(5)) - 2;
  std::size_t first = random.below(static_cast<std::uint32_t>(band.marks.size() - 1)), second = band.marks.size() - 1;
  if (first > 0 && random.below(2) == 0) std::swap(first, second);
  std::vector<BandStrip::Anchor> anchors;
  for (const std::size_t m : {first, second}) anchors.push_back({band.marks[m].column, slope * band.marks[m].multiple, random.below(2) == 0});
  const auto built = BandStrip::build(band, Placement::random(random), anchors, random.below(2) == 0, random, along_line(band, slope));
  return {built.strip, built.anchor[0], built.anchor[1], built.end};
}

/// A coordinate of one of the three points by an ulp, or the source by less.
inline InLine neighbour(InLine c, Random& random) {
  if (random.below(2) == 0) {
    c.strip.source.weight[1 + random.below(2)] += small_step(random);
  } else {
    const std::array<std::size_t, 3> points{0, c.through, c.v};
    nudge(c.strip.corner[points[random.below(3)]], random);
  }
  return c;
}

}  // namespace gvd::test
