#pragma once

#include <cstdint>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/source.hpp"

namespace gvd::kernel {

/// More random sources than this are refused.
inline constexpr std::uint64_t kMostRandomSources = 10'000'000;

/// `count` points, independent and uniform over the area of the surface, all strictly inside faces, with weight 0.
/// A face is drawn with the probability of its area in doubles, then a point of a grid in it whose barycentric coordinates 1 and 2
/// are odd multiples of 2^-21: a million steps along a side, and short rationals for the exact arithmetic on them. The same on
/// every machine: only IEEE + - * / and sqrt, scaling by powers of two, and `RandomGenerator`. It depends on the order of the faces
/// and of their corners. Throws InputError if count is 0 or too large, or if every face is so thin that its area underflows. Pre:
/// the mesh is not refined. Cost: O(faces + count log faces).
std::vector<Source> random_surface_sources(const Mesh& mesh, std::uint64_t count, std::uint64_t seed);

/// `count` distinct vertices that belong to faces, every choice with the same probability, in random order, with weight 0.
/// Throws InputError if count is 0 or there are fewer such vertices. Cost: O(vertices).
std::vector<Source> random_vertex_sources(const Mesh& mesh, std::uint64_t count, std::uint64_t seed);

}  // namespace gvd::kernel
