#pragma once

#include <cstdint>

#include "gvd/kernel/diagram.hpp"

namespace gvd::io {

/// The source that stands for a label set in pictures: the one with the smallest id; -1 for none (unreachable, or no set).
inline std::int32_t drawn_source(const kernel::Diagram& diagram, kernel::LabelSetId labels) {
  if (labels == kernel::kNone || diagram.label_sets[labels].empty()) return -1;
  return static_cast<std::int32_t>(diagram.label_sets[labels].front());
}

}  // namespace gvd::io
