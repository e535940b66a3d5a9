// What is compiled twice, for processors with fused multiply-add and for those without, must do the same to the last bit.
#include <gtest/gtest.h>

#include <bit>

#include "../../predicates/src/double_double_steps.hpp"
#include "gvd/predicates/face_frames.hpp"
#include "support/meshes.hpp"

namespace gvd::predicates {
namespace {

using robust::DoubleDouble;
using test::Random;
using Point = Disc<DoubleDouble>;
using Frame = EdgeFrame<DoubleDouble>;

void expect_same_bits(const DoubleDouble& a, const DoubleDouble& b) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a.hi), std::bit_cast<std::uint64_t>(b.hi));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a.lo), std::bit_cast<std::uint64_t>(b.lo));
}
void expect_same_bits(const Point& a, const Point& b) {
  expect_same_bits(a.mid.x, b.mid.x);
  expect_same_bits(a.mid.y, b.mid.y);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a.radius), std::bit_cast<std::uint64_t>(b.radius));
}

DoubleDouble number(Random& random) { return DoubleDouble(random.uniform(-1, 1)) + DoubleDouble(random.uniform(-0x1p-54, 0x1p-54)); }
Point point(Random& random) { return {{number(random), number(random)}, 0x1p-100 * random.uniform()}; }

/// The sides of a face.
std::array<Vector<DoubleDouble>, 3> sides(Random& random) {
  Vector<DoubleDouble> ab{number(random), number(random), number(random)}, bc{number(random), number(random), number(random)};
  return {ab, bc, {-(ab[0] + bc[0]), -(ab[1] + bc[1]), -(ab[2] + bc[2])}};
}

TEST(FusedMultiplyAdd, ChangesNoBitOfAFrame) {
  Random random(3100);
  for (int round = 0; round < 2000 && !HasFailure(); ++round) {
    const auto [ab, bc, ca] = sides(random);
    const auto frames = face_frames(ab, bc, ca), plain = face_frames<DoubleDouble>(ab, bc, ca);
    for (std::size_t k = 0; k < 3; ++k) {
      expect_same_bits(frames[k].u, plain[k].u);
      expect_same_bits(frames[k].v, plain[k].v);
      expect_same_bits(frames[k].y, plain[k].y);
      expect_same_bits(frames[k].length, plain[k].length);
    }
  }
}

template <bool kCone>
void expect_same_strips() {
  Random random(3200);
  for (int round = 0; round < 500 && !testing::Test::HasFailure(); ++round) {
    std::vector<Frame> frames;
    for (std::size_t n = 1 + random.below(20); n > 0; --n) {
      const auto [ab, bc, ca] = sides(random);
      frames.push_back(face_frames(ab, bc, ca)[random.below(3)]);
    }
    std::vector<DoubleDoubleStep> steps;
    for (const Frame& frame : frames) steps.push_back(step_over(frame, random.below(2) == 0, random.below(2) == 0));
    Unfolding<DoubleDouble> at{};
    at.image = point(random), at.cone0 = point(random), at.cone1 = point(random);
    const Point before = at.image;
    Unfolding<DoubleDouble> plain = at;
    unfold_steps<kCone>(at, steps);
    without_fma::unfold_steps<kCone>(plain, steps);
    expect_same_bits(at.image, plain.image);
    expect_same_bits(at.cone0, plain.cone0);
    expect_same_bits(at.cone1, plain.cone1);
    expect_same_bits(cross(before, frames[0], steps[0].left, unit<DoubleDouble>(0)), without_fma::cross(before, steps[0]));
  }
}
TEST(FusedMultiplyAdd, ChangesNoBitOfAStrip) {
  expect_same_strips<false>();
  expect_same_strips<true>();
}

}  // namespace
}  // namespace gvd::predicates
