#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "gvd/kernel/solver.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "gvd/robust/rational.hpp"
#include "gvd/robust/root_sum.hpp"
#include "meshes.hpp"

/// Distances known by other means than the kernel's, and the comparison with what it says.
namespace gvd::test {

using ExactPoint2 = std::array<mpq_class, 2>;

inline mpq_class square(const mpq_class& x) { return x * x; }

inline robust::RootSum planar_distance(const ExactPoint2& a, const ExactPoint2& b) {
  return {1, square(a[0] - b[0]) + square(a[1] - b[1])};
}

inline kernel::SolveOptions distances_only() {
  kernel::SolveOptions options;
  options.diagram = false;
  return options;
}

/// Whether everything was proved; if not, what was not.
inline testing::AssertionResult is_certified(const kernel::Solution& solution) {
  if (solution.status() == kernel::Status::certified) return testing::AssertionSuccess();
  auto result = testing::AssertionFailure() << kernel::status_name(solution.status());
  const auto& list = solution.decisions().undecided_list();
  for (std::size_t i = 0; i < std::min<std::size_t>(list.size(), 10); ++i) result << "\n  " << list[i];
  return result;
}

/// The distance of vertex v from source s, its weight not counted.
using DistanceTruth = std::function<robust::RootSum(kernel::VertexId v, std::size_t s)>;

/// Expects that the distance of each vertex is the correctly rounded least of `truth` plus weight, that its nearest sources are
/// exactly those which attain it, and that nothing was left undecided.
inline void expect_truth(const kernel::Mesh& mesh, const std::vector<kernel::Source>& sources, const DistanceTruth& truth,
                         const std::string& what = "") {
  SCOPED_TRACE(what);
  const auto solution = kernel::solve(mesh, sources, distances_only());
  EXPECT_TRUE(is_certified(solution));
  int shown = 0;
  for (kernel::VertexId v = 0; v < mesh.vertex_count() && shown < 5; ++v) {
    robust::RootSum least;
    std::vector<kernel::SourceId> nearest;
    for (std::size_t s = 0; s < sources.size(); ++s) {
      auto distance = truth(v, s) + robust::RootSum(robust::exact_rational(sources[s].weight));
      const auto sign = nearest.empty() ? robust::Sign::negative : compare(distance, least);
      if (sign == robust::Sign::positive) continue;
      if (sign == robust::Sign::negative) nearest.clear(), least = std::move(distance);
      nearest.push_back(static_cast<kernel::SourceId>(s));
    }
    EXPECT_EQ(solution.distance(v), least.rounded()) << "vertex " << v;
    const auto enclosure = solution.distance_enclosure(v);
    EXPECT_LE(robust::exact_rational(enclosure.low), robust::exact_rational(enclosure.high));
    EXPECT_NE(compare(robust::RootSum(robust::exact_rational(enclosure.low)), least), robust::Sign::positive) << "vertex " << v;
    EXPECT_NE(compare(robust::RootSum(robust::exact_rational(enclosure.high)), least), robust::Sign::negative) << "vertex " << v;
    const auto told = solution.nearest(v);
    EXPECT_EQ(std::vector<kernel::SourceId>(told.begin(), told.end()), nearest) << "vertex " << v;
    if (testing::Test::HasFailure()) ++shown;
  }
}

/// A flat grid of unit squares on [0, nx] x [0, ny] whose inner vertices are moved by up to `amount` < 0.3 in x and y, those on the
/// sides along their side; corners stay. Alternating diagonals, z = 0.
inline MeshArrays jittered_grid(std::uint32_t nx, std::uint32_t ny, double amount, std::uint64_t seed) {
  Random random(seed);
  MeshArrays mesh = flat_grid(nx, ny, Diagonal::alternating);
  for (std::uint32_t j = 0; j <= ny; ++j) {
    for (std::uint32_t i = 0; i <= nx; ++i) {
      Point& p = mesh.points[j * (nx + 1) + i];
      if (i > 0 && i < nx) p[0] += random.uniform(-amount, amount);
      if (j > 0 && j < ny) p[1] += random.uniform(-amount, amount);
    }
  }
  return mesh;
}

inline kernel::Source at_vertex(const kernel::Mesh& mesh, kernel::VertexId v, double weight = 0) {
  return {kernel::point_at_vertex(mesh, v), weight};
}

/// A source strictly inside face f with random barycentric coordinates, multiples of 2^-10.
inline kernel::Source inside_face(const kernel::Mesh& mesh, kernel::FaceId f, Random& random, double weight = 0) {
  const long a = 1 + random.below(1000), b = 1 + random.below(1000), c = 1 + random.below(1000);
  return {kernel::point_in_face(mesh, f, {mpq_class(a), mpq_class(b), mpq_class(c)}), weight};
}

/// A source strictly inside the edge of half-edge h, at a multiple of 1/16.
inline kernel::Source inside_edge(const kernel::Mesh& mesh, kernel::HalfedgeId h, Random& random, double weight = 0) {
  mpq_class t(1 + random.below(15), 16);
  t.canonicalize();
  return {kernel::point_on_edge(mesh, mesh.origin(h), mesh.target(h), t), weight};
}

/// A source at a vertex, inside an edge or inside a face.
inline kernel::Source random_source(const kernel::Mesh& mesh, Random& random, double weight = 0) {
  switch (random.below(3)) {
    case 0:
      return at_vertex(mesh, random.below(mesh.vertex_count()), weight);
    case 1:
      return inside_edge(mesh, random.below(mesh.halfedge_count()), random, weight);
    default:
      return inside_face(mesh, random.below(mesh.face_count()), random, weight);
  }
}

}  // namespace gvd::test
