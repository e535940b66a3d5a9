// Waves in plain doubles against long numbers (docs/error-bounds.md#waves-in-doubles).
#include "gvd/predicates/double_wave.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "gvd/predicates/wave.hpp"

namespace {

using gvd::predicates::Bounded;
using gvd::predicates::DoublePoint;
using gvd::predicates::DoubleWave;
using gvd::robust::Ball;
using gvd::robust::Mpfr;
using F = Ball<double>;
using Long = Ball<Mpfr>;
using LongPoint = gvd::predicates::PlanePoint<Long>;
using gvd::predicates::operator-;

constexpr int kBits = 400;
Long wide(double x) { return gvd::robust::from_double<Long>(x, kBits); }
double nearest(const Long& x) { return x.mid().to_double(); }

class Family {
 public:
  explicit Family(unsigned seed) : random_(seed) {}
  double number() { return std::ldexp(2 * unit_(random_) - 1, static_cast<int>(random_() % 40) - 20); }
  double error() { return std::ldexp(unit_(random_), -static_cast<int>(random_() % 30) - 25); }
  double share() { return 2 * unit_(random_) - 1; }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{0, 1};
};

gvd::predicates::Site<F> random_site(Family& family) {
  gvd::predicates::Site<F> site;
  site.image = {F(family.number(), family.error()), F(family.number(), family.error())};
  site.weight = F(std::fabs(family.number()), family.error());
  return site;
}

/// A member of the site's balls.
struct TrueWave {
  LongPoint image;
  Long weight;
};
TrueWave member(const gvd::predicates::Site<F>& site, Family& family) {
  const auto within = [&](const F& x) { return wide(x.mid()) + wide(family.share()) * wide(x.rad()); };
  return {{within(site.image.x), within(site.image.y)}, within(site.weight)};
}
Long true_distance(const TrueWave& wave, const DoublePoint& p) {
  return wave.weight + sqrt(squared_norm(LongPoint{wide(p.x), wide(p.y)} - wave.image));
}

/// The literal against its derivation: four roundings beside one another, to all orders, and four for those who use it.
TEST(DoubleWave, LiteralFollowsFromItsDerivation) {
  constexpr double u = gvd::predicates::kUnit;
  const Long one = wide(1), d = one + wide(u);
  const Long under_root = d * d * d * d;                       // (difference)^2, square, sum
  const Long relative = sqrt(under_root) * d * d - one;       // root, last sum
  EXPECT_LT(nearest(relative), 4.0001 * u);
  EXPECT_LE(2 * nearest(relative), gvd::predicates::kDoubleWaveError * (1 + 0x1p-20));
}

TEST(DoubleWave, DistanceIsWithinItsBoundOfEveryMember) {
  Family family(1);
  double largest = 0;
  for (int round = 0; round < 20000; ++round) {
    const auto site = random_site(family);
    const DoubleWave wave = gvd::predicates::double_wave(site);
    const DoublePoint p{family.number(), family.number()};
    const double computed = distance(wave, p), bound = distance_error(wave, computed);
    const double off = std::fabs(nearest(true_distance(member(site, family), p) - wide(computed)));
    ASSERT_LE(off, bound) << "round " << round;
    largest = std::max(largest, off / bound);
  }
  EXPECT_GT(largest, 0.3);  // a bound that nothing comes near would hide a test of nothing
}

TEST(DoubleWave, RoundingAloneIsWithinEightUnits) {
  Family family(2);
  for (int round = 0; round < 20000; ++round) {
    const DoubleWave wave{{family.number(), family.number()}, std::fabs(family.number()), 0};
    const DoublePoint p{family.number(), family.number()};
    const TrueWave truth{{wide(wave.image.x), wide(wave.image.y)}, wide(wave.weight)};
    const double computed = distance(wave, p);
    ASSERT_LE(std::fabs(nearest(true_distance(truth, p) - wide(computed))), 0.5 * gvd::predicates::kDoubleWaveError * computed) << "round " << round;
  }
}

TEST(DoubleWave, DifferenceOfTwoWavesHasACertainSignOrNone) {
  Family family(3);
  int certain = 0;
  for (int round = 0; round < 20000; ++round) {
    const auto a = random_site(family);
    auto b = random_site(family);
    if (round % 2 == 0) b = {{a.image.x + F(family.error()), a.image.y}, a.weight, {}, false};  // nearly the same wave
    const DoublePoint p{family.number(), family.number()};
    const DoubleWave wa = gvd::predicates::double_wave(a), wb = gvd::predicates::double_wave(b);
    const Bounded by = difference(wa, distance(wa, p), wb, distance(wb, p));
    const double truth = nearest(true_distance(member(b, family), p) - true_distance(member(a, family), p));
    ASSERT_LE(std::fabs(truth - by.value), by.error * (1 + 0x1p-40)) << "round " << round;
    if (by.positive() || by.negative()) {
      ++certain;
      ASSERT_EQ(truth > 0, by.positive()) << "round " << round;
    }
  }
  EXPECT_GT(certain, 9000);
  EXPECT_LT(certain, 20000);
}

TEST(DoubleWave, CrossProductsAreWithinTheirBounds) {
  Family family(4);
  for (int round = 0; round < 20000; ++round) {
    const DoublePoint a0{family.number(), family.number()}, a1{family.number(), family.number()};
    DoublePoint b1{family.number(), family.number()};
    if (round % 3 == 0) b1 = {a0.x + 3 * (a1.x - a0.x), a0.y + 3 * (a1.y - a0.y)};  // nearly collinear
    const double ea = family.error(), eb = family.error();
    const DoublePoint a{a1.x - a0.x, a1.y - a0.y}, b{b1.x - a0.x, b1.y - a0.y};
    const Bounded product = gvd::predicates::bounded_cross(a, ea, b, eb);
    const auto moved = [&](const DoublePoint& p, const DoublePoint& q, double e) {  // by less than e
      return LongPoint{wide(q.x) - wide(p.x) + wide(0.7 * e * family.share()), wide(q.y) - wide(p.y) + wide(0.7 * e * family.share())};
    };
    const double truth = nearest(cross(moved(a0, a1, ea), moved(a0, b1, eb)) - wide(product.value));
    ASSERT_LE(std::fabs(truth), product.error) << "round " << round;
  }
}

TEST(DoubleWave, ARelayOnItsParentsRayIsNeverCalledUnrelated) {
  Family family(5);
  for (int round = 0; round < 5000; ++round) {
    auto parent = random_site(family), relay = random_site(family);
    parent.image = {F(parent.image.x.mid()), F(parent.image.y.mid())};
    relay.image = {F(relay.image.x.mid()), F(relay.image.y.mid())};
    parent.weight = F(parent.weight.mid());
    relay.weight = gvd::predicates::distance(parent, relay.image);
    EXPECT_FALSE(gvd::predicates::certainly_unrelated(gvd::predicates::double_wave(parent), gvd::predicates::double_wave(relay))) << "round " << round;
    relay.weight = relay.weight * F(1 + 0x1p-30);
    EXPECT_TRUE(gvd::predicates::certainly_unrelated(gvd::predicates::double_wave(parent), gvd::predicates::double_wave(relay)) || relay.weight.mid() < 0x1p-10)
        << "round " << round;
  }
}

}  // namespace
