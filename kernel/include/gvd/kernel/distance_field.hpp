#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gvd/kernel/frames.hpp"
#include "gvd/kernel/ids.hpp"
#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/vertex_kind.hpp"
#include "gvd/predicates/frame.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::kernel {

/// A window as it is kept: a strip, nothing else (docs/architecture.md#windows). Its numbers are made again by replaying the strip.
struct WindowRecord {
  WindowId parent;         ///< kNone: seen from the root over the first edge
  std::uint32_t packed;    ///< half-edge and three flags
  VertexId root;
  WindowId next;           ///< the next window of the same half-edge

  static constexpr std::uint32_t kApexInCone = 1u << 31;  ///< made where its parent's cone contained the apex: that apex bounds this cone
  static constexpr std::uint32_t kDead = 1u << 30;        ///< superseded (first windows only): the same strip was emitted again
  static constexpr std::uint32_t kDominated = 1u << 29;    ///< another window of its half-edge is shorter at every point of it
  HalfedgeId halfedge() const noexcept { return packed & ~(kApexInCone | kDead | kDominated); }
  bool apex_in_cone() const noexcept { return (packed & kApexInCone) != 0; }
  bool dead() const noexcept { return (packed & kDead) != 0; }
  bool dominated() const noexcept { return (packed & kDominated) != 0; }
};

/// A path to a vertex that doubles could not rule out: through a window whose apex the vertex is, or straight along an edge.
struct Candidate {
  WindowId window;     ///< kNone: along the edge from `via`
  VertexId via;        ///< the root of the window, or the other end of the edge
  std::uint32_t next;  ///< the next candidate of the same vertex
  double distance, error;        ///< |distance - true length of this path| <= error
  predicates::Complex<double> image;  ///< window: in the frame of its half-edge
};

/// What the propagation leaves, in scaled units (kernel/frames.hpp): every window and every candidate that may be shortest somewhere.
struct DistanceField {
  /// Whether the window stems from waves that were sent again since: each of its rays is there once more.
  bool is_stale(WindowId window) const noexcept {
    if (!restarted) return false;
    while (windows[window].parent != kNone) window = windows[window].parent;
    return windows[window].dead();
  }

  std::vector<WindowRecord> windows;
  std::vector<WindowId> first_window;        ///< per half-edge: windows that come in over it
  std::vector<Candidate> candidates;
  std::vector<std::uint32_t> first_candidate;  ///< per vertex
  std::vector<std::uint8_t> corner_sees_face;  ///< per half-edge: its origin starts waves (source or relay) that may enter its face
  std::vector<double> distance, error;        ///< per vertex: |distance - D| <= error; infinity if unreachable
  std::uint64_t windows_propagated = 0;
  bool restarted = false;                     ///< some vertex sent its waves again: there are dead windows
};

/// Where a wave starts.
struct WaveStart {
  VertexId vertex;
  double weight;  ///< scaled units
};

/// Polled now and then with the number of settled vertices; return false to stop.
using PropagationPoll = bool (*)(void* user, std::uint64_t settled, std::uint64_t bytes);

/// Propagates the waves over the whole mesh (vertex-oriented triangle propagation, Qin et al. 2016, with certain drops only).
/// Returns false if `poll` stopped it.
bool propagate(const Frames& frames, std::span<const WaveStart> starts, const std::vector<VertexKind>& kinds, DistanceField& field,
               predicates::Decisions& decisions, PropagationPoll poll = nullptr, void* user = nullptr);

}  // namespace gvd::kernel
