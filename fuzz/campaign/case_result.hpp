#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fuzz/generators/family.hpp"
#include "fuzz/properties/property.hpp"

namespace gvd::fuzz {

/// What one case came to: one line of a results file.
struct CaseResult {
  int version = kGeneratorVersion;  ///< with the seed, the case
  std::uint64_t seed = 0;
  std::string family;
  std::uint64_t faces = 0, sources = 0;
  std::string status;                  ///< of the solution; "crash", "hang"
  std::vector<std::string> undecided;  ///< kinds of what the solution could not prove, numbers left out
  std::vector<std::string> tags;
  std::map<std::string, std::string> violated;   ///< property -> what was found
  std::vector<std::string> held, open, skipped;  ///< properties
  double milliseconds = 0;                       ///< of CPU, all threads together
  std::map<std::string, double> cost;            ///< property, or "make" and "solve" -> its share of that
  bool operator==(const CaseResult&) const = default;
};

/// One line of JSON, without a line break.
std::string to_line(const CaseResult& result);
/// Throws InputError if the text is no such line.
CaseResult parse_line(const std::string& text);

/// Which properties a case is put to.
struct Choice {
  std::string only;       ///< one of them; empty: all
  bool thorough = false;  ///< all of them on every case, whatever their rates
};

/// Makes the case of a seed and looks at its properties.
CaseResult run_case(std::uint64_t seed, const Wish& wish, const Choice& choice);
/// The same for a case that is given; `seed` is that of its draws.
CaseResult run_case(const Case& c, std::uint64_t seed, const Choice& choice);

/// A sentence with each run of digits replaced by #.
std::string without_numbers(const std::string& sentence);

}  // namespace gvd::fuzz
