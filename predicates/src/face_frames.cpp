#include "gvd/predicates/face_frames.hpp"

#include "fused_multiply_add.hpp"
#include "gvd/robust/double_quad.hpp"
#include "gvd/robust/rational.hpp"

namespace gvd::predicates {

using robust::DoubleDouble;
using robust::DoubleDoubleQuad;
using robust::DoubleQuad;

namespace {

using Side = Vector<DoubleDouble>;
using Frames = std::array<EdgeFrame<DoubleDouble>, 3>;
/// The sides ab, bc and ca of a face in three lanes, coordinate by coordinate; the last lane means nothing.
using Sides = std::array<DoubleDoubleQuad, 3>;

GVD_QUAD Sides in_lanes(const Side& ab, const Side& bc, const Side& ca) {
  const auto coordinate = [&](std::size_t i) { return robust::quad(ab[i], bc[i], ca[i], DoubleDouble()); };
  return {coordinate(0), coordinate(1), coordinate(2)};
}
GVD_QUAD Sides in_lanes(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c, double factor) {
  const auto coordinate = [&](std::size_t i) {
    const DoubleDoubleQuad d = robust::two_sum(DoubleQuad{b[i], c[i], a[i], 0}, -DoubleQuad{a[i], b[i], c[i], 0});
    return DoubleDoubleQuad{d.hi * robust::quad(factor), d.lo * robust::quad(factor)};
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

GVD_QUAD DoubleDoubleQuad cross_product(const Sides& side, std::size_t p, std::size_t q) {
  const auto coordinates = [&](std::size_t k) { return robust::quad(side[0].lane(k), side[1].lane(k), side[2].lane(k), DoubleDouble()); };
  const DoubleDoubleQuad a = coordinates(p), b = coordinates(q);
  return robust::lanes<1, 2, 0, 3>(a) * robust::lanes<2, 0, 1, 3>(b) - robust::lanes<2, 0, 1, 3>(a) * robust::lanes<1, 2, 0, 3>(b);
}

/// The formula of the template, for three sides at once.
GVD_QUAD Frames face_frames_here(const Sides& side) {
  const Sides before{robust::lanes<2, 0, 1, 3>(side[0]), robust::lanes<2, 0, 1, 3>(side[1]), robust::lanes<2, 0, 1, 3>(side[2])};
  const DoubleDoubleQuad at_corner = -(side[0] * before[0] + side[1] * before[1] + side[2] * before[2]);
  const DoubleDoubleQuad squared = side[0] * side[0] + side[1] * side[1] + side[2] * side[2];
  const DoubleDouble ll_ab = squared.lane(0), ll_bc = squared.lane(1), ll_ca = squared.lane(2);
  const std::size_t longest = !(ll_ab < ll_bc) && !(ll_ab < ll_ca) ? 0 : !(ll_bc < ll_ca) ? 1 : 2;
  const DoubleDoubleQuad normal = cross_product(side, (longest + 1) % 3, (longest + 2) % 3), squares = normal * normal;
  const DoubleDouble area2 = sqrt(squares.lane(0) + squares.lane(1) + squares.lane(2));
  const DoubleDoubleQuad u = at_corner / squared, v = robust::lanes<1, 2, 0, 3>(at_corner) / squared;
  const DoubleDoubleQuad y = robust::quad(area2, area2, area2, area2) / squared, length = sqrt(squared);
  Frames frames;
  for (std::size_t k = 0; k < 3; ++k) frames[k] = {u.lane(k), v.lane(k), y.lane(k), length.lane(k)};
  return frames;
}

GVD_FMA Frames face_frames_by_fma(const Side& ab, const Side& bc, const Side& ca) { return face_frames_here(in_lanes(ab, bc, ca)); }
GVD_FMA Frames face_frames_by_fma(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c, double factor) {
  return face_frames_here(in_lanes(a, b, c, factor));
}

}  // namespace

Frames face_frames(const Side& ab, const Side& bc, const Side& ca) {
  return has_fma() ? face_frames_by_fma(ab, bc, ca) : face_frames_here(in_lanes(ab, bc, ca));
}

Frames face_frames(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c, double factor) {
  return has_fma() ? face_frames_by_fma(a, b, c, factor) : face_frames_here(in_lanes(a, b, c, factor));
}

ExactFace exact_face(const std::array<Vector<mpq_class>, 3>& side) {
  robust::CommonDenominator common;
  for (const auto& v : side) common.include(v);
  std::array<Vector<mpz_class>, 3> whole;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) whole[k][i] = common.numerator(side[k][i]);
  const auto dot = [&](std::size_t j, std::size_t k) { return mpz_class(whole[j][0] * whole[k][0] + whole[j][1] * whole[k][1] + whole[j][2] * whole[k][2]); };
  const mpz_class square = *common * *common, across = dot(0, 2);
  ExactFace face;
  for (std::size_t k = 0; k < 3; ++k) {
    face.dot[k] = robust::ratio(-dot(k, (k + 2) % 3), square);
    face.squared[k] = robust::ratio(dot(k, k), square);
  }
  face.radicand = robust::ratio(dot(0, 0) * dot(2, 2) - across * across, square * square);
  return face;
}

}  // namespace gvd::predicates
