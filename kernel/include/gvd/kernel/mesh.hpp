#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gvd/kernel/ids.hpp"
#include "gvd/robust/gmp.hpp"

namespace gvd::kernel {

using Point = std::array<double, 3>;
using ExactPoint = std::array<mpq_class, 3>;

/// A triangle soup as a file or a caller gives it: nothing has been checked.
struct MeshArrays {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

/// A validated, consistently oriented triangle mesh with half-edges by arithmetic (docs/architecture.md#mesh).
/// Immutable after construction. Vertex and face ids are those of the input.
class Mesh {
 public:
  Mesh() = default;

  /// Validates and orients (DESIGN: finite coordinates, indices in range, no repeated vertex in a face, no face of zero area (exact),
  /// at most two faces an edge, vertex links are single fans, orientable). Each component keeps the orientation of the majority of its
  /// faces (of its lowest face on a draw). Isolated vertices are kept.
  /// Throws InputError naming the offending faces and vertices. Cost: O(n) expected, exact arithmetic only for needle faces.
  explicit Mesh(MeshArrays arrays);

  std::uint32_t vertex_count() const noexcept { return vertex_count_; }
  std::uint32_t face_count() const noexcept { return static_cast<std::uint32_t>(corners_.size() / 3); }
  std::uint32_t halfedge_count() const noexcept { return static_cast<std::uint32_t>(corners_.size()); }

  static constexpr FaceId face(HalfedgeId h) noexcept { return h / 3; }
  static constexpr HalfedgeId next(HalfedgeId h) noexcept { return h % 3 == 2 ? h - 2 : h + 1; }
  static constexpr HalfedgeId prev(HalfedgeId h) noexcept { return h % 3 == 0 ? h + 2 : h - 1; }
  VertexId origin(HalfedgeId h) const noexcept { return corners_[h]; }
  VertexId target(HalfedgeId h) const noexcept { return corners_[next(h)]; }
  VertexId apex(HalfedgeId h) const noexcept { return corners_[prev(h)]; }
  /// The half-edge of the neighbour face in the other direction; kNone on the boundary.
  HalfedgeId twin(HalfedgeId h) const noexcept { return twins_[h]; }

  /// A half-edge that starts at v; kNone for an isolated vertex. At a boundary vertex it is the one from which stepping
  /// `twin(prev(h))` (counter-clockwise) meets every face at v before it ends in kNone.
  HalfedgeId outgoing(VertexId v) const noexcept { return outgoing_[v]; }
  /// Calls `visit(h)` for the half-edges that start at v, counter-clockwise.
  template <class Visit>
  void for_each_outgoing(VertexId v, Visit&& visit) const {
    const HalfedgeId first = outgoing_[v];
    for (HalfedgeId h = first; h != kNone;) {
      visit(h);
      h = twins_[prev(h)];
      if (h == first) break;
    }
  }
  bool is_boundary(VertexId v) const noexcept {
    return outgoing_[v] != kNone && twins_[outgoing_[v]] == kNone;
  }
  bool is_isolated(VertexId v) const noexcept { return outgoing_[v] == kNone; }

  /// The position as a double: exact for vertices of the input, rounded to nearest for vertices inserted at sources.
  const Point& point(VertexId v) const noexcept { return points_[v]; }
  /// The position, exactly.
  ExactPoint exact_point(VertexId v) const;
  /// Whether the position is exactly `point(v)`.
  bool is_representable(VertexId v) const noexcept { return v < input_vertex_count_; }

  /// True if the face was turned round to orient the mesh: its corners 1 and 2 are those of the input swapped.
  bool flipped(FaceId f) const noexcept { return flipped_[f] != 0; }
  std::uint32_t flipped_count() const noexcept;

  // ---- refinement at sources (kernel/source.hpp) ----
  /// Vertices below this number are those of the input.
  std::uint32_t input_vertex_count() const noexcept { return input_vertex_count_; }
  /// The face of the input mesh which this face is a part of (itself without refinement).
  FaceId input_face(FaceId f) const noexcept { return input_face_.empty() ? f : input_face_[f]; }
  /// True if the edge of h lies inside a face of the input (it was made by a split and is not a part of an edge of the input).
  bool is_artificial(HalfedgeId h) const noexcept { return !artificial_.empty() && artificial_[h] != 0; }

 private:
  friend class MeshRefiner;
  friend const struct VertexKinds& kept_vertex_kinds(const Mesh& mesh);
  /// What is found out about a mesh once, when it is first asked for; copies share it.
  struct Kept;
  static std::shared_ptr<Kept> nothing_kept();
  void build_twins();  // from corners_: also checks edges and links

  std::vector<Point> points_;
  std::vector<VertexId> corners_;
  std::vector<HalfedgeId> twins_;
  std::vector<HalfedgeId> outgoing_;
  std::vector<std::uint8_t> flipped_;
  std::vector<FaceId> input_face_;
  std::vector<std::uint8_t> artificial_;
  std::vector<ExactPoint> inserted_;  // of vertex input_vertex_count_ + i
  std::uint32_t vertex_count_ = 0;
  std::uint32_t input_vertex_count_ = 0;
  std::shared_ptr<Kept> kept_ = nothing_kept();
};

/// Counts for `gvd info`.
struct MeshFacts {
  std::uint32_t vertices, faces, edges, boundary_edges, boundary_loops, components;
  std::uint32_t saddles;          ///< interior, total angle > 2 pi, decided exactly
  std::uint32_t boundary_relays;  ///< boundary, total angle > pi, decided exactly
  std::uint32_t flat_vertices;    ///< interior with exactly 2 pi (boundary vertices of exactly pi do not count)
  std::uint32_t flipped_faces, isolated_vertices;
  std::array<Point, 2> bbox;      ///< lowest and highest corner
  std::int64_t euler;             ///< V - E + F, isolated vertices not counted
};

}  // namespace gvd::kernel
