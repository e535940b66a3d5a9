#pragma once

#include <cstdint>
#include <vector>

#include "subdivision.hpp"

/// The outlines of the pieces into which the diagram cuts faces of the input mesh.
namespace gvd::kernel::subdivision {

/// A closed outline of a piece of an input face.
struct Loop {
  std::uint32_t region;  ///< the same for all loops of a piece
  LabelSetId labels;
  FaceId face;
  std::uint32_t begin, end;  ///< range of its darts
  double area = 0;           ///< inside it; negative for a hole
};

struct Loops {
  std::vector<Loop> list;  ///< by face, then by piece; of a piece first the outer one
  std::vector<std::uint32_t> darts;
};

/// Those of all input faces of which a facet is subdivided.
Loops find_loops(const DiagramInput& in, const Subdivision& s);

}  // namespace gvd::kernel::subdivision
