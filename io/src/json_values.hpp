#pragma once

#include <nlohmann/json.hpp>

#include "gvd/kernel/ids.hpp"
#include "gvd/kernel/solver.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::io {

using Json = nlohmann::ordered_json;

/// An id, or null for kNone.
inline Json id_json(std::uint32_t id) { return id == kernel::kNone ? Json() : Json(id); }

/// Text that may hold bytes that are not UTF-8 (file names) as valid JSON.
inline std::string dump(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// Decisions per predicate and stage.
Json decisions_json(const predicates::Decisions& decisions);
/// The counts of a summary from `status` to `decisions`: what depends on the input only, not on the machine.
Json counts_json(const kernel::Summary& summary, const predicates::Decisions& decisions);

}  // namespace gvd::io
