#pragma once

#include <array>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gvd/kernel/distance_field.hpp"
#include "gvd/kernel/frames.hpp"
#include "gvd/predicates/root_strip.hpp"
#include "gvd/predicates/strip_program.hpp"
#include "gvd/robust/gmp.hpp"

namespace gvd::kernel {

/// The strip of a window, from its parents. Cost: O(faces crossed).
predicates::Strip strip_of(const Mesh& mesh, const DistanceField& field, WindowId window);

predicates::Unfolding<double> unfold_double(const Frames& frames, const predicates::Strip& strip);
predicates::Unfolding<robust::DoubleDouble> unfold_double_double(const Frames& frames, const predicates::Strip& strip);

/// Where a proof of equality is wanted, so many bits are asked first whether there is anything to prove: they cost far less than algebra. Chooses the
/// order of the stages, and no more.
constexpr int kBitsBeforeAlgebra = 256;

/// MPFR frames of one precision, kept while strips that share faces are unfolded.
class MpfrFrames {
 public:
  const predicates::EdgeFrame<robust::Mpfr>& operator()(const Frames& frames, HalfedgeId h, int bits);

 private:
  std::unordered_map<FaceId, std::array<predicates::EdgeFrame<robust::Mpfr>, 3>> of_face_;
};
predicates::Unfolding<robust::Mpfr> unfold_mpfr(const Frames& frames, const predicates::Strip& strip, int bits, MpfrFrames& cache);
predicates::Unfolding<robust::Mpfr> unfold_mpfr(const Frames& frames, const predicates::Strip& strip, int bits);

/// The apex of the frame of h.
predicates::RootPoint exact_apex(const Frames& frames, HalfedgeId h);
/// The sides that a strip crosses, from its root on; each in the face that is left.
std::vector<HalfedgeId> sides_of(const predicates::Strip& strip);
/// The image of a way's root, as a program, however many square classes it crosses. `sides` as of `sides_of`: the first one is opposite to the root.
predicates::StripProgram way_program(const Frames& frames, std::span<const HalfedgeId> sides);

}  // namespace gvd::kernel
