#include "fuzz/campaign/tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <tuple>

#include "gvd/kernel/error.hpp"

namespace gvd::fuzz {

void Tally::add(const CaseResult& r) {
  ++cases_;
  milliseconds_ += r.milliseconds;
  ++status_[r.status];
  if (!r.violated.empty() || r.status == "crash" || r.status == "hang") ++violations_;
  for (const auto& tag : r.tags) ++tags_[tag];
  for (const auto& kind : r.undecided) ++undecided_[kind];
  for (const auto& [property, what] : r.violated) ++properties_[property].violated;
  for (const auto& property : r.held) ++properties_[property].held;
  for (const auto& property : r.open) ++properties_[property].open;
  for (const auto& property : r.skipped) ++properties_[property].skipped;
  for (const auto& [part, milliseconds] : r.cost) cost_[part] += milliseconds;
  auto& family = families_[r.family];
  ++family.cases;
  family.undecided += r.status == "undecided" ? 1 : 0;
  family.milliseconds += r.milliseconds;
}

std::uint64_t Tally::undecided() const noexcept {
  const auto found = status_.find("undecided");
  return found == status_.end() ? 0 : found->second;
}

std::vector<std::string> Tally::empty_classes() const {
  std::vector<std::string> empty;
  for (std::size_t t = 0; t < kTagCount; ++t) {
    const char* name = tag_name(static_cast<Tag>(t));
    if (tags_.count(name) == 0) empty.emplace_back(name);
  }
  return empty;
}

/// What the parts of a case cost, spread over all cases; the dearest first.
std::string Tally::cost_table() const {
  std::vector<std::pair<double, std::string>> parts;
  for (const auto& [part, milliseconds] : cost_) parts.emplace_back(milliseconds, part);
  std::sort(parts.rbegin(), parts.rend());
  std::string text = fmt::format("\n{:<34} {:>9} {:>9}\n", "cost", "ms a case", "of all");
  for (const auto& [milliseconds, part] : parts)
    text += fmt::format("{:<34} {:>9.3f} {:>7.2f} %\n", part, milliseconds / static_cast<double>(cases_), 100 * milliseconds / milliseconds_);
  return text;
}

std::string Tally::text() const {
  const double cases = static_cast<double>(std::max<std::uint64_t>(cases_, 1));
  std::string text = fmt::format("{} cases, {:.2f} ms of CPU each\n", cases_, milliseconds_ / cases);
  for (const auto& [status, n] : status_)
    text += fmt::format("  {:<40} {:>9}  {:6.2f} %\n", status, n, 100 * static_cast<double>(n) / cases);
  text += fmt::format("\n{:<34} {:>9} {:>9} {:>9} {:>9}\n", "property", "held", "violated", "open", "skipped");
  for (const auto& [name, c] : properties_)
    text += fmt::format("{:<34} {:>9} {:>9} {:>9} {:>9}\n", name, c.held, c.violated, c.open, c.skipped);
  text += cost_table();
  text += fmt::format("\n{:<34} {:>9}\n", "class", "cases");
  for (const auto& [tag, n] : tags_) text += fmt::format("{:<34} {:>9}\n", tag, n);
  text += fmt::format("\n{:<34} {:>9} {:>9} {:>9}\n", "family", "cases", "undecided", "ms each");
  for (const auto& [name, c] : families_)
    text += fmt::format("{:<34} {:>9} {:>9} {:>9.2f}\n", name, c.cases, c.undecided, c.milliseconds / static_cast<double>(c.cases));
  if (!undecided_.empty()) text += fmt::format("\n{:>9}  what could not be proved\n", "cases");
  for (const auto& [kind, n] : undecided_) text += fmt::format("{:>9}  {}\n", n, kind);
  return text;
}

std::vector<CaseResult> read_results(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file + ": cannot be read");
  const std::string text(std::istreambuf_iterator<char>(in), {});
  std::vector<CaseResult> results;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;  // cut off while it was written
    if (end > begin) results.push_back(parse_line(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return results;
}

std::vector<CaseResult> merged(std::vector<CaseResult> results) {
  std::sort(results.begin(), results.end(), [](const CaseResult& a, const CaseResult& b) {
    if (std::tie(a.version, a.seed) != std::tie(b.version, b.seed))
      return std::tie(a.version, a.seed) < std::tie(b.version, b.seed);
    return to_line(a) < to_line(b);
  });
  const auto same_case = [](const CaseResult& a, const CaseResult& b) { return a.version == b.version && a.seed == b.seed; };
  results.erase(std::unique(results.begin(), results.end(), same_case), results.end());
  return results;
}

}  // namespace gvd::fuzz
