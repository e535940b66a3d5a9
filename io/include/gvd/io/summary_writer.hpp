#pragma once

#include <string>

#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/solver.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::io {

/// The summary of a run as one JSON object (docs/formats.md#summary). `undecided`, the list of the open decisions, is added only when
/// the status is not certified.
std::string summary_json(const kernel::Summary& summary, const predicates::Decisions& decisions);
/// The same for a person: a few aligned lines, each ended by a line feed.
std::string summary_text(const kernel::Summary& summary, const predicates::Decisions& decisions);

/// Facts of a mesh as one JSON object, and as aligned lines.
std::string facts_json(const kernel::MeshFacts& facts);
std::string facts_text(const kernel::MeshFacts& facts);

}  // namespace gvd::io
