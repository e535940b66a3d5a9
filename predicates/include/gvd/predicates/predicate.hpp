#pragma once

#include <array>
#include <cstddef>

#include "gvd/robust/decision.hpp"

namespace gvd::predicates {

/// The predicates whose decisions are counted, in the order of DESIGN section 5.
enum class Predicate : std::size_t {
  window_orientation,  ///< the apex against the cone of a window
  window_pruning,      ///< "certainly longer" tests of the propagation: filter only, they may always say no
  vertex_distance,     ///< which candidate is nearest at a vertex
  rounding,            ///< which double is nearest (counted apart)
  saddle,              ///< angle sum against 2 pi or pi
  edge_tie,            ///< where two waves tie on an edge, and the order of such points
  corner_order,        ///< order of waves round a corner of a facet
  bisector_vertex,     ///< does a triple have a vertex (Apollonius point)
  cone_membership,     ///< is a point inside the cone of a window
  conflict,            ///< is a further site nearer at a bisector vertex
  location,            ///< is a constructed point inside its facet, on an edge, on a corner
  point_distance,      ///< nearest source at a point asked for
  source_location,     ///< nearest surface point, vertical drop
};
inline constexpr std::size_t kPredicateCount = 13;
inline constexpr std::array<const char*, kPredicateCount> kPredicateNames = {
    "window_orientation", "window_pruning", "vertex_distance", "rounding",       "saddle",
    "edge_tie",           "corner_order",   "bisector_vertex", "cone_membership", "conflict",
    "location",           "point_distance", "source_location"};

using Decisions = robust::DecisionTable<kPredicateCount>;

inline void count(Decisions& d, Predicate p, robust::Stage s) noexcept { d.count(static_cast<std::size_t>(p), s); }
inline void undecided(Decisions& d, Predicate p, std::string what) { d.undecided(static_cast<std::size_t>(p), std::move(what)); }

}  // namespace gvd::predicates
