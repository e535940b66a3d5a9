#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "gvd/io/mesh_reader.hpp"
#include "gvd/kernel/random_sources.hpp"
#include "gvd/kernel/tessellation.hpp"
#include "support/facet_reference.hpp"
#include "support/field_facets.hpp"
#include "support/meshes.hpp"

/// Facets as they occur on terrains, against every pair and every triple of their waves (support/facet_reference.hpp).
namespace gvd::kernel {
namespace {

struct Counts {
  std::size_t facets = 0, vertices = 0, singularities = 0, undecided = 0;
  std::size_t relay_regions = 0;  ///< of relays at a corner
  std::size_t corner_only = 0;    ///< those that touch the facet in their corner only
};

/// Regions of corner sites, and those of them without a piece of the outline.
void count_relays(const FacetWaves& waves, const FacetTessellation& t, Counts& counts) {
  std::set<std::uint32_t> has_arc, on_outline;
  for (const auto& arc : t.arcs) has_arc.insert({arc.left, arc.right});
  for (const auto& piece : t.outline) on_outline.insert(piece.site);
  for (const std::uint32_t site : has_arc) {
    if (waves.sites[site].corner == FacetSite::kNoCorner) continue;
    ++counts.relay_regions;
    if (on_outline.count(site) == 0) ++counts.corner_only;
  }
}

/// Tessellates up to `most` boundary facets; checks each if `with_reference` (some 0.1 s a facet).
Counts tessellate_facets(const Mesh& mesh, const std::vector<Source>& sources, std::size_t most, bool with_reference) {
  const test::FieldFacets field(mesh, sources);
  Counts counts;
  field.for_each_boundary_facet([&](FieldWaves& waves) {
    if (counts.facets == most) return;
    predicates::Decisions decisions;
    const FacetTessellation t = tessellate(waves, decisions);
    if (t.undecided) {
      ++counts.undecided;
      return;
    }
    ++counts.facets;
    count_relays(waves, t, counts);
    if (!with_reference) return;
    const test::FacetReference reference(waves);
    EXPECT_EQ(reference.check(t), "") << "facet " << waves.face;
    counts.vertices += reference.inside_count();
    counts.singularities += reference.side_count();
  });
  return counts;
}

void print(const char* name, const Counts& c) {
  std::printf("%s: %zu facets, %zu vertices, %zu singularities, %zu regions of corner relays, %zu of them touch the facet there only\n", name,
              c.facets, c.vertices, c.singularities, c.relay_regions, c.corner_only);
}

TEST(RealFacets, OfRandomTerrainsHaveTheBruteForceTessellation) {
  Counts all;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Mesh mesh(test::fractal_terrain(3, 4, 0.6, seed));
    const Counts c = tessellate_facets(mesh, random_surface_sources(mesh, 8, seed), 60, true);
    EXPECT_EQ(c.undecided, 0u) << "seed " << seed;
    all.facets += c.facets, all.vertices += c.vertices, all.singularities += c.singularities;
    all.relay_regions += c.relay_regions, all.corner_only += c.corner_only;
  }
  print("terrains", all);
  EXPECT_GT(all.facets, 100u);
  EXPECT_GT(all.vertices, 50u);
  EXPECT_GT(all.singularities, 200u);
  EXPECT_GT(all.relay_regions, 20u);
}

// A relay's shadow that other waves close before it meets another side: it owns an inner part of the facet, but of the outline one corner only.
TEST(RealFacets, ARegionMayTouchItsFacetAtARelayOnly) {
  Counts all;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Mesh mesh(test::random_terrain(6, 4, seed));
    const Counts c = tessellate_facets(mesh, random_surface_sources(mesh, 12, seed), 1000, false);
    all.facets += c.facets, all.relay_regions += c.relay_regions, all.corner_only += c.corner_only;
    EXPECT_EQ(c.undecided, 0u) << "seed " << seed;
  }
  print("rough terrains", all);
  EXPECT_GT(all.relay_regions, 100u);
  EXPECT_GT(all.corner_only, 3u);
}

TEST(RealFacets, OfStHelensHaveTheBruteForceTessellation) {
  const char* const folder = std::getenv("GVD_TEST_DATA");
  const auto path = std::filesystem::path(folder == nullptr ? "" : folder) / "st_helens_tin.vtk";
  if (folder == nullptr || !std::filesystem::exists(path)) GTEST_SKIP() << "st_helens_tin.vtk is not in $GVD_TEST_DATA";
  const Mesh mesh(io::read_mesh(path));
  const Counts c = tessellate_facets(mesh, random_surface_sources(mesh, 100, 3), 30, true);
  print("St Helens", c);
  EXPECT_EQ(c.undecided, 0u);
  EXPECT_EQ(c.facets, 30u);
  EXPECT_GT(c.singularities, 60u);
}

}  // namespace
}  // namespace gvd::kernel
