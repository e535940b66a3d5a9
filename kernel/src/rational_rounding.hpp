#pragma once

#include <gmpxx.h>

namespace gvd::kernel {

/// The double nearest to q, ties to even; infinity from the midpoint above the largest double on.
double nearest_double(const mpq_class& q);

/// The double nearest to the square root of q >= 0, ties to even.
double nearest_sqrt(const mpq_class& q);

}  // namespace gvd::kernel
