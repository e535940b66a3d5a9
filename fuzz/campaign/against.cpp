#include "fuzz/campaign/against.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "fuzz/generators/shrink.hpp"
#include "fuzz/properties/trial.hpp"
#include "gvd/kernel/error.hpp"

namespace gvd::fuzz {
namespace {

namespace fs = std::filesystem;
using kernel::VertexId;

/// A folder for the files of one run after the other, removed at the end.
class Workplace {
 public:
  Workplace() {
    std::string name = (fs::temp_directory_path() / "gvd-against-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw InternalError("no temporary directory");
    path_ = name;
  }
  ~Workplace() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

void write(const std::string& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw InternalError(file + ": cannot be written");
}

std::string filled_in(std::string command, const std::string& mark, const std::string& value) {
  for (std::size_t at = 0; (at = command.find(mark, at)) != std::string::npos; at += value.size())
    command.replace(at, mark.size(), value);
  return command;
}

struct Told {
  double distance;
  std::optional<kernel::SourceId> source;
};

/// One line `vertex,distance[,source]`; of several sources the first counts. A line that does not start with a number is a heading.
void read_line(const std::string& line, std::vector<std::optional<Told>>& told) {
  std::array<std::string, 3> words;
  std::istringstream stream(line);
  for (auto& word : words) std::getline(stream, word, ',');
  std::uint32_t vertex = 0;
  if (std::from_chars(words[0].data(), words[0].data() + words[0].size(), vertex).ec != std::errc{} || vertex >= told.size() ||
      words[1].empty())
    return;
  char* end = nullptr;
  const double distance = std::strtod(words[1].c_str(), &end);
  if (end == words[1].c_str()) return;
  kernel::SourceId source = 0;
  const bool labelled = std::from_chars(words[2].data(), words[2].data() + words[2].size(), source).ec == std::errc{};
  told[vertex] = Told{distance, labelled ? std::optional(source) : std::nullopt};
}

std::vector<std::optional<Told>> read_answer(const std::string& file, VertexId vertices) {
  std::vector<std::optional<Told>> told(vertices);
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line);) read_line(line, told);
  return told;
}

/// Next to a source a relative error means nothing: it is measured against at least this part of the longest edge.
constexpr double kLeastSize = 0x1p-20;
double relative_error(double told, double truth, double longest_edge) {
  return told == truth ? 0 : std::fabs(told - truth) / std::max(std::fabs(truth), kLeastSize * longest_edge);
}

/// Keeps the worst.
void note(Judgement& j, Failure failure, std::string what) {
  if (failure >= j.failure) return;
  j.failure = failure;
  j.what = std::move(what);
}

void judge_vertex(Trial& trial, VertexId v, const std::optional<Told>& told, double tolerance, double longest, Judgement& j) {
  const double truth = trial.field().distance(v);
  if (!told) return note(j, Failure::no_output, fmt::format("no distance for vertex {}", v));
  if (std::isnan(told->distance)) return note(j, Failure::not_a_number, fmt::format("vertex {} is not a number", v));
  if (std::isinf(told->distance) != std::isinf(truth))
    return note(j, Failure::reachability, fmt::format("vertex {}: told {}, truth {}", v, told->distance, truth));
  if (std::isinf(truth)) return;
  const double error = relative_error(told->distance, truth, longest);
  j.worst = std::max(j.worst, error);
  if (error > tolerance)
    return note(j, Failure::wrong_distance, fmt::format("vertex {}: told {}, truth {}", v, told->distance, truth));
  if (!told->source) return;
  if (*told->source >= trial.sources().size())
    return note(j, Failure::wrong_label, fmt::format("vertex {}: there is no source {}", v, *told->source));
  const double of_label = trial.alone(*told->source).distance(v);
  if (relative_error(of_label, truth, longest) > tolerance)
    note(j, Failure::wrong_label,
         fmt::format("vertex {}: labelled {}, which is at {}; the nearest is at {}", v, *told->source, of_label, truth));
}

double longest_edge(const kernel::Mesh& mesh) {
  double most = 0;
  for (kernel::HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    const auto &a = mesh.point(mesh.origin(h)), &b = mesh.point(mesh.target(h));
    most = std::max(most, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  return most;
}

Judgement judge_in(const Workplace& place, const Case& c, const AgainstOptions& options) {
  const std::string mesh = place.file("mesh.off"), sources = place.file("sources.txt"), out = place.file("out.csv");
  write(mesh, mesh_text(c.mesh));
  write(sources, source_text(c.sources));
  fs::remove(out);
  const ExternalEnd end = run_external(
      filled_in(filled_in(filled_in(options.command, "{mesh}", mesh), "{sources}", sources), "{out}", out), options.limits);
  Judgement j;
  if (end.kind == ExternalEnd::Kind::crashed) return note(j, Failure::crashed, fmt::format("signal {}", end.number)), j;
  if (end.kind == ExternalEnd::Kind::hung)
    return note(j, Failure::hung, fmt::format("no end after {} s", options.limits.seconds)), j;
  if (end.kind == ExternalEnd::Kind::failed) return note(j, Failure::refused, fmt::format("exit code {}", end.number)), j;
  Trial trial(c, 0);
  const auto told = read_answer(out, trial.mesh().vertex_count());
  const double longest = longest_edge(trial.mesh());
  for (VertexId v = 0; v < trial.mesh().vertex_count(); ++v) {
    if (trial.mesh().is_isolated(v)) continue;  // no part of the surface
    judge_vertex(trial, v, told[v], options.tolerance, longest, j);
  }
  return j;
}

std::string write_witness(const Workplace& place, const Case& c, const Judgement& j, const CampaignOptions& campaign,
                          const AgainstOptions& options) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                               std::chrono::duration<double>(campaign.shrink_seconds));
  const auto fails = [&](const Case& smaller) { return judge_in(place, smaller, options).failure == j.failure; };
  const Case small = campaign.shrink_seconds > 0 ? shrink(c, fails, deadline) : c;
  const Judgement last = judge_in(place, small, options);
  fs::create_directories(campaign.findings);
  const std::string stem = (fs::path(campaign.findings) / fmt::format("against-{}", failure_name(j.failure))).string();
  write(stem + ".off", case_text(small, {"found " + last.what,
                                         fmt::format("replay: gvd fuzz --against '{}' --replay {}.off", options.command, stem)}));
  write(stem + ".sources.txt", source_text(small.sources));
  return stem + ".off: " + last.what;
}

}  // namespace

const char* failure_name(Failure failure) {
  constexpr std::array<const char*, kFailureCount> kNames = {
      "crashed", "hung", "refused", "no_output", "not_a_number", "reachability", "wrong_distance", "wrong_label", "right"};
  return kNames[static_cast<std::size_t>(failure)];
}

Judgement judge(const Case& c, const AgainstOptions& options) { return judge_in(Workplace(), c, options); }

std::string AgainstReport::text() const {
  std::string text = fmt::format("{} cases\n", cases);
  for (const auto& [failure, n] : counts)
    text += fmt::format("  {:<16} {:>9}  {:6.2f} %\n", failure_name(failure), n,
                        100 * static_cast<double>(n) / static_cast<double>(cases));
  text += fmt::format("worst relative error {:.3g}\n", worst);
  for (const auto& [failure, what] : witness) text += fmt::format("witness of {}: {}\n", failure_name(failure), what);
  return text;
}

AgainstReport run_against(const CampaignOptions& campaign, const AgainstOptions& options) {
  const Workplace place;
  const auto start = std::chrono::steady_clock::now();
  AgainstReport report;
  Wish wish = campaign.wish;
  if (wish.weighted < 0) wish.weighted = 0;  // few programs know weights
  for (std::uint64_t i = campaign.shard; campaign.cases == 0 || i < campaign.cases; i += campaign.shards) {
    if (campaign.seconds > 0 && std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > campaign.seconds)
      break;
    const Case c = make_case(campaign_seed(campaign.seed, i), wish);
    Judgement j;
    try {
      j = judge_in(place, c, options);
    } catch (const std::exception& e) {  // the truth is not to be had: a matter for a campaign of our own
      fmt::print(stderr, "gvd: fuzz: seed {}: {}\n", campaign_seed(campaign.seed, i), e.what());
      continue;
    }
    ++report.cases;
    ++report.counts[j.failure];
    report.worst = std::max(report.worst, j.worst);
    if (j.failure == Failure::none || report.witness.count(j.failure) != 0) continue;
    report.witness[j.failure] = write_witness(place, c, j, campaign, options);
    if (!campaign.quiet) fmt::print(stderr, "gvd: fuzz: {}: {}\n", failure_name(j.failure), report.witness[j.failure]);
  }
  return report;
}

}  // namespace gvd::fuzz
