#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fuzz/campaign/case_result.hpp"

namespace gvd::fuzz {

/// Sums over results.
class Tally {
 public:
  void add(const CaseResult& result);
  std::uint64_t cases() const noexcept { return cases_; }
  std::uint64_t violations() const noexcept { return violations_; }
  std::uint64_t undecided() const noexcept;
  /// Tags that no case has.
  std::vector<std::string> empty_classes() const;
  /// A table for people.
  std::string text() const;

 private:
  std::string cost_table() const;

  struct Counts {
    std::uint64_t held = 0, violated = 0, open = 0, skipped = 0;
  };
  struct FamilyCounts {
    std::uint64_t cases = 0, undecided = 0;
    double milliseconds = 0;
  };
  std::uint64_t cases_ = 0, violations_ = 0;
  double milliseconds_ = 0;
  std::map<std::string, std::uint64_t> status_, tags_, undecided_;
  std::map<std::string, Counts> properties_;
  std::map<std::string, double> cost_;  ///< property, or "make" and "solve" -> milliseconds
  std::map<std::string, FamilyCounts> families_;
};

/// Reads results files; a last line that was cut off is left out, any other line that is none is refused (InputError).
std::vector<CaseResult> read_results(const std::string& file);

/// One result per case, in the order of version and seed; of several for a case the one whose line is least. Merging the result
/// with any of its parts gives it again.
std::vector<CaseResult> merged(std::vector<CaseResult> results);

}  // namespace gvd::fuzz
