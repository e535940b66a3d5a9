#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/robust/mpfr_float.hpp"

/// Geodesic distances by enumeration, with 512 bits: no windows, no pruning, none of the kernel's formulas.
namespace gvd::fuzz {

/// A mesh with exact positions, into which sources are inserted by splitting. Faces are oriented alike.
class ExactMesh {
 public:
  std::vector<kernel::ExactPoint> points;
  std::vector<std::array<std::uint32_t, 3>> faces;

  explicit ExactMesh(const kernel::Mesh& mesh) {
    for (kernel::VertexId v = 0; v < mesh.vertex_count(); ++v) points.push_back(mesh.exact_point(v));
    for (kernel::FaceId f = 0; f < mesh.face_count(); ++f)
      faces.push_back({mesh.origin(3 * f), mesh.origin(3 * f + 1), mesh.origin(3 * f + 2)});
  }

  /// Makes p, a point inside a face, inside an edge, or on a vertex, a vertex; returns its id.
  std::uint32_t insert(const kernel::ExactPoint& p) {
    for (std::uint32_t v = 0; v < points.size(); ++v)
      if (points[v] == p) return v;
    const auto id = static_cast<std::uint32_t>(points.size());
    points.push_back(p);
    std::vector<std::array<std::uint32_t, 3>> rest;
    for (const auto& f : faces) {
      if (!contains(f, p)) {
        rest.push_back(f);
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k)
        if (!collinear(points[f[k]], points[f[(k + 1) % 3]], p)) rest.push_back({f[k], f[(k + 1) % 3], id});
    }
    faces = rest;
    return id;
  }

 private:
  using Vector = kernel::ExactPoint;
  static Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static mpq_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static bool collinear(const Vector& a, const Vector& b, const Vector& p) {
    return cross(minus(b, a), minus(p, a)) == Vector{0, 0, 0};
  }
  bool contains(const std::array<std::uint32_t, 3>& f, const Vector& p) const {
    const Vector &a = points[f[0]], &b = points[f[1]], &c = points[f[2]];
    const Vector n = cross(minus(b, a), minus(c, a));
    if (sgn(dot(n, minus(p, a))) != 0) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector &u = points[f[k]], &v = points[f[(k + 1) % 3]];
      if (sgn(dot(cross(minus(v, u), minus(p, u)), n)) < 0) return false;
    }
    return true;
  }
};

/// The distances between all vertices: the straight segments through every strip that crosses no face twice, from every vertex,
/// joined by Dijkstra's rule. Exponential in the worst case, harmless below some fifty faces.
class BruteForce {
 public:
  using Mpfr = robust::Mpfr;
  static constexpr int kBits = 512;

