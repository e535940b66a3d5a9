#pragma once

#include <algorithm>

#include "laid_out.hpp"
#include "meshes.hpp"

/// Fans round a centre whose spokes are whole vectors of one length: (a, b, c) with its entries permuted and their signs changed. Which angles can
/// follow each other does not depend on the spoke, so the angles of a fan can be put into any order, and its last corner stays as far from its first one.
namespace gvd::test {

using WholeVector = std::array<int, 3>;
inline int dot(const WholeVector& a, const WholeVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// All vectors of the kind of `v`.
inline std::vector<WholeVector> orbit(WholeVector v) {
  std::vector<WholeVector> all;
  std::sort(v.begin(), v.end());
  do {
    for (int signs = 0; signs < 8; ++signs) {
      WholeVector w = v;
      for (std::size_t k = 0; k < 3; ++k)
        if ((signs >> k & 1) != 0) w[k] = -w[k];
      if (std::find(all.begin(), all.end(), w) == all.end()) all.push_back(w);
    }
  } while (std::next_permutation(v.begin(), v.end()));
  return all;
}

/// The cosines between spokes that are neither equal nor opposite, times the square of their length.
inline std::vector<int> dots_of(const std::vector<WholeVector>& spokes) {
  std::vector<int> dots;
  const int square = dot(spokes[0], spokes[0]);
  for (const WholeVector& w : spokes) {
    const int d = dot(spokes[0], w);
    if (d * d != square * square && std::find(dots.begin(), dots.end(), d) == dots.end()) dots.push_back(d);
  }
  return dots;
}

/// Spokes with the given products from each to the next one, the first one anywhere; no face comes twice in a row. Empty if the choice led nowhere.
inline std::vector<WholeVector> spokes_with(const std::vector<WholeVector>& all, const std::vector<int>& dots, Random& random) {
  std::vector<WholeVector> spokes{all[random.below(static_cast<std::uint32_t>(all.size()))]};
  for (const int d : dots) {
    std::vector<WholeVector> next;
    for (const WholeVector& w : all)
      if (dot(spokes.back(), w) == d && (spokes.size() < 2 || w != spokes[spokes.size() - 2])) next.push_back(w);
    if (next.empty()) return {};
    spokes.push_back(next[random.below(static_cast<std::uint32_t>(next.size()))]);
  }
  return spokes;
}

/// From the first spoke to the last one; `centre` plus spokes times `size` must be exact.
inline LaidOut fan_strip(const std::vector<WholeVector>& spokes, const predicates::SpacePoint& centre, double size) {
  const auto at = [&](const WholeVector& w) -> predicates::SpacePoint {
    return {centre[0] + size * w[0], centre[1] + size * w[1], centre[2] + size * w[2]};
  };
  LaidOut strip;
  strip.corner = {at(spokes[0]), centre, at(spokes[1])};
  for (std::size_t i = 2; i < spokes.size(); ++i) {
    strip.edge.push_back({1, i});
    strip.corner.push_back(at(spokes[i]));
  }
  return strip;
}

}  // namespace gvd::test
