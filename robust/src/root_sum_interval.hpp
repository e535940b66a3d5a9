#pragma once

#include "gvd/robust/root_sum.hpp"
#include "mpfr_interval.hpp"

namespace gvd::robust {

/// An interval around the sum, computed with numbers of that many bits.
MpfrInterval evaluated(const RootSum& x, int bits);

}  // namespace gvd::robust
