#include "solving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "cancellation.hpp"
#include "exit_code.hpp"
#include "gvd/io/mesh_reader.hpp"
#include "gvd/io/summary_writer.hpp"
#include "messages.hpp"
#include "progress_bar.hpp"

namespace gvd::cli {

namespace {

using kernel::Status;

/// What is left of the time limit, which counts from the start of the program; 0: no limit.
double remaining_seconds(const Options& options) {
  if (options.time_limit_seconds == 0) return 0;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - options.start).count();
  return std::max(std::numeric_limits<double>::min(), options.time_limit_seconds - elapsed);  // 0 would mean no limit
}

kernel::Solution run(const kernel::Mesh& mesh, const std::vector<kernel::Source>& sources, const Options& options, bool diagram) {
  catch_signals();
  ProgressBar bar(!options.quiet);
  kernel::SolveOptions solve_options;
  solve_options.threads = options.threads;
  solve_options.max_memory_bytes = options.max_memory_bytes;
  solve_options.time_limit_seconds = remaining_seconds(options);
  solve_options.diagram = diagram;
  solve_options.progress = [&bar](const kernel::Progress& progress) {
    bar.show(progress);
    return requested_signal() == 0;
  };
  return kernel::solve(mesh, sources, solve_options);
}

std::string reason(Status status) {
  switch (status) {
    case Status::memory_limit: return "the memory limit was reached";
    case Status::time_limit: return "the time limit was reached";
    default: return "stopped by a signal";
  }
}

/// Up to a few notes in full, and how many more there are.
template <class Range, class Sentence>
void note_each(const Range& range, const char* more, Sentence&& sentence) {
  constexpr std::size_t kMostShown = 5;
  for (std::size_t i = 0; i < std::min(range.size(), kMostShown); ++i) note(sentence(range[i]));
  if (range.size() > kMostShown) note(fmt::format("... and {} more {}", range.size() - kMostShown, more));
}

}  // namespace

kernel::Mesh load_mesh(const Options& options) {
  kernel::Mesh mesh(io::read_mesh(options.mesh));
  if (!options.quiet && mesh.flipped_count() != 0)
    note(fmt::format("{} of {} faces were turned round to orient the mesh", mesh.flipped_count(), mesh.face_count()));
  return mesh;
}

Solved::Solved(const Options& options, bool diagram)
    : options_(options),
      mesh_(load_mesh(options)),
      sources_(io::parse_source_spec(options.sources, options.seed, mesh_, source_report_)),
      solution_(run(mesh_, sources_, options, diagram)) {}

io::ResultView Solved::view(const Options& options) const {
  const auto duplicates = solution_.duplicates();
  return {mesh_,
          solution_.diagram(),
          solution_.summary(),
          solution_.decisions(),
          sources_,
          io::vertex_results(mesh_, solution_),
          {duplicates.begin(), duplicates.end()},
          std::filesystem::path(options.mesh).stem().string(),
          options.units};
}

void Solved::report_sources() const {
  note_each(source_report_.projected, "sources given as p X Y Z", [](const io::ProjectedSource& p) {
    return fmt::format("source {} was moved by {} to the nearest surface point", p.source, p.distance);
  });
  note_each(solution_.duplicates(), "duplicate sources", [](const std::array<kernel::SourceId, 2>& pair) {
    return fmt::format("source {} lies at the same point as source {}", pair[0], pair[1]);
  });
  note_each(solution_.hidden(), "hidden sources", [](kernel::SourceId source) {
    return fmt::format("source {} is hidden: another source reaches it with less than its weight, its cell is empty", source);
  });
  if (const auto count = solution_.summary().unreachable_vertices; count != 0)
    note(fmt::format("{} vertices are unreachable: no source lies in their component", count));
}

int Solved::finish(io::StagedFiles& files, const std::function<void()>& write) const {
  const auto& summary = solution_.summary();
  const std::string report = options_.json ? io::summary_json(summary, solution_.decisions()) + "\n"
                                           : io::summary_text(summary, solution_.decisions());
  if (!kernel::is_complete(summary.status)) {
    print(report);
    note("error: " + reason(summary.status) + ": nothing was written");
    return requested_signal() != 0 ? 128 + requested_signal() : kUnproved;
  }
  {
    const WritingOutput writing;
    write();
    if (requested_signal() == 0) files.commit();
  }
  if (requested_signal() != 0) {
    note("error: stopped by a signal: nothing was written");
    return 128 + requested_signal();
  }
  if (!options_.quiet) report_sources();
  print(report);
  const int code = report_undecided(solution_.decisions());
  return summary.status == Status::certified ? kCertified : std::max<int>(code, kUnproved);
}

}  // namespace gvd::cli
