#pragma once

#include "gvd/predicates/face_frames.hpp"
#include "gvd/predicates/strip.hpp"
#include "gvd/robust/root_sum.hpp"

/// Strips in exact numbers: coordinates are sums of roots, which the areas of the faces crossed bring in.
namespace gvd::predicates {

using RootPoint = Complex<robust::RootSum>;

struct RootUnfolding {
  RootPoint image, cone0, cone1;
};

/// The frame of side k, without the length. `doubled_area`: the root of the face's radicand.
EdgeFrame<robust::RootSum> root_frame(const ExactFace& face, std::size_t k, const robust::RootSum& doubled_area);

RootPoint cross(const RootPoint& z, const EdgeFrame<robust::RootSum>& side, bool left);

/// Each further independent square class among the faces may double the terms of a coordinate: this many for five.
inline constexpr std::size_t kMostTerms = 32;
inline bool is_short(const RootPoint& z) { return z.x.terms().size() <= kMostTerms && z.y.terms().size() <= kMostTerms; }

/// A window that its root sees over the first edge; `frame`: that of the strip's `opposite`.
RootUnfolding first_unfolding(const EdgeFrame<robust::RootSum>& frame);
/// Takes the window over the side of a step.
void take_step(RootUnfolding& at, const StripStep& step, const EdgeFrame<robust::RootSum>& side);

}  // namespace gvd::predicates
