#include "fuzz/campaign/case_result.hpp"

#include <algorithm>
#include <cctype>
#include <ctime>
#include <nlohmann/json.hpp>
#include <set>

#include "gvd/kernel/error.hpp"

namespace gvd::fuzz {
namespace {

std::vector<const Property*> chosen(const Choice& choice, std::uint64_t seed) {
  const auto is_drawn = [&](const Property& p) { return Draw(mixed_seed(seed, 0x9a7 + std::uint64_t{p.one_in})).one_in(p.one_in); };
  std::vector<const Property*> list;
  for (const Property& p : properties())
    if (choice.only.empty() ? choice.thorough || is_drawn(p) : choice.only == p.name) list.push_back(&p);
  return list;
}

/// Milliseconds of CPU since it was made: other programs on the machine do not count.
class Stopwatch {
 public:
  double milliseconds() const { return 1000.0 * static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

void look(Trial& trial, const Property& property, CaseResult& result) {
  const Stopwatch watch;
  const Outcome outcome = check(property, trial);
  result.cost[property.name] = watch.milliseconds();
  switch (outcome.kind) {
    case Outcome::Kind::violated:
      result.violated[property.name] = outcome.what;
      break;
    case Outcome::Kind::holds:
      result.held.emplace_back(property.name);
      break;
    case Outcome::Kind::undecided:
      result.open.emplace_back(property.name);
      break;
    case Outcome::Kind::skipped:
      result.skipped.emplace_back(property.name);
      break;
  }
}

void describe(Trial& trial, CaseResult& result) {
  const auto& solution = trial.solution();
  result.status = kernel::status_name(solution.status());
  std::set<std::string> kinds;
  for (const auto& what : solution.decisions().undecided_list()) kinds.insert(without_numbers(what));
  result.undecided.assign(kinds.begin(), kinds.end());
  const Tags tags = trial.tags();
  for (std::size_t t = 0; t < kTagCount; ++t)
    if (tags.has(static_cast<Tag>(t))) result.tags.emplace_back(tag_name(static_cast<Tag>(t)));
}

}  // namespace

std::string without_numbers(const std::string& sentence) {
  std::string kind;
  for (const char c : sentence)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0)
      kind += c;
    else if (kind.empty() || kind.back() != '#')
      kind += '#';
  return kind;
}

std::string to_line(const CaseResult& r) {
  const nlohmann::ordered_json line = {
      {"version", r.version}, {"seed", r.seed},           {"family", r.family},  {"faces", r.faces},       {"sources", r.sources},
      {"status", r.status},   {"undecided", r.undecided}, {"tags", r.tags},      {"violated", r.violated}, {"held", r.held},
      {"open", r.open},       {"skipped", r.skipped},     {"ms", r.milliseconds}, {"cost", r.cost}};
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

CaseResult parse_line(const std::string& text) {
  try {
    const auto line = nlohmann::json::parse(text);
    CaseResult r;
    line.at("version").get_to(r.version);
    line.at("seed").get_to(r.seed);
    line.at("family").get_to(r.family);
    line.at("faces").get_to(r.faces);
    line.at("sources").get_to(r.sources);
    line.at("status").get_to(r.status);
    line.at("undecided").get_to(r.undecided);
    line.at("tags").get_to(r.tags);
    line.at("violated").get_to(r.violated);
    line.at("held").get_to(r.held);
    line.at("open").get_to(r.open);
    line.at("skipped").get_to(r.skipped);
    line.at("ms").get_to(r.milliseconds);
    if (line.contains("cost")) line.at("cost").get_to(r.cost);
    return r;
  } catch (const nlohmann::json::exception& e) {
    throw InputError(std::string("not a line of results: ") + e.what());
  }
}

CaseResult run_case(const Case& c, std::uint64_t seed, const Choice& choice) {
  const Stopwatch watch;
  CaseResult result;
  result.seed = seed;
  result.family = c.family;
  result.faces = c.mesh.faces.size();
  result.sources = c.sources.size();
  try {
    Trial trial(c, seed);
    describe(trial, result);
    result.cost["solve"] = watch.milliseconds();
    for (const Property* property : chosen(choice, seed)) look(trial, *property, result);
  } catch (const TookTooLong&) {
    result.status = "too_long";
  } catch (const std::exception& e) {
    result.status = "threw";
    result.violated["solves"] = e.what();
  }
  result.milliseconds = watch.milliseconds();
  return result;
}

CaseResult run_case(std::uint64_t seed, const Wish& wish, const Choice& choice) {
  const Stopwatch watch;
  const Case c = make_case(seed, wish);
  const double made = watch.milliseconds();
  CaseResult result = run_case(c, seed, choice);
  result.cost["make"] = made;
  result.milliseconds += made;
  return result;
}

}  // namespace gvd::fuzz
