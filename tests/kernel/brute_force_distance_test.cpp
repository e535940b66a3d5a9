#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "gvd/io/mesh_reader.hpp"
#include "fuzz/properties/brute_force.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using robust::Mpfr;
using test::at_vertex;
using fuzz::BruteForce;
using test::inside_edge;
using test::inside_face;
using test::Random;

/// Compares distances and, unless something was undecided, nearest sources with the enumeration.
void expect_brute_force(const Mesh& mesh, const std::vector<Source>& sources, const std::string& what, bool certified = true) {
  SCOPED_TRACE(what);
  fuzz::ExactMesh exact(mesh);
  std::vector<std::uint32_t> roots;
  for (const Source& s : sources) roots.push_back(exact.insert(exact_position(mesh, s.at)));
  const BruteForce truth(exact);
  std::vector<std::vector<std::optional<Mpfr>>> waves;
  for (std::size_t s = 0; s < sources.size(); ++s) waves.push_back(truth.from(roots[s], sources[s].weight));
  const auto solution = solve(mesh, sources, test::distances_only());
  if (certified) {
    EXPECT_TRUE(test::is_certified(solution));
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    std::optional<Mpfr> least;
    for (const auto& wave : waves)
      if (wave[v] && (!least || *wave[v] < *least)) least = *wave[v];
    EXPECT_EQ(solution.distance(v), least ? least->to_double() : std::numeric_limits<double>::infinity()) << "vertex " << v;
    if (solution.status() != Status::certified) continue;
    std::vector<SourceId> nearest;
    for (SourceId s = 0; s < sources.size(); ++s)
      if (waves[s][v] && BruteForce::same(*waves[s][v], *least)) nearest.push_back(s);
    EXPECT_EQ(std::vector<SourceId>(solution.nearest(v).begin(), solution.nearest(v).end()), nearest) << "vertex " << v;
  }
}

std::vector<Source> random_sources(const Mesh& mesh, Random& random, std::uint32_t count, bool weighted) {
  std::vector<Source> sources;
  for (std::uint32_t i = 0; i < count; ++i) {
    sources.push_back(random_source(mesh, random, weighted ? random.uniform(0, 1.5) : 0));
  }
  return sources;
}

TEST(BruteForceDistance, RandomTerrains) {
  Random random(21);
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const double relief = std::array{0.2, 1.0, 3.0, 10.0}[seed % 4];
    const Mesh mesh(test::random_terrain(4, relief, 300 + seed));
    expect_brute_force(mesh, random_sources(mesh, random, 1 + seed % 3, false), "terrain " + std::to_string(seed));
  }
}

TEST(BruteForceDistance, WeightedSources) {
  Random random(22);
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Mesh mesh(test::random_terrain(4, 1.5, 400 + seed));
    expect_brute_force(mesh, random_sources(mesh, random, 3, true), "terrain " + std::to_string(seed));
  }
}

TEST(BruteForceDistance, FractalTerrains) {
  Random random(23);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Mesh mesh(test::fractal_terrain(2, 2, 0.7, 500 + seed));
    expect_brute_force(mesh, random_sources(mesh, random, 2, false), "terrain " + std::to_string(seed));
  }
}

TEST(BruteForceDistance, ClosedSurfaces) {
  Random random(24);
  const Mesh fine(test::cube(2)), cube(test::cube(1)), box(test::box({1, 2, 3}, {1, 1, 2}));
  expect_brute_force(fine, {at_vertex(fine, 0)}, "fine cube");
  for (int round = 0; round < 3; ++round) {
    expect_brute_force(cube, random_sources(cube, random, 1, false), "cube " + std::to_string(round));
    expect_brute_force(box, random_sources(box, random, 2, false), "box " + std::to_string(round));
  }
}

TEST(BruteForceDistance, IntegerTerrains) {
  // Exact ties abound; what nothing decides may be listed, the distances are right all the same.
  Random random(25);
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Mesh mesh(test::integer_terrain(4, 3, 600 + seed));
    expect_brute_force(mesh, random_sources(mesh, random, 2, false), "terrain " + std::to_string(seed), false);
  }
}

TEST(BruteForceDistance, Saddles) {
  for (const Mesh& mesh : {Mesh(test::saddle_fan(4, 0.8)), Mesh(test::integer_saddle(1)), Mesh(test::integer_saddle(2))}) {
    Random random(26);
    for (int round = 0; round < 4; ++round) expect_brute_force(mesh, random_sources(mesh, random, 2, false), "saddle", false);
  }
}

/// Fig. 5 of the article: one saddle whose faces unfold round it. The folder is not part of the repository.
TEST(BruteForceDistance, ArticleFigure5) {
  const char* const folder = std::getenv("GVD_TEST_DATA");
  const auto path = folder == nullptr ? std::filesystem::path() : std::filesystem::path(folder) / "topographic_bump_of_saddle.vtk";
  if (folder == nullptr || !std::filesystem::exists(path))
    GTEST_SKIP() << "topographic_bump_of_saddle.vtk is not in $GVD_TEST_DATA";
  const Mesh mesh(io::read_mesh(path));
  Random random(27);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) expect_brute_force(mesh, {at_vertex(mesh, v)}, "vertex " + std::to_string(v));
  for (int round = 0; round < 6; ++round)
    expect_brute_force(mesh, random_sources(mesh, random, 2, false), "round " + std::to_string(round));
}

}  // namespace
}  // namespace gvd::kernel
