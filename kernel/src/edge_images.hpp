#pragma once

#include "gvd/kernel/facet.hpp"
#include "gvd/kernel/resolution.hpp"

namespace gvd::kernel {

/// Whether a wave of the facet of half-edge h and one of the facet of its twin are as far all along the edge, by algebra of the strips: their roots are as
/// far, and their images are one or mirror images in the edge. True is a proof, false says nothing.
bool are_as_far_along(const Resolution& resolution, HalfedgeId h, const FacetSite& left, const FacetSite& right);

}  // namespace gvd::kernel
