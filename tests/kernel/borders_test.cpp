// Borders of label sets followed by doubles alone, against the whole tessellation of the same facets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "../support/field_facets.hpp"
#include "../support/meshes.hpp"
#include "../support/surface_points.hpp"
#include "gvd/io/mesh_reader.hpp"
#include "gvd/kernel/random_sources.hpp"
#include "gvd/kernel/tessellation.hpp"

namespace gvd::kernel {
namespace {

using Node = FacetTessellation::Node;
using Piece = FacetTessellation::Piece;

/// What tells a node from the others, and where it is.
struct Point {
  std::vector<std::uint32_t> sites;
  Node::Kind kind;
  robust::Ball<double> x, y;
};

Point point(const Node& node) {
  Point p{node.sites, node.kind, node.x, node.y};
  std::sort(p.sites.begin(), p.sites.end());
  return p;
}

bool overlap(const robust::Ball<double>& a, const robust::Ball<double>& b) { return a.lower() <= b.upper() && b.lower() <= a.upper(); }

bool is_same(const Point& a, const Point& b) { return a.kind == b.kind && a.sites == b.sites && overlap(a.x, b.x) && overlap(a.y, b.y); }

struct Border {
  std::uint32_t left, right;
  Point from, to;
};

std::vector<Border> borders(const FacetWaves& waves, const FacetTessellation& t) {
  std::vector<Border> all;
  for (const auto& arc : t.arcs)
    if (waves.sites[arc.left].labels != waves.sites[arc.right].labels)
      all.push_back({arc.left, arc.right, point(t.nodes[arc.from]), point(t.nodes[arc.to])});
  return all;
}

bool is_same(const Border& a, const Border& b) {
  return (a.left == b.left && a.right == b.right && is_same(a.from, b.from) && is_same(a.to, b.to)) ||
         (a.left == b.right && a.right == b.left && is_same(a.from, b.to) && is_same(a.to, b.from));
}

/// The label sets met along each side, one entry where it stays the same.
std::vector<std::pair<int, LabelSetId>> label_sequence(const FacetWaves& waves, const FacetTessellation& t) {
  std::vector<std::pair<int, LabelSetId>> sequence;
  for (const Piece& piece : t.outline) {
    const std::pair<int, LabelSetId> entry{piece.side, waves.sites[piece.site].labels};
    if (sequence.empty() || sequence.back() != entry) sequence.push_back(entry);
  }
  return sequence;
}

struct Counts {
  std::size_t facets = 0, followed = 0, borders = 0, inner = 0, uniform = 0;
};

void compare(FieldWaves& waves, Counts& counts) {
  predicates::Decisions of_borders, of_all;
  const FacetTessellation part = tessellate_borders(waves, of_borders);
  const FacetTessellation whole = tessellate(waves, of_all);
  ++counts.facets;
  if (!part.borders_only || whole.undecided) return;
  ++counts.followed;
  EXPECT_EQ(of_borders.total(robust::Stage::undecided), 0u);
  EXPECT_EQ(label_sequence(waves, part), label_sequence(waves, whole)) << "facet " << waves.face;
  const auto found = borders(waves, part), truth = borders(waves, whole);
  EXPECT_EQ(found.size(), part.arcs.size()) << "an arc between equal label sets, facet " << waves.face;
  EXPECT_EQ(found.size(), truth.size()) << "facet " << waves.face;
  EXPECT_TRUE(std::is_permutation(found.begin(), found.end(), truth.begin(), truth.end(),
                                  [](const Border& a, const Border& b) { return is_same(a, b); }))
      << "facet " << waves.face;
  counts.borders += found.size();
  counts.uniform += found.empty() ? 1 : 0;
  for (const Node& node : part.nodes) counts.inner += node.kind == Node::Kind::inside ? 1 : 0;
}

void print(const char* name, const Counts& c) {
  std::printf("%s: %zu of %zu facets, %zu borders, %zu inner nodes, %zu facets without any\n", name, c.followed, c.facets, c.borders, c.inner,
              c.uniform);
}

TEST(Borders, OfRandomTerrainsAreThoseOfTheTessellation) {
  Counts counts;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Mesh mesh(test::random_terrain(9, seed % 2 == 0 ? 0.6 : 4, seed));
    const test::FieldFacets field(mesh, random_surface_sources(mesh, 6 + 3 * static_cast<std::uint32_t>(seed % 3), seed));
    field.for_each_boundary_facet([&](FieldWaves& waves) { compare(waves, counts); });
  }
  print("terrains", counts);
  EXPECT_GT(counts.followed, counts.facets * 8 / 10);
  EXPECT_GT(counts.borders, 1000u);
  EXPECT_GT(counts.inner, 300u);
  EXPECT_GT(counts.uniform, 20u);
}

// Ties are not for doubles: where waves of several label sets attain a corner, or tie along a side, the whole tessellation is made.
TEST(Borders, TiedFacetsAreTessellated) {
  Counts counts;
  const Mesh mesh(test::flat_grid(6, 6, test::Diagonal::rising));
  const test::FieldFacets field(mesh, {test::vertex_source(mesh, 0), test::vertex_source(mesh, 6), test::vertex_source(mesh, 42), test::vertex_source(mesh, 48)});
  field.for_each_boundary_facet([&](FieldWaves& waves) { compare(waves, counts); });
  print("flat grid", counts);
  EXPECT_GT(counts.facets, 8u);
  EXPECT_LT(counts.followed, counts.facets);
}

TEST(Borders, OfStHelensAreThoseOfTheTessellation) {
  const char* const folder = std::getenv("GVD_TEST_DATA");
  const auto path = std::filesystem::path(folder == nullptr ? "" : folder) / "st_helens_tin.vtk";
  if (folder == nullptr || !std::filesystem::exists(path)) GTEST_SKIP() << "st_helens_tin.vtk is not in $GVD_TEST_DATA";
  const Mesh mesh(io::read_mesh(path));
  const test::FieldFacets field(mesh, random_surface_sources(mesh, 100, 3));
  Counts counts;
  field.for_each_boundary_facet([&](FieldWaves& waves) { compare(waves, counts); });
  print("St Helens", counts);
  EXPECT_GT(counts.followed, counts.facets * 9 / 10);
}

}  // namespace
}  // namespace gvd::kernel
