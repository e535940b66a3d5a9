#include "gvd/kernel/tessellation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/facet_reference.hpp"
#include "support/meshes.hpp"
#include "support/planar_waves.hpp"

namespace gvd::kernel {
namespace {

using robust::Stage;
using test::FacetReference;
using test::PlanarWaves;
using Node = FacetTessellation::Node;
using Point = PlanarWaves::Point;

FacetTessellation run(PlanarWaves& waves) {
  waves.finish();
  predicates::Decisions decisions;
  const FacetTessellation t = tessellate(waves, decisions);
  for (const auto& what : decisions.undecided_list()) ADD_FAILURE() << what;
  return t;
}

/// A point below side k of the facet, as an image of a wave that comes in over it.
Point below(test::Random& random, Point apex, std::uint8_t k) {
  const std::array<Point, 3> corner{Point{0, 0}, Point{1, 0}, apex};
  const Point a = corner[k], b = corner[(k + 1) % 3];
  const double t = random.uniform(-0.5, 1.5), depth = random.uniform(0.01, 2.0);
  return {a[0] + t * (b[0] - a[0]) + depth * (b[1] - a[1]), a[1] + t * (b[1] - a[1]) - depth * (b[0] - a[0])};
}

TEST(Tessellation, RandomWeightedWavesGiveTheBruteForceTessellation) {
  test::Random random(20230217);
  std::size_t vertices = 0, both = 0;
  for (int round = 0; round < 150; ++round) {
    const Point apex{random.uniform(-0.3, 1.3), random.uniform(0.3, 1.2)};
    PlanarWaves waves(apex);
    const std::uint32_t n = 2 + random.below(6);
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto side = static_cast<std::uint8_t>(random.below(3));
      const Point image = below(random, apex, side);
      // A weight that makes it about as near as the others at some point of the facet.
      const double x = random.uniform(0.1, 0.6), y = random.uniform(0.05, 0.3);
      const double there = std::hypot(image[0] - x, image[1] - y);
      waves.add(side, 10 + i, image, std::max(0.0, random.uniform(1.9, 2.1) - there));
    }
    const FacetTessellation t = run(waves);
    const FacetReference reference(waves);
    EXPECT_EQ(reference.check(t), "") << "round " << round;
    vertices += reference.inside_count();
    std::set<std::set<std::uint32_t>> triples;
    for (const Node& node : t.nodes)
      if (node.kind == Node::Kind::inside && !triples.insert({node.sites.begin(), node.sites.end()}).second) ++both;
  }
  EXPECT_GT(vertices, 100u);
  EXPECT_GT(both, 0u) << "no triple with two vertices was met";
}

TEST(Tessellation, LatticeWavesWithExactTiesGiveTheBruteForceTessellation) {
  test::Random random(7);
  std::size_t high_degree = 0, corner_ties = 0;
  for (int round = 0; round < 150; ++round) {
    const Point apex{0.25 * random.below(5), 1.0};
    PlanarWaves waves(apex);
    std::set<Point> used;
    for (std::uint32_t i = 0, n = 2 + random.below(4); i < n; ++i) {
      const auto x = 0.5 * (static_cast<double>(random.below(9)) - 4), y = 0.5 * (static_cast<double>(random.below(9)) - 4);
      const bool under = y < 0;
      const bool over_right = (apex[0] - 1) * y - (x - 1) < 0, over_left = x - apex[0] * y < 0;
      if (!(under || over_right || over_left) || !used.insert({x, y}).second) continue;
      waves.add(under ? 0 : over_right ? 1 : 2, 10 + i, {x, y}, 0);
    }
    if (waves.sites.size() < 2) continue;
    waves.finish();
    predicates::Decisions decisions;
    const FacetTessellation t = tessellate(waves, decisions);
    if (t.undecided) continue;  // waves that come along one line at a corner; counted below
    EXPECT_EQ(FacetReference(waves).check(t), "") << "round " << round;
    for (const Node& node : t.nodes) {
      high_degree += node.kind == Node::Kind::inside && node.sites.size() > 3;
      corner_ties += node.kind == Node::Kind::corner;
    }
  }
  EXPECT_GT(corner_ties, 0u);
}

TEST(Tessellation, FourWavesOfOneCircleMeetInOneVertex) {
  PlanarWaves waves({0.5, 1});
  waves.add(0, 10, {0.5, -1.625}, 0);  // all at distance 2 from (1/2, 3/8)
  waves.add(1, 11, {2.5, 0.375}, 0);
  waves.add(1, 12, {0.5, 2.375}, 0);
  waves.add(2, 13, {-1.5, 0.375}, 0);
  const FacetTessellation t = run(waves);
  EXPECT_EQ(FacetReference(waves).check(t), "");
  std::size_t inside = 0;
  for (const Node& node : t.nodes) {
    if (node.kind != Node::Kind::inside) continue;
    ++inside;
    EXPECT_EQ(node.sites.size(), 4u);
  }
  EXPECT_EQ(inside, 1u);
  EXPECT_EQ(t.arcs.size(), 4u);
}

TEST(Tessellation, AVertexOnASideIsOneNodeOfTheOutline) {
  PlanarWaves waves({0.5, 1});
  waves.add(0, 10, {0.5, -1}, 0);  // all at distance 1 from (1/2, 0)
  waves.add(2, 11, {-0.5, 0}, 0);
  waves.add(1, 12, {1.5, 0}, 0);
  const FacetTessellation t = run(waves);
  EXPECT_EQ(FacetReference(waves).check(t), "");
  ASSERT_EQ(t.nodes.size(), 2u);
}

TEST(Tessellation, ABisectorAlongASideLeavesTheOneInsideTheFacet) {
  PlanarWaves waves({0.5, 1});
  waves.add(0, 10, {0.5, -2}, 0);
  waves.add(1, 11, {0.5, 2}, 0);  // its mirror image in side 0, nearer everywhere above
  const FacetTessellation t = run(waves);
  EXPECT_TRUE(t.arcs.empty());
  for (const auto& piece : t.outline) EXPECT_EQ(piece.site, 1u);
}

TEST(Tessellation, WithoutExactNumbersATieIsUndecidedAndNotGuessed) {
  // Four images on a circle about (0.5, 0.375) whose radius, the root of 5, no number represents.
  PlanarWaves waves({0.5, 1}, false);
  waves.add(0, 10, {1.5, -1.625}, 0);
  waves.add(1, 11, {2.5, 1.375}, 0);
  waves.add(1, 12, {1.5, 2.375}, 0);
  waves.add(2, 13, {-1.5, 1.375}, 0);
  waves.finish();
  predicates::Decisions decisions;
  const FacetTessellation t = tessellate(waves, decisions);
  ASSERT_TRUE(t.undecided);
  EXPECT_TRUE(t.nodes.empty());
  EXPECT_NE(decisions.undecided_list().at(0).find("facet 0"), std::string::npos);
  EXPECT_EQ(decisions.total(Stage::undecided), 1u);
}

/// A source at (-5/2, -4) behind a wall that ends at the relay (-1, -2): the boundary ray enters the facet at (1/2, 0).
void add_wall(PlanarWaves& waves) {
  waves.add(0, 10, {-2.5, -4}, 0, {Point{-8, -2}, Point{-1, -2}}, {21, 20}, {false, true});
  waves.add(0, 20, {-1, -2}, 2.5, {Point{-9, -1}, Point{9, -1}}, {22, 23}, {false, false});
}

TEST(Tessellation, ARelayMeetsItsParentAlongTheBoundaryRay) {
  PlanarWaves waves({0.5, 1});
  add_wall(waves);
  const FacetTessellation t = run(waves);
  EXPECT_EQ(FacetReference(waves).check(t), "");
  ASSERT_EQ(t.arcs.size(), 1u);
  EXPECT_TRUE(t.arcs[0].tangent);
}

TEST(Tessellation, RelaysAmongRandomWavesGiveTheBruteForceTessellation) {
  test::Random random(11);
  std::size_t on_ray = 0;
  for (int round = 0; round < 60; ++round) {
    const Point apex{random.uniform(0.2, 0.9), random.uniform(0.4, 1.2)};
    PlanarWaves waves(apex);
    add_wall(waves);
    for (std::uint32_t i = 0, n = 1 + random.below(4); i < n; ++i) {
      const auto side = static_cast<std::uint8_t>(1 + random.below(2));
      const Point image = below(random, apex, side);
      const double x = random.uniform(0.2, 0.7), y = random.uniform(0.05, 0.3);
      const double there = std::hypot(x + 2.5, y + 4), weight = there - std::hypot(image[0] - x, image[1] - y);
      if (weight < 0 || weight + std::hypot(image[0] + 1, image[1] + 2) < 2.6) continue;  // it would reach the relay first
      waves.add(side, 30 + i, image, weight);
    }
    const FacetTessellation t = run(waves);
    EXPECT_EQ(FacetReference(waves).check(t), "") << "round " << round;
    for (const Node& node : t.nodes) on_ray += node.kind == Node::Kind::inside && node.ray != FacetTessellation::kNoSite;
  }
  EXPECT_GT(on_ray, 5u);
}

TEST(Tessellation, ARelayAtACornerOwnsItsShadow) {
  PlanarWaves waves({0.25, 1});  // the ray from (-3, -4) through corner 0 goes into the facet
  waves.add(2, 10, {-3, -4}, 0, {Point{-4, 3}, Point{0, 0}}, {21, 0}, {false, true});
  waves.add_corner(0, {0, 0}, 5);
  const FacetTessellation t = run(waves);
  EXPECT_EQ(FacetReference(waves).check(t), "");
  ASSERT_EQ(t.arcs.size(), 1u);
  EXPECT_TRUE(t.arcs[0].tangent);
  EXPECT_EQ(t.arcs[0].left, 0u);
  EXPECT_EQ(t.arcs[0].right, 1u);
}

TEST(Tessellation, ARelayWhoseRegionIsOnlyItsCornerHasNone) {
  PlanarWaves waves({1, 1});  // the ray through corner 0 leaves the facet on its right
  waves.add(0, 10, {-3, -4}, 0, {Point{0, 0}, Point{1, 0}}, {0, 1}, {true, true});
  waves.add_corner(0, {0, 0}, 5);
  const FacetTessellation t = run(waves);
  EXPECT_TRUE(t.arcs.empty());
  EXPECT_TRUE(t.nodes.empty());
  ASSERT_EQ(t.outline.size(), 3u);
  for (const auto& piece : t.outline) EXPECT_EQ(piece.site, 0u);
}

}  // namespace
}  // namespace gvd::kernel
