#pragma once

#include <optional>

#include "gvd/kernel/facet.hpp"
#include "gvd/kernel/mesh.hpp"

namespace gvd::kernel {

/// Whether two waves, sites of two facets at vertex v, have one image once the faces round v are unfolded counter-clockwise from
/// the facet of `a` to that of `b`. Decided by algebra; empty where the faces and strips cross too many square classes, or the
/// boundary lies between. Pre: v is a corner of both facets.
std::optional<bool> have_one_image_round(const Mesh& mesh, VertexId v, FacetWaves& a, std::uint32_t site_a, FacetWaves& b,
                                         std::uint32_t site_b);

}  // namespace gvd::kernel
