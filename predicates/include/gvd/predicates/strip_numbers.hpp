#pragma once

#include <cmath>
#include <type_traits>
#include <utility>

#include "gvd/predicates/enclosed_frame.hpp"
#include "gvd/predicates/root_strip.hpp"
#include "gvd/robust/exact.hpp"

/// Points carried along a strip in both directions, in error discs of any number type or in exact numbers: two classes with the same members,
/// so that one formula serves all.
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
  /// Back into the frame of h, from that of its neighbour over prev(h) (left) or next(h). The error is bounded as that of
  /// predicates::cross, which is of the same form.
  Point cross_back(const Point& z, std::uint32_t h, bool left) {
    const EdgeFrame<T>& f = frame_(h);
    Point result{predicates::cross_back(z.mid, f, left), 0};
    result.radius = radius_after(z, result.mid, length_bound(rough(left ? f.u : f.v), rough(f.y)), unit_);
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

/// In sums of roots. `frame(h)` gives the EdgeFrame<RootSum> of a half-edge, whose length is not used. A point whose coordinates would be too
/// long sums is left out, and with it all that follows: then nothing is known any more.
template <class FrameOf>
class RootNumbers {
 public:
  using Point = RootPoint;
  using Number = robust::Exact;

  explicit RootNumbers(FrameOf frame) : frame_(std::move(frame)) {}

  /// Whether all points so far are what they should be.
  bool is_known() const noexcept { return known_; }
  Number number(const mpq_class& q) const { return Number(q); }
  Point root(std::uint32_t h) const { return apex_from_behind(frame_(h)); }
  Point in_face(std::uint32_t h, const mpq_class& b1, const mpq_class& b2) const {
    const EdgeFrame<robust::RootSum>& f = frame_(h);
    return {robust::RootSum(b1) + b2 * f.u, b2 * f.y};
  }
  Point cross(const Point& z, std::uint32_t side, bool left) { return kept(predicates::cross(z, frame_(side), left)); }
  Point cross_back(const Point& z, std::uint32_t h, bool left) { return kept(predicates::cross_back(z, frame_(h), left)); }
  /// Undefined if not known.
  Number meet(const Point& below, const Point& above) const {
    if (!known_) return Number::undefined();
    return Number(below.x) - Number(above.x - below.x) * (Number(below.y) / Number(above.y - below.y));
  }
  PlanePoint<robust::RootSum> coordinates(const Point& z) const { return {z.x, z.y}; }

 private:
  Point kept(Point z) {
    known_ = known_ && is_short(z);
    return known_ ? std::move(z) : Point{};
  }

  FrameOf frame_;
  bool known_ = true;
};

}  // namespace gvd::predicates
