#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gvd/kernel/facet.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::kernel {

/// The exact lower envelope of the waves of one facet (docs/architecture.md#tessellation-of-a-facet). Indices of sites are those of `FacetWaves::sites`.
/// Windows of one root with the same image (they pass a flat vertex on either side) are one region; the lowest index stands for it.
/// A corner site whose region touches the facet only in its corner has no region here.
struct FacetTessellation {
  static constexpr std::uint32_t kNoSite = 0xffffffffu;

  struct Node {
    enum class Kind : std::uint8_t { corner, side, inside };
    Kind kind = Kind::inside;         ///< also of a vertex on a side that its regions only touch: nothing changes along the side there
    std::uint8_t where = 0;           ///< corner k or side k
    /// The sites whose regions meet here, counter-clockwise; at a corner or on a side from the direction in which the outline goes on to
    /// the one it came from. At least two; all regions that have this point as a corner.
    std::vector<std::uint32_t> sites;
    /// How to construct the point again in any number type (kernel/node_point.hpp): inside, the counter-clockwise triple; on a side, the site
    /// before and the site after the point, along the outline; nothing at a corner.
    std::array<std::uint32_t, 3> defining{kNoSite, kNoSite, kNoSite};
    /// If set, the point lies on the boundary ray of this site through its cone vertex `ray_end`, by identity. Inside the facet,
    /// `defining` is then {relay, third site}.
    std::uint32_t ray = kNoSite;
    std::uint8_t ray_end = 0;
    robust::Ball<double> x, y;        ///< frame of half-edge 3 * face, frame units
    robust::Ball<double> t;           ///< on a side: parameter along the side, 0 at corner k, 1 at corner k + 1
  };
  struct Arc {
    std::uint32_t left = kNoSite, right = kNoSite;  ///< regions beside the arc, seen along from -> to
    std::uint32_t from = 0, to = 0;                  ///< nodes
    bool tangent = false;                            ///< the bisector is a ray behind the focus: a relay against its parent
  };
  /// What lies just inside the facet along its outline, counter-clockwise from corner 0: the regions met, in order.
  struct Piece {
    std::uint8_t side = 0;
    std::uint32_t site = kNoSite;
    std::uint32_t from = kNoNode, to = kNoNode;  ///< nodes, or kNoNode where the piece begins or ends in the corner of the side
    static constexpr std::uint32_t kNoNode = 0xffffffffu;
  };

  /// Per site the one that stands for it (windows of one image are one region); itself as a rule.
  std::vector<std::uint32_t> representative;
  std::vector<Node> nodes;
  std::vector<Arc> arcs;
  std::vector<Piece> outline;
  /// Only the borders of label sets: arcs between different ones, and nodes on them. The outline has one piece where the label set stays the same,
  /// with the site where it begins; `representative` is complete.
  bool borders_only = false;
  /// Whether it is known that all of the closed facet has one label set.
  bool has_one_label() const { return borders_only && nodes.empty(); }
  bool undecided = false;  ///< some decision failed at every stage; it is listed in the decisions, and the tessellation is empty
};

/// Tessellates by direct window growth. Every combinatorial statement of the result is proved, or `undecided` is set.
/// Cost: O(n^3) predicates in the worst case for n sites, O(n^2) usually; n is 2 to 10 on terrains.
FacetTessellation tessellate(FacetWaves& waves, predicates::Decisions& decisions);

/// What the diagram needs of it: the borders alone where plain doubles can follow them from side to side (`borders_only`), else all of it.
FacetTessellation tessellate_borders(FacetWaves& waves, predicates::Decisions& decisions);

}  // namespace gvd::kernel
