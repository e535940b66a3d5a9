#include "gvd/predicates/face_strip.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "support/planar_strips.hpp"

namespace gvd::predicates {
namespace {

using robust::MaybeSign;
using robust::Sign;
using robust::Stage;
using test::FoldedStrip;
using test::Random;

Sign sign_of(int s) { return static_cast<Sign>(s); }

// The folded plane is known flat: every rung must say what two-dimensional rational arithmetic says, or nothing.
TEST(RaySide, AgreesWithTheFlatPlaneAtEveryRung) {
  Random random(1);
  std::map<Stage, int> decided;
  int ties = 0;
  for (int round = 0; round < 250; ++round) {
    const FoldedStrip folded = test::random_strip(1 + random.below(12), random);
    const double offset = round % 3 == 0 ? 1e7 : 0;
    const int scale = round % 4 == 0 ? 900 : round % 4 == 1 ? -980 : 0;
    const FaceStrip strip = folded.described(offset, scale, &random);
    const auto vertices = folded.vertices();
    for (int i = 0; i < 8; ++i) {
      const auto pick = [&] {
        const auto v = static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(vertices.size())));
        return v == 2 ? vertices.size() - 1 : v;
      };
      const std::size_t through = pick(), v = pick();
      const Sign truth = sign_of(turn(folded.image, vertices[through], vertices[v]));
      for (const Rung& rung : kRungs) {
        const MaybeSign sign = ray_side_at(rung, strip, through, v);
        EXPECT_EQ(sign.value_or(truth), truth) << "round " << round << ", stage " << static_cast<int>(rung.stage);
        EXPECT_TRUE(sign.has_value() || rung.stage != Stage::algebra);
      }
      const Decision d = ray_side(strip, through, v), swapped = ray_side(strip, v, through);
      EXPECT_EQ(d.sign, truth);
      EXPECT_EQ(swapped.sign, -truth);
      ++decided[d.stage];
      ties += truth == Sign::zero && through != v;
    }
  }
  EXPECT_GT(ties, 30);
  EXPECT_GT(decided[Stage::identity], 0);
  EXPECT_GT(decided[Stage::filter], 1000);
  EXPECT_GT(decided[Stage::algebra], 20);
}

// A step aside of one part in 2^200: only long numbers can tell.
TEST(RaySide, NeighboursOfTiesNeedTheLaterStages) {
  const FaceCorners first{{{0, 0, 0}, {4, 0, 0}, {2, -4, 0}}}, second{{{0, 0, 0}, {4, 0, 0}, {2, 4, 0}}};
  std::map<Stage, int> decided;
  for (int k = 2; k < 900; k += 7) {
    FacePoint source{{1, 1, 2}};  // on the axis of the kite
    source.weight[0] += mpq_class(1, mpz_class(1) << k);
    FaceStrip strip(first, source);
    strip.cross(second);
    strip.cross({{{4, 0, 0}, {2, 4, 0}, {2, 8, 0}}});  // vertices 3 and 4 and the axis are in line
    const Decision d = ray_side(strip, 3, 4);
    EXPECT_EQ(d.sign, Sign::negative) << k;  // the source is left of the axis
    ++decided[d.stage];
  }
  for (const Stage stage : {Stage::filter, Stage::double_double, Stage::mpfr, Stage::algebra}) EXPECT_GT(decided[stage], 0);
}

TEST(RaySide, AStripOfSeveralSquareClassesIsNeverGuessed) {
  // The source, vertices 3 and the middle of the edge lie in the plane x = 2 of symmetry: the ray through 3 goes on to 4 of the second strip.
  const FaceCorners first{{{4, 0, 0}, {0, 0, 0}, {2, -4, 1}}};
  FaceStrip kite(first, {{1, 1, 2}});
  kite.cross({{{0, 0, 0}, {4, 0, 0}, {2, 5, 2}}});
  EXPECT_EQ(ray_side(kite, 3, 1).sign, Sign::positive);
  EXPECT_EQ(ray_side(kite, 3, 0).sign, Sign::negative);
  // From the first face's apex, a corner of the mirror plane: in line with vertex 3, but the classes 17 and 29 are two.
  FaceStrip tie(first, FacePoint::corner(2));
  tie.cross({{{0, 0, 0}, {4, 0, 0}, {2, 5, 2}}});
  tie.cross({{{0, 0, 0}, {2, 5, 2}, {-2, 5, 2}}});
  tie.cross({{{0, 0, 0}, {-2, 5, 2}, {-4, 0, 0}}});
  for (const Rung& rung : kRungs) {
    const MaybeSign sign = ray_side_at(rung, tie, 3, 4);
    EXPECT_EQ(sign.value_or(Sign::positive), Sign::positive);
  }
}

