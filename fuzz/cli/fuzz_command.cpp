#include "fuzz/cli/fuzz_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "cli/arguments.hpp"
#include "gvd/io/staged_files.hpp"

namespace gvd::fuzz {
namespace {

void add_time(CLI::App& app, const std::string& name, double& seconds, const std::string& help) {
  app.add_option_function<std::string>(
         name,
         [&seconds, name](const std::string& text) {
           try {
             seconds = cli::parse_seconds(text);
           } catch (const std::invalid_argument& e) {
             throw CLI::ValidationError(name, e.what());
           }
         },
         help)
      ->type_name("TIME");
}

void add_shard(CLI::App& app, CampaignOptions& campaign) {
  app.add_option_function<std::string>(
         "--shard",
         [&campaign](const std::string& text) {
           unsigned long long shard = 0, shards = 0;
           if (std::sscanf(text.c_str(), "%llu/%llu", &shard, &shards) != 2 || shards == 0 || shard >= shards)
             throw CLI::ValidationError("--shard", "'" + text + "' is not i/N with 0 <= i < N");
           campaign.shard = shard;
           campaign.shards = shards;
         },
         "Only every N-th case, from the i-th on")
      ->type_name("i/N");
}

template <class Table>
CLI::Validator one_of(const Table& table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.name);
  return CLI::IsMember(names);
}

void print(const std::string& text) { std::fputs(text.c_str(), stdout); }

int list() {
  print("properties, each looked at in one of so many cases\n");
  for (const Property& p : properties()) print(fmt::format("  {:>2} {:<34} {}\n", p.one_in, p.name, p.says));
  print("families\n");
  for (const Family& f : families()) print(fmt::format("    {:<34} {}\n", f.name, f.about));
  print("patterns of sources\n");
  for (const Pattern& p : patterns()) print(fmt::format("    {}\n", p.name));
  return 0;
}

/// One case, given by a file or by its seed.
int run_one(const FuzzArguments& a) {
  const CampaignOptions& c = a.campaign;
  const CaseResult result = a.replay.empty() ? run_case(*a.one_case, c.wish, c.choice) : replay(a.replay, c.choice);
  if (!a.save.empty()) save_case(a.replay.empty() ? make_case(*a.one_case, c.wish) : read_case(a.replay), result.seed, a.save);
  print(to_line(result) + "\n");
  for (const auto& [property, what] : result.violated) fmt::print(stderr, "gvd: fuzz: {}: {}\n", property, what);
  return result.violated.empty() ? 0 : kFindings;
}

int set_against(const FuzzArguments& a, const CampaignOptions& campaign) {
  if (a.replay.empty()) {
    const AgainstReport report = run_against(campaign, a.against);
    print(report.text());
    return report.witness.empty() ? 0 : kFindings;
  }
  const Judgement j = judge(read_case(a.replay), a.against);
  print(fmt::format("{}: {}, worst relative error {:.3g}\n", failure_name(j.failure), j.what, j.worst));
  return j.failure == Failure::none ? 0 : kFindings;
}

int merge_files(const FuzzArguments& a) {
  std::vector<CaseResult> all;
  for (const auto& file : a.merge) {
    const auto part = read_results(file);
    all.insert(all.end(), part.begin(), part.end());
  }
  Tally tally;
  const auto once = merged(std::move(all));
  for (const auto& result : once) tally.add(result);
  if (!a.campaign.out.empty()) {
    const std::filesystem::path out = a.campaign.out;
    io::StagedFiles files(out.parent_path(), {out.filename().string()});
    files.write(out.filename().string(), [&](std::ostream& stream) {
      for (const auto& result : once) stream << to_line(result) << '\n';
    });
    files.commit();
  }
  print(tally.text());
  return tally.violations() == 0 ? 0 : kFindings;
}

}  // namespace

