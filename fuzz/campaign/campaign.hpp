#pragma once

#include <cstdint>
#include <string>

#include "fuzz/campaign/case_result.hpp"
#include "fuzz/campaign/tally.hpp"

namespace gvd::fuzz {

/// Cases 0, 1, 2, ... of a campaign have the seeds campaign_seed(seed, i); a shard takes every `shards`-th of them.
struct CampaignOptions {
  std::uint64_t seed = 1;
  std::uint64_t cases = 0;  ///< 0: no limit
  double seconds = 0;       ///< 0: no limit
  std::uint64_t shard = 0, shards = 1;
  Wish wish;
  Choice choice;
  std::string out;                    ///< results file; cases that it holds already are not run again. Empty: none
  std::string findings = "findings";  ///< folder for failing cases, made when there is one
  double shrink_seconds = 20;
  bool stop_at_first = false;   ///< end at the first finding
  bool quiet = false;
};

std::uint64_t campaign_seed(std::uint64_t seed, std::uint64_t index);

/// Runs the cases in a child process, which is started again after a crash or a hang (both are findings). Returns the sums over all
/// results, earlier ones of the results file included. Stops soon after SIGINT or SIGTERM.
Tally run_campaign(const CampaignOptions& options);

/// Shrinks a failing case and writes it with its replay command. Returns the file.
std::string write_finding(const Case& c, std::uint64_t seed, const std::string& property, const std::string& what,
                          const std::string& folder, double shrink_seconds);

/// Writes a case with its seed, for `replay`.
void save_case(const Case& c, std::uint64_t seed, const std::string& file);

/// Looks at a written case again: at the property it names, or at all. Returns the result.
CaseResult replay(const std::string& file, Choice choice);

}  // namespace gvd::fuzz
