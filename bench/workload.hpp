#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/source.hpp"

namespace gvd::bench {

/// A random point of a face, in barycentric coordinates of its corners as `Mesh` orders them.
struct FacePoint {
  kernel::FaceId face;
  std::array<double, 3> bary;  ///< the last one rounded: exactly it is 1 - bary[0] - bary[1]
};

/// Points that are uniform by area, always the same for the same mesh, number and seed.
std::vector<FacePoint> random_points(const kernel::Mesh& mesh, std::uint32_t count, std::uint64_t seed);

/// The same points as sources of the library.
std::vector<kernel::Source> as_sources(const std::vector<FacePoint>& points);

/// The article's St Helens TIN if the environment variable GVD_TEST_DATA names its folder, else a generated terrain of its size.
const kernel::Mesh& st_helens();
/// "St Helens TIN" or "generated terrain": which of the two it is.
std::string st_helens_name();

/// A generated terrain, made once and kept until another size is asked for.
const kernel::Mesh& terrain(std::uint32_t faces);

}  // namespace gvd::bench
