#pragma once

#include "gvd/predicates/filter_error.hpp"

namespace gvd::predicates {

/// A non-negative number for `is_certainly_longer`, larger or smaller than it is by what the comparison needs to be certain.
inline double enlarged(double x) noexcept { return x * (1 + 2 * kDistanceError); }
inline double diminished(double x) noexcept { return x * (1 - 2 * kDistanceError); }

/// Whether weight + length sqrt(squared_reach) - error is certainly more than a path, and by 32 u of the distance, where
/// `squared_length` = diminished(length^2), `path` is a sum of products of enlarged numbers and `rest` = enlarged(error) - weight.
/// No root is taken. N: double, or DoublePair for two at once. Pre: all numbers are sums of products of non-negative doubles; docs/error-bounds.md#propagation.
template <class N>
[[gnu::always_inline]] inline auto is_certainly_longer(const N& squared_reach, double squared_length, const N& path, double rest) noexcept {
  const N left = path + rest;
  return (left < 0) | (squared_length * squared_reach > left * left);
}

}  // namespace gvd::predicates
