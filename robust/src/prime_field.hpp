#pragma once

#include <cstddef>
#include <cstdint>

#include "gvd/robust/gmp.hpp"

namespace gvd::robust {

/// The n-th largest prime below 2^62, n from 0. Thread-safe; the list grows on demand.
std::uint64_t large_prime(std::size_t n);

/// The integers modulo an odd prime below 2^62, in Montgomery's representation x 2^64.
class PrimeField {
 public:
  explicit PrimeField(std::uint64_t p);

  std::uint64_t of(const mpz_class& n) const {
    std::uint64_t result = 0;
    for (std::size_t i = mpz_size(n.get_mpz_t()); i-- > 0;)
      result = add(multiply(result, square_), multiply(mpz_getlimbn(n.get_mpz_t(), static_cast<mp_size_t>(i)), square_));
    return sgn(n) < 0 ? subtract(0, result) : result;
  }
  /// One of them may be any word.
  std::uint64_t multiply(std::uint64_t x, std::uint64_t y) const {
    const auto product = static_cast<unsigned __int128>(x) * y;
    const std::uint64_t m = static_cast<std::uint64_t>(product) * minus_inverse_;
    const auto t = static_cast<std::uint64_t>((product + static_cast<unsigned __int128>(m) * p_) >> 64);
    return t >= p_ ? t - p_ : t;
  }
  std::uint64_t add(std::uint64_t x, std::uint64_t y) const { return x + y >= p_ ? x + y - p_ : x + y; }
  std::uint64_t subtract(std::uint64_t x, std::uint64_t y) const { return x >= y ? x - y : x + p_ - y; }

 private:
  std::uint64_t p_, minus_inverse_, square_;  // square_: 2^128 modulo p
};

}  // namespace gvd::robust
