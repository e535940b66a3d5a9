#pragma once

#include <vector>

#include "chains.hpp"
#include "loops.hpp"

/// Cells: their pieces in the faces, their Euler characteristic, their area.
namespace gvd::kernel::subdivision {

/// Where the links ended up in the diagram.
struct LinkArcs {
  std::vector<std::uint32_t> arc;      ///< per link
  std::vector<std::uint8_t> reversed;  ///< per link: the arc runs against it
};

/// Fills cells (source, hidden, euler). With `check`, throws InternalError unless  characteristic of the surface = sum over label sets of that of
/// their closed regions + open chains - sum over ends of chains of (label sets there - 1).
void count_cells(const DiagramInput& in, const Subdivision& s, const Chains& chains, bool check, Diagram& diagram);

/// Fills face_label, pieces, boundary_facets, the areas of the cells, shared. `point_of`: per place its point, or kNone. Pre: count_cells.
void make_cells(const DiagramInput& in, const Subdivision& s, const Loops& loops, const std::vector<std::uint32_t>& point_of, const LinkArcs& link_arcs,
                Diagram& diagram);

}  // namespace gvd::kernel::subdivision
