#pragma once

#include <cmath>
#include <type_traits>
#include <utility>

#include "gvd/predicates/enclosed_frame.hpp"
#include "gvd/predicates/rational_strip.hpp"

/// Points carried along a strip in both directions, in error discs of any number type or as rationals over one root: two classes with the
/// same members, so that one formula serves all.
namespace gvd::predicates {

/// In discs; Ball<T> is the number of a parameter. `frame(h)` gives the EdgeFrame<T> of a half-edge.
template <class T, class FrameOf>
class DiscNumbers {
 public:
  using Point = Disc<T>;
  using Number = robust::Ball<T>;

  DiscNumbers(FrameOf frame, int bits) : frame_(std::move(frame)), bits_(bits), unit_(unit<T>(bits)) {}

  Number number(const mpq_class& q) const { return robust::from<Number>(q, bits_); }
  /// A root that is the apex of h, in the frame of the twin of h.
  Point root(std::uint32_t h) {
    Point p{apex_from_behind(frame_(h)), 0};
    p.radius = kUnfoldingStep * unit_ * (rough_size(p.mid) + 1) + 0x1p-1000;
    return p;
  }
  /// b1 times the target of h plus b2 times its apex.
  Point in_face(std::uint32_t h, const mpq_class& b1, const mpq_class& b2) {
    const PlanePoint<Number> apex = enclosed_apex(frame_(h), unit_);
    const Number n2 = number(b2), x = number(b1) + n2 * apex.x, y = n2 * apex.y;
    return {{x.mid(), y.mid()}, (x.rad() + y.rad()) * (1 + 0x1p-40)};
  }
  Point cross(const Point& z, std::uint32_t side, bool left) { return predicates::cross(z, frame_(side), left, unit_); }
  /// Back into the frame of h, from that of its neighbour over prev(h) (left) or next(h): z w, or 1 - (1 - z)(1 - w) with the apex
  /// w of h. The error is bounded as that of predicates::cross, which is of the same form.
  Point cross_back(const Point& z, std::uint32_t h, bool left) {
    const EdgeFrame<T>& f = frame_(h);
    Point result;
    if (left) {
      result.mid = {z.mid.x * f.u - z.mid.y * f.y, z.mid.x * f.y + z.mid.y * f.u};
    } else {
      const T x = T(1.0) - z.mid.x;
      result.mid = {T(1.0) - (x * f.v - z.mid.y * f.y), x * f.y + z.mid.y * f.v};
    }
    const double turn = length_bound(rough(left ? f.u : f.v), rough(f.y));
    const double size = (rough_size(z.mid) + 1 + z.radius) * turn + rough_size(result.mid) + 1;
    result.radius = (z.radius * turn + kUnfoldingStep * unit_ * size) * (1 + 0x1p-40) + 0x1p-1000;
    return result;
  }
  /// Where the segment from a point below the side [0, 1] to one above meets its line.
  Number meet(const Point& below, const Point& above) const {
    const Number x0 = ball_x(below), y0 = ball_y(below);
    return x0 - (ball_x(above) - x0) * (y0 / (ball_y(above) - y0));
  }
  PlanePoint<Number> coordinates(const Point& z) const { return balls(z); }

 private:
  FrameOf frame_;
  int bits_;
  double unit_;
};

template <class T, class FrameOf>
DiscNumbers<T, FrameOf> disc_numbers(FrameOf frame, int bits = 0) {
  return {std::move(frame), bits};
}

/// In rationals over a common root. `frame(h)` gives the RationalFrame of a half-edge over sqrt(radicand).
template <class FrameOf>
class RationalNumbers {
 public:
  using Point = QuadraticPoint;
  using Number = mpq_class;

  RationalNumbers(FrameOf frame, mpq_class radicand) : frame_(std::move(frame)), radicand_(std::move(radicand)) {}

  Number number(const mpq_class& q) const { return q; }
  Point root(std::uint32_t h) const {
    const RationalFrame& f = frame_(h);
    return {f.v, -f.y};
  }
  Point in_face(std::uint32_t h, const mpq_class& b1, const mpq_class& b2) const {
    const RationalFrame& f = frame_(h);
    return {b1 + b2 * f.u, b2 * f.y};
  }
  Point cross(const Point& z, std::uint32_t side, bool left) const { return turn(z, frame_(side), left, radicand_); }
  Point cross_back(const Point& z, std::uint32_t h, bool left) const {
    const RationalFrame& f = frame_(h);
    if (left) return {z.x * f.u - z.y * f.y * radicand_, z.x * f.y + z.y * f.u};
    const mpq_class x = 1 - z.x;
    return {1 - (x * f.v - z.y * f.y * radicand_), x * f.y + z.y * f.v};
  }
  Number meet(const Point& below, const Point& above) const {
    return below.x - (above.x - below.x) * below.y / (above.y - below.y);
  }
  /// The second one over sqrt(radicand).
  PlanePoint<Number> coordinates(const Point& z) const { return {z.x, z.y}; }

 private:
  FrameOf frame_;
  mpq_class radicand_;
};

}  // namespace gvd::predicates
