#pragma once

#include "laid_out.hpp"
#include "meshes.hpp"

namespace gvd::test {

/// Random corners over random edges; `change` makes them adversarial.
template <class Change>
LaidOut random_layout(std::size_t faces, Random& random, const Change& change) {
  LaidOut strip;
  const auto point = [&](double x, double y, double z) { return change(predicates::SpacePoint{x, y, z}); };
  // A zigzag between two banks with heights: at every face one bank goes on.
  double left = 0, right = 0.5;
  strip.corner = {point(-1 + random.uniform(-0.3, 0.3), 0, random.uniform()), point(left, 1, random.uniform()), point(right, -1, random.uniform())};
  std::size_t bank_left = 1, bank_right = 2;
  while (strip.corner.size() < faces + 3) {
    const std::size_t v = strip.corner.size();
    strip.edge.push_back({bank_left, bank_right});
    if (random.below(2) == 0) {
      strip.corner.push_back(point(left += random.uniform(0.2, 1), 1 + random.uniform(-0.2, 0.2), random.uniform()));
      bank_left = v;
    } else {
      strip.corner.push_back(point(right += random.uniform(0.2, 1), -1 + random.uniform(-0.2, 0.2), random.uniform()));
      bank_right = v;
    }
  }
  return strip;
}

}  // namespace gvd::test
