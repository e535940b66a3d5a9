// Worst cases of conflicts: four windows that tie in a point by construction, and their nearest neighbours.
#include "support/tied_sites.hpp"
#include "support/worst_case_tally.hpp"

namespace gvd::predicates {
namespace {

using robust::Sign;
using robust::Stage;
using namespace gvd::test;

/// The rival's weight by a step, or a corner of its strip that is none of the facet by an ulp.
TiedSites neighbour(TiedSites c, Random& random) {
  LaidOut& strip = c.rival_strip;
  if (random.below(3) > 0) {
    const mpq_class step = small_step(random);
    c.windows[3].weight.given += random.below(2) == 0 ? step : -step;
    return c;
  }
  std::size_t v = 0;
  do v = random.below(static_cast<std::uint32_t>(strip.corner.size()));
  while (std::find(c.facet.begin(), c.facet.end(), strip.corner[v]) != c.facet.end());
  nudge(strip.corner[v], random);
  c.windows[3].strip = strip.strip();
  return c;
}

Conflict truth(const TiedSites& c) {
  const Sign sign = sign_of(c.tie - c.rival_distance(), abs(c.tie) + 1);
  return sign == Sign::zero ? Conflict::ties : sign == Sign::positive ? Conflict::nearer : Conflict::farther;
}

Stage check(const TiedSites& c, Conflict expected, bool all_rungs) {
  const std::array<const Window*, 3> ijk{&c.windows[0], &c.windows[1], &c.windows[2]};
  const ConflictDecision d = conflict(c.facet, ijk, c.windows[3]);
  EXPECT_EQ(d.verdict.has_value(), d.stage != Stage::undecided);
  EXPECT_EQ(d.verdict.value_or(expected), expected);
  if (!all_rungs) return d.stage;
  EXPECT_EQ(conflict(c.facet, {ijk[1], ijk[2], ijk[0]}, c.windows[3]).verdict.value_or(expected), expected);
  for (const Rung& rung : kRungs) EXPECT_EQ(conflict_at(rung, c.facet, ijk, c.windows[3]).value_or(expected), expected);
  return d.stage;
}

class ConflictZeros : public testing::TestWithParam<TiedSitesFamily> {};

TEST_P(ConflictZeros, AndTheirNeighbours) {
  Random random(600);
  Tally tally;
  // A tie over many square classes takes up to half a second of towers: few of those, on top of the ten thousand.
  const int rounds = GetParam().one_class ? zeros_of_a_family(kTiedSitesFamilies.size() - 1) : 30;
  for (int round = 0; round < rounds; ++round) {
    const TiedSites c = GetParam().make(random);
    ASSERT_EQ(truth(c), Conflict::ties) << round;
    ++tally.zeros[check(c, Conflict::ties, asks_all_rungs(round))];
    const TiedSites off = neighbour(c, random);
    ++tally.neighbours[check(off, truth(off), asks_all_rungs(round))];
    if (HasFailure()) FAIL() << "round " << round;
  }
  tally.record();
  if (GetParam().one_class) {
    EXPECT_EQ(tally.zeros[Stage::algebra], rounds);
  }
  for (const Stage stage : {Stage::filter, Stage::double_double, Stage::mpfr}) EXPECT_GT(tally.neighbours[stage], 0);
}

INSTANTIATE_TEST_SUITE_P(Families, ConflictZeros, testing::ValuesIn(kTiedSitesFamilies),
                         [](const auto& family) { return std::string(family.param.name); });

}  // namespace
}  // namespace gvd::predicates