void add_fuzz_command(CLI::App& app, FuzzArguments& a) {
  CampaignOptions& c = a.campaign;
  auto* fuzz = app.add_subcommand("fuzz", "Attack the kernel with generated meshes (docs/fuzzing.md)");
  fuzz->add_option("--cases", c.cases, "End after so many cases");
  add_time(*fuzz, "--time", c.seconds, "End after this time, as 10m");
  fuzz->add_option("--seed", c.seed, "Seed of the campaign")->capture_default_str();
  add_shard(*fuzz, c);
  fuzz->add_option("--property", c.choice.only, "Only this property")->check(one_of(properties()));
  fuzz->add_flag("--thorough", c.choice.thorough, "All properties on each case, whatever their rates");
  fuzz->add_option("--family", c.wish.family, "Only meshes of this family")->check(one_of(families()));
  fuzz->add_option("--pattern", c.wish.pattern, "Only sources of this pattern")->check(one_of(patterns()));
  fuzz->add_option("--size", c.wish.size, "Size of the meshes: about 2 SIZE^2 faces")->check(CLI::Range(1u, 200u));
  fuzz->add_option("--sources", c.wish.sources, "Number of sources")->check(CLI::Range(1u, 100000u));
  fuzz->add_option("--weighted", c.wish.weighted, "0: no weights, 1: weights")->check(CLI::Range(0, 1));
  fuzz->add_option("--out", c.out, "Results, one JSON object a line; cases that are there already are not run again")
      ->type_name("FILE.jsonl");
  fuzz->add_option("--findings", c.findings, "Folder for failing cases")->capture_default_str()->type_name("DIR");
  add_time(*fuzz, "--shrink-time", c.shrink_seconds, "Longest time to spend on shrinking a failing case");
  fuzz->add_flag("--first", c.stop_at_first, "End at the first finding");
  fuzz->add_option("--most-undecided", a.most_undecided, "Count it as a finding if more cases than these are undecided, in per cent")
      ->capture_default_str();
  fuzz->add_option("--case", a.one_case, "Only the case of this seed, as results name it; prints its line");
  fuzz->add_option("--save", a.save, "With --case: write mesh and sources, for --replay")->type_name("FILE.off");
  fuzz->add_option("--replay", a.replay, "Look at a written case again")->type_name("FILE.off");
  fuzz->add_option(
          "--against", a.against.command,
          "Judge another program: {mesh} (OFF), {sources} and {out} (CSV: vertex,distance[,source]) in the command are file names")
      ->type_name("COMMAND");
  fuzz->add_option("--tolerance", a.against.tolerance, "With --against: a larger relative error is a wrong distance")
      ->capture_default_str();
  add_time(*fuzz, "--case-time", a.against.limits.seconds, "With --against: longest time for one case");
  fuzz->add_option_function<std::string>(
          "--case-memory", [&a](const std::string& text) { a.against.limits.bytes = cli::parse_bytes(text); },
          "With --against: largest address space")
      ->type_name("SIZE");
  fuzz->add_flag("--list", a.list, "List properties, families and patterns");
  fuzz->add_flag("-q,--quiet", c.quiet, "No progress on the standard error");
  auto* merge = fuzz->add_subcommand("merge", "Join results files: each case once, in order");
  merge->add_option("FILES", a.merge, "Results files")->required()->type_name("FILE.jsonl");
  merge->add_option("--out", c.out, "Where to write the joined results")->type_name("FILE.jsonl");
  fuzz->footer(
      "Exit code 1: something was found.\nExamples:\n"
      "  gvd fuzz --time 10m --out results.jsonl\n"
      "  gvd fuzz --cases 1000 --seed 7 --family slivers --property renumbering\n"
      "  gvd fuzz --time 1m --against 'other_program {mesh} {sources} {out}'\n"
      "  gvd fuzz merge part-*.jsonl --out results.jsonl\n");
}

int run_fuzz_command(const FuzzArguments& a) {
  if (a.list) return list();
  if (!a.merge.empty()) return merge_files(a);
  CampaignOptions campaign = a.campaign;
  if (campaign.cases == 0 && campaign.seconds == 0) campaign.cases = 1000;
  if (!a.against.command.empty()) return set_against(a, campaign);
  if (!a.replay.empty() || a.one_case) return run_one(a);
  const Tally tally = run_campaign(campaign);
  print(tally.text());
  const bool too_many_open = 100 * static_cast<double>(tally.undecided()) > a.most_undecided * static_cast<double>(tally.cases());
  if (too_many_open) fmt::print(stderr, "gvd: fuzz: more than {} % of the cases are undecided\n", a.most_undecided);
  return tally.violations() == 0 && !too_many_open ? 0 : kFindings;
}

}  // namespace gvd::fuzz
