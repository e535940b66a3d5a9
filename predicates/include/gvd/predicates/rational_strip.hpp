#pragma once

#include <optional>

#include "gvd/predicates/face_frames.hpp"
#include "gvd/predicates/strip.hpp"

/// Strips whose faces all have radicands of one square class: everything is rational over one root.
namespace gvd::predicates {

/// A point x + i y sqrt(N) of a frame, N the radicand that the strip has in common.
struct QuadraticPoint {
  mpq_class x, y;
};

/// A frame over sqrt(N): y stands for y sqrt(N).
struct RationalFrame {
  mpq_class u, v, y;
};

/// The frame of side k. Empty if the face is not of the square class of `radicand`. Pre: that is not zero.
std::optional<RationalFrame> rational_frame(const ExactFace& face, std::size_t k, const mpq_class& radicand);

/// Over the side of a face into the frame of the neighbour (cross_left, cross_right); n: the radicand.
QuadraticPoint turn(const QuadraticPoint& z, const RationalFrame& side, bool left, const mpq_class& n);

/// The same as an Unfolding, over sqrt(radicand).
struct ExactUnfolding {
  mpq_class radicand;
  QuadraticPoint image, cone0, cone1;
};

/// Unfolds a strip; `frame(h)` gives the RationalFrame over sqrt(radicand) of each half-edge of it.
template <class FrameOf>
ExactUnfolding unfold_rational(const Strip& strip, const mpq_class& radicand, FrameOf&& frame) {
  ExactUnfolding at;
  at.radicand = radicand;
  const RationalFrame first = frame(strip.opposite);
  at.image = {first.v, -first.y};
  at.cone0 = {0, 0};
  at.cone1 = {1, 0};
  for (const StripStep& step : strip.steps) {
    const RationalFrame side = frame(step.side);
    at.image = turn(at.image, side, step.left, radicand);
    at.cone0 = step.bounds && !step.left ? QuadraticPoint{0, 0} : turn(at.cone0, side, step.left, radicand);
    at.cone1 = step.bounds && step.left ? QuadraticPoint{1, 0} : turn(at.cone1, side, step.left, radicand);
  }
  return at;
}

}  // namespace gvd::predicates
