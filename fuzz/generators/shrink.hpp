#pragma once

#include <chrono>
#include <functional>

#include "fuzz/generators/case.hpp"

namespace gvd::fuzz {

/// Makes a valid case smaller as long as `fails` says yes: takes away sources, faces (with what belongs to no face then) and
/// weights, and simplifies the numbers. Every case that `fails` sees is valid. Ends at a case of which no single step is left, or
/// at the deadline.
Case shrink(Case c, const std::function<bool(const Case&)>& fails, std::chrono::steady_clock::time_point deadline);

}  // namespace gvd::fuzz
