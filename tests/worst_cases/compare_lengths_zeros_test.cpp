// Worst cases of comparing lengths: equal by construction, and their nearest neighbours.
#include "gvd/robust/rational.hpp"
#include "support/equal_paths.hpp"
#include "support/worst_case_tally.hpp"

namespace gvd::predicates {
namespace {

using robust::Sign;
using robust::Stage;
using namespace gvd::test;

/// A corner by an ulp, or a length by less.
EqualPaths neighbour(EqualPaths c, Random& random) {
  LaidPath& path = random.below(2) == 0 ? c.a : c.b;
  if (random.below(2) == 0) {
    path.given += small_step(random) * robust::power_of_two(c.exponent);
  } else {
    auto& corners = path.legs.back().corner;
    nudge(random.below(2) == 0 ? corners.back() : corners[random.below(static_cast<std::uint32_t>(corners.size()))], random);
  }
  return c;
}

Sign truth(const EqualPaths& c) {
  const Real a = c.a.length(), b = c.b.length();
  return sign_of(a - b, a + b);
}

Stage check(const EqualPaths& c, Sign expected, bool all_rungs) {
  const Path a = c.a.described(), b = c.b.described();
  const Decision d = compare_lengths(a, b);
  EXPECT_EQ(d.sign.has_value(), d.stage != Stage::undecided);
  EXPECT_TRUE(d.sign.has_value() || expected == Sign::zero);
  EXPECT_EQ(d.sign.value_or(expected), expected);
  if (!all_rungs) return d.stage;
  const Decision swapped = compare_lengths(b, a);
  EXPECT_EQ(swapped.sign.value_or(-expected), -expected);
  EXPECT_EQ(swapped.stage, d.stage);
  for (const Rung& rung : kRungs) EXPECT_EQ(compare_lengths_at(rung, a, b).value_or(expected), expected);
  return d.stage;
}

class CompareLengthsZeros : public testing::TestWithParam<EqualPathsFamily> {};

TEST_P(CompareLengthsZeros, AndTheirNeighbours) {
  Random random(200);
  Tally tally;
  const int rounds = zeros_of_a_family(kEqualPathsFamilies.size());
  for (int round = 0; round < rounds; ++round) {
    const EqualPaths c = GetParam().make(random);
    if (asks_all_rungs(round)) {
      ASSERT_EQ(truth(c), Sign::zero) << round;
    }
    ++tally.zeros[check(c, Sign::zero, asks_all_rungs(round))];
    const EqualPaths off = neighbour(c, random);
    ++tally.neighbours[check(off, truth(off), asks_all_rungs(round))];
    if (HasFailure()) FAIL() << "round " << round;
  }
  tally.record();
  if (GetParam().one_class) {
    EXPECT_EQ(tally.zeros[Stage::algebra] + tally.zeros[Stage::identity], rounds);
  }
  for (const Stage stage : {Stage::filter, Stage::double_double, Stage::mpfr}) EXPECT_GT(tally.neighbours[stage], rounds / 50);
}

INSTANTIATE_TEST_SUITE_P(Families, CompareLengthsZeros, testing::ValuesIn(kEqualPathsFamilies),
                         [](const auto& family) { return std::string(family.param.name); });

}  // namespace
}  // namespace gvd::predicates
