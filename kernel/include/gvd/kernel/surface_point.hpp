#pragma once

#include <array>

#include "gvd/kernel/ids.hpp"
#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/robust/gmp.hpp"

namespace gvd::kernel {

/// What a surface point lies on.
struct Location {
  enum class Kind : std::uint8_t { vertex, edge, face };
  Kind kind = Kind::face;
  VertexId vertex = kNone;      ///< set if it is a vertex
  HalfedgeId halfedge = kNone;  ///< set if it lies inside an edge: the half-edge of `SurfacePoint::face`
  FaceId face = kNone;          ///< the face of the surface point; kNone for an isolated vertex
};

/// Classifies a surface point exactly by its zero coordinates.
/// Throws InputError if it is not a point of the mesh: the face or vertex does not exist, a coordinate is negative, the coordinates
/// do not add up to 1, or `vertex` contradicts them. Pre: the coordinates are in lowest terms (as every result of mpq arithmetic
/// is).
Location locate(const Mesh& mesh, const SurfacePoint& at);

/// The position in space, exactly. Pre: `locate` accepts the point.
ExactPoint exact_position(const Mesh& mesh, const SurfacePoint& at);

/// Vertex v; it may be isolated. Throws InputError if it does not exist.
SurfacePoint point_at_vertex(const Mesh& mesh, VertexId v);

/// The point A + t (B - A) of the edge between vertices a and b, for 0 <= t <= 1.
/// Throws InputError if one of the vertices does not exist, no edge joins them, or t lies outside [0, 1].
SurfacePoint point_on_edge(const Mesh& mesh, VertexId a, VertexId b, const mpq_class& t);

/// The point (w0 V0 + w1 V1 + w2 V2) / (w0 + w1 + w2) of a face, its corners in the order of the *input* (a face that was turned
/// round to orient the mesh has corners 1 and 2 swapped in `Mesh`). The weights need not add up to 1. Throws InputError if the face
/// does not exist, a weight is negative, or all are zero. Pre: the mesh is not refined.
SurfacePoint point_in_face(const Mesh& mesh, FaceId face, const std::array<mpq_class, 3>& weights);

}  // namespace gvd::kernel
