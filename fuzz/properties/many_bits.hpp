#pragma once
/// Looking again, without algebra: what is equal stays uncertain however many bits there are, and with so many whatever is not equal differs.
#include "gvd/robust/sign.hpp"

namespace gvd::fuzz {

inline constexpr int kManyBits = 512;

template <class NT>
bool differs(const NT& x) {
  return maybe_sign(x).value_or(robust::Sign::zero) != robust::Sign::zero;
}

}  // namespace gvd::fuzz
