#pragma once

#include "gvd/predicates/face_frames.hpp"
#include "gvd/predicates/strip.hpp"
#include "gvd/robust/root_program.hpp"
#include "gvd/robust/root_sum.hpp"

namespace gvd::predicates {

/// The face that a half-edge belongs to, in exact arithmetic.
struct ProgramFace {
  ExactFace face;
  robust::RootSum doubled_area;  ///< over one and the same integer for all faces of a square class
};

/// The image of the root of a strip as a program: state (|z|^2, x, y, 1) of the image z = x + i y in the frame of the half-edge reached, up to a common
/// positive factor; every layer is linear in it, because the turn at a vertex has a rational |q|^2.
class StripProgram {
 public:
  /// The root is the apex of side k of the face; the first frame is that of this side, seen from the neighbour.
  StripProgram(const ProgramFace& root_face, std::size_t k);
  /// Over side k of a face, which is its `prev` (left) or `next`.
  void cross(const ProgramFace& face, std::size_t k, bool left);
  /// A multiple of |z|^2, x, y and 1, added up.
  robust::RootProgram value(const std::array<long, 4>& functional) const;
  /// The squared distance from the root to a point of the face entered over side k: b1 times the target of that side plus b2 times its apex. In
  /// the units of that face; each face may have its own.
  robust::RootProgram squared_distance(const ProgramFace& face, std::size_t k, const mpq_class& b1, const mpq_class& b2) const;
  robust::RootProgram squared_distance_to_apex(const ProgramFace& face, std::size_t k) const { return squared_distance(face, k, 0, 1); }

 private:
  robust::RootProgram program_;
  mpq_class denominator_ = 1;
};

/// The whole strip. `face(h)` gives the ProgramFace of a half-edge.
template <class FaceOf>
StripProgram strip_program(const Strip& strip, FaceOf&& face) {
  StripProgram program(face(strip.opposite), strip.opposite % 3);
  for (const StripStep& step : strip.steps) program.cross(face(step.side), step.side % 3, step.left);
  return program;
}

}  // namespace gvd::predicates
