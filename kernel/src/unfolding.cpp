#include "gvd/kernel/unfolding.hpp"

#include <algorithm>

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

predicates::RootPoint exact_apex(const Frames& frames, HalfedgeId h) {
  const auto of_face = frames.in_roots(Mesh::face(h));
  const auto& frame = (*of_face)[h % 3];
  return {frame.u, frame.y};
}

std::vector<HalfedgeId> sides_of(const Strip& strip) {
  std::vector<HalfedgeId> sides{strip.opposite};
  for (const predicates::StripStep& step : strip.steps) sides.push_back(step.side);
  return sides;
}

predicates::StripProgram way_program(const Frames& frames, std::span<const HalfedgeId> sides) {
  const auto of_face = [&](HalfedgeId h) { return frames.for_program(Mesh::face(h)); };
  predicates::StripProgram program(*of_face(sides[0]), sides[0] % 3);
  for (std::size_t i = 1; i < sides.size(); ++i)
    program.cross(*of_face(sides[i]), sides[i] % 3, sides[i] == Mesh::prev(frames.mesh().twin(sides[i - 1])));
  return program;
}

}  // namespace gvd::kernel
