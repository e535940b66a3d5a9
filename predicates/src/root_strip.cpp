#include "gvd/predicates/root_strip.hpp"

namespace gvd::predicates {

using robust::RootSum;

EdgeFrame<RootSum> root_frame(const ExactFace& face, std::size_t k, const RootSum& doubled_area) {
  const mpq_class& length2 = face.squared[k];
  return {RootSum(face.dot[k] / length2), RootSum(face.dot[(k + 1) % 3] / length2), doubled_area * mpq_class(1 / length2), RootSum()};
}

RootPoint cross(const RootPoint& z, const EdgeFrame<RootSum>& side, bool left) {
  return left ? cross_left(z, side) : cross_right(z, side);
}

RootUnfolding first_unfolding(const EdgeFrame<RootSum>& frame) {
  return {apex_from_behind(frame), {RootSum(), RootSum()}, {RootSum(1), RootSum()}};
}

void take_step(RootUnfolding& at, const StripStep& step, const EdgeFrame<RootSum>& side) {
  at.image = cross(at.image, side, step.left);
  at.cone0 = step.bounds && !step.left ? RootPoint{RootSum(), RootSum()} : cross(at.cone0, side, step.left);
  at.cone1 = step.bounds && step.left ? RootPoint{RootSum(1), RootSum()} : cross(at.cone1, side, step.left);
}

}  // namespace gvd::predicates
