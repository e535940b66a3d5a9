#include "unfolded_windows.hpp"

#include "gvd/robust/double_double.hpp"

namespace gvd::kernel {

template <class T>
typename UnfoldedWindows<T>::Entry UnfoldedWindows<T>::make(const Frames& frames, const DistanceField& field, WindowId window,
                                                            const Entry* parent) {
  const WindowRecord& record = field.windows[window];
  const HalfedgeId side = frames.mesh().twin(record.halfedge());
  const double unit = predicates::unit<T>(0);
  if (parent == nullptr) {
    Entry entry{predicates::unfold_first(frame(frames, side), unit)};
    entry.first = window;
    entry.dead = record.dead();
    return entry;
  }
  const bool left = side == Mesh::prev(field.windows[record.parent].halfedge());
  Entry entry = *parent;
  predicates::unfold_step(entry.at, frame(frames, side), left, record.apex_in_cone(), unit);
  const std::size_t c = left ? 1 : 0;  // the cone vertex on the side that is left
  entry.bounds_edge[c] = record.apex_in_cone();
  if (record.apex_in_cone()) entry.bound[c] = record.parent;
  entry.dead = parent->dead || record.dead();
  return entry;
}

template class UnfoldedWindows<double>;
template class UnfoldedWindows<robust::DoubleDouble>;

}  // namespace gvd::kernel
