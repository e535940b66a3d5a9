#include "window_images.hpp"

namespace gvd::kernel {

void WindowImages::add(const std::vector<WindowId>& wanted) {
  std::uint32_t count = 0;
  for (const WindowId w : wanted)
    if (slot_[w] == kNone) slot_[w] = kWanted;
  for (WindowId w = static_cast<WindowId>(slot_.size()); w-- > 0;) {
    if (slot_[w] != kWanted) continue;
    ++count;
    if (const WindowId parent = field_.windows[w].parent; parent != kNone && slot_[parent] == kNone) slot_[parent] = kWanted;
  }
  images_.reserve(images_.size() + count);
  for (WindowId w = 0; w < slot_.size(); ++w) {
    if (slot_[w] != kWanted) continue;
    images_.push_back(from_parent(w));
    slot_[w] = static_cast<std::uint32_t>(images_.size() - 1);
  }
}

const WindowImages::Image& WindowImages::operator()(WindowId window) {
  for (WindowId w = window; w != kNone && slot_[w] == kNone; w = field_.windows[w].parent) path_.push_back(w);
  for (; !path_.empty(); path_.pop_back()) {
    images_.push_back(from_parent(path_.back()));
    slot_[path_.back()] = static_cast<std::uint32_t>(images_.size() - 1);
  }
  return images_[slot_[window]];
}

WindowImages::Image WindowImages::from_parent(WindowId window) const {
  const WindowRecord& record = field_.windows[window];
  const HalfedgeId side = frames_.mesh().twin(record.halfedge());
  const double unit = predicates::unit<robust::DoubleDouble>(0);
  const auto& frame = frames_.in_double_double(side);
  if (record.parent == kNone) return predicates::unfold_first(frame, unit).image;
  const bool left = side == Mesh::prev(field_.windows[record.parent].halfedge());
  return cross(images_[slot_[record.parent]], frame, left, unit);
}

}  // namespace gvd::kernel
