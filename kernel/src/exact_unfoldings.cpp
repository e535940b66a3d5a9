#include "exact_unfoldings.hpp"

#include <algorithm>
#include <vector>

#include "gvd/robust/proof_limit.hpp"

namespace gvd::kernel {

using predicates::RootUnfolding;

bool ExactUnfoldings::look_up(WindowId window, Pointer& found) const {
  Slot& slot = slots_[window % slots_.size()];
  const std::scoped_lock lock(slot.mutex);
  if (slot.window != window) return false;
  found = slot.unfolding;
  return true;
}

void ExactUnfoldings::keep(WindowId window, const Pointer& made) const {
  Slot& slot = slots_[window % slots_.size()];
  const std::scoped_lock lock(slot.mutex);
  slot.window = window;
  slot.unfolding = made;
}

ExactUnfoldings::Pointer ExactUnfoldings::step(WindowId window, const RootUnfolding* parent) const {
  const Mesh& mesh = frames_.mesh();
  const WindowRecord& record = field_.windows[window];
  const HalfedgeId side = mesh.twin(record.halfedge());
  const auto of_face = frames_.in_roots(Mesh::face(side));
  const auto& frame = (*of_face)[side % 3];
  if (record.parent == kNone) return std::make_shared<RootUnfolding>(predicates::first_unfolding(frame));
  const HalfedgeId before = field_.windows[record.parent].halfedge();
  auto next = std::make_shared<RootUnfolding>(*parent);
  predicates::take_step(*next, {side, side == Mesh::prev(before), record.apex_in_cone()}, frame);
  return predicates::is_short(next->image) ? next : nullptr;
}

ExactUnfoldings::Pointer ExactUnfoldings::operator()(WindowId window) const {
  if (!robust::ProofLimit::allows_one()) return nullptr;
  std::call_once(allocate_, [&] { slots_ = std::vector<Slot>(std::min<std::size_t>(kMostSlots, field_.windows.size())); });
  std::vector<WindowId> missing;
  Pointer at;
  bool started = false;
  for (WindowId w = window; w != kNone && !started; w = field_.windows[w].parent) {
    started = look_up(w, at);
    if (!started) missing.push_back(w);
  }
  for (; !missing.empty(); missing.pop_back()) {
    if (!started || at != nullptr) at = step(missing.back(), at.get());
    started = true;
    keep(missing.back(), at);
  }
  return at;
}

}  // namespace gvd::kernel
