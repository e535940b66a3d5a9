// The kernel with proofs taken away from it. Whatever it says without them it must say with them, too; the rest is undecided and says so.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "fuzz/generators/family.hpp"
#include "gvd/kernel/extract.hpp"
#include "gvd/robust/proof_limit.hpp"
#include "support/mirrored_terrain.hpp"
#include "support/surface_points.hpp"
#include "support/tied_facets.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using predicates::Decisions;
using robust::ProofLimit;
using robust::Stage;
using test::Random;

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

/// The first ones one by one, then further and further apart, and all but one.
std::vector<std::uint64_t> limits_up_to(std::uint64_t questions, std::uint64_t one_by_one, double factor) {
  std::vector<std::uint64_t> list;
  for (std::uint64_t n = 0; n < questions; n = n < one_by_one ? n + 1 : static_cast<std::uint64_t>(std::ceil(static_cast<double>(n) * factor)))
    list.push_back(n);
  if (questions > 0 && list.back() + 1 < questions) list.push_back(questions - 1);
  return list;
}

// --- Single facets ---

/// What meets where, and what borders on what.
struct Combinatorics {
  std::vector<std::string> nodes, arcs;
  explicit Combinatorics(const FacetTessellation& t) {
    for (const auto& node : t.nodes) {
      std::vector<std::uint32_t> cycle = node.sites;
      if (node.kind == FacetTessellation::Node::Kind::inside) std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
      std::string text = std::to_string(static_cast<int>(node.kind));
      if (node.kind != FacetTessellation::Node::Kind::inside) text += " at " + std::to_string(node.where);
      for (const std::uint32_t site : cycle) text += " " + std::to_string(site);
      nodes.push_back(text);
    }
    for (const auto& arc : t.arcs) arcs.push_back(std::to_string(std::min(arc.left, arc.right)) + " " + std::to_string(std::max(arc.left, arc.right)));
    std::sort(nodes.begin(), nodes.end());
    std::sort(arcs.begin(), arcs.end());
  }
  bool operator==(const Combinatorics&) const = default;
};

/// `make` gives the waves anew each time, for exact numbers remember their signs. Returns how many limits left the facet undecided.
template <class Make, class Tessellate>
int expect_same_or_undecided(const Make& make, const Tessellate& tessellated) {
  std::uint64_t questions = 0;
  const auto run = [&](std::uint64_t most, bool& undecided) {
    auto waves = make();
    Decisions decisions;
    const ProofLimit limit(most);
    const FacetTessellation t = tessellated(waves, decisions);
    undecided = t.undecided;
    EXPECT_EQ(t.undecided, decisions.total(Stage::undecided) > 0);
    EXPECT_TRUE(limit.was_reached() || !t.undecided);
    questions = most - limit.questions_left();
    return Combinatorics(t);
  };
  bool undecided = false;
  const Combinatorics truth = run(kUnlimited, undecided);
  EXPECT_FALSE(undecided);
  int failed = 0;
  for (const std::uint64_t most : limits_up_to(questions, 60, 1.2)) {
    const Combinatorics limited = run(most, undecided);
    failed += undecided;
    EXPECT_TRUE(undecided || limited == truth) << "with " << most << " proofs";
    if (testing::Test::HasFailure()) return failed;
  }
  return failed;
}

FacetTessellation whole(FacetWaves& waves, Decisions& decisions) { return tessellate(waves, decisions); }

TEST(UndecidedFacet, TiesAtAPoint) {
  Random random(2100);
  int undecided = 0;
  for (int round = 0; round < 24; ++round) {
    SCOPED_TRACE(round);
    const auto kind = static_cast<test::Node::Kind>(round % 3);
    const test::TiedFacet f = tied_facet(kind, 3 + random.below(4) + (kind == test::Node::Kind::inside ? 1 : 0), round % 2 == 0, round % 4 != 0, random);
    undecided += expect_same_or_undecided([&] { return f.waves(); }, whole);
    const test::TiedFacet off = neighbour(f, random);
    expect_same_or_undecided([&] { return off.waves(); }, whole);
    if (HasFailure()) return;
  }
  EXPECT_GT(undecided, 100);
}

TEST(UndecidedFacet, BoundaryRaysThatMeet) {
  Random random(2200);
  for (int round = 0; round < 6; ++round) {
    SCOPED_TRACE(round);
    const test::Walls w = test::walls(2 + random.below(4), random);
    EXPECT_GT(expect_same_or_undecided([&] { return w.waves(); }, whole), 0);
    if (HasFailure()) return;
  }
}

TEST(UndecidedFacet, ImagesInARowOrOnOneLine) {
  Random random(2300);
  int undecided = 0;
  for (int round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    const std::uint64_t seed = random.next();
    const auto make = [&] {
      Random same(seed);
      return round % 2 == 0 ? test::images_in_a_row(2 + round / 4, 3 + round % 4, false, 0, same) : test::on_one_line(0, same).waves();
    };
    undecided += expect_same_or_undecided(make, whole);
    if (HasFailure()) return;
  }
  EXPECT_GT(undecided, 10);
}

// --- Whole solutions ---

