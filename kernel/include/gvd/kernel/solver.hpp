#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gvd/kernel/diagram.hpp"
#include "gvd/kernel/ids.hpp"
#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::kernel {

/// How far one phase of the work is. `total` is an estimate of the same unit as `done` and may change between calls; 0 if unknown.
struct Progress {
  const char* phase;  ///< one of the names in Summary::seconds; lives as long as the program
  double done, total;
};

struct SolveOptions {
  /// Frames, facet tessellation, extraction and rounding run in parallel, on no more threads than the machine runs at once; results do not depend on it.
  unsigned threads = 1;
  std::uint64_t max_memory_bytes = 0;   ///< limit on the resident memory of the process; 0: none
  double time_limit_seconds = 0;        ///< limit on the wall time of `solve`; 0: none
  /// Called from the thread that called `solve`, a few times a second. Return false to cancel. Must not throw.
  std::function<bool(const Progress&)> progress;
  bool diagram = true;                  ///< false: the distance field only, `Solution::diagram` is empty
};

enum class Status : std::uint8_t {
  certified,     ///< everything is proved
  undecided,     ///< complete, but some decisions could not be proved: see Solution::decisions().undecided_list()
  memory_limit,  ///< stopped: there is no result
  time_limit,    ///< stopped: there is no result
  cancelled,     ///< stopped by the callback: there is no result
};

/// "certified", "undecided", "memory_limit", "time_limit", "cancelled".
constexpr const char* status_name(Status status) noexcept {
  constexpr std::array<const char*, 5> kNames = {"certified", "undecided", "memory_limit", "time_limit", "cancelled"};
  return kNames[static_cast<std::size_t>(status)];
}
/// Whether there is a result: the run came to its end.
constexpr bool is_complete(Status status) noexcept { return status == Status::certified || status == Status::undecided; }

/// Counts of one run. Those of the diagram are 0 when only distances were asked for.
struct Summary {
  struct Phase {
    std::string name;
    double seconds;  ///< wall time
  };
  Status status = Status::cancelled;
  std::uint32_t sources = 0;               ///< as given, duplicates counted
  std::uint32_t components = 0;            ///< connected components of the mesh, isolated vertices not counted
  std::uint32_t unreachable_vertices = 0;  ///< vertices of the input in no component that holds a source
  std::uint64_t windows_propagated = 0;    ///< windows ever made
  std::uint64_t windows_kept = 0;          ///< those neither superseded nor known to be longer than another one of their half-edge wherever they are seen
  std::uint32_t boundary_facets = 0;
  std::uint32_t cells = 0;  ///< non-empty cells
  std::uint32_t gvd_edges = 0, gvd_vertices = 0, break_points = 0, dual_edges = 0;
  std::uint64_t ties = 0;  ///< vertices of the input with two or more nearest sources
  std::vector<Phase> seconds;
  double peak_memory_mb = 0;  ///< largest resident memory of the process so far, in units of 2^20 bytes
};

/// A point of a geodesic path: on a vertex, inside an edge (where the path crosses it), or inside a face (the two ends only).
struct PathPoint {
  VertexId vertex = kNone;                     ///< set if the point is this vertex of the input mesh
  std::array<VertexId, 2> edge{kNone, kNone};  ///< set (low id first) if it lies inside this edge of the input mesh
  Enclosed t;                                  ///< on an edge: the point is edge[0] + t (edge[1] - edge[0])
  FaceId face = kNone;                         ///< the input face which holds the path from here to the next point (kNone for the last)
  Point position{};                            ///< within 1 ulp in each coordinate
};

/// What is known of a point that was asked for.
struct PointAnswer {
  double distance = 0;            ///< correctly rounded; infinity if unreachable
  Enclosed enclosure;             ///< of the distance
  std::vector<SourceId> nearest;  ///< all nearest sources, sorted; empty if unreachable
  std::vector<PathPoint> path;    ///< one geodesic, from the point to its source (the least id in a tie); only if asked for by `path`
  bool undecided = false;         ///< a decision could not be proved: the answer is the best known
  robust::Stage stage = robust::Stage::identity;  ///< the last one that was asked which waves are nearest, or how the distance rounds at a vertex
};

/// The geodesic distance field and Voronoi diagram of a mesh and its sources. Movable, not copyable.
/// Const functions may be called from several threads at once. Except for `status`, `summary` and `decisions`, a function may be
/// called only if `is_complete(status())`; else it throws InternalError.
class Solution {
 public:
  class Impl;
  explicit Solution(std::unique_ptr<Impl> impl);
  Solution(Solution&&) noexcept;
  Solution& operator=(Solution&&) noexcept;
  ~Solution();

  Status status() const noexcept;
  const Summary& summary() const noexcept;
  /// The decisions by predicate and stage, and the list of those that nothing could prove.
  const predicates::Decisions& decisions() const noexcept;

  /// Distance of vertex v of the input from its nearest source (weights included): the double nearest to the true value, ties to even;
  /// infinity if no source is in its component. Units of the mesh. Cost: O(1).
  double distance(VertexId v) const;
  Enclosed distance_enclosure(VertexId v) const;
  /// All nearest sources of vertex v of the input, sorted; empty if unreachable. Duplicate sources are both listed. Cost: O(1).
  std::span<const SourceId> nearest(VertexId v) const;

  /// Distance and nearest sources at any surface point of the input mesh. Throws InputError if `at` is none. Cost: proportional to the
  /// waves of its facet, and to the sources inside its face.
  PointAnswer query(const SurfacePoint& at) const;
  /// The same, with a geodesic path. Cost: in addition proportional to the length of the path in faces.
  PointAnswer path(const SurfacePoint& at) const;

  /// Empty if the options did not ask for it.
  const Diagram& diagram() const;

  /// (source, the earlier source at the same point), for sources that coincide.
  std::span<const std::array<SourceId, 2>> duplicates() const;
  /// Sources which another source reaches with strictly less than their own weight, sorted: their cells are empty.
  std::span<const SourceId> hidden() const;

 private:
  std::unique_ptr<Impl> impl_;
};

/// Solves the mesh for the sources. The mesh must outlive the solution.
/// Resource limits, cancellation and undecided decisions are told by `Solution::status`. Throws InputError if there is no source, if a
/// weight is negative or not finite, or if a source is not a point of the mesh.
/// Cost: on terrains about proportional to the number of faces; docs/performance.md has measured figures.
Solution solve(const Mesh& mesh, const std::vector<Source>& sources, const SolveOptions& options = {});

}  // namespace gvd::kernel
