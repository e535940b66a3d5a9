#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gvd/kernel/facet.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::kernel {

/// The exact lower envelope of the waves of one facet (docs/architecture.md#tessellation-of-a-facet). Indices of sites are those of `FacetWaves::sites`.
struct FacetTessellation {
  static constexpr std::uint32_t kNoSite = 0xffffffffu;

  struct Node {
    enum class Kind : std::uint8_t { corner, side, inside };
    Kind kind = Kind::inside;
    std::uint8_t where = 0;           ///< corner k or side k
    std::vector<std::uint32_t> sites;  ///< the sites whose regions meet here, counter-clockwise (at least two; all that are proved to tie)
    /// How to construct the point again in any number type: the counter-clockwise triple (inside), the pair (side), or nothing (corner).
    std::array<std::uint32_t, 3> defining{kNoSite, kNoSite, kNoSite};
    robust::Ball<double> x, y;        ///< frame of half-edge 3 * face, frame units
    robust::Ball<double> t;           ///< on a side: parameter along the side, 0 at corner k, 1 at corner k + 1
  };
  struct Arc {
    std::uint32_t left = kNoSite, right = kNoSite;  ///< regions beside the arc, seen along from -> to
    std::uint32_t from = 0, to = 0;                  ///< nodes
    bool tangent = false;                            ///< the bisector is a ray behind the focus (relay against its parent), or the sites have one image
  };
  /// What lies just inside the facet along its outline, counter-clockwise from corner 0: the regions met, in order.
  struct Piece {
    std::uint8_t side = 0;
    std::uint32_t site = kNoSite;
    std::uint32_t from = kNoNode, to = kNoNode;  ///< nodes, or kNoNode where the piece begins or ends in the corner of the side
    static constexpr std::uint32_t kNoNode = 0xffffffffu;
  };

  std::vector<Node> nodes;
  std::vector<Arc> arcs;
  std::vector<Piece> outline;
  bool undecided = false;  ///< some decision failed at every stage; it is listed in the decisions, and the tessellation is empty
};

/// Tessellates by direct window growth. Every combinatorial statement of the result is proved, or `undecided` is set.
/// Cost: O(n^3) predicates in the worst case for n sites, O(n^2) usually; n is 2 to 10 on terrains.
FacetTessellation tessellate(FacetWaves& waves, predicates::Decisions& decisions);

}  // namespace gvd::kernel
