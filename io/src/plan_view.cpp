#include "plan_view.hpp"

#include <algorithm>
#include <limits>

namespace gvd::io {

namespace {

kernel::Point raw_normal(const kernel::Mesh& mesh, kernel::FaceId face) {
  const auto h = 3 * face;
  const auto &a = mesh.point(mesh.origin(h)), &b = mesh.point(mesh.target(h)), &c = mesh.point(mesh.apex(h));
  const kernel::Point u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

}  // namespace

PlanView::PlanView(const kernel::Mesh& mesh, double longest) : mesh_(mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> high = {-kInfinity, -kInfinity};
  low_ = {kInfinity, kInfinity};
  for (kernel::VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.is_isolated(v)) continue;
    for (unsigned k = 0; k < 2; ++k) {
      low_[k] = std::min(low_[k], mesh.point(v)[k]);
      high[k] = std::max(high[k], mesh.point(v)[k]);
    }
  }
  const double extent = std::max(high[0] - low_[0], high[1] - low_[1]);
  scale_ = extent > 0 ? longest / extent : 1;
  width_ = (high[0] - low_[0]) * scale_;
  height_ = (high[1] - low_[1]) * scale_;
  double area = 0;
  for (kernel::FaceId f = 0; f < mesh.face_count(); ++f) area += raw_normal(mesh, f)[2];
  up_ = area < 0 ? -1 : 1;
  seen_.resize(mesh.face_count());
  for (kernel::FaceId f = 0; f < mesh.face_count(); ++f) seen_[f] = up_ * raw_normal(mesh, f)[2] > 0;
}

kernel::Point PlanView::normal(kernel::FaceId face) const {
  auto n = raw_normal(mesh_, face);
  for (auto& x : n) x *= up_;
  return n;
}

}  // namespace gvd::io
