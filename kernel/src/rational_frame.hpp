#pragma once

#include "gvd/kernel/frames.hpp"
#include "gvd/predicates/rational_strip.hpp"

namespace gvd::kernel {

using predicates::RationalFrame;
/// Throws InternalError unless the face is of the square class of `radicand`.
RationalFrame rational_frame(const Frames& frames, HalfedgeId h, const mpq_class& radicand);

}  // namespace gvd::kernel
