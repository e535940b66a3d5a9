#include "gvd/robust/floating_point.hpp"

#include <mpfr.h>

#include <cfenv>
#include <cmath>

namespace gvd::robust {

namespace {

// The operands go through volatile, so that the compiler can neither evaluate nor simplify the test.
double opaque(double x) {
  volatile double copy = x;
  return copy;
}

bool rounds_to_nearest() {
  const double one = opaque(1.0), bit = opaque(0x1p-53), more = opaque(0x1.8p-53);
  const bool ties_to_even = one + bit == 1.0 && (one + 0x1p-52) + bit == 1.0 + 0x1p-51;
  const bool nearest = one + more == 1.0 + 0x1p-52 && -one - more == -1.0 - 0x1p-52 && one - opaque(0x1p-55) == 1.0;
  return std::fegetround() == FE_TONEAREST && ties_to_even && nearest;
}

bool has_no_extra_precision() {
  const double one = opaque(1.0), bit = opaque(0x1p-60);
  // Kept beyond double, the sum would still know the bit; a product rounded to 64 bits first would round twice.
  const double lost = (one + bit) - one;
  const double product = opaque(0x1.0000000000001p0) * opaque(0x1.0000000000001p0);
  return lost == 0 && product == 0x1.0000000000002p0;
}

bool does_not_contract() {
  const double rounded = opaque(opaque(0x1.0000001p0) * opaque(0x1.0000001p0));
  // The product is not a double; a fused operation would return its rounding error. (Read again: a product that is used twice is
  // not fused.)
  const double x = opaque(0x1.0000001p0), y = opaque(0x1.0000001p0);
  return x * y - rounded == 0;
}

bool does_not_reassociate() {
  const double a = opaque(1e16), b = opaque(1.0);
  return ((a + b) - a) - b == -1.0;
}

bool root_and_fma_are_correct() {
  const double residual = std::fma(opaque(0x1.0000001p0), opaque(0x1.0000001p0), -0x1.0000002p0);
  const double underflowing = std::fma(opaque(0x1p-600), opaque(0x1p-600), opaque(1.0));
  return residual == 0x1p-56 && underflowing == 1.0 && std::sqrt(opaque(2.0)) == 0x1.6a09e667f3bcdp0 &&
         std::sqrt(opaque(0x1p-1074)) == 0x1p-537;
}

bool keeps_subnormals() {
  const double smallest = opaque(0x1p-1074);
  const bool output = opaque(0x1p-1022) * 0.5 == 0x1p-1023 && opaque(0x1p-1022) * 0.5 != 0.0;
  const bool input = smallest * 0x1p1000 == 0x1p-74 && smallest + smallest == 0x1p-1073 && smallest != 0.0;
  return output && input;
}

bool mpfr_has_a_wide_range() { return mpfr_get_emin() < -1000000000L && mpfr_get_emax() > 1000000000L; }

}  // namespace

std::string floating_point_fault() {
  std::string faults;
  const auto require = [&](bool holds, const char* fault) {
    if (!holds) faults += (faults.empty() ? "" : "\n") + std::string(fault);
  };
  require(rounds_to_nearest(), "the rounding mode is not round-to-nearest, ties to even");
  require(has_no_extra_precision(), "doubles are evaluated with more than 53 bits (x87 code?)");
  require(does_not_contract(), "a * b + c is contracted to one rounding: compile with -ffp-contract=off");
  require(does_not_reassociate(), "sums are re-associated: compile without -ffast-math");
  require(root_and_fma_are_correct(), "sqrt or fma is not correctly rounded");
  require(keeps_subnormals(), "subnormal numbers are flushed to zero");
  require(mpfr_has_a_wide_range(), "the exponent range of MPFR has been narrowed");
  return faults;
}

}  // namespace gvd::robust
