#pragma once
/// Where the strips of several waves were together last, going back from a facet.
#include <vector>

#include "gvd/kernel/ids.hpp"
#include "gvd/robust/rational.hpp"

namespace gvd::kernel {

/// Where strips were together: the half-edge that coordinates refer to, and of each wave its window there (kNone: it starts at a vertex in line with the
/// half-edge) with the place of the window's own half-edge, or of the vertex, along the first.
struct Parting {
  struct Strip {
    WindowId window;
    mpq_class origin = 0, length = 1;
  };
  HalfedgeId base;
  std::vector<Strip> strips;
};

}  // namespace gvd::kernel
