#pragma once

#include <vector>

#include "gvd/kernel/distance_field.hpp"
#include "gvd/kernel/frames.hpp"
#include "gvd/predicates/strip.hpp"

namespace gvd::kernel {

/// Images of windows in double-double, without their cones: each from its parent's by the one face between them, and each made once. Numbers as by
/// unfolding its strip.
class WindowImages {
 public:
  using Image = predicates::Disc<robust::DoubleDouble>;

  /// Makes those of the windows `wanted` and of all they come from, in the order in which windows were made: parents first.
  WindowImages(const Frames& frames, const DistanceField& field, const std::vector<WindowId>& wanted);
  /// Of any window; one that was not wanted is made now. Valid until the next call.
  const Image& operator()(WindowId window);

 private:
  Image from_parent(WindowId window) const;

  const Frames& frames_;
  const DistanceField& field_;
  std::vector<std::uint32_t> slot_;  // per window: where in images_, or kNone
  std::vector<Image> images_;
  std::vector<WindowId> path_;
};

}  // namespace gvd::kernel
