// The kernel with proofs taken away from it. Whatever it says without them it must say with them, too; the rest is undecided and says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
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

/// How many questions are refused: one alone, or all that follow.
constexpr std::array kRefused{std::uint64_t{1}, ProofLimit::kAll};

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
  const auto run = [&](std::uint64_t most, std::uint64_t refused, bool& undecided) {
    auto waves = make();
    Decisions decisions;
    const ProofLimit limit(most, refused);
    const FacetTessellation t = tessellated(waves, decisions);
    undecided = t.undecided;
    EXPECT_EQ(t.undecided, decisions.total(Stage::undecided) > 0);
    EXPECT_TRUE(limit.was_reached() || !t.undecided);
    questions = most - limit.questions_left();
    return Combinatorics(t);
  };
  bool undecided = false;
  const Combinatorics truth = run(ProofLimit::kAll, 0, undecided);
  EXPECT_FALSE(undecided);
  int failed = 0;
  for (const std::uint64_t most : limits_up_to(questions, 60, 1.2)) {
    for (const std::uint64_t refused : kRefused) {
      const Combinatorics limited = run(most, refused, undecided);
      failed += undecided;
      EXPECT_TRUE(undecided || limited == truth) << "with " << most << " proofs";
      if (testing::Test::HasFailure()) return failed;
    }
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
  const ProofLimit all(ProofLimit::kAll);
  const Solution truth = solve(mesh, sources);
  const std::uint64_t questions = ProofLimit::kAll - all.questions_left();
  int undecided = 0;
  for (const std::uint64_t most : limits_up_to(questions, one_by_one, factor)) {
    SCOPED_TRACE("with " + std::to_string(most) + " of " + std::to_string(questions) + " proofs");
    for (const std::uint64_t refused : kRefused) {
      const ProofLimit limit(most, refused);
      const Solution limited = solve(mesh, sources);
      undecided += limited.status() != Status::certified;
      expect_no_contradiction(mesh, limited, truth);
    }
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
    undecided += expect_same_or_undecided(mesh, fuzz::sources_of(mesh, c.sources), 1, 4);
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

/// Returns how often a query was left undecided.
int expect_same_or_undecided(const Solution& solution, const SurfacePoint& at) {
  const PointAnswer truth = solution.query(at);
  int undecided = 0;
  bool goes_on = true;
  for (std::uint64_t i = 0; goes_on; ++i) {
    const ProofLimit limit(i / 2, kRefused[i % 2]);
    const PointAnswer limited = solution.query(at), path = solution.path(at);
    undecided += limited.undecided;
    EXPECT_FALSE(path.path.empty());
    for (const PointAnswer* said : {&limited, &path}) {
      EXPECT_TRUE(said->undecided || (!truth.undecided && said->distance == truth.distance && said->nearest == truth.nearest)) << "with " << i / 2 << " proofs";
      EXPECT_LE(said->enclosure.low, truth.enclosure.high);
      EXPECT_GE(said->enclosure.high, truth.enclosure.low);
    }
    goes_on = limit.was_reached() && !testing::Test::HasFailure();
  }
  return undecided;
}

// Sources that mirror one another: along the lines between them, which are mesh edges, everything ties. (On rough terrain over more classes than are
// multiplied out, so that some of it is undecided in any case.)
TEST(UndecidedQuery, SameOrUndecided) {
  const auto ask = [](const Mesh& mesh, const std::vector<Source>& sources) {
    const Solution solution = solve(mesh, sources);
    int undecided = 0;
    for (FaceId f = 0; f < mesh.face_count() && !testing::Test::HasFailure(); ++f)
      for (const auto& [a, b, c] : {std::array{1, 1, 0}, {1, 0, 1}, {0, 2, 3}, {3, 2, 1}}) undecided += expect_same_or_undecided(solution, test::in_face(f, a, b, c));
    EXPECT_GT(undecided, 0);
  };
  const Mesh grid(test::flat_grid(4, 4)), hole(test::plane_with_hole(6, 5, 2, 4, 2, 3)), cube(test::cube(2)), terrain(test::mirrored_terrain());
  ask(grid, at_vertices(grid, {0, 4, 20, 24}));
  ask(hole, at_vertices(hole, {0, 6}));
  ask(cube, at_vertices(cube, {0, static_cast<VertexId>(cube.vertex_count()) - 1}));
  ask(terrain, test::mirrored_sources(terrain, 0));
}

}  // namespace
}  // namespace gvd::kernel
