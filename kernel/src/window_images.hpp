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

  WindowImages(const Frames& frames, const DistanceField& field) : frames_(frames), field_(field), slot_(field.windows.size(), kNone) {}
  /// Makes those of the windows `wanted` and of all they come from, in the order in which windows were made: parents first.
  void add(const std::vector<WindowId>& wanted);
  /// Of any window; one that was not added is made now. Valid until the next call, as what `find` gives.
  const Image& operator()(WindowId window);
  /// Null if it has not been made.
  const Image* find(WindowId window) const { return slot_[window] == kNone ? nullptr : &images_[slot_[window]]; }

 private:
  static constexpr std::uint32_t kWanted = kNone - 1;
  Image from_parent(WindowId window) const;

  const Frames& frames_;
  const DistanceField& field_;
  std::vector<std::uint32_t> slot_;  // per window: where in images_, or kNone, or kWanted for a while
  std::vector<Image> images_;
  std::vector<WindowId> path_;
};

}  // namespace gvd::kernel
