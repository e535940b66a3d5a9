#pragma once

#include "gvd/kernel/frames.hpp"
#include "gvd/kernel/unfolding.hpp"

namespace gvd::kernel {

/// A frame over sqrt(radicand): y stands for y sqrt(radicand).
struct RationalFrame {
  mpq_class u, v, y;
};
/// Throws InternalError unless the face is of the square class of `radicand`.
RationalFrame rational_frame(const Frames& frames, HalfedgeId h, const mpq_class& radicand);

/// Over the side of a face into the frame of the neighbour (predicates::cross_left, cross_right); n: the radicand.
QuadraticPoint turn(const QuadraticPoint& z, const RationalFrame& side, bool left, const mpq_class& n);

}  // namespace gvd::kernel
