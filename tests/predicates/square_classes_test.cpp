// The linkable predicates on strips whose faces are of several square classes. What is equal is so by symmetry or construction.
#include <gtest/gtest.h>

#include <map>

#include "gvd/predicates/strip_window.hpp"
#include "gvd/robust/rational.hpp"
#include "gvd/robust/square_classes.hpp"
#include "support/space_strips.hpp"

namespace gvd::predicates {
namespace {

using robust::MaybeSign;
using robust::Sign;
using robust::Stage;
using test::double_corner;
using test::integer_corner;
using test::Random;
using test::space_strip;
using test::SpaceStrip;

mpq_class exact(double x) { return robust::exact_rational(x); }

mpq_class dot(const SpacePoint& a, const SpacePoint& b) { return exact(a[0]) * exact(b[0]) + exact(a[1]) * exact(b[1]) + exact(a[2]) * exact(b[2]); }
SpacePoint minus(const SpacePoint& a, const SpacePoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
SpacePoint cross(const SpacePoint& a, const SpacePoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Four times the squared area. Pre: small whole coordinates.
mpq_class radicand(const FaceCorners& face) {
  const SpacePoint normal = cross(minus(face[1], face[0]), minus(face[2], face[0]));
  return dot(normal, normal);
}
std::size_t class_count(const SpaceStrip& strip) {
  robust::SquareClasses classes;
  std::uint32_t most = 0;
  for (const auto& face : strip.faces) most = std::max(most, classes(radicand(face)));
  return most + 1;
}

FacePoint some_end(Random& random) {
  return random.below(2) == 0 ? FacePoint::corner(2) : FacePoint{{1 + random.below(3), random.below(3), 1 + random.below(3)}};
}

/// Proved equal, and neighbours of any distance told apart, by algebra alone where precision cannot.
void expect_equal(const Path& a, const Path& b, const std::string& what) {
  SCOPED_TRACE(what);
  const Decision tie = compare_lengths(a, b);
  ASSERT_EQ(tie.sign, Sign::zero);
  ASSERT_EQ(tie.stage, Stage::algebra);
  for (const int bits : {40, 52, 200, 300, 2000}) {
    Path longer = a;
    longer.given += robust::power_of_two(-bits);
    const Decision d = compare_lengths(longer, b);
    ASSERT_EQ(d.sign, Sign::positive) << bits;
    ASSERT_EQ(compare_lengths(b, longer).sign, Sign::negative) << bits;
    ASSERT_EQ(d.stage == Stage::algebra, bits > 256) << bits;
    for (const Rung& rung : kRungs) ASSERT_EQ(compare_lengths_at(rung, longer, b).value_or(Sign::positive), Sign::positive) << bits;
  }
}

TEST(SquareClasses, LegsThroughFewClassesAreComparedAsSumsOfRoots) {
  Random random(31);
  std::map<std::size_t, int> of_classes;
  for (int round = 0; round < 60; ++round) {
    const SpaceStrip strip = space_strip(1 + random.below(3), random, [&] { return integer_corner(random, 3); });
    const FacePoint end = some_end(random);
    const std::string what = "round " + std::to_string(round);
    expect_equal({0, {strip.leg_to(end)}}, {0, {strip.back_from(end)}}, what);
    expect_equal({0, {strip.leg_to(end)}}, {0, {strip.mirrored().leg_to(end)}}, what);
    if (HasFatalFailure()) return;
    // Twice as long as another that is half as large: no leg of one is a leg of the other.
    const Leg doubled = strip.stretched({2, 2, 2}).leg_to(end), back = strip.back_from(end);
    ASSERT_EQ(compare_lengths({0, {doubled}}, {0, {back, back}}).sign, Sign::zero) << round;
    ++of_classes[class_count(strip)];
  }
  for (const std::size_t classes : {1u, 2u, 3u}) EXPECT_GT(of_classes[classes], 3) << classes;
}

TEST(SquareClasses, LegsThroughManyAreComparedByTheSpanTest) {
  Random random(32);
  for (int round = 0; round < 12; ++round) {
    const SpaceStrip strip = space_strip(8 + 2 * static_cast<std::size_t>(round), random, [&] { return double_corner(random); });
    const FacePoint end = some_end(random);
    const Leg there = strip.leg_to(end), back = strip.back_from(end), mirror = strip.mirrored().leg_to(end);
    const std::string what = "round " + std::to_string(round);
    expect_equal({0, {there}}, {0, {back}}, what);
    expect_equal({0, {mirror, there}}, {0, {back, there}}, what);
    if (HasFatalFailure()) return;
    ASSERT_EQ(exact_length({0, {there}}), std::nullopt);
    // Equal, but not leg by leg: too many roots for a proof, and never guessed.
    const Leg doubled = strip.stretched({2, 2, 2}).leg_to(end);
    const Decision open = compare_lengths({0, {doubled}}, {0, {back, back}});
    ASSERT_EQ(open.sign, std::nullopt);
    ASSERT_EQ(open.stage, Stage::undecided);
    ASSERT_EQ(compare_lengths({robust::power_of_two(-900), {doubled}}, {0, {back, back}}).sign, Sign::positive);
    // One corner moved by an ulp.
    SpaceStrip moved = strip;
    double& x = moved.faces.back()[2][round % 3];
    x = std::nextafter(x, 9);
    const Decision near = compare_lengths({0, {moved.leg_to(end)}}, {0, {back}});
    ASSERT_NE(near.sign.value_or(Sign::zero), Sign::zero);
    ASSERT_EQ(compare_lengths_at({Stage::algebra}, {0, {moved.leg_to(end)}}, {0, {back}}), std::nullopt);
  }
}

/// Rounding needs no equal leg: a length of several classes half a unit in the last place above a double.
TEST(SquareClasses, MidpointsAreRoundedToEven) {
  Random random(33);
  for (int round = 0; round < 20; ++round) {
    const SpaceStrip strip = space_strip(2, random, [&] { return integer_corner(random, 4); });
    const FacePoint end = some_end(random);
    const auto length = exact_length({0, {strip.leg_to(end)}});
    ASSERT_TRUE(length.has_value());
    const RoundedLength rounded = rounded_length({0, {strip.leg_to(end)}});
    ASSERT_EQ(rounded.value, robust::rounded(*length));
    // The other side of the midpoint, by less than MPFR can see.
    const mpq_class middle = exact(*rounded.value) + robust::power_of_two(std::ilogb(*rounded.value) - 53);
    const auto bounds = length->bounds(400);
    ASSERT_TRUE(bounds.has_value());
    const RoundedLength up = rounded_length({mpq_class(middle - bounds->first), {strip.leg_to(end)}});
    const RoundedLength down = rounded_length({mpq_class(middle - bounds->second), {strip.leg_to(end)}});
    if (bounds->first == bounds->second) continue;
    ASSERT_EQ(down.value, *rounded.value) << round;
    ASSERT_EQ(up.value, std::nextafter(*rounded.value, HUGE_VAL)) << round;
    ASSERT_EQ(up.stage, Stage::algebra);
  }
}

/// Two angles at the origin that add up to a right one: from a over b to c, not coplanar, of one square class.
struct RightTurn {
  SpacePoint a, b, c;
};
std::vector<RightTurn> right_turns() {
  std::vector<SpacePoint> list;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = 0; z <= 2; ++z) list.push_back({double(x), double(y), double(z)});
  std::vector<RightTurn> turns;
  for (const auto& a : list)
    for (const auto& b : list)
      for (const auto& c : list) {
        const mpq_class ab = dot(a, b), bc = dot(b, c), n = radicand({{{0, 0, 0}, a, b}}), m = radicand({{{0, 0, 0}, b, c}});
        if (sgn(ab) <= 0 || sgn(bc) <= 0 || sgn(n) == 0 || sgn(m) == 0) continue;
        if (ab * ab * bc * bc == n * m && !robust::is_square(n)) turns.push_back({a, b, c});
      }
  return turns;
}

TEST(SquareClasses, TwoPairsOfAnglesMakeAStraightLine) {
  const std::vector<RightTurn> turns = right_turns();
  std::map<Stage, int> decided;
  int ties = 0;
  Random random(34);
  for (int tries = 0; ties < 60 && tries < 200000; ++tries) {
    const auto pick = [&] { return turns[random.below(static_cast<std::uint32_t>(turns.size()))]; };
    const RightTurn first = pick(), second = pick();
    if (first.c != second.a) continue;
    const SpacePoint origin{0, 0, 0};
    const FaceCorners faces[] = {{first.a, origin, first.b}, {first.b, origin, first.c}, {second.a, origin, second.b}, {second.b, origin, second.c}};
    robust::SquareClasses classes;
    if (classes(radicand(faces[0])) == classes(radicand(faces[2]))) continue;
    // Seen from a, on and on to the left round the origin, which is vertex 1; c is in line with it and the source.
    const auto turn_to = [&](const SpacePoint& last) {
      FaceStrip strip(faces[0], FacePoint::corner(0));
      strip.cross(faces[1]);
      strip.cross(faces[2]);
      strip.cross({second.b, origin, last});
      return ray_side(strip, 1, strip.vertex_count() - 1);
    };
    const Decision tie = turn_to(second.c);
    ASSERT_EQ(tie.sign, Sign::zero);
    ASSERT_EQ(tie.stage, Stage::algebra);
    ++ties;
    // An ulp aside: beyond the line iff the last angle has grown (not if that is along the edge itself).
    const auto squared_cosine = [&](const SpacePoint& c) { return mpq_class(dot(second.b, c) * dot(second.b, c) / dot(c, c)); };
    const Sign side = *turn_to({second.c[0] - second.b[0] / 8, second.c[1] - second.b[1] / 8, second.c[2] - second.b[2] / 8}).sign;  // beyond
    for (std::size_t i = 0; i < 3; ++i) {
      SpacePoint aside = second.c;
      aside[i] = aside[i] == 0 ? 0x1p-300 : std::nextafter(aside[i], 9);
      const int change = sgn(squared_cosine(second.c) - squared_cosine(aside));
      const Decision d = turn_to(aside);
      ASSERT_EQ(d.sign, static_cast<Sign>(change * static_cast<int>(side)));
      ++decided[d.stage];
    }
  }
  EXPECT_EQ(ties, 60);
  EXPECT_GT(decided[Stage::double_double] + decided[Stage::filter], 20);
}

/// A strip that ends in a face over the edge from (0, 0, 0) to (0, 8, 0), x >= 0.
SpaceStrip strip_at_edge(std::size_t crossings, Random& random) {
  const auto corner = [&]() -> SpacePoint { return {1.0 + random.below(6), double(random.below(8)), double(random.below(6))}; };
  SpaceStrip outward;
  outward.faces.push_back(test::face_beyond({{{0, 8, 0}, {0, 0, 0}, {}}}, 0, corner));
  while (outward.faces.size() <= crossings) {
    const FaceCorners& last = outward.faces.back();
    const std::size_t side = 1 + random.below(2);
    outward.faces.push_back(test::face_beyond(last, side, corner));
  }
  SpaceStrip strip;
  strip.faces.assign(outward.faces.rbegin(), outward.faces.rend());
  strip.source = FacePoint::corner(2);
  return strip;
}

TEST(SquareClasses, MirrorImagesTieAlongAnEdge) {
  Random random(35);
  const std::array<SpacePoint, 2> edge{SpacePoint{0, 0, 0}, SpacePoint{0, 8, 0}};
  std::map<std::size_t, int> of_classes;
  for (int round = 0; round < 40; ++round) {
    const SpaceStrip strip = strip_at_edge(1 + random.below(3), random);
    const Window a{strip.described(), {}, std::nullopt};
    Window b{strip.stretched({-1, 1, 1}).described(), {}, std::nullopt};
    const EdgeTies all = ties_on_edge(a, b, edge);
    ASSERT_EQ(all.kind, EdgeTies::Kind::everywhere) << round;
    ASSERT_EQ(all.stage, Stage::algebra);
    for (const int bits : {52, 150, 700}) {
      b.weight.given = robust::power_of_two(-bits);
      const EdgeTies later = ties_on_edge(a, b, edge);
      ASSERT_EQ(later.kind, EdgeTies::Kind::none);
      ASSERT_TRUE(later.a_is_nearer);
    }
    ++of_classes[class_count(strip)];
  }
  EXPECT_GT(of_classes[2], 3);
  EXPECT_GT(of_classes[3], 3);
}

// Through many classes, by the span test: an image seen from either side of an edge, or by a strip and its mirror image. The weights, too, are
// equal by proof only.
TEST(SquareClasses, ImagesThroughManyClassesTieAlongAnEdge) {
  Random random(39);
  const auto corner = [&] { return double_corner(random); };
  for (int round = 0; round < 6; ++round) {
    const SpaceStrip strip = space_strip(9, random, corner), way = space_strip(9, random, corner);
    const FacePoint end = FacePoint::corner(2);
    const Window a{strip.described(), {0, {way.leg_to(end)}}, std::nullopt};
    const Path weight{0, {way.back_from(end)}};
    const Window mirrored{strip.mirrored().described(), weight, std::nullopt};
    const auto& last = strip.faces.back();
    for (std::size_t k = 0; k < 3; ++k) {
      const EdgeTies all = ties_on_edge(a, mirrored, {last[k], last[(k + 1) % 3]});
      ASSERT_EQ(all.kind, EdgeTies::Kind::everywhere) << round << " " << k;
      ASSERT_EQ(all.stage, Stage::algebra);
    }
    SpaceStrip shorter = strip;
    shorter.faces.pop_back();
    Window before{shorter.described(), weight, std::nullopt};
    ASSERT_EQ(ties_on_edge(a, before, {last[0], last[1]}).kind, EdgeTies::Kind::everywhere) << round;
    ASSERT_EQ(ties_on_edge(before, a, {last[1], last[0]}).kind, EdgeTies::Kind::everywhere) << round;
    before.weight.given = robust::power_of_two(-300);
    ASSERT_TRUE(ties_on_edge(a, before, {last[0], last[1]}).a_is_nearer) << round;
    // A corner on the way moved by an ulp: another image, and no proof.
    SpaceStrip moved = strip;
    moved.faces[0][2][0] = std::nextafter(moved.faces[0][2][0], 9);
    const Window other{moved.described(), weight, std::nullopt};
    ASSERT_NE(ties_on_edge(a, other, {last[0], last[1]}).kind, EdgeTies::Kind::everywhere) << round;
  }
}

// Mirror images in the middle of an edge are as far off it, but not over the same place.
TEST(SquareClasses, ImagesMirroredInTheMiddleOfAnEdgeTieThereOnly) {
  Random random(40);
  const std::array<SpacePoint, 2> edge{SpacePoint{0, 0, 0}, SpacePoint{0, 8, 0}};
  int too_many_classes = 0;
  for (int round = 0; round < 12; ++round) {
    const SpaceStrip strip = strip_at_edge(8, random);
    SpaceStrip turned = strip.stretched({1, -1, 1});
    for (auto& face : turned.faces)
      for (SpacePoint& p : face) p[1] += 8;
    const Window a{strip.described(), {}, std::nullopt}, b{turned.described(), {}, std::nullopt};
    const auto by_algebra = ties_on_edge_at({Stage::algebra}, a, b, edge);
    too_many_classes += !by_algebra;
    ASSERT_EQ(by_algebra ? by_algebra->kind : EdgeTies::Kind::points, EdgeTies::Kind::points) << round;
    const EdgeTies ties = ties_on_edge(a, b, edge);
    ASSERT_EQ(ties.kind, EdgeTies::Kind::points) << round;
    ASSERT_EQ(ties.ties.size(), 1u) << round;
    ASSERT_LE(ties.ties[0].t.lower, 0.5) << round;
    ASSERT_GE(ties.ties[0].t.upper, 0.5) << round;
  }
  EXPECT_GT(too_many_classes, 3);
}

// Each starts later by the other's way to the first end of the edge: so they tie there.
TEST(SquareClasses, WeightsOfSeveralClassesTieAtAVertex) {
  Random random(36);
  const std::array<SpacePoint, 2> edge{SpacePoint{0, 0, 0}, SpacePoint{0, 8, 0}};
  int tied = 0;
  for (int round = 0; round < 12; ++round) {
    const SpaceStrip first = strip_at_edge(1, random), second = strip_at_edge(1, random).stretched({-1, 1, 1});
    const auto to_end = [&](const SpaceStrip& strip) {
      const auto& face = strip.faces.back();
      return strip.leg_to(FacePoint::corner(static_cast<std::size_t>(std::find(face.begin(), face.end(), edge[0]) - face.begin())));
    };
    Window a{first.described(), {0, {to_end(second)}}, std::nullopt}, b{second.described(), {0, {to_end(first)}}, std::nullopt};
    const auto at_end = [&] { return compare_lengths({a.weight.given, {to_end(first), to_end(second)}}, {0, {to_end(first), to_end(second)}}); };
    ASSERT_EQ(at_end().sign, Sign::zero);
    const EdgeTies ties = ties_on_edge(a, b, edge);
    ASSERT_NE(ties.kind, EdgeTies::Kind::undecided) << round;
    if (ties.kind == EdgeTies::Kind::none) continue;  // symmetric waves
    ASSERT_EQ(ties.kind, EdgeTies::Kind::points) << round;
    ASSERT_EQ(ties.ties[0].t.lower, 0) << round;
    ASSERT_EQ(ties.ties[0].t.upper, 0) << round;
    ASSERT_EQ(ties.stage, Stage::algebra);
    ++tied;
    // With the later one still later the tie moves off the end, one way or the other.
    a.weight.given = robust::power_of_two(-400);
    const EdgeTies off = ties_on_edge(a, b, edge);
    ASSERT_TRUE(off.ties.empty() || off.ties[0].t.upper > 0 || off.ties.size() < ties.ties.size()) << round;
  }
  EXPECT_GT(tied, 8);
}

// Four images that are corners of a symmetric trapezium lie on a circle, through strips of up to three classes.
TEST(SquareClasses, ConflictsOfSymmetricWindowsAreTies) {
  const FaceCorners facet{{{-3, 0, 0}, {3, 0, 0}, {0, 6, 2}}};
  Random random(37);
  int found = 0;
  for (int round = 0; round < 400 && found < 20; ++round) {
    const auto corner = [&]() -> SpacePoint { return {1.0 + random.below(9), double(random.below(9)) - 4, double(random.below(9)) - 4}; };
    const auto over = [&](const FaceCorners& face) {
      SpaceStrip strip{{face, facet}, FacePoint::corner(2)};
      return Window{strip.described(), {}, std::nullopt};
    };
    const SpacePoint d = corner(), e = corner();
    const auto mirror = [](const SpacePoint& p) { return SpacePoint{-p[0], p[1], p[2]}; };
    const FaceCorners right{{facet[2], facet[1], d}}, left{{facet[0], facet[2], mirror(d)}};
    const FaceCorners below{{facet[1], facet[0], e}}, below_left{{facet[1], facet[0], mirror(e)}};
    if (!test::has_area(right) || !test::has_area(below)) continue;
    const Window r = over(right), l = over(left), br = over(below), bl = over(below_left);
    const ConflictDecision tie = conflict(facet, {&r, &l, &bl}, br);
    ASSERT_TRUE(tie.verdict.has_value()) << round;
    if (*tie.verdict == Conflict::no_vertex) continue;
    ASSERT_EQ(*tie.verdict, Conflict::ties) << round;
    ASSERT_EQ(tie.stage, Stage::algebra);
    ++found;
    for (const int bits : {52, 200, 600}) {
      Window later = br;
      later.weight.given = robust::power_of_two(-bits);
      ASSERT_EQ(conflict(facet, {&r, &l, &bl}, later).verdict, Conflict::farther) << bits;
      later.weight.given *= -1;
      ASSERT_EQ(conflict(facet, {&r, &l, &bl}, later).verdict, Conflict::nearer) << bits;
    }
  }
  EXPECT_EQ(found, 20);
}

/// Through three right angles at the origin, from u over c, d to w: the radicands u c, c d, d w (squared lengths) are of other classes for another
/// c, but their product is u w times a square.
std::array<SpacePoint, 4> right_angles(const SpacePoint& u, const SpacePoint& w, Random& random) {
  for (;;) {
    const SpacePoint c = cross(u, integer_corner(random, 4)), d = cross(c, w);
    if (dot(c, c) != 0 && dot(d, d) != 0) return {u, c, d, w};
  }
}

TEST(SquareClasses, DependentClassesAreProvedEqual) {
  Random random(38);
  for (int round = 0; round < 12; ++round) {
    const auto corner = [&] { return integer_corner(random, 100); };
    SpaceStrip first = space_strip(1, random, corner), second = first;
    int detours = 0;
    const SpacePoint origin{0, 0, 0};
    // Common faces to a vertex at the origin, a detour of their own there, and so on.
    SpacePoint u = corner();
    for (auto* strip : {&first, &second}) {
      const auto last = strip->faces.back();
      strip->faces.push_back({last[0], last[2], origin});
      strip->faces.push_back({last[2], origin, u});
    }
    if (!test::has_area(first.faces[2]) || !test::has_area(first.faces[3])) continue;
    while (detours < 1 + round % 3) {
      const SpacePoint w = corner(), common = corner();
      if (!test::has_area({{origin, w, common}}) || dot(u, u) == 0) continue;
      for (auto* strip : {&first, &second}) {
        const auto way = right_angles(u, w, random);
        for (std::size_t i = 0; i < 3; ++i) strip->faces.push_back({way[i], origin, way[i + 1]});
        strip->faces.push_back({w, origin, common});
      }
      u = common;
      ++detours;
    }
    ASSERT_TRUE(first.faces != second.faces);
    const FacePoint end = some_end(random);
    const Path a{0, {first.leg_to(end)}}, b{0, {second.leg_to(end)}}, back{0, {second.back_from(end)}};
    const std::string what = "round " + std::to_string(round);
    expect_equal(a, b, what);
    expect_equal(a, back, what);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace gvd::predicates
