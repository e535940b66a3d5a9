#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "fuzz/properties/property.hpp"
#include "fuzz/properties/surface_points.hpp"

namespace gvd::fuzz {
namespace {

using kernel::SourceId;
using kernel::VertexId;

Outcome union_is_the_minimum(Trial& t) {
  const auto& all = t.sources();
  if (all.size() < 2) return skipped();
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(
                                        1 + t.draw("union_is_the_minimum").below(static_cast<std::uint32_t>(all.size() - 1)));
  const auto first = Trial::solve(t.mesh(), {all.begin(), middle}, false),
             second = Trial::solve(t.mesh(), {middle, all.end()}, false);
  for (VertexId v = 0; v < t.mesh().vertex_count(); ++v)
    if (t.solution().distance(v) != std::min(first.distance(v), second.distance(v)))
      return violated(fmt::format("{}: {} with all sources, {} and {} with two parts of them", vertex_name(v),
                                  t.solution().distance(v), first.distance(v), second.distance(v)));
  return holds();
}

/// The last source is taken away; what it took from the others is compared.
Outcome a_source_only_takes(Trial& t) {
  const auto& all = t.sources();
  if (all.size() < 2) return skipped();
  const auto added = static_cast<SourceId>(all.size() - 1);
  const auto before = Trial::solve(t.mesh(), {all.begin(), all.end() - 1}, false);
  const bool labels = t.certified() && before.status() == kernel::Status::certified;
  for (VertexId v = 0; v < t.mesh().vertex_count(); ++v) {
    const double now = t.solution().distance(v), then = before.distance(v);
    if (now > then) return violated(fmt::format("{}: another source raised D from {} to {}", vertex_name(v), then, now));
    if (!labels) continue;
    Sources left = nearest(t.solution(), v), had = nearest(before, v);
    const bool took = !left.empty() && left.back() == added;
    if (took) left.pop_back();
    if (!std::includes(had.begin(), had.end(), left.begin(), left.end()))
      return violated(fmt::format("{}: nearest {} became {}", vertex_name(v), text_of(had), text_of(left)));
    if (!took && (left != had || now != then))
      return violated(
          fmt::format("{}: a source that does not own it changed {} to {}", vertex_name(v), text_of(had), text_of(left)));
  }
  return holds();
}

constexpr std::array<Property, 2> kProperties = {{
    {"union_is_the_minimum", union_is_the_minimum, 12, "D of a union of sources is the minimum, bit for bit"},
    {"a_source_only_takes", a_source_only_takes, 12,
     "adding a source raises D nowhere, and only its own cell changes: cells nest"},
}};

}  // namespace

std::span<const Property> source_set_properties() { return kProperties; }

}  // namespace gvd::fuzz
