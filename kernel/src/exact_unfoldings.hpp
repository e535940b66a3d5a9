#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "gvd/kernel/unfolding.hpp"

namespace gvd::kernel {

/// The windows of a finished distance field in exact numbers. A window is its parent's unfolding and one step more, so the last
/// ones made are kept: facets beside each other ask for windows of the same strips. Thread-safe.
class ExactUnfoldings {
 public:
  ExactUnfoldings(const Frames& frames, const DistanceField& field) : frames_(frames), field_(field) {}

  /// Null if the strip crosses too many independent square classes.
  std::shared_ptr<const predicates::RootUnfolding> operator()(WindowId window) const;

 private:
  using Pointer = std::shared_ptr<const predicates::RootUnfolding>;
  struct Slot {
    std::mutex mutex;
    WindowId window = kNone;
    Pointer unfolding;
  };
  static constexpr std::size_t kMostSlots = 1 << 14;  // some 20 MB when full

  bool look_up(WindowId window, Pointer& found) const;
  void keep(WindowId window, const Pointer& made) const;
  Pointer step(WindowId window, const predicates::RootUnfolding* parent) const;

  const Frames& frames_;
  const DistanceField& field_;
  mutable std::once_flag allocate_;
  mutable std::vector<Slot> slots_;
};

}  // namespace gvd::kernel
