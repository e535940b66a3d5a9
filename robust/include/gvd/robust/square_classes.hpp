#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "gvd/robust/root_sum.hpp"

namespace gvd::robust {

/// The square classes of the positive rationals that are asked for, found as they turn up. Classes are told apart by their signatures; equal
/// ones are confirmed by a perfect square. Not thread-safe.
class SquareClasses {
 public:
  /// Equal numbers for two radicands if and only if they differ by the square of a rational. Pre: radicand > 0.
  std::uint32_t operator()(const mpq_class& radicand);
  /// sqrt(radicand): a rational, or a term over one and the same integer for all radicands of a class. Pre: radicand > 0.
  RootSum root(const mpq_class& radicand);

 private:
  std::vector<mpq_class> first_;  // radicand of each class
  std::vector<RootSum> root_;     // of that
  std::unordered_multimap<std::uint64_t, std::uint32_t> by_signature_;
};

}  // namespace gvd::robust
