#include "rational_rounding.hpp"

#include <cmath>
#include <limits>

#include "gvd/kernel/error.hpp"

namespace gvd::kernel {
namespace {

/// The double nearest to (quotient + r) 2^exponent, where r = 0, or 0 < r < 1 if `inexact`. This is the only rounding of this file.
/// Pre: the quotient has at least 55 bits, so that r alone never decides against a bit that is there.
double scale_rounded(const mpz_class& quotient, bool inexact, long exponent) {
  // Bits that the result may keep: 53, fewer where the result is subnormal.
  const long bits = static_cast<long>(mpz_sizeinbase(quotient.get_mpz_t(), 2));
  long drop = bits - 53;
  if (exponent + drop < -1074) drop = -1074 - exponent;
  if (drop < 2) throw InternalError("rounding needs more bits of the quotient");
  mpz_class kept = quotient >> static_cast<mp_bitcnt_t>(drop);
  const mpz_class rest = quotient - (kept << static_cast<mp_bitcnt_t>(drop));
  const mpz_class half = mpz_class(1) << static_cast<mp_bitcnt_t>(drop - 1);
  const int side = rest == half ? (inexact ? 1 : 0) : cmp(rest, half);
  if (side > 0 || (side == 0 && mpz_odd_p(kept.get_mpz_t()))) ++kept;
  const long top = exponent + drop;
  if (top > 1024) return std::numeric_limits<double>::infinity();
  return std::ldexp(kept.get_d(), static_cast<int>(top));
}

long bit_length(const mpz_class& z) { return static_cast<long>(mpz_sizeinbase(z.get_mpz_t(), 2)); }

mpz_class shifted(const mpz_class& z, long bits) {
  return bits >= 0 ? mpz_class(z << static_cast<mp_bitcnt_t>(bits)) : mpz_class(z >> static_cast<mp_bitcnt_t>(-bits));
}

}  // namespace

double nearest_double(const mpq_class& q) {
  if (sgn(q) == 0) return 0;
  const mpz_class numerator = abs(q.get_num());
  // A quotient of 56 or 57 bits.
  const long shift = 56 - (bit_length(numerator) - bit_length(q.get_den()));
  const mpz_class n = shift > 0 ? shifted(numerator, shift) : numerator;
  const mpz_class d = shift < 0 ? shifted(q.get_den(), -shift) : q.get_den();
  mpz_class quotient, rest;
  mpz_tdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), n.get_mpz_t(), d.get_mpz_t());
  return std::copysign(scale_rounded(quotient, sgn(rest) != 0, -shift), static_cast<double>(sgn(q)));
}

double nearest_sqrt(const mpq_class& q) {
  if (sgn(q) < 0) throw InternalError("square root of a negative number");
  if (sgn(q) == 0) return 0;
  // floor(sqrt(q 4^k)) with 57 bits or so; the root is exact iff q 4^k is an integer and a square.
  const long size = bit_length(q.get_num()) - bit_length(q.get_den());
  const long k = 57 - (size >= 0 ? size / 2 : -((-size + 1) / 2));
  const mpz_class n = k > 0 ? shifted(q.get_num(), 2 * k) : q.get_num();
  const mpz_class d = k < 0 ? shifted(q.get_den(), -2 * k) : q.get_den();
  mpz_class quotient, rest, root, root_rest;
  mpz_tdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), n.get_mpz_t(), d.get_mpz_t());
  mpz_sqrtrem(root.get_mpz_t(), root_rest.get_mpz_t(), quotient.get_mpz_t());
  return scale_rounded(root, sgn(rest) != 0 || sgn(root_rest) != 0, -k);
}

}  // namespace gvd::kernel
