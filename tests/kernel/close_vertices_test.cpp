#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "support/truth.hpp"

/// Sources a few roundings away from a vertex or an edge of their face.
namespace gvd::kernel {
namespace {

Source in_face(const Mesh& mesh, FaceId face, const std::array<double, 3>& weights, double weight) {
  return {point_in_face(mesh, face, {mpq_class(weights[0]), mpq_class(weights[1]), mpq_class(weights[2])}), weight};
}

TEST(CloseVertices, DoNotStartOneAnotherAnewWithoutEnd) {
  // Found by fuzzing: the errors of the distances are larger than the lengths of the edges between the vertices.
  const test::MeshArrays arrays{
      {{0, 0, 0.6183791283850657}, {1, 0, 0.2401688058210767},   {2, 0, 0.355871481752843},    {4, 0, 0.8937850917403974},
       {5, 0, 0.8731528746183321}, {6, 0, 0.34156749703644196},  {0, 1, 0.3743148107010965},   {1, 1, 0.9522589592154977},
       {2, 1, 0.7312204628116413}, {3, 1, 0.036780451136788295}, {4, 1, 0.034317673709400864}, {5, 1, 0.5657493951613488},
       {6, 1, 0.9895031064137727}, {0, 2, 0.03402129426518885},  {1, 2, 0.05794959709853709},  {2, 2, 0.0734693133619686},
       {3, 2, 0.7580477467023521}, {4, 2, 0.9779980063573476},   {5, 2, 0.6113452380294746},   {6, 2, 0.13072966578813594}},
      {{0, 1, 7},   {0, 7, 6},   {1, 2, 8},    {1, 8, 7},    {3, 4, 11},   {3, 11, 10}, {4, 5, 12},
       {4, 12, 11}, {6, 7, 14},  {6, 14, 13},  {7, 8, 15},   {7, 15, 14},  {8, 9, 16},  {8, 16, 15},
       {9, 10, 17}, {9, 17, 16}, {10, 11, 18}, {10, 18, 17}, {11, 12, 19}, {11, 19, 18}}};
  const Mesh mesh(arrays);
  const std::vector<Source> sources = {
      in_face(mesh, 12, {3.051757812500001e-05, 1, 0}, 0.5), in_face(mesh, 3, {0, 1, 3.5527136788005005e-15}, 1),
      in_face(mesh, 1, {1, 0.00048828125, 0}, 0.25), in_face(mesh, 19, {1, 1.8189894035458573e-12, 0}, 0)};
  const auto solution = solve(mesh, sources);
  EXPECT_LT(solution.summary().windows_propagated, 1000u);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) EXPECT_LT(solution.distance(v), 10);
}

TEST(CloseVertices, APathDoesNotComeBackToItsSource) {
  // A needle with a source within doubles of its tip: straight lines wind round the tip, and round both, hundreds of times.
  test::MeshArrays needle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {}};
  needle.points[0][2] = 3000;
  for (std::uint32_t i = 0; i < 4; ++i) needle.faces.push_back({0, 1 + i, 1 + (i + 1) % 4});
  const Mesh mesh(needle);
  const std::vector<Source> sources = {in_face(mesh, 0, {1, 0x1p-60, 0x1p-61}, 0), in_face(mesh, 1, {1, 0x1p-58, 0}, 0)};
  SolveOptions options;
  options.diagram = false;
  const auto solution = solve(mesh, sources, options);
  ASSERT_TRUE(test::is_certified(solution));
  EXPECT_LT(solution.summary().windows_propagated, 1000u);
}

TEST(CloseVertices, CellsOfTwoSourcesInOneFacetHaveAnArea) {
  // Doubles cannot construct the points of their bisector.
  const Mesh mesh(test::MeshArrays{{{6, 53, 0}, {7, 53, 0}, {7, 54, 0}, {6, 54, 0}}, {{0, 1, 2}, {0, 2, 3}}});
  const std::vector<Source> sources = {in_face(mesh, 0, {0.5, 0, 0.5}, 0), in_face(mesh, 0, {0.5 - 0x1p-50, 0x1p-50, 0.5}, 0)};
  const auto solution = solve(mesh, sources);
  ASSERT_TRUE(test::is_certified(solution));
  for (const Cell& cell : solution.diagram().cells) EXPECT_NEAR(cell.area, 0.5, 1e-12);
}