/// What holds of one that lacks proofs: distances to the last bit but one, all nearest sources and perhaps more.
void expect_no_contradiction(const Mesh& mesh, const Solution& limited, const Solution& truth) {
  ASSERT_TRUE(is_complete(limited.status()));
  const bool certified = limited.status() == Status::certified;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    SCOPED_TRACE(v);
    const double d = truth.distance(v);
    const auto nearest = limited.nearest(v), true_nearest = truth.nearest(v);
    EXPECT_TRUE(std::includes(nearest.begin(), nearest.end(), true_nearest.begin(), true_nearest.end()));
    if (certified) {
      EXPECT_EQ(limited.distance(v), d);
      EXPECT_EQ(nearest.size(), true_nearest.size());
    } else if (std::isfinite(d)) {
      EXPECT_LE(limited.distance(v), std::nextafter(d, HUGE_VAL));
      EXPECT_GE(limited.distance(v), std::nextafter(d, -HUGE_VAL));
      EXPECT_LE(limited.distance_enclosure(v).low, truth.distance_enclosure(v).high);
      EXPECT_GE(limited.distance_enclosure(v).high, truth.distance_enclosure(v).low);
    }
    if (testing::Test::HasFailure()) return;
  }
  if (certified) {
    EXPECT_EQ(canonical(limited.diagram()), canonical(truth.diagram()));
  }
}

/// Returns how many limits left something undecided.
int expect_same_or_undecided(const Mesh& mesh, const std::vector<Source>& sources, std::uint64_t one_by_one, double factor) {
  ProofLimit all(kUnlimited);
  const Solution truth = solve(mesh, sources);
  const std::uint64_t questions = kUnlimited - all.questions_left();
  int undecided = 0;
  for (const std::uint64_t most : limits_up_to(questions, one_by_one, factor)) {
    SCOPED_TRACE("with " + std::to_string(most) + " of " + std::to_string(questions) + " proofs");
    const ProofLimit limit(most);
    const Solution limited = solve(mesh, sources);
    undecided += limited.status() != Status::certified;
    expect_no_contradiction(mesh, limited, truth);
    if (testing::Test::HasFailure()) break;
  }
  return undecided;
}

std::vector<Source> at_vertices(const Mesh& mesh, const std::vector<VertexId>& vertices) {
  std::vector<Source> sources;
  for (const VertexId v : vertices) sources.push_back(test::at_vertex(mesh, v));
  return sources;
}

TEST(UndecidedSolution, PlanesAndBlocks) {
  const std::vector<test::MeshArrays> meshes{test::flat_grid(4, 3),    test::plane_with_hole(5, 4, 2, 3, 2, 3), test::cube(2),
                                             test::staircase(2, 2),    test::roof(4, 2, 4, 4),                  test::integer_saddle(1),
                                             test::flat_grid(3, 3, test::Diagonal::alternating)};
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    SCOPED_TRACE(i);
    const Mesh mesh(meshes[i]);
    const VertexId last = static_cast<VertexId>(mesh.vertex_count()) - 1;
    EXPECT_GT(expect_same_or_undecided(mesh, at_vertices(mesh, {0, last / 2, last}), 4, 1.4), 0);
    if (HasFailure()) return;
  }
}

TEST(UndecidedSolution, MirroredTerrain) {
  const Mesh mesh(test::mirrored_terrain());
  EXPECT_GT(expect_same_or_undecided(mesh, test::mirrored_sources(mesh, 0), 10, 1.5), 0);
}

/// What fuzzing once found.
TEST(UndecidedSolution, Regressions) {
  constexpr std::size_t kMostFaces = 120;
  int undecided = 0;
  for (const auto& file : std::filesystem::directory_iterator(GVD_SOURCE_DIR "/tests/regressions")) {
    SCOPED_TRACE(file.path().filename().string());
    const fuzz::Case c = fuzz::read_case(file.path().string());
    const Mesh mesh(c.mesh);
    if (mesh.face_count() > kMostFaces) continue;
    undecided += expect_same_or_undecided(mesh, fuzz::sources_of(mesh, c.sources), 2, 2.5);
    if (HasFailure()) return;
  }
  EXPECT_GT(undecided, 0);
}

TEST(UndecidedSolution, FuzzedCases) {
  Random random(2400);
  fuzz::Wish wish;
  wish.size = 2;
  int undecided = 0;
  for (int round = 0; round < 100; ++round) {
    const std::uint64_t seed = random.next();
    SCOPED_TRACE(seed);
    const fuzz::Case c = fuzz::make_case(seed, wish);
    const Mesh mesh(c.mesh);
    undecided += expect_same_or_undecided(mesh, fuzz::sources_of(mesh, c.sources), 1, 5);
    if (HasFailure()) return;
  }
  EXPECT_GT(undecided, 0);
}

TEST(UndecidedQuery, SameOrUndecided) {
  Random random(2500);
  int undecided = 0;
  for (const auto& arrays : {test::flat_grid(3, 3), test::plane_with_hole(4, 4, 1, 3, 1, 2), test::cube(2), test::roof(4, 2, 4, 4), test::mirrored_terrain()}) {
    const Mesh mesh(arrays);
    const VertexId last = static_cast<VertexId>(mesh.vertex_count()) - 1;
    const Solution solution = solve(mesh, at_vertices(mesh, {0, last / 2, last}));
    for (int i = 0; i < 30; ++i) {
      const SurfacePoint at = test::random_point(mesh, random);
      const PointAnswer truth = solution.query(at);
      EXPECT_FALSE(truth.undecided);
      for (std::uint64_t most = 0;; ++most) {
        const ProofLimit limit(most);
        const PointAnswer limited = solution.query(at), path = solution.path(at);
        undecided += limited.undecided;
        EXPECT_FALSE(path.path.empty());
        for (const PointAnswer* said : {&limited, &path}) {
          EXPECT_TRUE(said->undecided || (said->distance == truth.distance && said->nearest == truth.nearest)) << most;
          EXPECT_LE(said->enclosure.low, truth.enclosure.high);
          EXPECT_GE(said->enclosure.high, truth.enclosure.low);
        }
        if (!limit.was_reached() || HasFailure()) break;
      }
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(undecided, 0);
}

}  // namespace
}  // namespace gvd::kernel
