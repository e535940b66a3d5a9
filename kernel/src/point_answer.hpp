#pragma once

#include <memory>

#include "nearest_waves.hpp"
#include "solution_impl.hpp"

namespace gvd::kernel {

/// An answer and what it came from.
struct AnsweredPoint {
  PointAnswer answer;
  RefinedPoint at;
  std::unique_ptr<FieldWaves> waves;  ///< unless the point is a vertex of the refined mesh
  NearestWaves nearest;               ///< the same
};

/// Pre: the solution is complete. `to_one_path`: as for `nearest_waves`.
AnsweredPoint answer_point(const Solution::Impl& state, const SurfacePoint& at, bool to_one_path);

}  // namespace gvd::kernel
