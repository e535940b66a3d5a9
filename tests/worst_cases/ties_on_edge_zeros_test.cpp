// Worst cases of ties on an edge: everywhere, at an end, a contact or a ray by construction, and their nearest neighbours.
#include "gvd/robust/rational.hpp"
#include "support/tied_windows.hpp"
#include "support/worst_case_tally.hpp"

namespace gvd::predicates {
namespace {

using robust::Sign;
using robust::Stage;
using namespace gvd::test;
using Kind = EdgeTies::Kind;

/// A corner of a strip by an ulp, or a weight by a step.
TiedWindows neighbour(TiedWindows c, Random& random) {
  LaidWindow& window = random.below(2) == 0 ? c.a : c.b;
  if (random.below(3) > 0) {
    const mpq_class step = small_step(random) * robust::power_of_two(c.exponent);
    window.weight.given += random.below(2) == 0 ? step : -step;
  } else {
    std::size_t v = 0;
    do v = random.below(static_cast<std::uint32_t>(window.strip.corner.size()));
    while (window.strip.corner[v] == c.edge[0] || window.strip.corner[v] == c.edge[1]);
    nudge(window.strip.corner[v], random);
  }
  return c;
}

/// Every statement about ties by the sign of the difference at the places named and at some in between.
class TiesTruth {
 public:
  explicit TiesTruth(const TiedWindows& c) : a_(c.a, c.edge), b_(c.b, c.edge) {}

  /// Positive where a is nearer.
  Sign lead(const Real& t) const {
    const Real a = a_.at(t), b = b_.at(t);
    return sign_of(b - a, abs(a) + abs(b));
  }
  void expect(const EdgeTies& ties, const mpq_class& critical) const {
    if (ties.kind == Kind::everywhere || ties.kind == Kind::none) {
      const Sign all = ties.kind == Kind::everywhere ? Sign::zero : ties.a_is_nearer ? Sign::positive : Sign::negative;
      for (int i = 0; i <= 6; ++i) EXPECT_EQ(lead(Real(i) / 6), all) << i;
      EXPECT_EQ(lead(real(critical)), all);
      return;
    }
    if (ties.kind == Kind::ray) {
      EXPECT_EQ(lead(Real(ties.ties[0].t.upper)), Sign::zero);
      return;
    }
    // Two ties may be nearer to one another than doubles tell: then only what is outside of both is known.
    Real from = 0;
    Sign last = Sign::zero;
    for (std::size_t i = 0; i < ties.ties.size(); ++i) {
      const EdgeTie& tie = ties.ties[i];
      const Sign before = tie.a_before ? Sign::positive : Sign::negative;
      last = tie.is_contact ? before : -before;
      if (i == 0 || ties.ties[i - 1].t.upper < tie.t.lower) {
        EXPECT_NE(lead(Real(tie.t.lower)), -before);
        if (from < tie.t.lower) {
          EXPECT_EQ(lead((from + Real(tie.t.lower)) / 2), before);
        }
      }
      if (i + 1 == ties.ties.size() || tie.t.upper < ties.ties[i + 1].t.lower) {
        EXPECT_NE(lead(Real(tie.t.upper)), -last);
      }
      from = Real(tie.t.upper);
    }
    if (from < 1) {
      EXPECT_EQ(lead((from + 1) / 2), last);
    }
  }

 private:
  EdgeDistances a_, b_;
};

Stage check(const TiedWindows& c, bool is_tie, bool all_rungs) {
  const Window a = c.a.described(), b = c.b.described();
  const EdgeTies ties = ties_on_edge(a, b, c.edge);
  EXPECT_EQ(ties.kind == Kind::undecided, ties.stage == Stage::undecided);
  const auto expect_case = [&](const EdgeTies& said) {
    EXPECT_EQ(said.kind, c.kind);
    if (said.kind != Kind::points && said.kind != Kind::ray) return;
    ASSERT_EQ(said.ties.size(), 1u);
    EXPECT_EQ(said.ties[0].is_contact, c.is_contact);
    EXPECT_LE(mpq_class(said.ties[0].t.lower), c.t);
    EXPECT_GE(mpq_class(said.ties[0].t.upper), c.t);
    EXPECT_LE(said.kind == Kind::ray ? 0 : said.ties[0].t.upper - said.ties[0].t.lower, 0x1p-50);
  };
  if (is_tie && ties.kind != Kind::undecided) expect_case(ties);
  if (!all_rungs) return ties.stage;
  const TiesTruth truth(c);
  if (ties.kind != Kind::undecided) truth.expect(ties, c.t);
  for (const Rung& rung : kRungs) {
    const auto other = ties_on_edge_at(rung, a, b, c.edge);
    if (!other) continue;
    EXPECT_EQ(other->kind, ties.kind);
    EXPECT_EQ(other->ties.size(), ties.ties.size());
    truth.expect(*other, c.t);
  }
  const EdgeTies swapped = ties_on_edge(b, a, c.edge);
  EXPECT_EQ(swapped.kind, ties.kind);
  EXPECT_EQ(swapped.stage, ties.stage);
  EXPECT_EQ(swapped.kind == Kind::none && swapped.a_is_nearer == ties.a_is_nearer, false);
  for (std::size_t i = 0; i < std::min(ties.ties.size(), swapped.ties.size()); ++i) EXPECT_NE(swapped.ties[i].a_before, ties.ties[i].a_before);
  return ties.stage;
}

class TiesOnEdgeZeros : public testing::TestWithParam<TiedWindowsFamily> {};

TEST_P(TiesOnEdgeZeros, AndTheirNeighbours) {
  Random random(500);
  Tally tally;
  const int rounds = zeros_of_a_family(kTiedWindowsFamilies.size());
  for (int round = 0; round < rounds; ++round) {
    const TiedWindows c = GetParam().make(random);
    ++tally.zeros[check(c, true, asks_all_rungs(round))];
    const TiedWindows off = neighbour(c, random);
    ++tally.neighbours[check(off, false, asks_all_rungs(round))];
    if (HasFailure()) FAIL() << "round " << round;
  }
  tally.record();
  if (GetParam().one_class) {
    EXPECT_EQ(tally.zeros[Stage::algebra] + tally.zeros[Stage::identity], rounds);
  }
  for (const Stage stage : {Stage::filter, Stage::double_double, Stage::mpfr}) EXPECT_GT(tally.neighbours[stage], 0);
}

INSTANTIATE_TEST_SUITE_P(Families, TiesOnEdgeZeros, testing::ValuesIn(kTiedWindowsFamilies),
                         [](const auto& family) { return std::string(family.param.name); });

}  // namespace
}  // namespace gvd::predicates
