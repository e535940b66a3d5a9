#include "gvd/io/arc_sampler.hpp"

#include <algorithm>
#include <cmath>

namespace gvd::io {

using kernel::Point;

namespace {

constexpr int kDeepest = 20;  // a million chords an arc: the deviation falls fourfold a level, so this is never reached in practice

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double norm(const Point& a) { return std::sqrt(dot(a, a)); }
Point scaled(const Point& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

double distance(const PlanePoint& a, const PlanePoint& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }
PlanePoint values(const std::array<kernel::Enclosed, 2>& p) { return {p[0].value, p[1].value}; }

/// A hyperbola x^2/a^2 - y^2/b^2 = 1 about `centre` with the unit axis `axis`.
struct Hyperbola {
  PlanePoint centre, axis;
  double a2, b2;

  /// For a chord of one branch: by how much the diameter through the middle of the chord, from the centre, must be shortened (as a
  /// part of it) to meet the branch. There the tangent is parallel to the chord: it is the point of the largest deviation.
  /// With q the quadratic form and h half the chord, q(middle) = 1 - q(h), and q(h) <= 0: no cancellation when the chord is short.
  double shortening(const PlanePoint& h) const {
    const double along = h[0] * axis[0] + h[1] * axis[1], across = h[0] * axis[1] - h[1] * axis[0];
    const double q = along * along / a2 - across * across / b2;
    if (!(q < 0)) return 0;
    const double root = std::sqrt(1 - q);
    return -q / (root * (1 + root));
  }
};

bool is_straight(const kernel::Arc& arc) { return arc.along_edge || arc.conic != kernel::Arc::Conic::hyperbola; }

/// Appends the inner points of the polyline for the part of the branch from p to q.
void refine(const Hyperbola& curve, const PlanePoint& p, const PlanePoint& q, double allowed, int depth, std::vector<PlanePoint>& out) {
  const PlanePoint h = {(q[0] - p[0]) / 2, (q[1] - p[1]) / 2};
  const PlanePoint diameter = {p[0] + h[0] - curve.centre[0], p[1] + h[1] - curve.centre[1]};
  const double part = curve.shortening(h);
  const double deviation = part * std::abs(diameter[0] * h[1] - diameter[1] * h[0]) / std::hypot(h[0], h[1]);
  if (depth == kDeepest || !(deviation > allowed)) return;
  const PlanePoint middle = {p[0] + h[0] - part * diameter[0], p[1] + h[1] - part * diameter[1]};
  refine(curve, p, middle, allowed, depth + 1, out);
  out.push_back(middle);
  refine(curve, middle, q, allowed, depth + 1, out);
}

std::vector<PlanePoint> inner_points(const kernel::Arc& arc, const PlanePoint& p, const PlanePoint& q, double allowed) {
  std::vector<PlanePoint> points;
  if (is_straight(arc)) return points;
  const PlanePoint f0 = values(arc.image[0]), f1 = values(arc.image[1]);
  const double c = distance(f0, f1) / 2, a = std::abs(arc.weight[1].value - arc.weight[0].value) / 2;
  if (!(a > 0 && a < c)) return points;
  const Hyperbola curve{{(f0[0] + f1[0]) / 2, (f0[1] + f1[1]) / 2},
                        {(f1[0] - f0[0]) / (2 * c), (f1[1] - f0[1]) / (2 * c)},
                        a * a,
                        (c - a) * (c + a)};
  refine(curve, p, q, allowed, 0, points);
  return points;
}

}  // namespace

FacePlane::FacePlane(const kernel::Mesh& mesh, kernel::FaceId face) {
  const auto h = 3 * face;
  origin_ = mesh.point(mesh.origin(h));
  const Point b = minus(mesh.point(mesh.target(h)), origin_), c = minus(mesh.point(mesh.apex(h)), origin_);
  length_ = norm(b);
  ex_ = scaled(b, 1 / length_);
  apex_[0] = dot(c, ex_);
  const Point height = minus(c, scaled(ex_, apex_[0]));
  apex_[1] = norm(height);
  ey_ = scaled(height, 1 / apex_[1]);
}

PlanePoint FacePlane::to_plane(const Point& p) const {
  const Point d = minus(p, origin_);
  return {dot(d, ex_), dot(d, ey_)};
}

Point FacePlane::to_space(const PlanePoint& p) const {
  Point x;
  for (unsigned k = 0; k < 3; ++k) x[k] = origin_[k] + p[0] * ex_[k] + p[1] * ey_[k];
  return x;
}

PlanePoint FacePlane::corner(unsigned k) const {
  if (k == 2) return apex_;
  return {k == 0 ? 0 : length_, 0};
}

double FacePlane::longest_side() const {
  return std::max({length_, std::hypot(apex_[0], apex_[1]), std::hypot(apex_[0] - length_, apex_[1])});
}

ArcSampler::ArcSampler(const kernel::Mesh& mesh, const kernel::Diagram& diagram, double deviation)
    : mesh_(mesh), diagram_(diagram), deviation_(deviation) {}

PlanePoint ArcSampler::node_in_plane(const FacePlane& plane, kernel::FaceId face, std::uint32_t node) const {
  const auto& point = diagram_.points[node];
  return point.face == face ? values(point.frame) : plane.to_plane(point.position);
}

std::vector<ArcSample> ArcSampler::sample(std::uint32_t index) const {
  const auto& arc = diagram_.arcs[index];
  const FacePlane plane(mesh_, arc.face);
  const PlanePoint image = values(arc.image[0]);
  const auto at = [&](const PlanePoint& p, const Point& position) {
    return ArcSample{p, position, arc.weight[0].value + distance(p, image)};
  };
  const PlanePoint first = node_in_plane(plane, arc.face, arc.node[0]), last = node_in_plane(plane, arc.face, arc.node[1]);
  std::vector<ArcSample> samples = {at(first, diagram_.points[arc.node[0]].position)};
  for (const auto& p : inner_points(arc, first, last, deviation_ * plane.longest_side())) samples.push_back(at(p, plane.to_space(p)));
  samples.push_back(at(last, diagram_.points[arc.node[1]].position));
  return samples;
}

double ArcSampler::node_distance(std::uint32_t index, unsigned end) const {
  const auto& arc = diagram_.arcs[index];
  const PlanePoint p = node_in_plane(FacePlane(mesh_, arc.face), arc.face, arc.node[end]);
  return arc.weight[0].value + distance(p, values(arc.image[0]));
}

double ArcSampler::largest_allowed_deviation() const {
  double longest = 0;
  for (const auto& arc : diagram_.arcs) longest = std::max(longest, FacePlane(mesh_, arc.face).longest_side());
  return deviation_ * longest;
}

}  // namespace gvd::io
