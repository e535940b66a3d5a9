#pragma once

#include <string>

#include "gvd/predicates/predicate.hpp"

namespace gvd::cli {

/// Writes to stdout and checks that it arrived.
void print(const std::string& text);
/// One line on stderr that starts with "gvd: ".
void note(const std::string& message);
/// Lists what could not be proved on stderr. Returns kUnproved, or kCertified if there is nothing to list.
int report_undecided(const predicates::Decisions& decisions);
/// Turns the exception that is being handled into a message on stderr, with `json` also into an object {"status", "error"} on stdout,
/// and into an exit code.
int report_error(bool json) noexcept;

}  // namespace gvd::cli
