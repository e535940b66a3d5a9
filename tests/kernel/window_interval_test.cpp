#include "../../kernel/src/window_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/meshes.hpp"

namespace gvd::test {
namespace {

using kernel::Trim;
using kernel::WindowInterval;

constexpr double kLength = 0.75;

/// A window with errors so large that long double tells the truth.
WindowInterval random_window(Random& random) {
  WindowInterval w{};
  w.image = {random.uniform(-2, 3), -std::ldexp(random.uniform(0.5, 1), static_cast<int>(random.below(12)) - 10)};
  w.weight = random.uniform(0, 2);
  const int small = static_cast<int>(random.below(30)) + 8;
  w.image_error = std::ldexp(random.uniform(), -small);
  w.weight_error = static_cast<float>(std::ldexp(random.uniform(), -small));
  const double a = random.uniform(), b = random.uniform();
  w.begin = random.below(3) == 0 ? 0 : std::min(a, b);
  w.end = random.below(3) == 0 ? 1 : std::max(a, b);
  w.slack.begin = random.below(2) == 0 ? 0 : static_cast<float>(random.uniform() * 0.1);
  w.slack.end = random.below(2) == 0 ? 0 : static_cast<float>(random.uniform() * 0.1);
  return w;
}

/// A true window of which the computed one may come.
struct Truth {
  long double x, y, weight;
  Truth(const WindowInterval& w, Random& random) {
    const double angle = random.uniform(0, 6.28), off = w.image_error / kLength;
    x = static_cast<long double>(w.image.x) + off * std::cos(angle);
    y = static_cast<long double>(w.image.y) + off * std::sin(angle);
    weight = static_cast<long double>(w.weight) + (random.below(2) == 0 ? 1 : -1) * static_cast<double>(w.weight_error);
  }
  long double operator()(double at) const { return weight + kLength * std::sqrt((at - x) * (at - x) + y * y); }
};

/// What `cut` lost of `was` must be seen by `other` and be longer than it, whatever the truth is within the errors.
void expect_loser(const WindowInterval& was, const WindowInterval& cut, bool dropped, const WindowInterval& other, Random& random) {
  for (int i = 0; i <= 64; ++i) {
    const double x = was.begin + (was.end - was.begin) * i / 64;
    if (!dropped && x >= cut.begin && x <= cut.end) continue;
    ASSERT_GE(x, other.begin + other.slack.begin);
    ASSERT_LE(x, other.end - other.slack.end);
    for (int k = 0; k < 4; ++k) ASSERT_LT(Truth(other, random)(x), Truth(was, random)(x)) << "at " << x;
  }
  if (!dropped && cut.begin > was.begin) {
    ASSERT_GE(cut.begin, was.begin + was.slack.begin);
  }
  if (!dropped && cut.end < was.end) {
    ASSERT_LE(cut.end, was.end - was.slack.end);
  }
}

TEST(WindowInterval, OnlyCertainlyLongerPartsAreCutOff) {
  Random random(1);
  int drops = 0, cuts = 0, both = 0;
  for (int i = 0; i < 60000; ++i) {
    WindowInterval first = random_window(random), second = random_window(random);
    if (first.begin > second.begin && random.below(4) != 0) std::swap(first, second);
    if (!(first.begin < first.end && second.begin < second.end)) continue;
    const WindowInterval a = first, b = second;
    const Trim t = kernel::trim(first, second, kLength);
    expect_loser(a, first, t == Trim::drop_first, b, random);
    expect_loser(b, second, t == Trim::drop_second, a, random);
    if (HasFatalFailure()) FAIL() << "pair " << i;
    const bool cut_first = first.end != a.end || first.begin != a.begin, cut_second = second.begin != b.begin || second.end != b.end;
    drops += t != Trim::none;
    cuts += cut_first != cut_second;
    both += cut_first && cut_second;
  }
  EXPECT_GT(drops, 500);
  EXPECT_GT(cuts, 500);
  EXPECT_GT(both, 50);
}

// The second is shorter up to its own end, inside the first: what lies beyond stays with the first.
TEST(WindowInterval, NothingIsCutBeyondTheEndOfTheOther) {
  WindowInterval first{}, second{};
  first.image = {0, -1};
  second.image = {1, -1};
  first.end = 1;
  second.end = 0.75;
  const Trim t = kernel::trim(first, second, kLength);
  EXPECT_EQ(t, Trim::none);
  EXPECT_EQ(first.end, 1);
  EXPECT_GT(second.begin, 0.4);
}

// Each is unseen by the width of its slack where the common stretch begins or ends; the root lies well inside.
TEST(WindowInterval, SlackAtTheOtherEndDoesNotHinder) {
  WindowInterval first{}, second{};
  first.image = {0.25, -1};
  second.image = {0.75, -1};
  first.end = 0.75;
  second.begin = 0.25;
  second.end = 1;
  first.image_error = second.image_error = 1e-15F;
  first.slack.end = second.slack.begin = 1e-12F;
  EXPECT_EQ(kernel::trim(first, second, kLength), Trim::none);
  EXPECT_NEAR(first.end, 0.5, 1e-6);
  EXPECT_NEAR(second.begin, 0.5, 1e-6);
  EXPECT_LE(second.begin, first.end);
}

// A relay's wave touches its parent's along the ray that bounds both: doubles cannot compare them there.
TEST(WindowInterval, ARelayIsCutOffWhereItsParentSees) {
  WindowInterval parent{}, relay{};
  parent.image = {0.25, -2};
  parent.end = 0.625;
  relay.image = {0.4375, -1};
  relay.weight = kLength * std::sqrt(0.1875 * 0.1875 + 1);
  relay.end = 1;
  for (WindowInterval* w : {&parent, &relay}) w->weight_error = w->image_error = 1e-15F;
  for (const bool parent_first : {true, false}) {
    WindowInterval a = parent, b = relay;
    EXPECT_EQ(parent_first ? kernel::trim(a, b, kLength) : kernel::trim(b, a, kLength), Trim::none);
    EXPECT_EQ(a.end, 0.625);
    EXPECT_GT(b.begin, 0.6);
    EXPECT_LT(b.begin, 0.625);
  }
}

}  // namespace
}  // namespace gvd::test
