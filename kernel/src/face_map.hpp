#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "gvd/kernel/mesh.hpp"
#include "gvd/predicates/plane.hpp"

/// From the frame of a facet of the refined mesh to space and to the frame of the input face.
namespace gvd::kernel {

/// The barycentric coordinates of a vertex of the refined mesh in an input face, exactly. Pre: it lies in the plane of the face.
std::array<mpq_class, 3> barycentric_in_face(const Mesh& input, FaceId face, const Mesh& refined, VertexId v);

template <class NT>
std::array<NT, 3> position_in(const Mesh& mesh, VertexId v, int bits) {
  if (mesh.is_representable(v)) {
    const Point& p = mesh.point(v);
    return {robust::from_double<NT>(p[0], bits), robust::from_double<NT>(p[1], bits), robust::from_double<NT>(p[2], bits)};
  }
  const ExactPoint p = mesh.exact_point(v);
  return {robust::from<NT>(p[0], bits), robust::from<NT>(p[1], bits), robust::from<NT>(p[2], bits)};
}

/// The binary exponent of the largest difference of coordinates.
inline int exponent_of_longest_side(const Mesh& input, FaceId face) {
  double largest = 0;
  const Point& origin = input.point(input.origin(3 * face));
  for (std::uint32_t k = 1; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) largest = std::max(largest, std::fabs(input.point(input.origin(3 * face + k))[i] - origin[i]));
  return std::isfinite(largest) ? std::ilogb(largest) : 0;
}

/// The frame of an input face: corner 0 = (0, 0), corner 1 = (length, 0), mesh units.
template <class NT>
struct InputFrame {
  NT length;
  predicates::PlanePoint<NT> apex;
};

template <class NT>
InputFrame<NT> input_frame(const Mesh& input, FaceId face, int bits) {
  std::array<std::array<NT, 3>, 3> p;
  for (std::uint32_t k = 0; k < 3; ++k) p[k] = position_in<NT>(input, input.origin(3 * face + k), bits);
  const int unit = exponent_of_longest_side(input, face);  // so that no square overflows, and few underflow
  std::array<NT, 3> a, b;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = (p[1][i] - p[0][i]).scaled(-unit);
    b[i] = (p[2][i] - p[0][i]).scaled(-unit);
  }
  const NT n0 = a[1] * b[2] - a[2] * b[1], n1 = a[2] * b[0] - a[0] * b[2], n2 = a[0] * b[1] - a[1] * b[0];
  const NT length = sqrt(square(a[0]) + square(a[1]) + square(a[2]));
  const NT x = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / length, y = sqrt(square(n0) + square(n1) + square(n2)) / length;
  return {length.scaled(unit), {x.scaled(unit), y.scaled(unit)}};
}

/// Maps points of a facet's frame (frame units) to the frame of the input face that it is a part of: a turn, a factor and a shift.
template <class NT>
class FaceMap {
 public:
  using P = predicates::PlanePoint<NT>;

  /// `frame`: the facet's; null if it has none: then only `corner` is asked for. Pre: the face has been split, or there is a frame.
  FaceMap(const Mesh& input, const Mesh& refined, FaceId facet, const predicates::FacetFrame<NT>* frame, int bits) {
    using predicates::operator*, predicates::operator-;
    const FaceId face = refined.input_face(facet);
    for (std::uint32_t k = 0; k < 3; ++k) whole_ = whole_ && refined.origin(3 * facet + k) == input.origin(3 * face + k);
    if (whole_) {
      corner_ = {P{NT(0.0), NT(0.0)}, P{frame->length, NT(0.0)}, frame->length * frame->apex};
    } else {
      const InputFrame<NT> whole = input_frame<NT>(input, face, bits);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto bary = barycentric_in_face(input, face, refined, refined.origin(3 * facet + k));
        const NT b1 = robust::from<NT>(bary[1], bits), b2 = robust::from<NT>(bary[2], bits);
        corner_[k] = {b1 * whole.length + b2 * whole.apex.x, b2 * whole.apex.y};
      }
    }
    turn_ = corner_[1] - corner_[0];
  }

  P operator()(const P& p) const {
    using predicates::operator*;
    if (whole_) return turn_.x * p;
    return {corner_[0].x + (p.x * turn_.x - p.y * turn_.y), corner_[0].y + (p.x * turn_.y + p.y * turn_.x)};
  }
  const P& corner(std::size_t k) const { return corner_[k]; }
  /// What turns and stretches: corner(1) - corner(0).
  const P& turn() const { return turn_; }

 private:
  bool whole_ = true;
  std::array<P, 3> corner_;
  P turn_;
};

}  // namespace gvd::kernel
