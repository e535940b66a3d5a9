#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gvd/robust/root_sum.hpp"

namespace gvd::robust {

/// The product of two sums of roots as elements of a field Q(sqrt b_1, ..., sqrt b_k): each coefficient stands at the place whose bits tell which
/// b_i are multiplied below its root. The b_i are radicands of the factors, of independent symbols, so of independent square classes; all others are
/// products of them, times a square, which is confirmed.
class ProductOfRootSums {
 public:
  ProductOfRootSums(const RootSum& a, const RootSum& b);

  /// Empty if the symbols do not tell the classes apart, or there are more than `kMostClasses`.
  std::optional<RootSum> result();

 private:
  using Place = std::uint32_t;
  using Numbers = std::span<const mpz_class>;
  static constexpr std::size_t kMostClasses = 7;

  struct Class {
    mpz_class radicand;  // b_i
    std::uint64_t signature;
    std::uint64_t reduced;  // the signature less those of classes before, by elimination
    Place reduced_place;    // these classes and its own
  };
  /// sqrt(product of b_i) = multiple * sqrt(radicand)
  struct Root {
    mpz_class radicand = 1, multiple = 1;
  };
  struct Factor {
    std::vector<mpz_class> coefficients;  // one a place
    mpz_class denominator;
  };

  std::optional<Place> place_of(std::uint64_t signature) const;
  bool find_classes(const RootSum& a, const RootSum& b);
  void make_roots();
  std::optional<Factor> factor(const RootSum& x) const;
  void multiply(Numbers x, Numbers y, std::span<mpz_class> product, std::size_t level) const;

  const RootSum &a_, &b_;
  std::vector<Class> classes_;
  std::vector<Root> roots_;
};

}  // namespace gvd::robust
