#pragma once

#include <cstdint>
#include <string>

#include "gvd/kernel/mesh.hpp"

namespace gvd::bench {

/// The article's St Helens TIN if the environment variable GVD_TEST_DATA names its folder, else a generated terrain of its size.
const kernel::MeshArrays& st_helens_arrays();
const kernel::Mesh& st_helens();
/// "St Helens TIN" or "generated terrain": which of the two it is.
std::string st_helens_name();

/// A generated terrain, made once and kept until another size is asked for.
const kernel::MeshArrays& terrain(std::uint32_t faces);

}  // namespace gvd::bench
