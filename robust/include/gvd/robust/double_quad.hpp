#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "gvd/robust/double_double.hpp"

/// Four doubles, and four double-doubles, at once, for what is alike for the coordinates of a point, the sides of a face or the waves at a point. Every
/// operation is that of double_double.hpp in each lane, so the numbers are the same. Worth while where the processor has fused multiply-add (and so AVX)
/// and the code is compiled for it.
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wpsabi"  // no vector of four goes through a call: all of this is inlined
#endif

namespace gvd::robust {

using DoubleQuad = double __attribute__((vector_size(32)));
/// All bits set, or none, a lane: what a comparison gives.
using QuadMask = std::int64_t __attribute__((vector_size(32)));

// What is made of quads is inlined for ever: compiled for other processors than its caller it would hand them over in other registers.
#define GVD_QUAD [[gnu::always_inline]] inline

GVD_QUAD DoubleQuad quad(double x) noexcept { return DoubleQuad{x, x, x, x}; }
GVD_QUAD DoubleQuad choose(const QuadMask& which, const DoubleQuad& yes, const DoubleQuad& no) noexcept { return which ? yes : no; }
GVD_QUAD DoubleQuad abs(const DoubleQuad& x) noexcept {
  return reinterpret_cast<DoubleQuad>(reinterpret_cast<QuadMask>(x) & QuadMask{INT64_MAX, INT64_MAX, INT64_MAX, INT64_MAX});
}
GVD_QUAD DoubleQuad fma(const DoubleQuad& a, const DoubleQuad& b, const DoubleQuad& c) noexcept {
  DoubleQuad result;
  for (int k = 0; k < 4; ++k) result[k] = std::fma(a[k], b[k], c[k]);  // one instruction where there is one
  return result;
}
GVD_QUAD DoubleQuad sqrt(const DoubleQuad& x) noexcept {
  DoubleQuad result;
  for (int k = 0; k < 4; ++k) result[k] = std::sqrt(x[k]);
  return result;
}
GVD_QUAD bool all(const QuadMask& mask) noexcept { return (mask[0] & mask[1] & mask[2] & mask[3]) != 0; }

struct DoubleDoubleQuad {
  DoubleQuad hi, lo;

  GVD_QUAD DoubleDouble lane(std::size_t k) const noexcept { return {hi[k], lo[k]}; }
};

GVD_QUAD DoubleDoubleQuad quad(const DoubleDouble& a, const DoubleDouble& b, const DoubleDouble& c, const DoubleDouble& d) noexcept {
  return {DoubleQuad{a.hi, b.hi, c.hi, d.hi}, DoubleQuad{a.lo, b.lo, c.lo, d.lo}};
}
/// The lanes i, j, k, l.
template <int i, int j, int k, int l>
GVD_QUAD DoubleDoubleQuad lanes(const DoubleDoubleQuad& x) noexcept {
  return {__builtin_shufflevector(x.hi, x.hi, i, j, k, l), __builtin_shufflevector(x.lo, x.lo, i, j, k, l)};
}

GVD_QUAD DoubleDoubleQuad two_sum(const DoubleQuad& a, const DoubleQuad& b) noexcept {
  const DoubleQuad s = a + b, b_part = s - a, a_part = s - b_part;
  return {s, (a - a_part) + (b - b_part)};
}
GVD_QUAD DoubleDoubleQuad fast_two_sum(const DoubleQuad& a, const DoubleQuad& b) noexcept {
  const DoubleQuad s = a + b;
  return {s, b - (s - a)};
}
GVD_QUAD DoubleDoubleQuad two_prod(const DoubleQuad& a, const DoubleQuad& b) noexcept {
  const DoubleQuad p = a * b;
  return {p, fma(a, b, -p)};
}

GVD_QUAD DoubleDoubleQuad operator-(const DoubleDoubleQuad& x) noexcept { return {-x.hi, -x.lo}; }

GVD_QUAD DoubleDoubleQuad operator+(const DoubleDoubleQuad& x, const DoubleDoubleQuad& y) noexcept {
  const DoubleDoubleQuad s = two_sum(x.hi, y.hi), t = two_sum(x.lo, y.lo), v = fast_two_sum(s.hi, s.lo + t.hi);
  return fast_two_sum(v.hi, t.lo + v.lo);
}
GVD_QUAD DoubleDoubleQuad operator-(const DoubleDoubleQuad& x, const DoubleDoubleQuad& y) noexcept { return x + -y; }

GVD_QUAD DoubleDoubleQuad operator*(const DoubleDoubleQuad& x, const DoubleDoubleQuad& y) noexcept {
  const DoubleDoubleQuad c = two_prod(x.hi, y.hi);
  return fast_two_sum(c.hi, c.lo + fma(x.lo, y.hi, fma(x.hi, y.lo, x.lo * y.lo)));
}

GVD_QUAD DoubleDoubleQuad operator/(const DoubleDoubleQuad& x, const DoubleDoubleQuad& y) noexcept {
  const DoubleQuad q = x.hi / y.hi;
  const DoubleDoubleQuad c = two_prod(y.hi, q), r = fast_two_sum(c.hi, fma(y.lo, q, c.lo));
  return fast_two_sum(q, ((x.hi - r.hi) + (x.lo - r.lo)) / y.hi);
}

/// Pre: x >= 0 in each lane.
GVD_QUAD DoubleDoubleQuad sqrt(const DoubleDoubleQuad& x) noexcept {
  const QuadMask is_zero = x.hi == quad(0), is_small = x.hi < quad(0x1p-900);
  const DoubleQuad up = choose(is_small, quad(0x1p200), quad(1)), down = choose(is_small, quad(0x1p-100), quad(1));
  const DoubleQuad hi = x.hi * up, s = sqrt(hi);
  const DoubleDoubleQuad root = fast_two_sum(s, (fma(-s, s, hi) + x.lo * up) / (quad(2) * s));
  return {choose(is_zero, quad(0), root.hi * down), choose(is_zero, quad(0), root.lo * down)};
}

}  // namespace gvd::robust
