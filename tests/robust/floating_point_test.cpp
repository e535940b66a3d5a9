#include "gvd/robust/floating_point.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cfenv>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace gvd::robust::test {
namespace {

bool says(const std::string& fault, const char* what) { return fault.find(what) != std::string::npos; }

TEST(FloatingPoint, IsFineHere) { EXPECT_EQ(floating_point_fault(), ""); }

TEST(FloatingPoint, OtherRoundingModesAreNamed) {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const std::string fault = floating_point_fault();
    std::fesetround(FE_TONEAREST);
    EXPECT_TRUE(says(fault, "round-to-nearest")) << fault;
  }
}

#if defined(__SSE2__)
TEST(FloatingPoint, FlushingSubnormalsIsNamed) {
  constexpr unsigned kFlushResults = 0x8000, kZeroOperands = 0x0040;
  for (const unsigned flag : {kFlushResults, kZeroOperands, kFlushResults | kZeroOperands}) {
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | flag);
    const std::string fault = floating_point_fault();
    _mm_setcsr(before);
    EXPECT_TRUE(says(fault, "subnormal")) << fault;
  }
}
#endif

TEST(FloatingPoint, ANarrowRangeOfMpfrIsNamed) {
  const mpfr_exp_t before = mpfr_get_emin();
  mpfr_set_emin(-1073);
  const std::string fault = floating_point_fault();
  mpfr_set_emin(before);
  EXPECT_TRUE(says(fault, "MPFR")) << fault;
}

}  // namespace
}  // namespace gvd::robust::test
