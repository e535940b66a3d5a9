#pragma once

#include <boost/multiprecision/mpfr.hpp>

#include "gvd/robust/gmp.hpp"
#include "gvd/robust/sign.hpp"

/// Numbers of 512 bits and more, by a library that the kernel does not use: the independent truth of near ties.
namespace gvd::test {

/// 160 decimal digits.
using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<160>, boost::multiprecision::et_off>;
inline const Real kRealTie = ldexp(Real(1), -400);

inline Real real(const mpq_class& q) { return Real(q.get_mpq_t()); }

/// The sign of `value`, which is of the given size when it is far from zero. What 400 bits do not show is called zero: not a proof, but no case of
/// the tests is non-zero and nearer.
inline robust::Sign sign_of(const Real& value, const Real& size) {
  if (abs(value) <= size * kRealTie) return robust::Sign::zero;
  return value > 0 ? robust::Sign::positive : robust::Sign::negative;
}

}  // namespace gvd::test
