#pragma once

#include <cstdint>
#include <optional>

#include "gvd/robust/gmp.hpp"

namespace gvd::robust {

/// The field of p^2 elements a + b i, i^2 = -1, for a prime p = 3 modulo 4 below 2^62. All integers are squares there.
class ResidueField {
 public:
  struct Element {
    std::uint64_t a = 0, b = 0;
  };

  explicit ResidueField(std::uint64_t p) : p_(p) {}

  Element of(const mpz_class& n) const { return {mpz_fdiv_ui(n.get_mpz_t(), p_), 0}; }
  static bool is_zero(const Element& x) { return x.a == 0 && x.b == 0; }
  Element add(const Element& x, const Element& y) const { return {sum(x.a, y.a), sum(x.b, y.b)}; }
  Element multiply(const Element& x, const Element& y) const {
    return {difference(product(x.a, y.a), product(x.b, y.b)), sum(product(x.a, y.b), product(x.b, y.a))};
  }
  /// Whether x has a square root; zero has.
  bool is_square(const Element& x) const;
  std::optional<Element> root(const Element& x) const;

 private:
  std::uint64_t sum(std::uint64_t x, std::uint64_t y) const { return x + y < p_ ? x + y : x + y - p_; }
  std::uint64_t difference(std::uint64_t x, std::uint64_t y) const { return x >= y ? x - y : x + p_ - y; }
  std::uint64_t product(std::uint64_t x, std::uint64_t y) const {
    return static_cast<std::uint64_t>(static_cast<unsigned __int128>(x) * y % p_);
  }
  std::uint64_t power(std::uint64_t x, std::uint64_t exponent) const;
  std::optional<std::uint64_t> rational_root(std::uint64_t x) const;

  std::uint64_t p_;
};

}  // namespace gvd::robust
