#include "gvd/predicates/face_frames.hpp"

#include "fused_multiply_add.hpp"
#include "gvd/robust/double_quad.hpp"
#include "gvd/robust/rational.hpp"

namespace gvd::predicates {

using robust::DoubleDouble;
using robust::DoubleDoubleQuad;

namespace {

using Side = Vector<DoubleDouble>;
using Frames = std::array<EdgeFrame<DoubleDouble>, 3>;

inline DoubleDoubleQuad in_lanes(const Side& side) { return robust::quad(side[0], side[1], side[2], DoubleDouble()); }

inline DoubleDoubleQuad cross_in_lanes(const Side& p, const Side& q) {
  const DoubleDoubleQuad a = in_lanes(p), b = in_lanes(q);
  return robust::lanes<1, 2, 0, 3>(a) * robust::lanes<2, 0, 1, 3>(b) - robust::lanes<2, 0, 1, 3>(a) * robust::lanes<1, 2, 0, 3>(b);
}

/// The formula of the template, the three sides in three lanes; the last lane means nothing.
inline Frames face_frames_here(const Side& ab, const Side& bc, const Side& ca) {
  std::array<DoubleDoubleQuad, 3> side, before;
  for (std::size_t i = 0; i < 3; ++i) {
    side[i] = robust::quad(ab[i], bc[i], ca[i], DoubleDouble());
    before[i] = robust::lanes<2, 0, 1, 3>(side[i]);
  }
  const DoubleDoubleQuad at_corner = -(side[0] * before[0] + side[1] * before[1] + side[2] * before[2]);
  const DoubleDoubleQuad squared = side[0] * side[0] + side[1] * side[1] + side[2] * side[2];
  const DoubleDouble ll_ab = squared.lane(0), ll_bc = squared.lane(1), ll_ca = squared.lane(2);
  const auto normal = !(ll_ab < ll_bc) && !(ll_ab < ll_ca) ? cross_in_lanes(bc, ca) : !(ll_bc < ll_ca) ? cross_in_lanes(ca, ab) : cross_in_lanes(ab, bc);
  const DoubleDoubleQuad squares = normal * normal;
  const DoubleDouble area2 = sqrt(squares.lane(0) + squares.lane(1) + squares.lane(2));
  const DoubleDoubleQuad u = at_corner / squared, v = robust::lanes<1, 2, 0, 3>(at_corner) / squared;
  const DoubleDoubleQuad y = robust::quad(area2, area2, area2, area2) / squared, length = sqrt(squared);
  Frames frames;
  for (std::size_t k = 0; k < 3; ++k) frames[k] = {u.lane(k), v.lane(k), y.lane(k), length.lane(k)};
  return frames;
}

#ifdef GVD_CHOOSES_FMA
GVD_FMA Frames face_frames_by_fma(const Side& ab, const Side& bc, const Side& ca) { return face_frames_here(ab, bc, ca); }
#endif

}  // namespace

Frames face_frames(const Side& ab, const Side& bc, const Side& ca) {
#ifdef GVD_CHOOSES_FMA
  if (has_fma()) return face_frames_by_fma(ab, bc, ca);
#endif
  return face_frames<DoubleDouble>(ab, bc, ca);
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