/// What the source sees, by rational arithmetic: the part of the last edge crossed inside the half-planes of all earlier edges.
struct FlatCone {
  bool sees;
  std::array<test::PlanarPoint, 2> bound;
};
FlatCone flat_cone(const FoldedStrip& strip) {
  const auto edge = [&](std::size_t i) { return std::array{strip.faces[i][0].planar(), strip.faces[i][1].planar()}; };
  FlatCone cone{true, edge(1)};
  for (std::size_t i = 2; i < strip.faces.size(); ++i) {
    const auto e = edge(i);
    if (turn(strip.image, cone.bound[0], e[1]) >= 0 || turn(strip.image, cone.bound[1], e[0]) <= 0) return {false, {}};
    if (turn(strip.image, cone.bound[0], e[0]) < 0) cone.bound[0] = e[0];
    if (turn(strip.image, cone.bound[1], e[1]) > 0) cone.bound[1] = e[1];
    if (turn(strip.image, cone.bound[0], cone.bound[1]) >= 0) return {false, {}};
  }
  return cone;
}

TEST(ConeOf, AgreesWithTheFlatPlane) {
  Random random(2);
  int seen = 0, hidden = 0, reset = 0;
  for (int round = 0; round < 1500; ++round) {
    const FoldedStrip folded = test::random_strip(1 + random.below(5), random);
    const ConeDecision cone = cone_of(folded.described(0, 0, &random));
    const FlatCone truth = flat_cone(folded);
    ASSERT_EQ(cone.sight, truth.sees ? ConeDecision::Sight::interval : ConeDecision::Sight::nothing) << round;
    ++(truth.sees ? seen : hidden);
    if (!truth.sees) continue;
    const auto vertices = folded.vertices();
    for (std::size_t end = 0; end < 2; ++end) {
      // Two vertices of one ray bound the same cone.
      EXPECT_EQ(turn(folded.image, vertices[cone.bound[end]], truth.bound[end]), 0) << round;
      reset += cone.bound[end] > 2;
    }
  }
  EXPECT_GT(seen, 300);
  EXPECT_GT(hidden, 100);
  EXPECT_GT(reset, 100);
}

TEST(FaceStrip, RefusesWhatIsNoStrip) {
  const FaceCorners first{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, next{{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  const auto refused = [](const auto& body) {
    try {
      body();
    } catch (const std::invalid_argument&) {
      return true;
    }
    return false;
  };
  const FacePoint centre{{1, 1, 1}};
  EXPECT_TRUE(refused([&] { FaceStrip({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}, centre); }));
  EXPECT_TRUE(refused([&] { FaceStrip({{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}}, centre); }));
  EXPECT_TRUE(refused([&] { FaceStrip({{{0, 0, 0}, {1, 0, 0}, {0, 1, 1 / 0.0}}}, centre); }));
  EXPECT_TRUE(refused([&] { FaceStrip(first, {{1, -1, 1}}); }));
  EXPECT_TRUE(refused([&] { FaceStrip(first, {{0, 0, 0}}); }));
  FaceStrip strip(first, FacePoint::on_side(1, mpq_class(1, 3)));
  EXPECT_TRUE(refused([&] { strip.cross(next); }));                                          // through the source's own edge
  EXPECT_TRUE(refused([&] { strip.cross({{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}}}); }));            // one corner in common
  EXPECT_TRUE(refused([&] { strip.cross(first); }));                                          // all of them
  EXPECT_TRUE(refused([&] { strip.cross({{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}}); }));
  EXPECT_TRUE(refused([&] { cone_of(strip); }));
  EXPECT_EQ(strip.crossings(), 0u);
  FaceStrip on(first, centre);
  on.cross(next);
  EXPECT_TRUE(refused([&] { on.cross(first); }));                                             // back
  EXPECT_TRUE(refused([&] { ray_side(on, 0, 3); }));                                          // not on an edge crossed
  EXPECT_TRUE(refused([&] { ray_side(on, 1, 4); }));
  EXPECT_EQ(on.vertex_count(), 4u);
  const std::vector<SpacePoint> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  FaceStrip indexed(vertices, {0, 1, 2}, centre);
  indexed.cross(vertices, {1, 2, 3});
  EXPECT_TRUE(on == indexed);
  EXPECT_TRUE(refused([&] { indexed.cross(vertices, {1, 3, 4}); }));
}

}  // namespace
}  // namespace gvd::predicates
