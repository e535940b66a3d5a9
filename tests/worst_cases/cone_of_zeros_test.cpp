// Worst cases of what a strip lets through: vertices that bound the view in line with the source by construction, and their nearest neighbours.
#include "support/in_line.hpp"
#include "support/worst_case_tally.hpp"

namespace gvd::predicates {
namespace {

using robust::Sign;
using robust::Stage;
using namespace gvd::test;
using Sight = ConeDecision::Sight;

/// The view through all edges at once: between the rightmost of their left ends and the leftmost of their right ends, the first of each where several
/// are in line. Empty if that is a ray or less.
std::optional<std::array<std::size_t, 2>> truth(const LaidOut& strip) {
  const auto flat = strip.flat<Real>();
  const auto image = strip.image(flat);
  const auto turn = [&](std::size_t from, std::size_t to) {
    const auto a = flat[from] - image, b = flat[to] - image;
    return sign_of(cross(a, b), (abs(a.x) + abs(a.y)) * (abs(b.x) + abs(b.y)));
  };
  auto [right, left] = strip.edge[0];
  for (const auto& [r, l] : strip.edge) {
    if (turn(left, l) == Sign::negative) left = l;
    if (turn(right, r) == Sign::positive) right = r;
  }
  if (turn(right, left) != Sign::positive) return std::nullopt;
  return std::array{left, right};
}

Stage check(const LaidOut& strip, const std::optional<std::array<std::size_t, 2>>& expected) {
  const ConeDecision cone = cone_of(strip.strip());
  EXPECT_EQ(cone.sight == Sight::undecided, cone.stage == Stage::undecided);
  if (cone.sight == Sight::undecided) return cone.stage;
  EXPECT_EQ(cone.sight, expected ? Sight::interval : Sight::nothing);
  if (expected && cone.sight == Sight::interval) {
    EXPECT_EQ(cone.bound, *expected);
  }
  return cone.stage;
}

class ConeOfZeros : public testing::TestWithParam<BandFamily> {};

TEST_P(ConeOfZeros, AndTheirNeighbours) {
  Random random(700);
  Tally tally;
  // Where others bound the view, it does not matter that two are in line: such a strip is no case.
  const int rounds = zeros_of_a_family(kBandFamilies.size());
  int nothing = 0;
  for (int round = 0; tally.zeros[Stage::algebra] < rounds; ++round) {
    ASSERT_LT(round, 4 * rounds);
    const InLine c = in_line(GetParam(), random);
    ++tally.zeros[check(c.extended(), truth(c.extended()))];
    if (round % 4 == 0) {
      const LaidOut off = neighbour(c, random).extended();
      const auto expected = truth(off);
      nothing += !expected;
      const Stage stage = check(off, expected);
      EXPECT_NE(stage, Stage::undecided);
      ++tally.neighbours[stage];
    }
    if (HasFailure()) FAIL() << "round " << round;
  }
  tally.record();
  EXPECT_EQ(tally.zeros[Stage::undecided], 0);
  for (const Stage stage : {Stage::filter, Stage::double_double, Stage::mpfr}) EXPECT_GT(tally.neighbours[stage], rounds / 200);
  EXPECT_GT(nothing, rounds / 40);
  EXPECT_LT(nothing, Tally::all(tally.neighbours) - rounds / 40);
}

INSTANTIATE_TEST_SUITE_P(Families, ConeOfZeros, testing::ValuesIn(kBandFamilies), [](const auto& family) { return std::string(family.param.name); });

}  // namespace
}  // namespace gvd::predicates
