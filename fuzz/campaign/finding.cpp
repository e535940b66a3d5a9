#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "fuzz/campaign/campaign.hpp"
#include "fuzz/generators/shrink.hpp"
#include "gvd/kernel/error.hpp"

namespace gvd::fuzz {
namespace {

bool still_fails(const Case& c, std::uint64_t seed, const std::string& property) {
  Choice choice;
  choice.only = property;
  return run_case(c, seed, choice).violated.count(property) != 0;
}

/// What follows `mark` on a line of its own; empty if nothing does.
std::string remark(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find("\n# " + mark + " ");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + mark.size() + 4;
  return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

std::string write_finding(const Case& c, std::uint64_t seed, const std::string& property, const std::string& what,
                          const std::string& folder, double shrink_seconds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                               std::chrono::duration<double>(shrink_seconds));
  const auto fails = [&](const Case& smaller) { return still_fails(smaller, seed, property); };
  const Case small = shrink_seconds > 0 ? shrink(c, fails, deadline) : c;
  const std::string file =
      (std::filesystem::path(folder) / fmt::format("{}-{}-{}.off", kGeneratorVersion, seed, property)).string();
  std::filesystem::create_directories(folder);
  std::ofstream out(file, std::ios::binary);
  out << case_text(small,
                   {"seed " + std::to_string(seed), "property " + property, "found " + what, "replay: gvd fuzz --replay " + file});
  if (!out.flush()) throw InternalError(file + ": cannot be written");
  return file;
}

void save_case(const Case& c, std::uint64_t seed, const std::string& file) {
  std::ofstream out(file, std::ios::binary);
  out << case_text(c, {"seed " + std::to_string(seed), "replay: gvd fuzz --replay " + file});
  if (!out.flush()) throw InternalError(file + ": cannot be written");
}

CaseResult replay(const std::string& file, Choice choice) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file + ": cannot be read");
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const std::string seed = remark(text, "seed");
  if (choice.only.empty()) choice.only = remark(text, "property");
  if (find_property(choice.only) == nullptr) choice.only.clear();
  return run_case(parse_case(text, file), seed.empty() ? 0 : std::stoull(seed), choice);
}

}  // namespace gvd::fuzz