  explicit BruteForce(const ExactMesh& mesh) : mesh_(mesh), count_(mesh.points.size()) {
    straight_.assign(count_ * count_, std::nullopt);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) beside_[{mesh.faces[f][k], mesh.faces[f][(k + 1) % 3]}] = f;
    used_.assign(mesh.faces.size(), 0);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) start(f, mesh.faces[f][k], mesh.faces[f][(k + 1) % 3], mesh.faces[f][(k + 2) % 3]);
  }

  /// Distances of all vertices from the wave that starts at `origin` with weight `weight`; nothing where it cannot come.
  std::vector<std::optional<Mpfr>> from(std::uint32_t origin, double weight = 0) const {
    std::vector<std::optional<Mpfr>> distance(count_);
    std::vector<char> settled(count_, 0);
    distance[origin] = Mpfr(weight, kBits);
    for (;;) {
      std::size_t nearest = count_;
      for (std::size_t v = 0; v < count_; ++v)
        if (settled[v] == 0 && distance[v] && (nearest == count_ || *distance[v] < *distance[nearest])) nearest = v;
      if (nearest == count_) return distance;
      settled[nearest] = 1;
      for (std::size_t v = 0; v < count_; ++v) {
        const auto& step = straight_[nearest * count_ + v];
        if (!step) continue;
        Mpfr through = *distance[nearest] + *step;
        if (!distance[v] || through < *distance[v]) distance[v] = std::move(through);
      }
    }
  }

  /// Whether two distances are equal as far as 512 bits tell.
  static bool same(const Mpfr& a, const Mpfr& b) { return !(abs(a - b) > a.scaled(-400)); }

  std::size_t strips() const { return strips_; }

 private:
  struct Place {
    Mpfr x, y;
  };
  static Mpfr cross(const Place& a, const Place& b) { return a.x * b.y - a.y * b.x; }

  mpq_class dot(std::uint32_t o, std::uint32_t a, std::uint32_t b) const {
    mpq_class sum;
    for (std::size_t k = 0; k < 3; ++k)
      sum += (mesh_.points[a][k] - mesh_.points[o][k]) * (mesh_.points[b][k] - mesh_.points[o][k]);
    return sum;
  }
  /// Coordinates of c along and across the edge a -> b, as multiples of the edge: c = a + t (b - a) + s (b - a) turned left.
  Place shape(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const mpq_class ab = dot(a, b, b), ac = dot(a, c, c), d = dot(a, b, c);
    return {Mpfr(mpq_class(d / ab), kBits), sqrt(Mpfr(mpq_class((ab * ac - d * d) / (ab * ab)), kBits))};
  }
  static Place put(const Place& a, const Place& b, const Place& shape) {
    const Mpfr dx = b.x - a.x, dy = b.y - a.y;
    return {a.x + shape.x * dx - shape.y * dy, a.y + shape.x * dy + shape.y * dx};
  }
  void record(std::uint32_t root, std::uint32_t v, Mpfr length) {
    for (auto* best : {&straight_[root * count_ + v], &straight_[v * count_ + root]})
      if (!*best || length < **best) *best = length;
  }

  void start(std::uint32_t face, std::uint32_t root, std::uint32_t b, std::uint32_t c) {
    const Place origin{Mpfr(0.0, kBits), Mpfr(0.0, kBits)}, at_b{sqrt(Mpfr(dot(root, b, b), kBits)), Mpfr(0.0, kBits)};
    record(root, b, at_b.x);
    const Place at_c = put(origin, at_b, shape(root, b, c));
    record(root, c, sqrt(Mpfr(dot(root, c, c), kBits)));
    used_[face] = 1;
    cross_edge(root, b, at_b, c, at_c, at_b, at_c);
    used_[face] = 0;
  }

  /// The cone between the directions `right` and `left` goes over the edge a (right) -> b (left) of the face it comes from.
  void cross_edge(std::uint32_t root, std::uint32_t a, const Place& at_a, std::uint32_t b, const Place& at_b, const Place& right,
                  const Place& left) {
    const auto found = beside_.find({b, a});
    if (found == beside_.end() || used_[found->second] != 0) return;
    ++strips_;
    const std::uint32_t face = found->second;
    const auto& corner = mesh_.faces[face];
    const std::uint32_t c = *std::find_if(corner.begin(), corner.end(), [&](std::uint32_t v) { return v != a && v != b; });
    const Place at_c = put(at_b, at_a, shape(b, a, c));
    const int from_right = cross(right, at_c).sign(), from_left = cross(at_c, left).sign();
    if (from_right >= 0 && from_left >= 0) record(root, c, sqrt(at_c.x * at_c.x + at_c.y * at_c.y));
    used_[face] = 1;
    if (from_right > 0) cross_edge(root, a, at_a, c, at_c, right, from_left > 0 ? at_c : left);
    if (from_left > 0) cross_edge(root, c, at_c, b, at_b, from_right > 0 ? at_c : right, left);
    used_[face] = 0;
  }

  const ExactMesh& mesh_;
  std::size_t count_;
  std::vector<std::optional<Mpfr>> straight_;  // [root * count_ + vertex]
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> beside_;
  std::vector<char> used_;
  std::size_t strips_ = 0;
};

}  // namespace gvd::fuzz
