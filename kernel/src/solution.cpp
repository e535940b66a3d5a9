#include <cmath>
#include <limits>
#include <string>

#include "gvd/kernel/error.hpp"
#include "solution_impl.hpp"

namespace gvd::kernel {
namespace {

const Solution::Impl& complete(const Solution::Impl& state) {
  if (!is_complete(state.status)) throw InternalError(std::string("the solution is not complete: ") + status_name(state.status));
  return state;
}

}  // namespace

Solution::Solution(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Solution::Solution(Solution&&) noexcept = default;
Solution& Solution::operator=(Solution&&) noexcept = default;
Solution::~Solution() = default;

Status Solution::status() const noexcept { return impl_->status; }
const Summary& Solution::summary() const noexcept { return impl_->summary; }
const predicates::Decisions& Solution::decisions() const noexcept { return impl_->decisions; }
double Solution::distance(VertexId v) const { return complete(*impl_).distance[v]; }

Enclosed Solution::distance_enclosure(VertexId v) const {
  const Impl& state = complete(*impl_);
  const double value = state.distance[v];
  if (!state.resolution->is_reached(v)) return {value, value, value};
  const auto d = state.resolution->distance(v).scaled(state.frames->scale());
  return {value, d.lower(), d.upper()};
}

std::span<const SourceId> Solution::nearest(VertexId v) const {
  const Impl& state = complete(*impl_);
  if (!state.resolution->is_reached(v)) return {};
  return state.label_sets[state.resolution->labels(v)];
}

const Diagram& Solution::diagram() const { return complete(*impl_).diagram; }
std::span<const std::array<SourceId, 2>> Solution::duplicates() const { return complete(*impl_).where.duplicates; }
std::span<const SourceId> Solution::hidden() const { return complete(*impl_).hidden; }

}  // namespace gvd::kernel
