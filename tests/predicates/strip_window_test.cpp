#include "gvd/predicates/strip_window.hpp"

#include <gtest/gtest.h>

#include <map>

#include "gvd/robust/rational.hpp"
#include "support/planar_strips.hpp"

namespace gvd::predicates {
namespace {

using robust::RootSum;
using robust::Sign;
using robust::Stage;
using test::FoldedFace;
using test::FoldedPoint;
using test::FoldedStrip;
using test::PlanarPoint;
using test::Random;

/// A window on an edge of the folded plane, and where its image is.
struct KnownWindow {
  Window window;
  PlanarPoint image;
  RootSum weight;
};

/// Faces from the one on the right of p -> q outwards, turned round: a strip that comes in over p -> q, `crossings` faces away.
FoldedStrip inward_strip(const FoldedPoint& p, const FoldedPoint& q, std::size_t crossings, Random& random) {
  std::vector<FoldedFace> outward{test::face_beyond(p, q, random)};
  while (outward.size() < crossings) {
    const FoldedFace& last = outward.back();
    const std::size_t side = 1 + random.below(2);
    outward.push_back(test::face_beyond(last[side], last[(side + 1) % 3], random));
  }
  FoldedStrip strip;
  strip.faces.assign(outward.rbegin(), outward.rend());
  strip.source.weight = test::random_weights(random);  // off the side by which the strip leaves
  strip.image = test::planar_point(strip.faces[0], strip.source.weight);
  return strip;
}

void give_weight(KnownWindow& w, const mpq_class& weight) {
  w.window.weight.given = weight;
  w.weight = RootSum(weight);
}

/// A window that comes in over p -> q into `facet`.
KnownWindow known_window(const FoldedPoint& p, const FoldedPoint& q, const FoldedFace& facet, Random& random) {
  FoldedStrip strip = inward_strip(p, q, 1 + random.below(4), random);
  strip.faces.push_back(facet);
  return {{strip.described(0, 0, &random), {}, std::nullopt}, strip.image, RootSum()};
}

/// second(x) - first(x) at p + t (q - p), exactly.
RootSum lead(const KnownWindow& a, const KnownWindow& b, const PlanarPoint& p, const PlanarPoint& q, const mpq_class& t) {
  const PlanarPoint x{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
  return b.weight + RootSum(1, test::squared_distance(b.image, x)) - a.weight - RootSum(1, test::squared_distance(a.image, x));
}

struct Scene {
  FoldedPoint p, q;
  FoldedFace left, right;  ///< of the edge
};
Scene random_scene(Random& random) {
  const FoldedPoint p{0, static_cast<int>(random.below(5))}, q{static_cast<int>(random.below(2)), p.y + 1 + static_cast<int>(random.below(9))};
  return {p, q, test::face_beyond(q, p, random), test::face_beyond(p, q, random)};
}
/// From either side of the edge, or over another side of the face on its left.
KnownWindow random_window(const Scene& scene, Random& random) {
  switch (random.below(3)) {
    case 0: return known_window(scene.p, scene.q, scene.left, random);
    case 1: return known_window(scene.q, scene.p, scene.right, random);
    default: {
      const std::size_t side = 1 + random.below(2);
      return known_window(scene.left[side], scene.left[(side + 1) % 3], scene.left, random);
    }
  }
}

/// Every statement about the ties is checked by exact signs at rational points round them.
void expect_true(const EdgeTies& ties, const KnownWindow& a, const KnownWindow& b, const PlanarPoint& p, const PlanarPoint& q) {
  const auto sign = [&](const mpq_class& t) { return lead(a, b, p, q, t).sign(); };
  if (ties.kind == EdgeTies::Kind::none || ties.kind == EdgeTies::Kind::everywhere) {
    const Sign all = ties.kind == EdgeTies::Kind::everywhere ? Sign::zero : ties.a_is_nearer ? Sign::positive : Sign::negative;
    for (int i = 0; i <= 16; ++i) {
      ASSERT_EQ(sign(mpq_class(i, 16)), all);
    }
  } else {
    ASSERT_EQ(ties.kind, EdgeTies::Kind::points);
    mpq_class from = 0;
    for (std::size_t i = 0; i < ties.ties.size(); ++i) {
      const EdgeTie& tie = ties.ties[i];
      ASSERT_FALSE(tie.is_contact);
      const Sign before = tie.a_before ? Sign::positive : Sign::negative;
      const mpq_class lower = robust::exact_rational(tie.t.lower), upper = robust::exact_rational(tie.t.upper);
      ASSERT_NE(sign(lower), -before);
      ASSERT_NE(sign(upper), before);
      for (int n = 1; n < 8 && from < lower; ++n) {
        ASSERT_EQ(sign(from + (lower - from) * n / 8), before) << i << " " << n;
      }
      from = upper;
      if (i > 0) {
        ASSERT_NE(ties.ties[i - 1].a_before, tie.a_before);
      }
    }
    const Sign after = ties.ties.back().a_before ? Sign::negative : Sign::positive;
    for (int n = 1; n < 8 && from < 1; ++n) {
      ASSERT_EQ(sign(from + (1 - from) * n / 8), after);
    }
  }
}

TEST(TiesOnEdge, AreTheSignChangesOfTheDifference) {
  Random random(6);
  std::map<Stage, int> decided;
  std::map<std::size_t, int> count;
  int at_ends = 0;
  for (int round = 0; round < 500; ++round) {
    const Scene scene = random_scene(random);
    KnownWindow a = random_window(scene, random), b = random_window(scene, random);
    if (round % 2 == 0) {
      // Tie near some point of the edge.
      const mpq_class t = mpq_class(static_cast<int>(random.below(9)), 8);
      const double d = lead(a, b, scene.p.planar(), scene.q.planar(), t).rounded();
      give_weight(d > 0 ? a : b, mpq_class(std::fabs(d)));
    }
    const std::array<SpacePoint, 2> edge{scene.p.in_space(), scene.q.in_space()};
    const EdgeTies ties = ties_on_edge(a.window, b.window, edge);
    ASSERT_NE(ties.kind, EdgeTies::Kind::undecided) << round;
    expect_true(ties, a, b, scene.p.planar(), scene.q.planar());
    if (HasFatalFailure()) FAIL() << "round " << round;
    ++decided[ties.stage];
    ++count[ties.ties.size()];
    for (const Rung& rung : kRungs) {
      const auto other = ties_on_edge_at(rung, a.window, b.window, edge);
      if (!other) continue;
      ASSERT_EQ(other->kind, ties.kind) << round;
      ASSERT_EQ(other->ties.size(), ties.ties.size()) << round;
    }
    const EdgeTies swapped = ties_on_edge(b.window, a.window, {edge[1], edge[0]});
    ASSERT_EQ(swapped.kind, ties.kind);
    ASSERT_EQ(swapped.ties.size(), ties.ties.size());
    for (std::size_t i = 0; i < ties.ties.size(); ++i) {
      const EdgeTie &tie = ties.ties[i], &back = swapped.ties[ties.ties.size() - 1 - i];
      ASSERT_LE(back.t.lower, 1 - tie.t.lower + 1e-15);
      ASSERT_GE(back.t.upper, 1 - tie.t.upper - 1e-15);
      ASSERT_EQ(back.a_before, tie.a_before);  // the other way along, and the names exchanged
      at_ends += tie.t.lower <= 0 || tie.t.upper >= 1;
    }
  }
  EXPECT_GT(decided[Stage::filter], 200);
  EXPECT_GT(count[0], 30);
  EXPECT_GT(count[1], 100);
  EXPECT_GT(count[2], 3);
}

TEST(TiesOnEdge, ExactCasesAreToldApart) {
  const FaceCorners below{{{0, 0, 0}, {0, -8, 0}, {8, 0, 0}}}, above{{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}};
  const std::array<SpacePoint, 2> edge{SpacePoint{0, 0, 0}, SpacePoint{8, 0, 0}};
  const auto at = [&](int x, int y) {  // in `below`, seen in `above`
    FaceStrip strip(below, {{8 - x + y, -y, x}});
    strip.cross(above);
    return Window{strip, {}, std::nullopt};
  };
  const auto inside = [&](int x, int y) { return Window{FaceStrip(above, {{8 - x - y, x, y}}), {}, std::nullopt}; };
  const auto weighted = [](Window w, double weight) {
    w.weight.given = weight;
    return w;
  };
  EXPECT_EQ(ties_on_edge(at(2, -2), at(2, -2), edge).stage, Stage::identity);
  EXPECT_EQ(ties_on_edge(at(2, -2), at(2, -2), edge).kind, EdgeTies::Kind::everywhere);
  const EdgeTies mirror = ties_on_edge(at(2, -2), inside(2, 2), edge);
  EXPECT_EQ(mirror.kind, EdgeTies::Kind::everywhere);
  const EdgeTies lower = ties_on_edge(at(2, -3), at(2, -2), edge);
  EXPECT_EQ(lower.kind, EdgeTies::Kind::none);
  EXPECT_FALSE(lower.a_is_nearer);
  // From (1, -5) the heavier (4, -1) lies on the way to (19/4, 0): they touch there.
  const EdgeTies touch = ties_on_edge(at(1, -5), weighted(at(4, -1), 5), edge);
  ASSERT_EQ(touch.kind, EdgeTies::Kind::points);
  ASSERT_EQ(touch.ties.size(), 1u);
  EXPECT_TRUE(touch.ties[0].is_contact);
  EXPECT_TRUE(touch.ties[0].a_before);
  EXPECT_LE(touch.ties[0].t.lower, 19.0 / 32);
  EXPECT_GE(touch.ties[0].t.upper, 19.0 / 32);
  EXPECT_EQ(touch.stage, Stage::algebra);
  EXPECT_EQ(ties_on_edge(at(1, -5), weighted(at(4, -1), std::nextafter(5, 6)), edge).kind, EdgeTies::Kind::none);
  EXPECT_EQ(ties_on_edge(at(1, -5), weighted(at(4, -1), std::nextafter(5, 4)), edge).ties.size(), 2u);
  // The same from the heavier one: away from the edge, so no contact.
  EXPECT_EQ(ties_on_edge(weighted(at(1, -5), 5), at(4, -1), edge).kind, EdgeTies::Kind::none);
  // Both on the line of the edge: beyond the heavier one they are one.
  const auto on_edge = [&](int x) { return Window{FaceStrip(above, {{8 - x, x, 0}}), {}, std::nullopt}; };
  const EdgeTies ray = ties_on_edge(on_edge(1), weighted(on_edge(3), 2), edge);
  ASSERT_EQ(ray.kind, EdgeTies::Kind::ray);
  EXPECT_EQ(ray.ties[0].t.upper, 1);
  EXPECT_LE(ray.ties[0].t.lower, 3.0 / 8);
  EXPECT_EQ(ties_on_edge(weighted(on_edge(3), 2), on_edge(1), edge).kind, EdgeTies::Kind::ray);
  EXPECT_THROW(ties_on_edge(at(1, -1), at(2, -1), {SpacePoint{0, 0, 0}, SpacePoint{8, 8, 0}}), std::invalid_argument);
  EXPECT_THROW(ties_on_edge(at(1, -1), at(2, -1), {SpacePoint{0, 0, 0}, SpacePoint{0, 0, 0}}), std::invalid_argument);
}

/// Sign of the in-circle determinant of four points, positive iff d is inside the circle of a, b, c (counter-clockwise).
int in_circle(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c, const PlanarPoint& d) {
  const auto row = [&](const PlanarPoint& p) {
    const mpq_class x = p.x - d.x, y = p.y - d.y;
    return std::array<mpq_class, 3>{x, y, x * x + y * y};
  };
  const auto r = row(a), s = row(b), t = row(c);
  return sgn(r[0] * (s[1] * t[2] - s[2] * t[1]) - r[1] * (s[0] * t[2] - s[2] * t[0]) + r[2] * (s[0] * t[1] - s[1] * t[0]));
}

TEST(WindowConflict, EqualWeightsAreTheInCircleTest) {
  Random random(8);
  std::map<Conflict, int> verdicts;
  for (int round = 0; round < 300; ++round) {
    const Scene scene = random_scene(random);
    const FoldedFace& facet = scene.left;
    bool distinct = true;
    std::vector<KnownWindow> list;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t side = random.below(3);
      list.push_back(known_window(facet[side], facet[(side + 1) % 3], facet, random));
      for (std::size_t j = 0; j < i; ++j) distinct = distinct && !(list[i].image == list[j].image);
    }
    if (!distinct) continue;
    const int order = turn(list[0].image, list[1].image, list[2].image);
    const ConflictDecision d =
        conflict(test::in_space(facet), {&list[0].window, &list[1].window, &list[2].window}, list[3].window);
    const Conflict truth = order <= 0 ? Conflict::no_vertex
                                      : std::array{Conflict::farther, Conflict::ties, Conflict::nearer}[static_cast<std::size_t>(
                                            in_circle(list[0].image, list[1].image, list[2].image, list[3].image) + 1)];
    ASSERT_EQ(d.verdict, truth) << round;
    const ConflictDecision turned =
        conflict(test::in_space(facet), {&list[2].window, &list[0].window, &list[1].window}, list[3].window);
    ASSERT_EQ(turned.verdict, truth) << round;
    ++verdicts[truth];
  }
  EXPECT_GT(verdicts[Conflict::farther], 20);
  EXPECT_GT(verdicts[Conflict::nearer], 20);
  EXPECT_GT(verdicts[Conflict::no_vertex], 20);
}

// Images on Pythagorean directions from a point of the facet, weights that make all of them tie there, and the rival a little off.
TEST(WindowConflict, WeightedTiesAndTheirNeighbours) {
  const FaceCorners facet{{{-60, -60, 0}, {60, -60, 0}, {0, 60, 0}}};
  const std::array<FaceCorners, 3> beyond{{{{{-60, -60, 0}, {0, -900, 0}, {60, -60, 0}}},
                                           {{{60, -60, 0}, {900, 600, 0}, {0, 60, 0}}},
                                           {{{0, 60, 0}, {-900, 600, 0}, {-60, -60, 0}}}}};
  // In which face beyond a point lies, and its barycentric coordinates there.
  const auto window = [&](int x, int y, const mpq_class& weight) -> std::optional<Window> {
    for (const FaceCorners& face : beyond) {
      const auto area = [&](const SpacePoint& a, const SpacePoint& b, double cx, double cy) {
        return mpq_class((b[0] - a[0]) * (cy - a[1]) - (b[1] - a[1]) * (cx - a[0]));
      };
      const mpq_class w0 = area(face[1], face[2], x, y), w1 = area(face[2], face[0], x, y), w2 = area(face[0], face[1], x, y);
      if (sgn(w0) < 0 || sgn(w1) <= 0 || sgn(w2) < 0) continue;
      FaceStrip strip(face, {{w0, w1, w2}});
      strip.cross(facet);
      return Window{strip, {weight, {}}, std::nullopt};
    }
    return std::nullopt;
  };
  const std::array<std::array<int, 2>, 8> directions{{{3, 4}, {4, 3}, {-3, 4}, {-4, 3}, {3, -4}, {-3, -4}, {4, -3}, {-4, -3}}};
  Random random(9);
  std::map<Stage, int> decided;
  int found = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<std::pair<double, std::pair<Window, int>>> waves;  // by direction
    std::vector<std::size_t> used;
    constexpr int kValue = 400;
    while (waves.size() < 4) {
      const std::size_t n = random.below(8);
      if (std::find(used.begin(), used.end(), n) != used.end()) continue;
      const auto [dx, dy] = directions[n];
      const int r = 20 + static_cast<int>(random.below(30));
      if (auto w = window(r * dx, r * dy, kValue - 5 * r)) {
        used.push_back(n);
        waves.push_back({std::atan2(dy, dx), {*w, r}});
      }
    }
    const Window rival = waves.back().second.first;
    waves.pop_back();
    std::sort(waves.begin(), waves.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::array<const Window*, 3> ijk{&waves[0].second.first, &waves[1].second.first, &waves[2].second.first};
    const ConflictDecision tie = conflict(facet, ijk, rival);
    ASSERT_EQ(tie.verdict, Conflict::ties) << round;
    ASSERT_EQ(tie.stage, Stage::algebra);
    EXPECT_EQ(conflict(facet, {ijk[2], ijk[1], ijk[0]}, rival).verdict.value_or(Conflict::no_vertex) == Conflict::ties, false);
    for (const int bits : {20, 60, 150, 300}) {
      Window off = rival;
      off.weight.given += robust::power_of_two(-bits);
      const ConflictDecision farther = conflict(facet, ijk, off);
      ASSERT_EQ(farther.verdict, Conflict::farther) << round << " " << bits;
      ++decided[farther.stage];
      off.weight.given -= robust::power_of_two(1 - bits);
      ASSERT_EQ(conflict(facet, ijk, off).verdict, Conflict::nearer) << round << " " << bits;
    }
    ++found;
  }
  EXPECT_EQ(found, 400);
  for (const Stage stage : {Stage::filter, Stage::double_double, Stage::mpfr}) EXPECT_GT(decided[stage], 0);
}

TEST(WindowConflict, WhatIsNotSeenDoesNotCount) {
  const FaceCorners facet{{{-6, -6, 0}, {6, -6, 0}, {0, 6, 0}}};
  const Window right{FaceStrip(facet, FacePoint::corner(1)), {}, std::nullopt}, top{FaceStrip(facet, FacePoint::corner(2)), {}, std::nullopt},
      left{FaceStrip(facet, FacePoint::corner(0)), {}, std::nullopt};
  FaceStrip strip({{{-6, -6, 0}, {0, -12, 0}, {6, -6, 0}}}, {{1, 4, 1}});  // at (0, -10), straight below the vertex at (0, -3/2)
  strip.cross(facet);
  Window below{strip, {}, std::nullopt};
  EXPECT_EQ(conflict(facet, {&right, &top, &left}, below).verdict, Conflict::farther);
  below.weight.given = -3;
  EXPECT_EQ(conflict(facet, {&right, &top, &left}, below).verdict, Conflict::nearer);
  below.cone = {0, 2};
  EXPECT_EQ(conflict(facet, {&right, &top, &left}, below).verdict, Conflict::nearer);
  below.cone = {3, 2};  // right of the ray through the top corner, on which the vertex lies: the cone is closed
  EXPECT_EQ(conflict(facet, {&right, &top, &left}, below).verdict, Conflict::nearer);
  FaceStrip aside({{{-6, -6, 0}, {0, -12, 0}, {6, -6, 0}}}, {{1, 4, 2}});  // that ray leaves the vertex on its left
  aside.cross(facet);
  const auto seen_between = [&](std::size_t l, std::size_t r) {
    return conflict(facet, {&right, &top, &left}, Window{aside, {-3, {}}, {{l, r}}}).verdict;
  };
  EXPECT_EQ(seen_between(0, 3), Conflict::nearer);
  EXPECT_EQ(seen_between(3, 2), Conflict::farther);
  // The same of one of the three: what it does not see is no vertex.
  const Window half{aside, {}, {{3, 2}}}, whole{aside, {}, {{0, 2}}};
  const Window far{FaceStrip(facet, FacePoint::corner(0)), {20, {}}, std::nullopt};
  EXPECT_EQ(conflict(facet, {&right, &top, &whole}, far).verdict.value_or(Conflict::ties), Conflict::farther);
  EXPECT_EQ(conflict(facet, {&right, &top, &half}, far).verdict.value_or(Conflict::ties), Conflict::no_vertex);
  EXPECT_EQ(conflict(facet, {&right, &top, &left}, left).verdict, Conflict::ties);
  below.cone = {1, 0};  // not on an edge crossed
  EXPECT_THROW(conflict(facet, {&right, &top, &left}, below), std::invalid_argument);
  below.cone = std::nullopt;
  EXPECT_THROW(conflict({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {&right, &top, &left}, below), std::invalid_argument);
}

TEST(Window, IsTheSameByStripWeightAndCone) {
  FaceStrip strip({{{-6, -6, 0}, {0, -12, 0}, {6, -6, 0}}}, {{1, 4, 1}}), other({{{-6, -6, 0}, {0, -12, 0}, {6, -6, 0}}}, {{1, 4, 2}});
  for (FaceStrip* s : {&strip, &other}) s->cross({{{-6, -6, 0}, {6, -6, 0}, {0, 6, 0}}});
  const Window window{strip, {1, {}}, {{0, 2}}};
  EXPECT_TRUE((window == Window{strip, {1, {}}, {{0, 2}}}));
  EXPECT_FALSE((window == Window{other, {1, {}}, {{0, 2}}}));
  EXPECT_FALSE((window == Window{strip, {2, {}}, {{0, 2}}}));
  EXPECT_FALSE((window == Window{strip, {1, {}}, {{3, 2}}}));
  EXPECT_FALSE((window == Window{strip, {1, {}}, std::nullopt}));
}

// A weight through a face too thin for doubles: they are not asked, and long numbers find the ties.
TEST(TiesOnEdge, AWeightOutOfRange) {
  const std::array<SpacePoint, 2> edge{{{0, 0, 0}, {8, 0, 0}}};
  const FaceCorners facet{{{0, 0, 0}, {8, 0, 0}, {4, 8, 0}}};
  const Leg sliver(FaceStrip({{{0, 0, 0}, {1, 0, 0}, {1, 0x1p-300, 0}}}, FacePoint::corner(0)), FacePoint::corner(2));
  const Window a{FaceStrip(facet, FacePoint::corner(0)), {0, {sliver}}, std::nullopt}, b{FaceStrip(facet, FacePoint::corner(1)), {1, {}}, std::nullopt};
  EXPECT_FALSE(ties_on_edge_at({Stage::filter}, a, b, edge));
  EXPECT_FALSE(ties_on_edge_at({Stage::double_double}, b, a, edge));
  const EdgeTies ties = ties_on_edge(a, b, edge);
  ASSERT_EQ(ties.kind, EdgeTies::Kind::points);
  EXPECT_EQ(ties.stage, Stage::mpfr);
  EXPECT_LE(ties.ties[0].t.lower, 0.5);
  EXPECT_GE(ties.ties[0].t.upper, 0.5);
}

// Seen from behind, the facet and the order of the waves are the other way round, and nothing else changes.
TEST(WindowConflict, AFacetSeenFromBehind) {
  const FaceCorners facet{{{-6, -6, 0}, {6, -6, 0}, {0, 6, 0}}};
  const Window right{FaceStrip(facet, FacePoint::corner(1)), {}, std::nullopt}, top{FaceStrip(facet, FacePoint::corner(2)), {}, std::nullopt},
      left{FaceStrip(facet, FacePoint::corner(0)), {}, std::nullopt};
  FaceStrip strip({{{-6, -6, 0}, {0, -12, 0}, {6, -6, 0}}}, {{1, 4, 1}});
  strip.cross(facet);
  std::array<std::size_t, 3> corner{0, 1, 2};
  do {
    const FaceCorners named{facet[corner[0]], facet[corner[1]], facet[corner[2]]};
    const bool behind = (corner[0] + 1) % 3 != corner[1];
    const auto verdict = [&](const Window& a, const Window& b, const Window& c, const Window& rival) {
      return conflict(named, behind ? std::array{&c, &b, &a} : std::array{&a, &b, &c}, rival).verdict;
    };
    for (const int weight : {0, -3}) {
      for (const auto& cone : {std::array<std::size_t, 2>{0, 2}, {3, 2}, {0, 3}}) {
        const Window below{strip, {weight, {}}, cone};
        EXPECT_EQ(verdict(right, top, left, below), weight < 0 ? Conflict::nearer : Conflict::farther);
        // The vertex of the lower three lies on the ray through the top corner, too: each half sees it.
        EXPECT_EQ(verdict(below, right, left, Window{FaceStrip(facet, FacePoint::corner(2)), {30, {}}, std::nullopt}), Conflict::farther);
      }
    }
  } while (std::next_permutation(corner.begin(), corner.end()));
}

}  // namespace
}  // namespace gvd::predicates
