#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "fuzz/generators/family.hpp"
#include "fuzz/generators/shrink.hpp"
#include "gvd/kernel/mesh_facts.hpp"
#include "gvd/kernel/surface_point.hpp"

namespace gvd::fuzz {
namespace {

kernel::MeshFacts facts_of(const Case& c) {
  predicates::Decisions decisions;
  return kernel::facts(kernel::Mesh(c.mesh), decisions);
}

Case of_family(const std::string& family, std::uint64_t seed, std::uint32_t size = 4) {
  Wish wish;
  wish.family = family;
  wish.size = size;
  return make_case(seed, wish);
}

TEST(Draw, IsTheSameOnEveryMachine) {
  Draw draw(1);
  EXPECT_EQ(draw.bits(), 12966619160104079557u);
  EXPECT_EQ(mixed_seed(1, 2), mixed_seed(1, 2));
  EXPECT_NE(mixed_seed(1, 2), mixed_seed(2, 1));
}

TEST(Draw, BitDoublesMeetEveryExponentAndExtremeSignificands) {
  Draw draw(7);
  std::set<int> exponents;
  int powers = 0, below = 0, negative = 0;
  for (int i = 0; i < 4000; ++i) {
    const double x = draw.bit_double(-20, 20);
    int exponent = 0;
    const double m = std::fabs(std::frexp(x, &exponent));
    exponents.insert(exponent - 1);
    powers += m == 0.5 ? 1 : 0;
    below += m > 1 - 0x1p-50 ? 1 : 0;
    negative += x < 0 ? 1 : 0;
  }
  EXPECT_EQ(exponents.size(), 41u);
  EXPECT_EQ(*exponents.begin(), -20);
  EXPECT_GT(powers, 500);
  EXPECT_GT(below, 500);
  EXPECT_NEAR(negative, 2000, 200);
}

TEST(Draw, NudgedStaysWithinItsUlps) {
  Draw draw(3);
  std::set<double> seen;
  for (int i = 0; i < 100; ++i) seen.insert(draw.nudged(1, 1));
  EXPECT_EQ(seen, (std::set<double>{std::nextafter(1, 0), 1, std::nextafter(1, 2)}));
}

TEST(Families, EveryOneMakesValidCasesOfEverySizeAndAgain) {
  for (const Family& family : families())
    for (std::uint32_t size = 1; size <= 8; ++size)
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const Case c = of_family(family.name, seed, size);
        EXPECT_TRUE(is_valid(c)) << family.name;
        EXPECT_FALSE(c.sources.empty());
        EXPECT_EQ(case_text(c, {}), case_text(of_family(family.name, seed, size), {})) << family.name << " is not deterministic";
      }
}

TEST(Families, EveryPatternGivesValidSources) {
  for (const Pattern& pattern : patterns())
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      Wish wish;
      wish.pattern = pattern.name;
      EXPECT_TRUE(is_valid(make_case(seed, wish))) << pattern.name;
    }
}

TEST(Families, TopologyIsThatOfTheName) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    EXPECT_EQ(facts_of(of_family("sphere", seed)).euler, 2);
    EXPECT_EQ(facts_of(of_family("torus", seed)).euler, 0);
    EXPECT_EQ(facts_of(of_family("double_torus", seed)).euler, -2);
    EXPECT_EQ(facts_of(of_family("double_torus", seed)).boundary_edges, 0u);
    EXPECT_EQ(facts_of(of_family("tube", seed)).boundary_loops, 2u);
    EXPECT_GE(facts_of(of_family("components", seed)).components, 2u);
    EXPECT_EQ(facts_of(of_family("bridges", seed)).components, 1u);
    EXPECT_GT(facts_of(of_family("valleys", seed)).saddles, 0u);
  }
}

TEST(Families, HolesOccur) {
  std::uint32_t most = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) most = std::max(most, facts_of(of_family("holes", seed, 6)).boundary_loops);
  EXPECT_GT(most, 2u);
}

TEST(Families, NecksAreOneEdgeWide) {
  // Somewhere an edge has both its ends on the boundary and both its faces inside.
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const kernel::Mesh mesh(of_family("bridges", seed, 6).mesh);
    std::size_t necks = 0;
    for (kernel::HalfedgeId h = 0; h < mesh.halfedge_count(); ++h)
      necks += mesh.twin(h) != kernel::kNone && mesh.is_boundary(mesh.origin(h)) && mesh.is_boundary(mesh.target(h)) ? 1 : 0;
    EXPECT_GT(necks, 0u);
  }
}

TEST(Families, SliversReachAspectsOfABillion) {
  double most = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Case c = of_family("slivers", seed);
    double high = 0;
    for (const auto& p : c.mesh.points) high = std::max(high, p[1]);
    most = std::max(most, 1 / high);
  }
  EXPECT_GT(most, 1e8);
}

TEST(Families, ScalesGoFar) {
  int low = 0, high = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Case c = of_family("scaled", seed);
    for (const auto& p : c.mesh.points)
      if (p[0] != 0) low = std::min(low, std::ilogb(p[0])), high = std::max(high, std::ilogb(p[0]));
  }
  EXPECT_LT(low, -200);
  EXPECT_GT(high, 200);
}

TEST(MakeCase, DrawsEveryFamilyAndNowAndThenManySources) {
  std::map<std::string, int> seen;
  std::size_t most = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const Case c = make_case(seed);
    ++seen[c.family];
    most = std::max(most, c.sources.size());
  }
  EXPECT_EQ(seen.size(), families().size());
  EXPECT_GT(most, 100u);
}

TEST(CaseText, ReadsBackAsTheSameCase) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Case c = make_case(seed);
    const Case again = parse_case(case_text(c, {"a remark", "seed 1"}), "x.off");
    EXPECT_EQ(again.mesh.points, c.mesh.points);
    EXPECT_EQ(again.mesh.faces, c.mesh.faces);
    EXPECT_EQ(source_text(again.sources), source_text(c.sources));
  }
}

constexpr auto kLongEnough = std::chrono::seconds(60);

TEST(Shrink, EndsAtTheLeastMeshThatStillFails) {
  // "Fails": some vertex lies higher than 1 and there are two sources.
  const auto fails = [](const Case& c) {
    bool high = false;
    for (const auto& p : c.mesh.points) high = high || p[2] > 1;
    return high && c.sources.size() >= 2;
  };
  Wish wish;
  wish.family = "spikes";
  wish.size = 6;
  wish.sources = 5;
  wish.weighted = 1;
  const Case c = make_case(3, wish);
  ASSERT_TRUE(fails(c));
  const Case small = shrink(c, fails, std::chrono::steady_clock::now() + kLongEnough);
  EXPECT_TRUE(is_valid(small));
  EXPECT_TRUE(fails(small));
  EXPECT_LE(small.mesh.faces.size(), 2u);
  EXPECT_EQ(small.sources.size(), 2u);
  for (const Place& s : small.sources) EXPECT_EQ(s.weight, 0);
}

TEST(Shrink, ShowsOnlyValidCases) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    int asked = 0;
    shrink(
        make_case(seed),
        [&](const Case& c) {
          EXPECT_TRUE(is_valid(c));
          return ++asked % 3 != 0;
        },
        std::chrono::steady_clock::now() + kLongEnough);
    EXPECT_GT(asked, 0);
  }
}

}  // namespace
}  // namespace gvd::fuzz
