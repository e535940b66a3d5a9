#include "gvd/predicates/strip_program.hpp"

#include <gtest/gtest.h>

#include "gvd/predicates/root_strip.hpp"
#include "gvd/robust/rational.hpp"
#include "support/random_strip.hpp"

namespace gvd::predicates::test {
namespace {

using gvd::test::Corner;
using gvd::test::loose_strip;
using gvd::test::LooseStrip;
using gvd::test::mirrored;
using gvd::test::turned_round;
using robust::RootSum;
using robust::test::RandomNumbers;

Corner integer_corner(RandomNumbers& random, std::uint64_t range) {
  Corner c;
  for (auto& x : c) x = static_cast<long>(random.below(range));
  return c;
}

Corner double_corner(RandomNumbers& random) {
  Corner c;
  for (auto& x : c) x = mpq_class(random.between(0, 1));
  return c;
}

bool has_area(const LooseStrip& strip) {
  for (const auto& face : strip.faces)
    if (sgn(face.face.radicand) == 0) return false;
  return true;
}

/// The squared length as a sum of roots, by another way: the coordinates of the image.
RootSum squared_length(const LooseStrip& strip) {
  const auto frame = [&](std::uint32_t h) { return root_frame(strip.faces[h / 3].face, h % 3, strip.faces[h / 3].doubled_area); };
  RootUnfolding at = first_unfolding(frame(strip.strip.opposite));
  for (const auto& step : strip.strip.steps) take_step(at, step, frame(step.side));
  const auto last = frame(strip.last);
  const RootSum x = at.image.x - last.u, y = at.image.y - last.y;
  return (x * x + y * y) * strip.faces[strip.last / 3].face.squared[strip.last % 3];
}

bool equal(const LooseStrip& a, const LooseStrip& b) { return are_proved_equal(a.squared_length(), b.squared_length()); }

/// The last bit of the squared side over which the face is entered, as if a corner had moved by next to nothing.
LooseStrip neighbour(LooseStrip strip, std::size_t face) {
  strip.faces[face].face.squared[0] *= 1 + robust::power_of_two(-52);
  return strip;
}

TEST(StripProgram, MirrorImagesAndReturnTripsAreEqualAndTheirNeighboursAreNot) {
  RandomNumbers random(11);
  for (int i = 0; i < 150; ++i) {
    const std::size_t faces = 2 + random.below(i < 140 ? 8 : 40);
    const LooseStrip strip = loose_strip(faces, random, [&] { return double_corner(random); });
    const LooseStrip mirror = mirrored(strip), back = turned_round(strip);
    ASSERT_TRUE(equal(strip, mirror)) << i;
    ASSERT_TRUE(equal(strip, back)) << i;
    ASSERT_TRUE(equal(mirror, back)) << i;
    ASSERT_FALSE(equal(strip, neighbour(mirror, random.below(faces)))) << i;
    ASSERT_FALSE(equal(neighbour(back, random.below(faces)), strip)) << i;
  }
}

/// Strips of up to 4 faces with small whole coordinates: equal lengths, equal, coplanar and dependent classes (2 x 3 = 6) abound.
TEST(StripProgram, AgreesWithSumsOfRoots) {
  RandomNumbers random(12);
  int zeros = 0, missed = 0, cases = 0;
  for (std::uint64_t seed = 0; cases < 10000; ++seed) {
    const std::uint64_t range = 2 + random.below(2);
    std::vector<LooseStrip> strips;
    for (int i = 0; i < 3; ++i) {
      const LooseStrip strip = loose_strip(2 + random.below(3), random, [&] { return integer_corner(random, range); });
      if (!has_area(strip)) continue;
      strips.push_back(strip);
      strips.push_back(random.chance(50) ? mirrored(strip) : turned_round(strip));
    }
    for (std::size_t i = 0; i < strips.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        ++cases;
        const bool zero = (squared_length(strips[i]) - squared_length(strips[j])).is_zero(), proved = equal(strips[i], strips[j]);
        ASSERT_FALSE(proved && !zero) << seed << ", " << i << ", " << j;
        zeros += zero;
        missed += zero && !proved;
      }
  }
  EXPECT_GT(zeros, 2000);
  EXPECT_EQ(missed, 0);
}

TEST(StripProgram, CoordinatesOfMirrorImagesAreMirrored) {
  RandomNumbers random(13);
  for (int i = 0; i < 100; ++i) {
    const LooseStrip strip = loose_strip(2 + random.below(8), random, [&] { return double_corner(random); });
    const StripProgram a = strip.program(), b = mirrored(strip).program();  // z and 1 - conj z
    ASSERT_TRUE(are_proved_equal(a.value({0, -1, 0, 1}), b.value({0, 1, 0, 0})));
    ASSERT_TRUE(are_proved_equal(a.value({0, 0, 1, 0}), b.value({0, 0, 1, 0})));
    ASSERT_FALSE(are_proved_equal(a.value({0, 1, 0, 0}), b.value({0, 1, 0, 0})));
  }
}

TEST(StripProgram, TwoHundredFaces) {
  RandomNumbers random(14);
  const LooseStrip strip = loose_strip(200, random, [&] { return double_corner(random); });
  EXPECT_TRUE(equal(strip, mirrored(strip)));
  EXPECT_TRUE(equal(strip, turned_round(strip)));
  EXPECT_FALSE(equal(strip, neighbour(turned_round(strip), 100)));
}

}  // namespace
}  // namespace gvd::predicates::test
