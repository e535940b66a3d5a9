#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "gvd/kernel/distance_field.hpp"
#include "gvd/kernel/frames.hpp"
#include "gvd/predicates/strip.hpp"

namespace gvd::kernel {

/// Windows unfolded along the tree of their strips: each from its parent's numbers by the one face between them, which gives the same numbers as
/// its whole strip. Not for several threads while windows are added.
template <class T>
class UnfoldedWindows {
 public:
  struct Entry {
    predicates::Unfolding<T> at;
    /// Per cone vertex: the window whose apex it is, or kNone: an end of the first edge.
    std::array<WindowId, 2> bound{kNone, kNone};
    /// Per cone vertex: whether it bounds the last edge, too: no step since has left it.
    std::array<bool, 2> bounds_edge{true, true};
    bool dead = false;  ///< the window, or one that it comes from, was superseded
  };

  UnfoldedWindows(const Frames& frames, const DistanceField& field) : frames_(frames), field_(field) {}

  void reserve(std::size_t windows) { entries_.reserve(windows); }
  /// Adds the window and all it comes from.
  const Entry& add(WindowId window) {
    path_.clear();
    while (window != kNone && !entries_.contains(window)) {
      path_.push_back(window);
      window = field_.windows[window].parent;
    }
    const Entry* entry = window == kNone ? nullptr : &entries_.find(window)->second;
    for (; !path_.empty(); path_.pop_back()) entry = &entries_.emplace(path_.back(), make(path_.back(), entry)).first->second;
    return entry == nullptr ? entries_.find(window)->second : *entry;
  }
  /// Null if it was not added.
  const Entry* find(WindowId window) const {
    const auto at = entries_.find(window);
    return at == entries_.end() ? nullptr : &at->second;
  }

 private:
  Entry make(WindowId window, const Entry* parent) const;
  const predicates::EdgeFrame<T>& frame(HalfedgeId h) const {
    if constexpr (std::is_same_v<T, double>)
      return frames_(h);
    else
      return frames_.in_double_double(h);
  }

  const Frames& frames_;
  const DistanceField& field_;
  std::unordered_map<WindowId, Entry> entries_;
  std::vector<WindowId> path_;
};

}  // namespace gvd::kernel
