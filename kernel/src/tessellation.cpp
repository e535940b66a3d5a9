#include "gvd/kernel/tessellation.hpp"

#include <cmath>

#include "border_tracer.hpp"
#include "contenders.hpp"
#include "growth.hpp"
#include "outline.hpp"

namespace gvd::kernel {
namespace {

template <class T>
robust::Ball<double> in_double(const robust::Ball<T>& x) {
  return narrowed(x);
}
robust::Ball<double> in_double(const robust::Exact& x) { return narrowed(x.enclosure(64)); }

bool is_finite(const FacetTessellation::Node& node) { return std::isfinite(node.x.rad()) && std::isfinite(node.y.rad()); }

/// Where doubles cannot construct a node (close sources, say) finer numbers give its enclosure.
void enclose(FacetTessellation::Node& node, const FacetWaves& waves, FacetLadder& ladder) {
  using Kind = FacetTessellation::Node::Kind;
  ladder.for_each_stage([&](const auto& numbers, robust::Stage) -> std::optional<bool> {
    const auto p = node_point(waves, numbers, node);
    node.x = in_double(p.x);
    node.y = in_double(p.y);
    if (node.kind == Kind::side) node.t = in_double(node_parameter(waves, numbers, node));
    return is_finite(node) ? std::optional(true) : std::nullopt;
  });
}

FacetTessellation grow(FacetWaves& waves, const Contenders& contenders, const FacetFilter& filter, FacetLadder& ladder) {
  FacetTessellation result;
  const std::vector<Occurrence> outline = OutlineWalk(waves, contenders, filter, ladder, result).walk();
  if (!ladder.failed()) Growth(waves, contenders, filter, ladder, result).run(outline);
  if (ladder.failed()) {
    result = {};
    result.undecided = true;
    return result;
  }
  for (auto& node : result.nodes)
    if (!is_finite(node)) enclose(node, waves, ladder);
  result.representative = contenders.representatives();
  return result;
}

}  // namespace

FacetTessellation tessellate(FacetWaves& waves, predicates::Decisions& decisions) {
  FacetLadder ladder(waves, decisions);
  const Contenders contenders(waves, ladder);
  const FacetFilter filter(contenders, ladder);
  return grow(waves, contenders, filter, ladder);
}

FacetTessellation tessellate_borders(FacetWaves& waves, predicates::Decisions& decisions) {
  FacetLadder ladder(waves, decisions);
  const Contenders contenders(waves, ladder);
  const FacetFilter filter(contenders, ladder);
  if (auto borders = BorderTracer(waves, contenders, filter, ladder).run()) return std::move(*borders);
  return grow(waves, contenders, filter, ladder);
}

}  // namespace gvd::kernel
