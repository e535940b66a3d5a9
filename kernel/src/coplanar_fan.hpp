#pragma once

#include "gvd/kernel/mesh.hpp"

namespace gvd::kernel {

/// A quick proof that the faces at v lie in one plane, are turned the same way there, and, at a boundary vertex, begin and end on
/// one line through v. Then the total angle is a multiple of 2 pi (interior) or of pi (boundary). False means nothing.
/// Pre: that angle is known to be less than a quarter turn off 2 pi or pi (so numbers are in range). Needs differences from v that are exact in double and either lie in a plane across an axis or
/// are multiples of one power of two, less than 2^40 of it. Cost: some 100 nanoseconds. This spares lakes and flat meshes the
/// exact stages.
bool is_certainly_straight_coplanar_fan(const Mesh& mesh, VertexId v);

}  // namespace gvd::kernel
