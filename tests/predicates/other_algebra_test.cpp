// What algebra says about short strips, beside Calcium and CORE, which know nothing of strips: they lay the faces out by the lengths of their edges.
#include <CGAL/CORE_Expr.h>

#include "support/calcium.hpp"
#include "support/equal_paths.hpp"
#include "support/worst_case_tally.hpp"

namespace gvd::predicates {
namespace {

using robust::MaybeSign;
using robust::Sign;
using robust::Stage;
using namespace gvd::test;

MaybeSign maybe_sign(const CORE::Expr& x) { return static_cast<Sign>(x.sign()); }

/// The sign of the difference of the squared lengths of strips that begin in a corner.
template <class Number>
MaybeSign compare_in(const LaidOut& a, const LaidOut& b) {
  const auto squared_length = [](const LaidOut& strip) {
    const auto flat = strip.flat_in_units<Number>();
    const auto d = flat.back() - flat[0];
    return (d.x * d.x + d.y * d.y) * strip.squared_unit<Number>();
  };
  return maybe_sign(squared_length(a) - squared_length(b));
}
template <class Number>
MaybeSign side_in(const LaidOut& strip, std::size_t through, std::size_t v) {
  const auto flat = strip.flat_in_units<Number>();
  return maybe_sign(cross(flat[through] - flat[0], flat[v] - flat[0]));
}

struct Compared {
  int zeros = 0, others = 0;
};

/// What Number knows agrees with what algebra and the whole ladder know.
template <class Number>
void compare_with_ours(const LaidOut& a, const LaidOut& b, Compared& count) {
  const MaybeSign truth = compare_in<Number>(a, b);
  ASSERT_TRUE(truth.has_value());
  const Path pa = LaidPath{0, {a}}.described(), pb = LaidPath{0, {b}}.described();
  const MaybeSign algebra = compare_lengths_at({Stage::algebra}, pa, pb), ladder = compare_lengths(pa, pb).sign;
  ASSERT_EQ(algebra.value_or(*truth), *truth);
  ASSERT_EQ(ladder.value_or(Sign::zero), *truth);
  ++(*truth == Sign::zero ? count.zeros : count.others);
}

/// Pairs of a family whose strips have at most `faces` faces, each with a neighbour.
template <class Number>
Compared compare_family(EqualPaths (*family)(Random&), int pairs, std::size_t faces, std::uint64_t seed) {
  Random random(seed);
  Compared count;
  while (count.zeros < pairs) {
    const EqualPaths c = family(random);
    const LaidOut &a = c.a.legs[0], &b = c.b.legs[0];
    if (c.exponent != 0 || std::max(a.corner.size(), b.corner.size()) > faces + 2) continue;
    if (a.source.weight[0] != 1 || a.source.weight[1] != 0 || a.source.weight[2] != 0) continue;
    compare_with_ours<Number>(a, b, count);
    LaidOut off = b;
    nudge(off.corner.back(), random);
    compare_with_ours<Number>(a, off, count);
    if (testing::Test::HasFailure()) break;
  }
  return count;
}

TEST(OtherAlgebra, CalciumAgreesAboutLengths) {
  for (const auto family : {mirror_images, ways_back, turned_fans, grid_points, dependent_products}) {
    const Compared count = compare_family<Calcium>(family, 4, 4, 700);
    EXPECT_GE(count.zeros, 4);
    EXPECT_GT(count.others, 0);
  }
}

TEST(OtherAlgebra, CoreAgreesAboutLengths) {
  for (const auto family : {turned_fans, grid_points, dependent_products}) {
    const Compared count = compare_family<CORE::Expr>(family, 1, 3, 701);
    EXPECT_GE(count.zeros, 1);
  }
}

/// Vertices in line with the source of a band strip.
TEST(OtherAlgebra, BothAgreeAboutSidesOfRays) {
  Random random(702);
  int zeros = 0;
  for (int round = 0; round < 12; ++round) {
    FoldedBand band;
    band.panels = {any_panel(random), any_panel(random)};
    const auto built = BandStrip::build(band, Placement{}, {{1, 0, true}, {2, 0, true}}, false, random);
    LaidOut strip = built.strip;
    for (int step = 0; step < 2; ++step) {
      const MaybeSign calcium = side_in<Calcium>(strip, built.anchor[0], built.anchor[1]);
      ASSERT_TRUE(calcium.has_value());
      zeros += *calcium == Sign::zero;
      ASSERT_EQ(ray_side_at({Stage::algebra}, strip.strip(), built.anchor[0], built.anchor[1]).value_or(*calcium), *calcium);
      ASSERT_EQ(ray_side(strip.strip(), built.anchor[0], built.anchor[1]).sign.value_or(Sign::zero), *calcium);
      if (round < 3) {
        ASSERT_EQ(side_in<CORE::Expr>(strip, built.anchor[0], built.anchor[1]), calcium);
      }
      nudge(strip.corner[built.anchor[1]], random);
    }
  }
  EXPECT_GE(zeros, 12);
}

}  // namespace
}  // namespace gvd::predicates
