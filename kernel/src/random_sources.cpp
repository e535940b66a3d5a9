#include "gvd/kernel/random_sources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "gvd/kernel/error.hpp"
#include "gvd/kernel/random_generator.hpp"
#include "gvd/kernel/surface_point.hpp"

namespace gvd::kernel {
namespace {

/// Half the vector from vertex a to b: the difference of two doubles may overflow, that of their halves cannot.
Point half_edge_vector(const Mesh& mesh, VertexId a, VertexId b) {
  const Point &p = mesh.point(a), &q = mesh.point(b);
  return {q[0] * 0.5 - p[0] * 0.5, q[1] * 0.5 - p[1] * 0.5, q[2] * 0.5 - p[2] * 0.5};
}

/// The power of two of the longest coordinate difference along a side of a face.
int scale_exponent(const Mesh& mesh) {
  double largest = 0;
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    for (const double d : half_edge_vector(mesh, mesh.origin(h), mesh.target(h))) largest = std::max(largest, std::abs(d));
  }
  return largest > 0 ? std::ilogb(largest) : 0;
}

/// Sums of the faces' areas, in their order, up to a common factor.
std::vector<double> area_sums(const Mesh& mesh) {
  const int exponent = scale_exponent(mesh);
  std::vector<double> sums(mesh.face_count());
  double sum = 0;
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    Point d = half_edge_vector(mesh, mesh.origin(3 * f), mesh.origin(3 * f + 1));
    Point e = half_edge_vector(mesh, mesh.origin(3 * f), mesh.origin(3 * f + 2));
    for (std::size_t i = 0; i < 3; ++i) {
      d[i] = std::ldexp(d[i], -exponent);
      e[i] = std::ldexp(e[i], -exponent);
    }
    const double x = d[1] * e[2] - d[2] * e[1], y = d[2] * e[0] - d[0] * e[2], z = d[0] * e[1] - d[1] * e[0];
    sum += std::sqrt(x * x + y * y + z * z);
    sums[f] = sum;
  }
  return sums;
}

/// Uniform on the points of the grid that lie strictly inside the face: those of the unit square, folded over its diagonal.
SurfacePoint random_point(FaceId face, RandomGenerator& random) {
  constexpr int kBits = 20;
  constexpr std::uint32_t kSteps = 1u << kBits;
  std::uint32_t i = 0, j = 0;
  do {
    i = static_cast<std::uint32_t>(random.bits(kBits));
    j = static_cast<std::uint32_t>(random.bits(kBits));
  } while (i + j + 1 == kSteps);  // on the diagonal
  if (i + j + 1 > kSteps) {
    i = kSteps - 1 - i;
    j = kSteps - 1 - j;
  }
  SurfacePoint at;
  at.face = face;
  at.bary[1] = mpq_class(2 * i + 1, 2 * kSteps);
  at.bary[2] = mpq_class(2 * j + 1, 2 * kSteps);
  at.bary[0] = 1 - at.bary[1] - at.bary[2];
  return at;
}

void check_count(std::uint64_t count) {
  if (count == 0) throw InputError("the number of random sources is 0");
  if (count > kMostRandomSources) {
    throw InputError(fmt::format("{} random sources are too many (at most {})", count, kMostRandomSources));
  }
}

}  // namespace

std::vector<Source> random_surface_sources(const Mesh& mesh, std::uint64_t count, std::uint64_t seed) {
  check_count(count);
  const std::vector<double> sums = area_sums(mesh);
  if (sums.empty() || !(sums.back() > 0)) throw InputError("the faces are too thin for random sources: their areas underflow");
  RandomGenerator random(seed);
  std::vector<Source> sources;
  sources.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double target = static_cast<double>(random.bits(53)) * 0x1p-53 * sums.back();
    const auto drawn = std::min(std::upper_bound(sums.begin(), sums.end(), target), sums.end() - 1);
    sources.push_back({random_point(static_cast<FaceId>(drawn - sums.begin()), random), 0});
  }
  return sources;
}

std::vector<Source> random_vertex_sources(const Mesh& mesh, std::uint64_t count, std::uint64_t seed) {
  check_count(count);
  std::vector<VertexId> vertices;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_isolated(v)) vertices.push_back(v);
  }
  if (count > vertices.size()) {
    throw InputError(fmt::format("{} random vertices are asked for, but only {} belong to faces", count, vertices.size()));
  }
  RandomGenerator random(seed);
  std::vector<Source> sources;
  sources.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {  // the beginning of a shuffle
    std::swap(vertices[i], vertices[i + random.below(vertices.size() - i)]);
    sources.push_back({point_at_vertex(mesh, vertices[i]), 0});
  }
  return sources;
}

}  // namespace gvd::kernel
