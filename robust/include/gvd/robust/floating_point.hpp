#pragma once

#include <string>

namespace gvd::robust {

/// Checks on the running thread that doubles behave as the error bounds assume: IEEE 754 binary64, round to nearest, no extra
/// precision, no contraction of a * b + c, no re-association, correctly rounded root and fused multiply-add, subnormals kept on
/// input and output; and that the exponent range of MPFR has not been narrowed. Returns one line per violation that says what is
/// wrong, or an empty string. Cost: microseconds. Call it at start-up, and in any thread whose floating-point environment others
/// may have changed.
std::string floating_point_fault();

}  // namespace gvd::robust
