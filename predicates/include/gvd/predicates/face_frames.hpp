#pragma once

#include <array>
#include <cmath>

#include "gvd/predicates/frame.hpp"
#include "gvd/robust/double_double.hpp"
#include "gvd/robust/rational.hpp"

/// From the sides of a face, as vectors in space, to the frames of its directed edges, in any number type.
namespace gvd::predicates {

template <class T>
using Vector = std::array<T, 3>;

template <class T>
T dot(const Vector<T>& p, const Vector<T>& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
template <class T>
Vector<T> cross(const Vector<T>& p, const Vector<T>& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// Sides below this lose too many bits to underflow, sides above overflowed: pre for `face_frames` in double and double-double, where the
/// largest coordinate of a side of the face (or of its mesh) has been scaled into [1, 2). docs/error-bounds.md#frames.
inline constexpr double kLeastSide = 0x1p-200, kMostSide = 4;

/// The frames of a -> b, b -> c and c -> a from the sides ab, bc, ca of a face (their sum is zero). Errors: docs/error-bounds.md#frames.
template <class T>
std::array<EdgeFrame<T>, 3> face_frames(const Vector<T>& ab, const Vector<T>& bc, const Vector<T>& ca) {
  using std::sqrt;
  const T dot_a = -dot(ab, ca), dot_b = -dot(bc, ab), dot_c = -dot(ca, bc);
  const T ll_ab = dot(ab, ab), ll_bc = dot(bc, bc), ll_ca = dot(ca, ca);
  // The two shortest sides give the cross product its best relative error.
  const auto normal = !(ll_ab < ll_bc) && !(ll_ab < ll_ca) ? cross(bc, ca) : !(ll_bc < ll_ca) ? cross(ca, ab) : cross(ab, bc);
  const T area2 = sqrt(dot(normal, normal));
  return {{{dot_a / ll_ab, dot_b / ll_ab, area2 / ll_ab, sqrt(ll_ab)},
           {dot_b / ll_bc, dot_c / ll_bc, area2 / ll_bc, sqrt(ll_bc)},
           {dot_c / ll_ca, dot_a / ll_ca, area2 / ll_ca, sqrt(ll_ca)}}};
}

/// The same numbers, by the processor's own fused multiply-add where it has one.
std::array<EdgeFrame<robust::DoubleDouble>, 3> face_frames(const Vector<robust::DoubleDouble>& ab, const Vector<robust::DoubleDouble>& bc,
                                                           const Vector<robust::DoubleDouble>& ca);
/// The same from the corners: the sides are their differences, exactly, times `factor`, a power of two.
std::array<EdgeFrame<robust::DoubleDouble>, 3> face_frames(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c, double factor);

/// A face in exact arithmetic: dot products at the corners, squared sides, and N (four times the squared area).
struct ExactFace {
  std::array<mpq_class, 3> dot;      ///< at corner k
  std::array<mpq_class, 3> squared;  ///< of side k, from corner k to corner k + 1
  mpq_class radicand;
};

/// `side[k]` goes from corner k to corner k + 1.
ExactFace exact_face(const std::array<Vector<mpq_class>, 3>& side);

}  // namespace gvd::predicates
