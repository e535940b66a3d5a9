// Worst cases of the angle sum: fans of exactly 2 pi or pi by construction, and their nearest neighbours.
#include "support/closing_fans.hpp"
#include "support/real.hpp"
#include "support/worst_case_tally.hpp"

namespace gvd::predicates {
namespace {

using robust::MaybeSign;
using robust::Sign;
using robust::Stage;
using namespace gvd::test;

std::vector<ExactCorner> exact(const ClosingFan& fan) {
  std::vector<ExactCorner> corners;
  for (const auto& [d, e] : fan.corners)
    corners.push_back(exact_corner({mpq_class(d[0]), mpq_class(d[1]), mpq_class(d[2])}, {mpq_class(e[0]), mpq_class(e[1]), mpq_class(e[2])}));
  return corners;
}

/// The sum of arc tangents against the turns.
Sign truth(const std::vector<ExactCorner>& corners, int quarter_turns) {
  static const Real quarter = acos(Real(0));
  Real sum = -quarter * quarter_turns;
  for (const ExactCorner& corner : corners) sum += atan2(sqrt(real(corner.cross_square)), real(corner.dot));
  return sign_of(sum, Real(1));
}

/// A coordinate by an ulp or by what doubles see well, or an angle by less.
void move(ClosingFan& fan, std::vector<ExactCorner>& corners, Random& random) {
  const std::uint32_t i = random.below(static_cast<std::uint32_t>(corners.size())), kind = random.below(4);
  if (kind < 2) {
    corners[i].dot += small_step(random);
    fan.corners.clear();
    return;
  }
  Spoke& spoke = fan.corners[i][random.below(2)];
  if (kind == 2)
    nudge(spoke, random);
  else
    spoke[random.below(3)] += 0x1p-10;
  corners = exact(fan);
}

Stage check(const ClosingFan& fan, const std::vector<ExactCorner>& corners, Sign expected, bool all_stages) {
  const int turns = fan.quarter_turns;
  AngleSumFilter filter;
  for (const auto& [d, e] : fan.corners) filter.add(d, e);
  const MaybeSign filtered = fan.corners.empty() ? std::nullopt : filter.compare(turns);
  EXPECT_EQ(filtered.value_or(expected), expected);
  const Decision d = compare_angle_sum(corners, turns);
  EXPECT_EQ(d.sign, expected);
  if (all_stages) {
    EXPECT_EQ(compare_angle_sum(std::vector(corners.rbegin(), corners.rend()), turns).sign, expected);
    EXPECT_EQ(double_double_compare_angle_sum(corners, turns).value_or(expected), expected);
    EXPECT_EQ(exact_compare_angle_sum(corners, turns).value_or(expected), expected);
    EXPECT_EQ(multiprecision_compare_angle_sum(corners, turns, 512).value_or(expected), expected);
  }
  return filtered ? Stage::filter : d.stage;
}

class AngleSumZeros : public testing::TestWithParam<FanFamily> {};

TEST_P(AngleSumZeros, AndTheirNeighbours) {
  Random random(400);
  Tally tally;
  const int rounds = zeros_of_a_family(kFanFamilies.size());
  for (int round = 0; round < rounds; ++round) {
    ClosingFan fan = GetParam().make(random);
    auto corners = exact(fan);
    if (asks_all_rungs(round)) {
      ASSERT_EQ(truth(corners, fan.quarter_turns), Sign::zero) << round;
    }
    ++tally.zeros[check(fan, corners, Sign::zero, asks_all_rungs(round))];
    move(fan, corners, random);
    ++tally.neighbours[check(fan, corners, truth(corners, fan.quarter_turns), asks_all_rungs(round))];
    if (HasFailure()) FAIL() << "round " << round;
  }
  tally.record();
  // Where no root is irrational, double-double may be exact.
  EXPECT_EQ(tally.zeros[Stage::algebra] + tally.zeros[Stage::double_double], rounds);
  EXPECT_GT(tally.zeros[Stage::algebra], rounds * 9 / 10);
  for (const Stage stage : {Stage::filter, Stage::double_double, Stage::algebra}) EXPECT_GT(tally.neighbours[stage], rounds / 50);
  if (GetParam().several_roots) {
    EXPECT_GT(tally.neighbours[Stage::mpfr], 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, AngleSumZeros, testing::ValuesIn(kFanFamilies),
                         [](const auto& family) { return std::string(family.param.name); });

}  // namespace
}  // namespace gvd::predicates
