#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "subdivision.hpp"

/// Chains of links: the GVD edges, and what their ends and inner places are.
namespace gvd::kernel::subdivision {

enum class Role : std::uint8_t {
  none,      ///< no link meets here
  erased,    ///< a link goes on inside one input face with the same waves: no trace is left
  crossing,  ///< the same, on an edge or vertex of the input mesh
  break_point,
  vertex,    ///< GVD vertex
  boundary,  ///< GVD edges end on the boundary of the mesh
  open,      ///< GVD edges end because something beside is undecided
};
constexpr bool is_end(Role role) { return role >= Role::vertex; }

struct DirectedLink {
  std::uint32_t link = kNone;
  bool reversed = false;
};

struct Chain {
  std::vector<DirectedLink> links;
  bool closed = false;
};

struct Chains {
  std::vector<Role> role;  ///< per place
  std::vector<Chain> chains;
  std::vector<std::string> doubts;  ///< places where it could not be proved whether the conic changes
};

inline std::uint32_t from_place(const Subdivision& s, DirectedLink l) {
  return l.reversed ? s.links[l.link].to : s.links[l.link].from;
}
inline std::uint32_t to_place(const Subdivision& s, DirectedLink l) {
  return l.reversed ? s.links[l.link].from : s.links[l.link].to;
}
/// The dart on the left (0) or right (1) of a link.
inline std::uint32_t dart_beside(const Subdivision& s, DirectedLink l, std::size_t side) {
  const std::uint32_t d = s.links[l.link].dart;
  return l.reversed == (side == 0) ? s.darts[d].twin : d;
}
inline LabelSetId label_beside(const Subdivision& s, DirectedLink l, std::size_t side) {
  return s.links[l.link].labels[l.reversed ? 1 - side : side];
}

/// Whether the place lies inside a face of the input mesh (not on one of its edges or vertices).
bool inside_input_face(const DiagramInput& in, const Place& place);

/// The nearest sources at a place where links meet, sorted.
std::vector<SourceId> sources_at(const DiagramInput& in, const Subdivision& s, std::uint32_t place);

/// Throws InternalError if a GVD edge ends nowhere, or changes its label sets; unless something is undecided: then its end is open.
Chains trace(const DiagramInput& in, const Subdivision& s, bool all_decided);

}  // namespace gvd::kernel::subdivision
