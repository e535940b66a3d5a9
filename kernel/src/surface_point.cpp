#include "gvd/kernel/surface_point.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "gvd/kernel/error.hpp"

namespace gvd::kernel {
namespace {

void check_vertex(const Mesh& mesh, VertexId v) {
  if (v >= mesh.vertex_count()) {
    throw InputError(fmt::format("vertex {} does not exist (there are {} vertices)", v, mesh.vertex_count()));
  }
}

void check_face(const Mesh& mesh, FaceId f) {
  if (f >= mesh.face_count()) throw InputError(fmt::format("face {} does not exist (there are {} faces)", f, mesh.face_count()));
}

/// The half-edge from a to b, or on the boundary the one from b to a; kNone if no edge joins them.
HalfedgeId find_edge(const Mesh& mesh, VertexId a, VertexId b) {
  HalfedgeId found = kNone;
  mesh.for_each_outgoing(a, [&](HalfedgeId h) {
    if (mesh.target(h) == b) found = h;
    if (found == kNone && mesh.origin(Mesh::prev(h)) == b) found = Mesh::prev(h);
  });
  return found;
}

Location locate_isolated(const Mesh& mesh, const SurfacePoint& at) {
  if (at.vertex == kNone) throw InputError("a surface point names neither a face nor a vertex");
  check_vertex(mesh, at.vertex);
  if (!mesh.is_isolated(at.vertex)) throw InputError(fmt::format("a surface point at vertex {} names no face", at.vertex));
  return {Location::Kind::vertex, at.vertex, kNone, kNone};
}

}  // namespace

Location locate(const Mesh& mesh, const SurfacePoint& at) {
  if (at.face == kNone) return locate_isolated(mesh, at);
  check_face(mesh, at.face);
  int zeros = 0, zero = 0, positive = 0;
  for (int k = 0; k < 3; ++k) {
    const int sign = sgn(at.bary[k]);
    if (sign < 0) throw InputError(fmt::format("face {}: barycentric coordinate {} is negative", at.face, k));
    if (sign == 0) {
      ++zeros;
      zero = k;
    } else {
      positive = k;
    }
  }
  if (at.bary[0] + at.bary[1] + at.bary[2] != 1) {
    throw InputError(fmt::format("face {}: barycentric coordinates do not add up to 1", at.face));
  }
  Location where;
  where.face = at.face;
  if (zeros == 2) {
    where.kind = Location::Kind::vertex;
    where.vertex = mesh.origin(3 * at.face + positive);
  } else if (zeros == 1) {
    where.kind = Location::Kind::edge;
    where.halfedge = Mesh::next(3 * at.face + zero);  // the side that faces the corner of weight zero
  }
  if (at.vertex != kNone && at.vertex != where.vertex) {
    throw InputError(fmt::format("a surface point of face {} claims to be vertex {}, which it is not", at.face, at.vertex));
  }
  return where;
}

ExactPoint exact_position(const Mesh& mesh, const SurfacePoint& at) {
  if (at.face == kNone) return mesh.exact_point(at.vertex);
  ExactPoint sum;
  for (int k = 0; k < 3; ++k) {
    if (sgn(at.bary[k]) == 0) continue;
    const ExactPoint corner = mesh.exact_point(mesh.origin(3 * at.face + k));
    for (int i = 0; i < 3; ++i) sum[i] += at.bary[k] * corner[i];
  }
  return sum;
}

SurfacePoint point_at_vertex(const Mesh& mesh, VertexId v) {
  check_vertex(mesh, v);
  SurfacePoint at;
  at.vertex = v;
  if (mesh.is_isolated(v)) return at;
  const HalfedgeId h = mesh.outgoing(v);
  at.face = Mesh::face(h);
  at.bary[h % 3] = 1;
  return at;
}

SurfacePoint point_on_edge(const Mesh& mesh, VertexId a, VertexId b, const mpq_class& t) {
  check_vertex(mesh, a);
  check_vertex(mesh, b);
  const HalfedgeId h = find_edge(mesh, a, b);
  if (h == kNone) throw InputError(fmt::format("no edge joins vertices {} and {}", a, b));
  mpq_class s = t;
  s.canonicalize();
  if (s < 0 || s > 1) throw InputError(fmt::format("the parameter {} on edge {}-{} lies outside [0, 1]", s.get_d(), a, b));
  if (s == 0) return point_at_vertex(mesh, a);
  if (s == 1) return point_at_vertex(mesh, b);
  SurfacePoint at;
  at.face = Mesh::face(h);
  const bool forward = mesh.origin(h) == a;
  at.bary[Mesh::next(h) % 3] = forward ? s : mpq_class(1 - s);
  at.bary[h % 3] = 1 - at.bary[Mesh::next(h) % 3];
  return at;
}

SurfacePoint point_in_face(const Mesh& mesh, FaceId face, const std::array<mpq_class, 3>& weights) {
  check_face(mesh, face);
  SurfacePoint at;
  at.face = face;
  at.bary = weights;
  for (int k = 0; k < 3; ++k) {
    at.bary[k].canonicalize();
    if (at.bary[k] < 0) throw InputError(fmt::format("face {}: weight {} of corner {} is negative", face, at.bary[k].get_d(), k));
  }
  if (mesh.flipped(face)) std::swap(at.bary[1], at.bary[2]);
  const mpq_class sum = at.bary[0] + at.bary[1] + at.bary[2];
  if (sum == 0) throw InputError(fmt::format("face {}: the weights of all corners are zero", face));
  for (mpq_class& b : at.bary) b /= sum;
  const Location where = locate(mesh, at);
  at.vertex = where.vertex;
  return at;
}

}  // namespace gvd::kernel
