#pragma once

#include <cmath>

namespace gvd::predicates {

/// The constants of the hand-derived filters in double; docs/error-bounds.md derives each, tests/predicates/frame_bounds_test.cpp repeats it.
inline constexpr double kUnit = 0x1p-53;
/// #frames: error of a frame's apex as a disc, relative to its distance from an end of the edge (both ends).
inline constexpr double kFrameError = 16 * kUnit;
/// #propagation: error of crossing one face, as a disc, over the sum of the distances to the ends of the edges (see there).
inline constexpr double kStepError = 20 * kUnit;
/// #propagation: relative error of weight + length * |image - point|, also where the point is the apex or the third vertex of a face.
inline constexpr double kDistanceError = 32 * kUnit;
/// #propagation: rounding of the determinant of two differences, over the product of their 1-norms.
inline constexpr double kOrientationError = 6 * kUnit;
/// #propagation: relative error of one turn of a direction by the angle of a face.
inline constexpr double kTurnError = 24 * kUnit;

/// #angle-sums: what a corner may be in size, and by what power of two a product that left these bounds is brought back.
inline constexpr double kLeastAngleFactor = 1e-140, kMostAngleFactor = 1e140;
inline constexpr int kAngleRescale = 467;
/// #angle-sums: relative error of the product a corner, and a unit of the errors of its points.
inline constexpr double kAngleFactorError = 13 * kUnit, kAngleInputError = 1.6;
inline constexpr double kMostAngleError = 0x1p-10;

/// #stretches: not above, not below the zero of the linear function with these values at 0 and 1. Pre: one is negative, the other is not.
inline double below_zero_of(double at_0, double at_1) noexcept { return at_0 / (at_0 - at_1) * (1 - 0x1p-48) - 0x1p-1070; }
inline double above_zero_of(double at_0, double at_1) noexcept { return at_0 / (at_0 - at_1) * (1 + 0x1p-48) + 0x1p-1070; }

/// #waves-in-doubles: relative error of weight + |p - image| in plain doubles.
inline constexpr double kDoubleWaveError = 8 * kUnit;

/// #floats: a float that exceeds the error by at least 2^-21 of itself, also below the range of float. Pre: error is below 2^127.
inline float rounded_up(double error) noexcept { return static_cast<float>(error * (1 + 0x1p-20) + 0x1p-120); }

}  // namespace gvd::predicates
