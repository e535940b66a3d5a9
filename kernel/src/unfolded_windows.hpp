#pragma once

#include <array>
#include <vector>

#include "gvd/kernel/distance_field.hpp"
#include "gvd/kernel/frames.hpp"
#include "gvd/predicates/strip.hpp"

namespace gvd::kernel {

/// Windows unfolded along the tree of their strips, in doubles with their error discs: each from its parent's numbers by the one face between them, which gives the same numbers as
/// its whole strip.
class UnfoldedWindows {
 public:
  struct Entry {
    predicates::Unfolding<double> at;
    /// Per cone vertex: the window whose apex it is, or kNone: an end of the first edge.
    std::array<WindowId, 2> bound{kNone, kNone};
    /// Per cone vertex: whether it bounds the last edge, too: no step since has left it.
    std::array<bool, 2> bounds_edge{true, true};
    WindowId first = kNone;  ///< the first window of the strip
    bool dead = false;       ///< the first window was superseded, and so all that come from it
  };

  /// Those wanted and all they come from, in the order in which windows were made: parents first.
  UnfoldedWindows(const Frames& frames, const DistanceField& field, const std::vector<WindowId>& wanted);
  /// A single window, of which no other one is known.
  static Entry alone(const Frames& frames, const DistanceField& field, WindowId window) {
    std::vector<WindowId> path;
    for (; window != kNone; window = field.windows[window].parent) path.push_back(window);
    Entry entry = make(frames, field, path.back(), nullptr);
    for (path.pop_back(); !path.empty(); path.pop_back()) entry = make(frames, field, path.back(), &entry);
    return entry;
  }
  /// Null if it was not wanted.
  const Entry* find(WindowId window) const { return entry_of_[window] == kNone ? nullptr : &entries_[entry_of_[window]]; }

 private:
  static Entry make(const Frames& frames, const DistanceField& field, WindowId window, const Entry* parent);

  std::vector<std::uint32_t> entry_of_;  ///< per window
  std::vector<Entry> entries_;
};

}  // namespace gvd::kernel
