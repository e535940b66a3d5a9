#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "fuzz/properties/property.hpp"
#include "fuzz/properties/surface_points.hpp"

namespace gvd::fuzz {
namespace {

using kernel::ExactPoint;
using kernel::FaceId;
using kernel::HalfedgeId;
using kernel::MeshArrays;
using kernel::VertexId;

/// The point as doubles, if it is exactly that.
std::optional<kernel::Point> representable(const ExactPoint& p) {
  kernel::Point q;
  for (std::size_t k = 0; k < 3; ++k) {
    q[k] = p[k].get_d();
    if (!std::isfinite(q[k]) || mpq_class(q[k]) != p[k]) return std::nullopt;
  }
  return q;
}

ExactPoint mean(const kernel::Mesh& mesh, const std::vector<std::pair<VertexId, int>>& parts) {
  ExactPoint sum;
  int total = 0;
  for (const auto& [v, weight] : parts) {
    const ExactPoint p = mesh.exact_point(v);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * p[k];
    total += weight;
  }
  for (auto& x : sum) x /= total;
  return sum;
}

std::set<FaceId> source_faces(const Trial& t) {
  std::set<FaceId> faces;
  for (const Place& s : t.problem().sources) faces.insert(s.face);
  return faces;
}

/// The surface is the same, so D and the labels of the old vertices are. Faces keep their ids where sources lie.
Outcome same_at_vertices(Trial& t, const MeshArrays& arrays) {
  const kernel::Mesh mesh(arrays);
  const auto other = Trial::solve(mesh, sources_of(mesh, t.problem().sources), false);
  const bool labels = t.certified() && other.status() == kernel::Status::certified;
  for (VertexId v = 0; v < t.mesh().vertex_count(); ++v) {
    if (other.distance(v) != t.solution().distance(v))
      return violated(fmt::format("{}: D was {} and is {}", vertex_name(v), t.solution().distance(v), other.distance(v)));
    if (labels && nearest(other, v) != nearest(t.solution(), v))
      return violated(fmt::format("{}: nearest were {} and are {}", vertex_name(v), text_of(nearest(t.solution(), v)),
                                  text_of(nearest(other, v))));
  }
  return labels ? holds() : undecided();
}

Outcome splitting_a_face(Trial& t) {
  Draw draw = t.draw("splitting_a_face");
  const auto taken = source_faces(t);
  for (int attempt = 0; attempt < 20; ++attempt) {
    const FaceId f = draw.below(t.mesh().face_count());
    if (taken.count(f) != 0) continue;
    MeshArrays arrays = t.problem().mesh;
    const auto [a, b, c] = arrays.faces[f];
    const int first = draw.between(1, 2);
    const auto p = representable(mean(t.mesh(), {{a, first}, {b, 1}, {c, 3 - first}}));
    const auto q = p ? p : representable(mean(t.mesh(), {{a, 1}, {b, 1}, {c, 2}}));
    if (!q) continue;
    const auto id = static_cast<VertexId>(arrays.points.size());
    arrays.points.push_back(*q);
    arrays.faces[f] = {a, b, id};
    arrays.faces.push_back({b, c, id});
    arrays.faces.push_back({c, a, id});
    return same_at_vertices(t, arrays);
  }
  return skipped();
}

/// In place of each face beside the edge two.
Outcome splitting_an_edge(Trial& t) {
  Draw draw = t.draw("splitting_an_edge");
  const auto taken = source_faces(t);
  for (int attempt = 0; attempt < 20; ++attempt) {
    const HalfedgeId h = draw.below(t.mesh().halfedge_count()), twin = t.mesh().twin(h);
    if (taken.count(h / 3) != 0 || (twin != kernel::kNone && taken.count(twin / 3) != 0)) continue;
    const VertexId u = t.mesh().origin(h), v = t.mesh().target(h);
    const auto p = representable(mean(t.mesh(), {{u, draw.between(1, 3)}, {v, 1}}));
    if (!p) continue;
    MeshArrays arrays = t.problem().mesh;
    const auto id = static_cast<VertexId>(arrays.points.size());
    arrays.points.push_back(*p);
    for (const HalfedgeId side : {h, twin}) {
      if (side == kernel::kNone) continue;
      auto copy = arrays.faces[side / 3];
      for (auto& corner : copy)
        if (corner == u) corner = id;
      for (auto& corner : arrays.faces[side / 3])
        if (corner == v) corner = id;
      arrays.faces.push_back(copy);
    }
    return same_at_vertices(t, arrays);
  }
  return skipped();
}

ExactPoint minus(const ExactPoint& a, const ExactPoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
ExactPoint cross(const ExactPoint& a, const ExactPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpq_class dot(const ExactPoint& a, const ExactPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Whether the two faces at h lie in one plane and make a strictly convex quadrilateral.
bool may_flip(const kernel::Mesh& mesh, HalfedgeId h) {
  const HalfedgeId twin = mesh.twin(h);
  const ExactPoint a = mesh.exact_point(mesh.origin(h)), b = mesh.exact_point(mesh.target(h)), c = mesh.exact_point(mesh.apex(h)),
                   d = mesh.exact_point(mesh.apex(twin));
  const ExactPoint normal = cross(minus(b, a), minus(c, a));
  if (sgn(dot(normal, minus(d, a))) != 0 || sgn(dot(normal, cross(minus(a, b), minus(d, b)))) <= 0) return false;
  return sgn(dot(normal, cross(minus(d, a), minus(c, a)))) > 0 && sgn(dot(normal, cross(minus(c, b), minus(d, b)))) > 0;
}

Outcome flipping_a_coplanar_diagonal(Trial& t) {
  Draw draw = t.draw("flipping_a_coplanar_diagonal");
  const auto taken = source_faces(t);
  const auto& mesh = t.mesh();
  std::set<std::pair<VertexId, VertexId>> edges;
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) edges.insert(std::minmax(mesh.origin(h), mesh.target(h)));
  for (int attempt = 0; attempt < 20; ++attempt) {
    const HalfedgeId h = draw.below(mesh.halfedge_count()), twin = mesh.twin(h);
    if (twin == kernel::kNone || taken.count(h / 3) != 0 || taken.count(twin / 3) != 0) continue;
    const VertexId a = mesh.origin(h), b = mesh.target(h), c = mesh.apex(h), d = mesh.apex(twin);
    if (edges.count(std::minmax(c, d)) != 0 || !may_flip(mesh, h)) continue;
    MeshArrays arrays = t.problem().mesh;
    arrays.faces[h / 3] = {a, d, c};
    arrays.faces[twin / 3] = {d, b, c};
    return same_at_vertices(t, arrays);
  }
  return skipped();
}

constexpr std::array<Property, 3> kProperties = {{
    {"splitting_a_face", splitting_a_face, 10, "a further vertex inside a face changes no distance"},
    {"splitting_an_edge", splitting_an_edge, 10, "nor does one inside an edge"},
    {"flipping_a_coplanar_diagonal", flipping_a_coplanar_diagonal, 10, "nor the other diagonal of a plane quadrilateral"},
}};

}  // namespace

std::span<const Property> remeshing_properties() { return kProperties; }

}  // namespace gvd::fuzz
