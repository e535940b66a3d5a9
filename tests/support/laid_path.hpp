#pragma once

#include "gvd/predicates/strip_path.hpp"
#include "laid_out.hpp"
#include "real.hpp"

/// Paths of legs that end in the last corner of their strip, and their lengths by independent means.
namespace gvd::test {

struct LaidPath {
  mpq_class given = 0;
  std::vector<LaidOut> legs;

  predicates::Path described() const {
    predicates::Path path;
    path.given = given;
    for (const LaidOut& leg : legs) path.legs.emplace_back(leg.strip(), predicates::FacePoint::corner(2));
    return path;
  }
  Real length() const {
    Real sum = real(given);
    for (const LaidOut& leg : legs) {
      const auto flat = leg.flat<Real>();
      sum += norm(flat.back() - leg.image(flat));
    }
    return sum;
  }
};

/// The same strip from its last corner to its source. Pre: the source is corner 0.
inline LaidOut turned_round(const LaidOut& strip) {
  LaidOut back;
  std::vector<std::size_t> number(strip.corner.size());
  const auto add = [&](std::size_t v) {
    number[v] = back.corner.size();
    back.corner.push_back(strip.corner[v]);
  };
  add(strip.corner.size() - 1);
  add(strip.edge.back()[1]);
  add(strip.edge.back()[0]);
  for (std::size_t i = strip.edge.size(); i-- > 0;) {
    const auto [a, b] = strip.edge[i];
    back.edge.push_back({number[b], number[a]});
    if (i == 0) {
      add(0);
    } else {  // the corner of the face before that is not on this edge
      const std::array<std::size_t, 3> face{strip.edge[i - 1][0], strip.edge[i - 1][1], i + 2};
      for (const std::size_t v : face)
        if (v != a && v != b) add(v);
    }
  }
  return back;
}

}  // namespace gvd::test
