#include "gvd/io/summary_writer.hpp"

#include <fmt/format.h>

#include "json_values.hpp"

namespace gvd::io {

namespace {

using robust::Stage;

constexpr int kKeyWidth = 22;

std::string line(std::string_view key, const std::string& value) { return fmt::format("{:<{}}{}\n", key, kKeyWidth, value); }

std::string stage_totals(const predicates::Decisions& decisions) {
  std::string text;
  for (std::size_t s = 0; s < robust::kStageCount; ++s)
    text += fmt::format("{}{} {}", s == 0 ? "" : ", ", robust::kStageNames[s], decisions.total(static_cast<Stage>(s)));
  return text;
}

Json facts_object(const kernel::MeshFacts& facts) {
  Json json;
  json["vertices"] = facts.vertices;
  json["faces"] = facts.faces;
  json["edges"] = facts.edges;
  json["boundary_edges"] = facts.boundary_edges;
  json["boundary_loops"] = facts.boundary_loops;
  json["components"] = facts.components;
  json["saddles"] = facts.saddles;
  json["boundary_relays"] = facts.boundary_relays;
  json["flat_vertices"] = facts.flat_vertices;
  json["flipped_faces"] = facts.flipped_faces;
  json["isolated_vertices"] = facts.isolated_vertices;
  json["bbox"] = facts.bbox;
  json["euler"] = facts.euler;
  return json;
}

}  // namespace

Json decisions_json(const predicates::Decisions& decisions) {
  Json json = Json::object();
  for (std::size_t p = 0; p < predicates::kPredicateCount; ++p) {
    Json& row = json[predicates::kPredicateNames[p]];
    for (std::size_t s = 0; s < robust::kStageCount; ++s) row[robust::kStageNames[s]] = decisions(p, static_cast<Stage>(s));
  }
  return json;
}

Json counts_json(const kernel::Summary& summary, const predicates::Decisions& decisions) {
  Json json;
  json["status"] = kernel::status_name(summary.status);
  json["sources"] = summary.sources;
  json["components"] = summary.components;
  json["unreachable_vertices"] = summary.unreachable_vertices;
  json["windows_propagated"] = summary.windows_propagated;
  json["windows_kept"] = summary.windows_kept;
  json["boundary_facets"] = summary.boundary_facets;
  json["cells"] = summary.cells;
  json["gvd_edges"] = summary.gvd_edges;
  json["gvd_vertices"] = summary.gvd_vertices;
  json["break_points"] = summary.break_points;
  json["dual_edges"] = summary.dual_edges;
  json["ties"] = summary.ties;
  json["decisions"] = decisions_json(decisions);
  return json;
}

std::string summary_json(const kernel::Summary& summary, const predicates::Decisions& decisions) {
  Json json = counts_json(summary, decisions);
  Json& seconds = json["seconds"] = Json::object();
  for (const auto& phase : summary.seconds) seconds[phase.name] = phase.seconds;
  json["peak_memory_mb"] = summary.peak_memory_mb;
  if (summary.status != kernel::Status::certified) json["undecided"] = decisions.undecided_list();
  return dump(json);
}

std::string summary_text(const kernel::Summary& summary, const predicates::Decisions& decisions) {
  double total = 0;
  for (const auto& phase : summary.seconds) total += phase.seconds;
  std::string text = line("status", kernel::status_name(summary.status));
  text += line("sources", fmt::format("{}", summary.sources));
  text += line("components", fmt::format("{}", summary.components));
  text += line("unreachable vertices", fmt::format("{}", summary.unreachable_vertices));
  text += line("ties", fmt::format("{}", summary.ties));
  text += line("windows", fmt::format("{} propagated, {} kept", summary.windows_propagated, summary.windows_kept));
  if (summary.cells != 0) {
    text += line("boundary facets", fmt::format("{}", summary.boundary_facets));
    text += line("cells", fmt::format("{}", summary.cells));
    text += line("GVD edges, vertices", fmt::format("{}, {}", summary.gvd_edges, summary.gvd_vertices));
    text += line("break points", fmt::format("{}", summary.break_points));
    text += line("dual edges", fmt::format("{}", summary.dual_edges));
  }
  text += line("decisions", stage_totals(decisions));
  text += line("seconds", fmt::format("{:.3f}", total));
  text += line("peak memory", fmt::format("{:.0f} MB", summary.peak_memory_mb));
  return text;
}

std::string facts_json(const kernel::MeshFacts& facts) { return dump(facts_object(facts)); }

std::string facts_text(const kernel::MeshFacts& facts) {
  const Json json = facts_object(facts);
  std::string text;
  for (const auto& [key, value] : json.items()) text += line(key, dump(value));
  return text;
}

}  // namespace gvd::io
