#include "face_shape.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gvd/robust/ball.hpp"
#include "gvd/robust/rational.hpp"

namespace gvd::predicates {

using robust::DoubleDouble;
using robust::Mpfr;

ExactPoint exact_point(const SpacePoint& p) {
  return {robust::exact_rational(p[0]), robust::exact_rational(p[1]), robust::exact_rational(p[2])};
}

FaceShape::FaceShape(const FaceCorners& corners) : corners_(corners) { prepare(); }

FaceShape::FaceShape(const SpacePoint& a, const SpacePoint& b, const ExactPoint& apex) : corners_{a, b, {}}, apex_(apex) {
  for (std::size_t i = 0; i < 3; ++i) corners_[2][i] = robust::from<robust::Ball<double>>(apex[i]).mid();
  prepare();
}

const ExactPoint FaceShape::exact_corner(std::size_t k) const { return k == 2 && apex_ ? *apex_ : exact_point(corners_[k]); }

void FaceShape::prepare() {
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const double difference = std::fabs(corners_[(k + 1) % 3][i] - corners_[k][i]);
      if (!std::isfinite(difference)) throw std::invalid_argument("a corner of a face is not finite, or too far from another");
      largest = std::max(largest, difference);
    }
  if (largest == 0) throw std::invalid_argument("the corners of a face are one point");
  exponent_ = std::ilogb(largest);
  const auto side = sides<double>(53);
  double_ = face_frames(side[0], side[1], side[2]);
  static_assert(kMostSide * kMostSide > 3 * 2 * 2);  // no difference of two coordinates exceeds 2
  in_range_ = std::all_of(double_.begin(), double_.end(), [](const auto& frame) { return frame.length > kLeastSide; });
  // An apex certainly above its side makes an area; the rest is for rationals.
  const bool has_height = in_range_ && double_[0].y > 0x1p-40 * rough_size(Complex<double>{double_[0].u, double_[0].y});
  if (!has_height && sgn(exact().radicand) == 0) throw std::invalid_argument("the corners of a face are in line");
}

std::array<Vector<mpq_class>, 3> FaceShape::exact_sides() const {
  const std::array<ExactPoint, 3> corner{exact_corner(0), exact_corner(1), exact_corner(2)};
  const mpq_class scale = robust::power_of_two(-exponent_);
  std::array<Vector<mpq_class>, 3> side;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) side[k][i] = (corner[(k + 1) % 3][i] - corner[k][i]) * scale;
  return side;
}

template <class T>
std::array<Vector<T>, 3> FaceShape::sides(int bits) const {
  std::array<Vector<T>, 3> side;
  if constexpr (!std::is_same_v<T, Mpfr>) {
    for (std::size_t k = 0; k < 3 && !apex_; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        const DoubleDouble d = robust::two_sum(corners_[(k + 1) % 3][i], -corners_[k][i]);
        if constexpr (std::is_same_v<T, double>)
          side[k][i] = std::ldexp(d.hi, -exponent_);
        else
          side[k][i] = {std::ldexp(d.hi, -exponent_), std::ldexp(d.lo, -exponent_)};
      }
    }
    if (!apex_) return side;
  }
  const auto exact = exact_sides();
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) side[k][i] = robust::from<robust::Ball<T>>(exact[k][i], bits).mid();
  return side;
}

const std::array<EdgeFrame<DoubleDouble>, 3>& FaceShape::in_double_double() const {
  std::call_once(double_double_once_, [&] {
    const auto side = sides<DoubleDouble>(106);
    double_double_ = face_frames(side[0], side[1], side[2]);
  });
  return double_double_;
}

std::array<EdgeFrame<Mpfr>, 3> FaceShape::in_mpfr(int bits) const {
  const auto side = sides<Mpfr>(bits + 8);  // kUnfoldingStep counts on these
  return face_frames(side[0], side[1], side[2]);
}

const ExactFace& FaceShape::exact() const {
  std::call_once(exact_once_, [&] { exact_ = exact_face(exact_sides()); });
  return exact_;
}

const std::array<EdgeFrame<robust::RootSum>, 3>& FaceShape::in_roots() const {
  std::call_once(roots_once_, [&] {
    const robust::RootSum doubled_area(1, exact().radicand);
    for (std::size_t k = 0; k < 3; ++k) roots_[k] = root_frame(exact(), k, doubled_area);
  });
  return roots_;
}

ProgramFace FaceShape::for_program(robust::SquareClasses& classes) const {
  ProgramFace result{exact(), {}};
  const mpq_class unit = robust::power_of_two(2 * exponent_);
  for (std::size_t k = 0; k < 3; ++k) {
    result.face.dot[k] *= unit;
    result.face.squared[k] *= unit;
  }
  result.face.radicand *= unit * unit;
  result.doubled_area = classes.root(result.face.radicand);
  return result;
}

}  // namespace gvd::predicates
