#pragma once

#include <cstddef>
#include <vector>

#include "gvd/robust/gmp.hpp"

namespace gvd::robust {

/// Square roots of whole numbers by roots that are independent. A radicand that no product with others of the basis makes a square joins the
/// basis; the root of any other is a rational times a product of basis roots (as sqrt 6 = sqrt 2 sqrt 3).
///
/// Legendre symbols, vectors over GF(2), tell which product to try (elimination); a perfect square confirms it. A product that should be a
/// square and is none leaves its radicand in the basis: nothing wrong follows, only a relation may be missed. With `count` + 32 symbols that is
/// unlikely; independent symbols prove independence.
class RootBasis {
 public:
  /// For up to so many radicands.
  explicit RootBasis(std::size_t count) : symbols_(count + 32) {}

  struct Product {
    mpq_class factor;
    std::vector<std::size_t> members;  ///< rising
  };
  /// sqrt(radicand). Pre: radicand > 0.
  Product root(const mpz_class& radicand);
  const mpz_class& radicand(std::size_t member) const { return members_[member]; }
  std::size_t size() const noexcept { return members_.size(); }

 private:
  struct Row {
    mpz_class symbols;  ///< bit i: of prime i
    mpz_class members;  ///< bit i: whether member i is in the product with these symbols
    mp_bitcnt_t pivot;
  };
  std::size_t symbols_;
  std::vector<mpz_class> members_;
  std::vector<Row> rows_;
};

}  // namespace gvd::robust
