#include <cmath>

#include "gvd/kernel/distance_field.hpp"

namespace gvd::kernel {
namespace {

struct Vector {
  double x, y, z;
};
Vector between(const Point& p, const Point& q) { return {q[0] - p[0], q[1] - p[1], q[2] - p[2]}; }
double dot(const Vector& p, const Vector& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
Vector cross(const Vector& p, const Vector& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

}  // namespace

std::vector<predicates::EdgeFrame<double>> make_frames(const Mesh& mesh) {
  std::vector<predicates::EdgeFrame<double>> frames(mesh.halfedge_count());
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); h += 3) {
    const Point& a = mesh.point(mesh.origin(h));
    const Point& b = mesh.point(mesh.origin(h + 1));
    const Point& c = mesh.point(mesh.origin(h + 2));
    const Vector ab = between(a, b), bc = between(b, c), ca = between(c, a);
    const double dot_a = -dot(ab, ca), dot_b = -dot(bc, ab), dot_c = -dot(ca, bc);
    const double ll_ab = dot(ab, ab), ll_bc = dot(bc, bc), ll_ca = dot(ca, ca);
    // The two shortest sides give the cross product its best relative error.
    const Vector normal = ll_ab >= ll_bc && ll_ab >= ll_ca ? cross(bc, ca) : ll_bc >= ll_ca ? cross(ca, ab) : cross(ab, bc);
    const double area2 = std::sqrt(dot(normal, normal));
    frames[h] = {dot_a / ll_ab, dot_b / ll_ab, area2 / ll_ab, std::sqrt(ll_ab)};
    frames[h + 1] = {dot_b / ll_bc, dot_c / ll_bc, area2 / ll_bc, std::sqrt(ll_bc)};
    frames[h + 2] = {dot_c / ll_ca, dot_a / ll_ca, area2 / ll_ca, std::sqrt(ll_ca)};
  }
  return frames;
}

}  // namespace gvd::kernel
