// Worst cases of the side of a ray: vertices in line with the source by construction, and their nearest neighbours.
#include "support/in_line.hpp"
#include "support/worst_case_tally.hpp"

namespace gvd::predicates {
namespace {

using robust::MaybeSign;
using robust::Sign;
using robust::Stage;
using namespace gvd::test;

Sign truth(const InLine& c) {
  const auto flat = c.strip.flat<Real>();
  const auto image = c.strip.image(flat), a = flat[c.through] - image, b = flat[c.v] - image;
  return sign_of(cross(a, b), norm(a) * norm(b));
}

class RaySideZeros : public testing::TestWithParam<BandFamily> {
 protected:
  /// Returns the stage that decided.
  Stage check(const InLine& c, Sign expected, bool all_rungs) {
    const FaceStrip strip = c.strip.strip();
    const Decision d = ray_side(strip, c.through, c.v);
    EXPECT_EQ(d.sign.has_value(), d.stage != Stage::undecided);
    EXPECT_TRUE(d.sign.has_value() || expected == Sign::zero);
    EXPECT_EQ(d.sign.value_or(expected), expected);
    if (!all_rungs) return d.stage;
    const Decision swapped = ray_side(strip, c.v, c.through);
    EXPECT_EQ(swapped.sign.value_or(-expected), -expected);
    EXPECT_EQ(swapped.stage, d.stage);
    for (const Rung& rung : kRungs) EXPECT_EQ(ray_side_at(rung, strip, c.through, c.v).value_or(expected), expected);
    return d.stage;
  }
};

TEST_P(RaySideZeros, AndTheirNeighbours) {
  Random random(100);
  Tally tally;
  const int rounds = zeros_of_a_family(kBandFamilies.size());
  for (int round = 0; round < rounds; ++round) {
    const InLine c = in_line(GetParam(), random);
    if (asks_all_rungs(round)) {
      ASSERT_EQ(truth(c), Sign::zero) << round;
    }
    ++tally.zeros[check(c, Sign::zero, asks_all_rungs(round))];
    const InLine off = neighbour(c, random);
    ++tally.neighbours[check(off, truth(off), asks_all_rungs(round))];
    if (HasFailure()) FAIL() << "round " << round;
  }
  tally.record();
  EXPECT_EQ(tally.zeros[Stage::algebra], rounds);
  for (const Stage stage : {Stage::filter, Stage::double_double, Stage::mpfr}) EXPECT_GT(tally.neighbours[stage], rounds / 50);
}

INSTANTIATE_TEST_SUITE_P(Families, RaySideZeros, testing::ValuesIn(kBandFamilies), [](const auto& family) { return std::string(family.param.name); });

}  // namespace
}  // namespace gvd::predicates
