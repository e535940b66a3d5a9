#include "gvd/kernel/unfolding.hpp"

#include <algorithm>

#include "gvd/kernel/error.hpp"
#include "gvd/robust/rational.hpp"
#include "rational_frame.hpp"

namespace gvd::kernel {

using predicates::Strip;
using predicates::Unfolding;
using robust::DoubleDouble;
using robust::Mpfr;

Strip strip_of(const Mesh& mesh, const DistanceField& field, WindowId window) {
  Strip strip;
  const WindowRecord* record = &field.windows[window];
  while (record->parent != kNone) {
    const WindowRecord& parent = field.windows[record->parent];
    const HalfedgeId side = mesh.twin(record->halfedge());
    strip.steps.push_back({side, side == Mesh::prev(parent.halfedge()), record->apex_in_cone()});
    record = &parent;
  }
  strip.opposite = mesh.twin(record->halfedge());
  std::reverse(strip.steps.begin(), strip.steps.end());
  return strip;
}

Unfolding<double> unfold_double(const Frames& frames, const Strip& strip) {
  return predicates::unfold<double>(strip, [&](HalfedgeId h) -> const predicates::EdgeFrame<double>& { return frames(h); });
}

Unfolding<DoubleDouble> unfold_double_double(const Frames& frames, const Strip& strip) {
  return predicates::unfold<DoubleDouble>(
      strip, [&](HalfedgeId h) -> const predicates::EdgeFrame<DoubleDouble>& { return frames.in_double_double(h); });
}

const predicates::EdgeFrame<Mpfr>& MpfrFrames::operator()(const Frames& frames, HalfedgeId h, int bits) {
  const auto [it, added] = of_face_.try_emplace(Mesh::face(h));
  if (added) it->second = frames.in_mpfr(Mesh::face(h), bits);
  return it->second[h % 3];
}

Unfolding<Mpfr> unfold_mpfr(const Frames& frames, const Strip& strip, int bits, MpfrFrames& cache) {
  return predicates::unfold<Mpfr>(
      strip, [&](HalfedgeId h) -> const predicates::EdgeFrame<Mpfr>& { return cache(frames, h, bits); }, bits);
}

Unfolding<Mpfr> unfold_mpfr(const Frames& frames, const Strip& strip, int bits) {
  MpfrFrames cache;
  return unfold_mpfr(frames, strip, bits, cache);
}

RationalFrame rational_frame(const Frames& frames, HalfedgeId h, const mpq_class& radicand) {
  const ExactFace face = frames.exact(Mesh::face(h));
  const std::size_t k = h % 3;
  const auto root = robust::rational_square_root(face.radicand / radicand);
  if (!root) throw InternalError("unfolding: a face is not of the square class of its strip");
  const mpq_class& length2 = face.squared[k];
  return {face.dot[k] / length2, face.dot[(k + 1) % 3] / length2, *root / length2};
}

QuadraticPoint turn(const QuadraticPoint& z, const RationalFrame& side, bool left, const mpq_class& n) {
  if (left) return {z.x * side.v + z.y * side.y * n, z.y * side.v - z.x * side.y};
  const mpq_class x = 1 - z.x;
  return {1 - (x * side.u + z.y * side.y * n), z.y * side.u - x * side.y};
}

QuadraticPoint exact_apex(const Frames& frames, HalfedgeId h, const mpq_class& radicand) {
  const RationalFrame f = rational_frame(frames, h, radicand);
  return {f.u, f.y};
}

std::optional<ExactUnfolding> unfold_exact(const Frames& frames, const Strip& strip, HalfedgeId last) {
  const std::uint32_t square_class = frames.square_class(Mesh::face(last));
  if (frames.square_class(Mesh::face(strip.opposite)) != square_class) return std::nullopt;
  for (const auto& step : strip.steps)
    if (frames.square_class(Mesh::face(step.side)) != square_class) return std::nullopt;
  ExactUnfolding at;
  at.radicand = frames.exact(Mesh::face(last)).radicand;
  const RationalFrame first = rational_frame(frames, strip.opposite, at.radicand);
  at.image = {first.v, -first.y};
  at.cone0 = {0, 0};
  at.cone1 = {1, 0};
  for (const auto& step : strip.steps) {
    const RationalFrame side = rational_frame(frames, step.side, at.radicand);
    at.image = turn(at.image, side, step.left, at.radicand);
    at.cone0 = step.bounds && !step.left ? QuadraticPoint{0, 0} : turn(at.cone0, side, step.left, at.radicand);
    at.cone1 = step.bounds && step.left ? QuadraticPoint{1, 0} : turn(at.cone1, side, step.left, at.radicand);
  }
  return at;
}

}  // namespace gvd::kernel
