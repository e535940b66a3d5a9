#pragma once

#include <vector>

#include "gvd/predicates/face_strip.hpp"

namespace gvd::test {

template <class Real>
struct RealPoint {
  Real x, y;
  friend RealPoint operator-(const RealPoint& a, const RealPoint& b) { return {a.x - b.x, a.y - b.y}; }
};
template <class Real>
Real cross(const RealPoint<Real>& a, const RealPoint<Real>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class Real>
Real norm(const RealPoint<Real>& a) {
  return sqrt(a.x * a.x + a.y * a.y);
}
template <class Real>
Real squared(const predicates::SpacePoint& a, const predicates::SpacePoint& b) {
  Real sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (Real(a[i]) - Real(b[i])) * (Real(a[i]) - Real(b[i]));
  return sum;
}

/// A strip by its corners, which is unfolded here from nothing but the lengths of its edges: each new corner is placed over its edge by its
/// two distances.
struct LaidOut {
  std::vector<predicates::SpacePoint> corner;    ///< 0, 1 and 2 the first face, left over the side 1 2; then one a face
  std::vector<std::array<std::size_t, 2>> edge;  ///< per corner from 3: the edge it is over, corner 0 on its left
  predicates::FacePoint source = predicates::FacePoint::corner(0);  ///< in the first face, not on its side 1 2

  predicates::FaceStrip strip() const {
    predicates::FaceStrip s({corner[0], corner[1], corner[2]}, source);
    for (std::size_t v = 3; v < corner.size(); ++v) s.cross({corner[edge[v - 3][1]], corner[edge[v - 3][0]], corner[v]});
    return s;
  }
  /// The corners in the plane: 1 in the origin, 2 on the positive x axis, 0 above it, what is crossed below.
  template <class Real>
  std::vector<RealPoint<Real>> flat() const {
    auto p = flat_in_units<Real>();
    const Real unit = sqrt(squared_unit<Real>());
    for (auto& q : p) q = {q.x * unit, q.y * unit};
    return p;
  }
  /// The same in units of the side 1 2: one root a face.
  template <class Real>
  std::vector<RealPoint<Real>> flat_in_units() const {
    std::vector<RealPoint<Real>> p(corner.size());
    p[1] = {Real(0), Real(0)};
    p[2] = {Real(1), Real(0)};
    place(p, 0, 1, 2, true);
    for (std::size_t v = 3; v < corner.size(); ++v) place(p, v, edge[v - 3][0], edge[v - 3][1], false);
    return p;
  }
  template <class Real>
  Real squared_unit() const {
    return squared<Real>(corner[1], corner[2]);
  }
  /// The source, as `flat` has it.
  template <class Real>
  RealPoint<Real> image(const std::vector<RealPoint<Real>>& flat) const {
    const mpq_class sum = source.weight[0] + source.weight[1] + source.weight[2];
    RealPoint<Real> at{Real(0), Real(0)};
    for (std::size_t k = 0; k < 3; ++k) {
      const Real share(mpq_class(source.weight[k] / sum).get_mpq_t());
      at = {at.x + share * flat[k].x, at.y + share * flat[k].y};
    }
    return at;
  }

 private:
  /// On the left of a -> b, or on the right.
  template <class Real>
  void place(std::vector<RealPoint<Real>>& p, std::size_t v, std::size_t a, std::size_t b, bool left) const {
    const Real l = squared<Real>(corner[a], corner[b]), va = squared<Real>(corner[v], corner[a]), vb = squared<Real>(corner[v], corner[b]);
    const Real t = (va - vb + l) / (2 * l), h = sqrt(va / l - t * t);
    const Real dx = p[b].x - p[a].x, dy = p[b].y - p[a].y, s = left ? h : -h;
    p[v] = {p[a].x + t * dx - s * dy, p[a].y + t * dy + s * dx};
  }
};

}  // namespace gvd::test
