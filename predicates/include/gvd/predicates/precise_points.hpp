#pragma once

#include <array>

#include "gvd/predicates/double_wave.hpp"
#include "gvd/predicates/enclosed_frame.hpp"
#include "gvd/predicates/side_tie.hpp"
#include "gvd/robust/ball_quad.hpp"

/// The points of a facet's tessellation in double-double, each from a double that is known to be near: one step of Newton's iteration, whose residual is
/// a ball, and a bound of what the step leaves (docs/error-bounds.md#points-in-double-double). Nothing is decided here: that the point exists, which of
/// several it is, and how near it is, is known. By the processor's own fused multiply-add where it has one.
namespace gvd::predicates {

using DoubleDoubleBall = robust::Ball<robust::DoubleDouble>;
using PrecisePoint = PlanePoint<DoubleDoubleBall>;

/// A wave without its cone, in the frame of a facet.
struct PreciseWave {
  PrecisePoint image;
  DoubleDoubleBall weight;  ///< frame units
};

/// A point of the plane, certainly within `radius` of `at`.
struct NearPoint {
  DoublePoint at;
  double radius;
};

/// The wave of a window that is seen over side `side`, in the frame of the facet's first side `first`; `distance` is that of the root, in the unit of lengths.
PreciseWave wave_over_side(const Disc<robust::DoubleDouble>& image, unsigned side, const DoubleDoubleBall& distance,
                           const EdgeFrame<robust::DoubleDouble>& first);
/// The wave of corner `corner`.
PreciseWave wave_of_corner(unsigned corner, const DoubleDoubleBall& distance, const EdgeFrame<robust::DoubleDouble>& first);

/// The point where three waves tie. Pre: it is there. Balls of infinite radius if the waves turn too little.
PrecisePoint vertex_near(const PreciseWave& i, const PreciseWave& j, const PreciseWave& k, const NearPoint& start);
/// The point of the ray from the image of `parent` through that of `relay`, beyond it, where relay and `other` tie. Pre: it is there.
PrecisePoint ray_vertex_near(const PreciseWave& parent, const PreciseWave& relay, const PreciseWave& other, const NearPoint& start);
/// The parameter of the point of a side where two waves tie. Pre: it is there, within `radius` of `start`.
DoubleDoubleBall side_tie_near(const SideLine<DoubleDoubleBall>& side, const PreciseWave& from, const PreciseWave& to, double start, double radius);

/// origin + t direction.
PrecisePoint point_of_side(const SideLine<DoubleDoubleBall>& side, const DoubleDoubleBall& t);

/// A facet's frame in space: p is at origin + p.x along + p.y across. The three coordinates are in three lanes; the last one means nothing.
struct FrameInSpace {
  robust::BallQuad origin, along, across;
};
FrameInSpace frame_in_space(const std::array<robust::BallQuad, 3>& corner, const PrecisePoint& apex);
robust::BallQuad in_space(const FrameInSpace& frame, const PrecisePoint& p);
/// a + t (b - a).
robust::BallQuad between(const robust::BallQuad& a, const robust::BallQuad& b, const DoubleDoubleBall& t);

/// factor p.
PrecisePoint multiple(const DoubleDoubleBall& factor, const PrecisePoint& p);
/// The coordinates of the image and the weight, in the first three lanes, times a factor.
robust::BallQuad multiple(const DoubleDoubleBall& factor, const PreciseWave& wave);
/// base + turn p, as complex numbers.
PrecisePoint turned_and_moved(const PrecisePoint& base, const PrecisePoint& turn, const PrecisePoint& p);

}  // namespace gvd::predicates
