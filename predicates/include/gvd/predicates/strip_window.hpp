#pragma once

#include <optional>
#include <vector>

#include "gvd/predicates/strip_path.hpp"

/// Windows of the caller: where two of them tie along an edge, and which of four is nearer at a vertex of three.
namespace gvd::predicates {

/// A wave: a source seen through a strip, after a path that brought the wave to the source (empty for a true source). At a point of the last
/// face its distance is length(weight) + |image - point|.
struct Window {
  FaceStrip strip;
  Path weight;
  /// The vertices of the strip whose rays bound what the window sees, left and right (`cone_of` finds them); without it sees everything.
  std::optional<std::array<std::size_t, 2>> cone;
  friend bool operator==(const Window&, const Window&) = default;
};

/// A place of an edge where two windows tie.
struct EdgeTie {
  Enclosure t;      ///< parameter along the edge, 0 at its first end
  bool a_before;    ///< whether `a` is the nearer one just before it (for a contact: on both sides, where it is not everywhere)
  bool is_contact;  ///< they touch there without crossing
};
struct EdgeTies {
  enum class Kind {
    none,        ///< one window is nearer all along: `a_is_nearer`
    points,      ///< one or two, in the order of the edge
    everywhere,  ///< all along the line of the edge: the same image, or mirror images, with equal weights
    ray,         ///< both images lie on the line of the edge and tie along a ray of it that meets the edge in more than a point
    undecided
  };
  Kind kind = Kind::undecided;
  bool a_is_nearer = false;
  std::vector<EdgeTie> ties;
  robust::Stage stage = robust::Stage::undecided;
};
/// Where the two windows tie on the closed edge, cones aside. `edge`: two corners of the last faces of both strips (which may be the faces
/// on either side of it, and may come in over it or over another edge). Laws: swapping the windows exchanges their parts; swapping the ends
/// maps t to 1 - t; equal weights are recognised by identity if the paths are equal.
/// Throws std::invalid_argument if `edge` is not an edge of both last faces.
EdgeTies ties_on_edge(const Window& a, const Window& b, const std::array<SpacePoint, 2>& edge);
std::optional<EdgeTies> ties_on_edge_at(const Rung& rung, const Window& a, const Window& b, const std::array<SpacePoint, 2>& edge);

/// What a further window is to the vertex of three.
enum class Conflict {
  no_vertex,  ///< the three tie nowhere with their regions in this order, or one of them does not see the point
  farther,    ///< or it does not see the point
  ties,
  nearer,     ///< the vertex is none of the diagram
};
struct ConflictDecision {
  std::optional<Conflict> verdict;
  robust::Stage stage = robust::Stage::undecided;
};
/// Whether `rival` conflicts with the point of the plane of `facet` at which windows i, j, k tie, their regions counter-clockwise round it.
/// There is at most one such point; it may lie outside the facet. `facet`: the last face of all four strips, its corners counter-clockwise
/// (a strip without crossing whose only face it is may be among them: a source in the facet or at its corner).
/// Laws: invariant under cyclic permutation of i, j, k. Pre: none of the three is a relay whose parent is another of them (their bisector is
/// a ray behind the relay, which the caller knows by identity; here it counts as `no_vertex`). Throws std::invalid_argument if a last face has other corners.
ConflictDecision conflict(const FaceCorners& facet, const std::array<const Window*, 3>& ijk, const Window& rival);
std::optional<Conflict> conflict_at(const Rung& rung, const FaceCorners& facet, const std::array<const Window*, 3>& ijk, const Window& rival);

}  // namespace gvd::predicates
