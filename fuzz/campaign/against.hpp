#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "fuzz/campaign/campaign.hpp"
#include "fuzz/campaign/external.hpp"

namespace gvd::fuzz {

/// What another program made of a case, from bad to good.
enum class Failure : std::uint8_t {
  crashed,
  hung,
  refused,
  no_output,
  not_a_number,
  reachability,
  wrong_distance,
  wrong_label,
  none
};
inline constexpr std::size_t kFailureCount = 9;
const char* failure_name(Failure failure);

struct Judgement {
  Failure failure = Failure::none;
  double worst = 0;  ///< the largest relative error of a distance
  std::string what;
};

struct AgainstOptions {
  std::string command;  ///< {mesh}: OFF file, {sources}: source file, {out}: CSV file vertex,distance[,source] that it must write
  double tolerance = 1e-6;  ///< a relative error above this is wrong
  Limits limits;
};

/// Runs the program on the case and compares with certified distances and labels. A label is wrong if that source alone is farther
/// away than the tolerance allows.
Judgement judge(const Case& c, const AgainstOptions& options);

struct AgainstReport {
  std::map<Failure, std::uint64_t> counts;
  std::map<Failure, std::string> witness;  ///< shrunken case, per class the first one
  std::uint64_t cases = 0;
  double worst = 0;  ///< among the cases with a wrong distance or label, and those without a failure
  std::string text() const;
};

/// Runs the program on the cases of a campaign.
AgainstReport run_against(const CampaignOptions& campaign, const AgainstOptions& options);

}  // namespace gvd::fuzz
