#include "unfolded_windows.hpp"

namespace gvd::kernel {

UnfoldedWindows::UnfoldedWindows(const Frames& frames, const DistanceField& field, const std::vector<WindowId>& wanted)
    : entry_of_(field.windows.size(), kNone) {
  std::size_t count = 0;
  for (const WindowId w : wanted) entry_of_[w] = 0;
  for (auto w = static_cast<WindowId>(entry_of_.size()); w-- > 0;) {
    if (entry_of_[w] == kNone) continue;
    ++count;
    if (const WindowId parent = field.windows[w].parent; parent != kNone) entry_of_[parent] = 0;
  }
  entries_.reserve(count);
  for (WindowId w = 0; w < entry_of_.size(); ++w) {
    if (entry_of_[w] == kNone) continue;
    const WindowId parent = field.windows[w].parent;
    entry_of_[w] = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back(make(frames, field, w, parent == kNone ? nullptr : &entries_[entry_of_[parent]]));
  }
}

UnfoldedWindows::Entry UnfoldedWindows::make(const Frames& frames, const DistanceField& field, WindowId window, const Entry* parent) {
  const WindowRecord& record = field.windows[window];
  const HalfedgeId side = frames.mesh().twin(record.halfedge());
  const double unit = predicates::unit<double>(0);
  if (parent == nullptr) {
    Entry entry{predicates::unfold_first(frames(side), unit)};
    entry.first = window;
    entry.dead = record.dead();
    return entry;
  }
  const bool left = side == Mesh::prev(field.windows[record.parent].halfedge());
  Entry entry = *parent;
  const auto& frame = frames(side);
  const double turn = predicates::length_bound(left ? frame.v : frame.u, frame.y);  // one for all three
  predicates::unfold_step_by<true>(entry.at, left, record.apex_in_cone(), [&](const predicates::Disc<double>& z) {
    const auto to = left ? cross_left(z.mid, frame) : cross_right(z.mid, frame);
    return predicates::Disc<double>{to, predicates::radius_after(z, to, turn, unit)};
  });
  const std::size_t c = left ? 1 : 0;  // the cone vertex on the side that is left
  entry.bounds_edge[c] = record.apex_in_cone();
  if (record.apex_in_cone()) entry.bound[c] = record.parent;
  return entry;
}

}  // namespace gvd::kernel
