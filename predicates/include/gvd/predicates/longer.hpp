#pragma once

#include "gvd/predicates/filter_error.hpp"

namespace gvd::predicates {

/// Whether weight + length sqrt(squared_reach) - error is certainly more than `path`, and by 32 u of the distance; `squared_length` is that of length.
/// No root is taken. Pre: all numbers are sums of products of non-negative doubles; docs/error-bounds.md#propagation.
inline bool is_certainly_longer(double weight, double squared_length, double squared_reach, double error, double path) noexcept {
  const double rest = (path + error) * (1 + 2 * kDistanceError) - weight;
  return rest < 0 || squared_length * squared_reach * (1 - 2 * kDistanceError) > rest * rest;
}

}  // namespace gvd::predicates
