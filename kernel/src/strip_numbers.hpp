#pragma once

#include <cmath>
#include <type_traits>

#include "gvd/kernel/frames.hpp"
#include "gvd/predicates/strip.hpp"
#include "rational_frame.hpp"

/// Points carried along a strip in both directions, in error discs of any number type or as rationals.
namespace gvd::kernel {

/// In discs. Ball<T> is the number of a parameter.
template <class T>
class DiscNumbers {
 public:
  using Point = predicates::Disc<T>;
  using Number = robust::Ball<T>;

  DiscNumbers(const Frames& frames, int bits) : frames_(frames), bits_(bits), unit_(predicates::unit<T>(bits)) {}

  Number number(const mpq_class& q) const { return robust::from<Number>(q, bits_); }
  /// A root that is the apex of h, in the frame of the twin of h.
  Point root(HalfedgeId h) {
    Point p{predicates::apex_from_behind(frame(h)), 0};
    p.radius = predicates::kUnfoldingStep * unit_ * (predicates::rough_size(p.mid) + 1) + 0x1p-1000;
    return p;
  }
  /// b1 times the target of h plus b2 times its apex.
  Point in_face(HalfedgeId h, const mpq_class& b1, const mpq_class& b2) {
    const auto& f = frame(h);
    const double error = predicates::kUnfoldingStep * unit_ * predicates::rough_size(predicates::Complex<T>{f.u, f.y});
    const Number n2 = number(b2), x = number(b1) + n2 * Number(f.u, error), y = n2 * Number(f.y, error);
    return {{x.mid(), y.mid()}, (x.rad() + y.rad()) * (1 + 0x1p-40)};
  }
  Point cross(const Point& z, HalfedgeId side, bool left) { return predicates::cross(z, frame(side), left, unit_); }
  /// Back into the frame of h, from that of its neighbour over prev(h) (left) or next(h): z w, or 1 - (1 - z)(1 - w) with the apex
  /// w of h. The error is bounded as that of predicates::cross, which is of the same form.
  Point cross_back(const Point& z, HalfedgeId h, bool left) {
    const auto& f = frame(h);
    Point result;
    if (left) {
      result.mid = {z.mid.x * f.u - z.mid.y * f.y, z.mid.x * f.y + z.mid.y * f.u};
    } else {
      const T x = T(1.0) - z.mid.x;
      result.mid = {T(1.0) - (x * f.v - z.mid.y * f.y), x * f.y + z.mid.y * f.v};
    }
    const double turn = std::hypot(predicates::rough(left ? f.u : f.v), predicates::rough(f.y)) * (1 + 0x1p-40);
    const double size = (predicates::rough_size(z.mid) + 1 + z.radius) * turn + predicates::rough_size(result.mid) + 1;
    result.radius = (z.radius * turn + predicates::kUnfoldingStep * unit_ * size) * (1 + 0x1p-40) + 0x1p-1000;
    return result;
  }
  /// Where the segment from a point below the side [0, 1] to one above meets its line.
  Number meet(const Point& below, const Point& above) const {
    const Number x0 = predicates::ball_x(below), y0 = predicates::ball_y(below);
    return x0 - (predicates::ball_x(above) - x0) * (y0 / (predicates::ball_y(above) - y0));
  }

 private:
  const predicates::EdgeFrame<T>& frame(HalfedgeId h) {
    if constexpr (std::is_same_v<T, robust::DoubleDouble>) {
      return frames_.in_double_double(h);
    } else {
      return cache_(frames_, h, bits_);
    }
  }

  const Frames& frames_;
  int bits_;
  double unit_;
  MpfrFrames cache_;
};

/// In rationals over a common root. Pre: all faces of the strip are of the class of `radicand`.
class RationalNumbers {
 public:
  using Point = QuadraticPoint;
  using Number = mpq_class;

  RationalNumbers(const Frames& frames, mpq_class radicand) : frames_(frames), radicand_(std::move(radicand)) {}

  Number number(const mpq_class& q) const { return q; }
  Point root(HalfedgeId h) const {
    const RationalFrame f = frame(h);
    return {f.v, -f.y};
  }
  Point in_face(HalfedgeId h, const mpq_class& b1, const mpq_class& b2) const {
    const RationalFrame f = frame(h);
    return {b1 + b2 * f.u, b2 * f.y};
  }
  Point cross(const Point& z, HalfedgeId side, bool left) const { return predicates::turn(z, frame(side), left, radicand_); }
  Point cross_back(const Point& z, HalfedgeId h, bool left) const {
    const RationalFrame f = frame(h);
    if (left) return {z.x * f.u - z.y * f.y * radicand_, z.x * f.y + z.y * f.u};
    const mpq_class x = 1 - z.x;
    return {1 - (x * f.v - z.y * f.y * radicand_), x * f.y + z.y * f.v};
  }
  Number meet(const Point& below, const Point& above) const {
    return below.x - (above.x - below.x) * below.y / (above.y - below.y);
  }

 private:
  RationalFrame frame(HalfedgeId h) const { return rational_frame(frames_, h, radicand_); }

  const Frames& frames_;
  mpq_class radicand_;
};

}  // namespace gvd::kernel
