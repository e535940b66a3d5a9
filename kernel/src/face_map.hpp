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

/// Maps points of a facet's frame (frame units) to the frame of the input face that it is a part of.
template <class NT>
class FaceMap {
 public:
  using P = predicates::PlanePoint<NT>;

  /// `apex`: that of the facet's frame.
  FaceMap(const Mesh& input, const Mesh& refined, FaceId facet, const P& apex, int bits) : apex_(apex) {
    const FaceId face = refined.input_face(facet);
    const InputFrame<NT> frame = input_frame<NT>(input, face, bits);
    for (std::uint32_t k = 0; k < 3; ++k) whole_ = whole_ && refined.origin(3 * facet + k) == input.origin(3 * face + k);
    if (whole_) {
      corner_ = {P{NT(0.0), NT(0.0)}, P{frame.length, NT(0.0)}, frame.apex};
      return;
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto bary = barycentric_in_face(input, face, refined, refined.origin(3 * facet + k));
      const NT b1 = robust::from<NT>(bary[1], bits), b2 = robust::from<NT>(bary[2], bits);
      corner_[k] = {b1 * frame.length + b2 * frame.apex.x, b2 * frame.apex.y};
    }
  }

  /// Coordinates (b1, b2) of p with p = corner 0 + b1 (corner 1 - corner 0) + b2 (corner 2 - corner 0).
  P affine(const P& p) const {
    const NT b2 = p.y / apex_.y;
    return {p.x - apex_.x * b2, b2};
  }
  P operator()(const P& p) const {
    if (whole_) return {p.x * corner_[1].x, p.y * corner_[1].x};
    const P b = affine(p);
    return corner_[0] + b.x * (corner_[1] - corner_[0]) + b.y * (corner_[2] - corner_[0]);
  }
  const P& corner(std::size_t k) const { return corner_[k]; }

 private:
  P apex_;
  bool whole_ = true;
  std::array<P, 3> corner_;
};

}  // namespace gvd::kernel
