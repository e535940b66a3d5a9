#pragma once

#include "gvd/predicates/strip_window.hpp"
#include "laid_path.hpp"

namespace gvd::test {

/// A window by the corners of its strip, and its distances by independent means.
struct LaidWindow {
  LaidOut strip;
  LaidPath weight;

  predicates::Window described() const { return {strip.strip(), weight.described(), std::nullopt}; }
};

/// Distances along a window at the points of the segment between two corners of its strip.
class EdgeDistances {
 public:
  EdgeDistances(const LaidWindow& window, const std::array<predicates::SpacePoint, 2>& edge) : weight_(window.weight.length()) {
    const auto flat = window.strip.flat<Real>();
    image_ = window.strip.image(flat);
    for (std::size_t end = 0; end < 2; ++end) {
      std::size_t v = flat.size();
      while (window.strip.corner[--v] != edge[end]) continue;
      end_[end] = flat[v];
    }
  }
  Real at(const Real& t) const {
    const auto along = end_[1] - end_[0];
    return weight_ + norm(RealPoint<Real>{end_[0].x + t * along.x, end_[0].y + t * along.y} - image_);
  }

 private:
  Real weight_;
  RealPoint<Real> image_;
  std::array<RealPoint<Real>, 2> end_;
};

}  // namespace gvd::test
