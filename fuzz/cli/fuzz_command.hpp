#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/campaign/against.hpp"
#include "fuzz/campaign/campaign.hpp"

namespace gvd::fuzz {

/// What the arguments of `gvd fuzz` said.
struct FuzzArguments {
  CampaignOptions campaign;
  AgainstOptions against;
  std::string replay, save;
  std::optional<std::uint64_t> one_case;
  double most_undecided = 100;  ///< per cent
  std::vector<std::string> merge;
  bool list = false, json = false;
};

/// Adds the command to the program.
void add_fuzz_command(CLI::App& app, FuzzArguments& arguments);

/// Returns an exit code: 0, or kFindings if something was found.
int run_fuzz_command(const FuzzArguments& arguments);
inline constexpr int kFindings = 1;

}  // namespace gvd::fuzz
