#pragma once

#include <optional>

namespace gvd::robust {

/// The sign of a real number that has been decided. There is no value for "uncertain": a stage that cannot decide
/// returns an empty `MaybeSign`.
enum class Sign : signed char { negative = -1, zero = 0, positive = 1 };

/// What one stage of the decision ladder says: a proved sign, or nothing.
using MaybeSign = std::optional<Sign>;

constexpr Sign operator-(Sign s) noexcept { return static_cast<Sign>(-static_cast<signed char>(s)); }

constexpr Sign operator*(Sign a, Sign b) noexcept {
  return static_cast<Sign>(static_cast<signed char>(a) * static_cast<signed char>(b));
}

}  // namespace gvd::robust
