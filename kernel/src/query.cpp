#include <algorithm>
#include <limits>
#include <string>

#include "gvd/kernel/error.hpp"
#include "point_answer.hpp"

namespace gvd::kernel {
namespace {

/// Whether all that the answer is made of is proved: the strips, and the distances of the roots of all waves.
bool stands_on_proof(const Solution::Impl& state, const AnsweredPoint& result) {
  const auto strips = static_cast<std::size_t>(predicates::Predicate::window_orientation);
  if (state.decisions(strips, robust::Stage::undecided) > 0) return false;
  if (result.at.vertex != kNone) return state.resolution->is_proved(result.at.vertex);
  const auto& sites = result.waves->sites;
  return std::all_of(sites.begin(), sites.end(), [&](const FacetSite& site) { return state.resolution->is_proved(site.root); });
}

void answer_unreachable(PointAnswer& answer) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  answer.distance = kInfinity;
  answer.enclosure = {kInfinity, kInfinity, kInfinity};
}

void answer_vertex(const Solution::Impl& state, VertexId v, PointAnswer& answer) {
  predicates::Decisions decisions;
  answer.distance = rounded_distance(*state.resolution, v, decisions);
  answer.undecided = decisions.total(robust::Stage::undecided) > 0;
  while (decisions.total(answer.stage) == 0) answer.stage = static_cast<robust::Stage>(static_cast<int>(answer.stage) + 1);
  const auto d = state.resolution->distance(v).scaled(state.frames->scale());
  answer.enclosure = {answer.distance, d.lower(), d.upper()};
  answer.nearest = state.label_sets[state.resolution->labels(v)];
}

}  // namespace

AnsweredPoint answer_point(const Solution::Impl& state, const SurfacePoint& at, bool to_one_path) {
  if (!is_complete(state.status)) throw InternalError(std::string("the solution is not complete: ") + status_name(state.status));
  AnsweredPoint result;
  result.at = find_in_refined(state.input, state.refined, state.parts, at);
  const VertexId v = result.at.vertex != kNone ? result.at.vertex : state.refined.origin(3 * result.at.face);
  if (!state.resolution->is_reached(v)) {
    answer_unreachable(result.answer);
    return result;
  }
  if (result.at.vertex != kNone) {
    answer_vertex(state, v, result.answer);
  } else {
    result.waves = std::make_unique<FieldWaves>(*state.resolution, state.kinds, result.at.face);
    result.nearest = nearest_waves(*state.resolution, *result.waves, result.at, to_one_path);
    result.answer.distance = result.nearest.distance.value;
    result.answer.enclosure = result.nearest.distance;
    result.answer.undecided = !result.nearest.is_decided;
    result.answer.stage = result.nearest.stage;
    for (const std::uint32_t i : result.nearest.sites) {
      const auto& labels = state.label_sets[result.waves->sites[i].labels];
      result.answer.nearest.insert(result.answer.nearest.end(), labels.begin(), labels.end());
    }
    auto& nearest = result.answer.nearest;
    std::sort(nearest.begin(), nearest.end());
    nearest.erase(std::unique(nearest.begin(), nearest.end()), nearest.end());
  }
  result.answer.undecided = result.answer.undecided || !stands_on_proof(state, result);
  return result;
}

PointAnswer Solution::query(const SurfacePoint& at) const { return answer_point(*impl_, at, false).answer; }

}  // namespace gvd::kernel
