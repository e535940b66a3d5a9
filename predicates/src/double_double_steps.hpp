#pragma once

#include <span>

#include "gvd/predicates/strip.hpp"

/// The steps of strips in double-double as processors without fused multiply-add take them (fused_multiply_add.hpp). Tests compare them, bit for bit, with what this
/// processor does.
namespace gvd::predicates::without_fma {

Disc<robust::DoubleDouble> cross(const Disc<robust::DoubleDouble>& z, const DoubleDoubleStep& step);
template <bool kCone>
void unfold_steps(Unfolding<robust::DoubleDouble>& at, std::span<const DoubleDoubleStep> steps);

}  // namespace gvd::predicates::without_fma
