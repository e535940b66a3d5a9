// Worst cases of rounding: lengths halfway between two doubles by construction, and their nearest neighbours.
#include "support/midpoint_paths.hpp"
#include "support/worst_case_tally.hpp"

namespace gvd::predicates {
namespace {

using robust::Stage;
using namespace gvd::test;

double ties_to_even(const mpq_class& midpoint) {
  mpfr_t rounded;
  mpfr_init2(rounded, 53);
  mpfr_set_q(rounded, midpoint.get_mpq_t(), MPFR_RNDN);
  const double result = mpfr_get_d(rounded, MPFR_RNDN);
  mpfr_clear(rounded);
  return result;
}

/// The double nearest to the length of a path near the midpoint.
double truth(const LaidPath& path, const mpq_class& midpoint) {
  const Real length = path.length(), at = real(midpoint);
  if (sign_of(length - at, at) == robust::Sign::zero) return ties_to_even(midpoint);
  return mpfr_get_d(length.backend().data(), MPFR_RNDN);
}

LaidPath neighbour(LaidPath path, const mpq_class& midpoint, Random& random) {
  if (random.below(2) == 0) {
    const mpq_class step = small_step(random) * midpoint;
    path.given += random.below(2) == 0 ? step : -step;
  } else {
    auto& corners = path.legs.back().corner;
    nudge(random.below(2) == 0 ? corners.back() : corners[random.below(static_cast<std::uint32_t>(corners.size()))], random);
  }
  return path;
}

Stage check(const LaidPath& path, double expected, bool is_tie, bool all_rungs) {
  const RoundedLength length = rounded_length(path.described());
  EXPECT_EQ(length.value.has_value(), length.stage != Stage::undecided);
  EXPECT_TRUE(length.value.has_value() || is_tie);
  EXPECT_EQ(length.value.value_or(expected), expected);
  if (all_rungs) {
    LaidPath twice = path;
    twice.given *= 2;
    for (LaidOut& leg : twice.legs)
      for (SpacePoint& p : leg.corner)
        for (double& x : p) x *= 2;
    EXPECT_EQ(rounded_length(twice.described()).value.value_or(2 * expected), 2 * expected);
  }
  return length.stage;
}

class RoundedLengthZeros : public testing::TestWithParam<MidpointFamily> {};

TEST_P(RoundedLengthZeros, AndTheirNeighbours) {
  Random random(300);
  Tally tally;
  const int rounds = zeros_of_a_family(kMidpointFamilies.size());
  int up = 0;
  for (int round = 0; round < rounds; ++round) {
    const MidpointPath c = GetParam().make(random);
    ASSERT_EQ(sign_of(c.path.length() - real(c.length), real(c.length)), robust::Sign::zero) << round;
    const double even = ties_to_even(c.length);
    const mpq_class other = 2 * c.length - mpq_class(even);  // the double on the other side
    ASSERT_NE(other, mpq_class(even));
    ASSERT_EQ(mpq_class(other.get_d()), other);
    up += mpq_class(even) > c.length;
    ++tally.zeros[check(c.path, even, true, asks_all_rungs(round))];
    const LaidPath off = neighbour(c.path, c.length, random);
    const bool is_tie = sign_of(off.length() - real(c.length), real(c.length)) == robust::Sign::zero;
    ++tally.neighbours[check(off, truth(off, c.length), is_tie, asks_all_rungs(round))];
    if (HasFailure()) FAIL() << "round " << round;
  }
  tally.record();
  EXPECT_EQ(tally.zeros[Stage::algebra], rounds);
  EXPECT_GT(up, rounds / 4);
  EXPECT_LT(up, rounds * 3 / 4);
  for (const Stage stage : {Stage::double_double, Stage::mpfr}) EXPECT_GT(tally.neighbours[stage], rounds / 50);
}

INSTANTIATE_TEST_SUITE_P(Families, RoundedLengthZeros, testing::ValuesIn(kMidpointFamilies),
                         [](const auto& family) { return std::string(family.param.name); });

// Plain doubles round what is exact in them; a strip's length is never known well enough.
TEST(RoundedLength, FilterRoundsWhatIsExact) {
  EXPECT_EQ(rounded_length({mpq_class(3), {}}).value, 3);
  EXPECT_EQ(rounded_length({mpq_class(3), {}}).stage, Stage::filter);
}

}  // namespace
}  // namespace gvd::predicates