TEST(CloseVertices, TheirOrderIsKnownToAnyNumberOfBits) {
  // A source between two others that reach it with 2^-150 and 2^-149 more than their weights, which pairs of doubles do not see: it is hidden, in
  // whichever order they are named.
  const Mesh mesh(test::MeshArrays{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}});
  const mpq_class step = mpq_class(1) >> 150, half(1, 2), quarter(1, 4);
  const auto source = [&](int steps, double weight) { return Source{point_in_face(mesh, 0, {half + steps * step, quarter - steps * step, quarter}), weight}; };
  std::vector<SourceId> order = {0, 1, 2};  // the first one, the second one, the hidden one
  do {
    std::vector<Source> sources(3);
    sources[order[0]] = source(0, 1), sources[order[1]] = source(3, 1), sources[order[2]] = source(1, 2);
    const auto solution = solve(mesh, sources);
    ASSERT_TRUE(test::is_certified(solution));
    EXPECT_EQ(solution.summary().cells, 2u);
    const std::array<SourceId, 3> nearest = {order[1], order[0], order[0]};
    for (VertexId v = 0; v < 3; ++v) EXPECT_EQ(std::vector(solution.nearest(v).begin(), solution.nearest(v).end()), std::vector{nearest[v]});
    EXPECT_GT(solution.decisions()(static_cast<std::size_t>(predicates::Predicate::vertex_distance), robust::Stage::mpfr), 0u);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(CloseVertices, NobodyGuessesTheirOrder) {
  // As above, closer than error bounds of doubles allow for, which is said, and at last too close for 1024 bits, too: then the order is listed as open.
  const Mesh mesh(test::MeshArrays{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}});
  for (const unsigned bits : {190u, 400u, 900u, 1030u}) {
    SCOPED_TRACE(bits);
    const mpq_class step = mpq_class(1) >> bits, half(1, 2), quarter(1, 4);
    const auto source = [&](int steps, double weight) { return Source{point_in_face(mesh, 0, {half + steps * step, quarter - steps * step, quarter}), weight}; };
    const auto solution = solve(mesh, {source(0, 1), source(3, 1), source(1, 2)}, test::distances_only());
    EXPECT_EQ(solution.status(), bits < 200 ? Status::certified : Status::undecided);
    const auto open = solution.decisions()(static_cast<std::size_t>(predicates::Predicate::vertex_distance), robust::Stage::undecided);
    EXPECT_EQ(open > 0, bits > 800);
    const std::array<SourceId, 3> nearest = {1, 0, 0};
    for (VertexId v = 0; v < 3; ++v) {
      const auto told = solution.nearest(v);
      EXPECT_NE(std::find(told.begin(), told.end(), nearest[v]), told.end()) << v;
    }
  }
}

TEST(CloseVertices, AHiddenSourceBesideAVertexChangesNothing) {
  // Doubles do not tell which of the two is nearer. Where the vertex relays and goes first, what it has sent is to be sent again when the other one shows a second path to it.
  const Mesh mesh(test::random_terrain(6, 1.5, 11));
  const auto plain = solve(mesh, {test::at_vertex(mesh, 0)}, test::distances_only());
  for (VertexId v = 1; v < mesh.vertex_count(); ++v) {
    SCOPED_TRACE(v);
    std::vector<VertexId> neighbours;
    mesh.for_each_outgoing(v, [&](HalfedgeId h) { neighbours.push_back(mesh.target(h)); });
    for (const VertexId to : neighbours) {
      const auto solution = solve(mesh, {test::at_vertex(mesh, 0), {point_on_edge(mesh, v, to, mpq_class(1) >> 58), 1000}}, test::distances_only());
      ASSERT_TRUE(test::is_certified(solution));
      for (VertexId u = 0; u < mesh.vertex_count(); ++u) EXPECT_EQ(solution.distance(u), plain.distance(u)) << u;
    }
    if (HasFailure()) return;
  }
}

TEST(CloseVertices, WhatADoubleCannotSayOfAPositionIsNotLeftOut) {
  // Beside a vertex of a tiny mesh positions have 24 bits, and what is left of them is below the least double. One source is 1e-4 of their last bit
  // nearer, and would be 1.2 farther if both were rounded.
  constexpr double k = 0x1p-900;
  const Mesh mesh(test::MeshArrays{{{0, 0, 0}, {k, 0, 0}, {0, k, 0}, {-k, 0, 0}, {0, -k, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}});
  const std::vector<Source> sources = {in_face(mesh, 0, {0x1p181, 2147609151, 0}, 0), in_face(mesh, 0, {0x1p181, 1518588994, 1518588994}, 0)};
  SolveOptions options;
  options.diagram = false;
  const auto solution = solve(mesh, sources, options);
  ASSERT_TRUE(test::is_certified(solution));
  ASSERT_EQ(solution.nearest(0).size(), 1u);
  EXPECT_EQ(solution.nearest(0)[0], 1u);
}

}  // namespace
}  // namespace gvd::kernel
