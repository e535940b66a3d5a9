#pragma once

#include <cstdint>

#include "gvd/kernel/mesh.hpp"

namespace gvd::bench {

/// A rough terrain of about `faces` triangles: value noise over five octaves on a square grid whose points are moved at random by
/// less than a quarter of a cell, each quadrilateral cut by its shorter diagonal. Deterministic: only the four operations, square
/// roots and integers. `cell` is 20 m, heights span some hundred metres; about six in ten inner vertices are saddles, as in TINs of
/// real mountains.
kernel::MeshArrays generated_terrain(std::uint32_t faces, std::uint64_t seed);

}  // namespace gvd::bench
