#pragma once

#include <functional>
#include <vector>

#include "commands.hpp"
#include "gvd/io/result_view.hpp"
#include "gvd/io/source_reader.hpp"
#include "gvd/io/staged_files.hpp"
#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/solver.hpp"
#include "gvd/kernel/source.hpp"

namespace gvd::cli {

/// Reads and validates the mesh.
kernel::Mesh load_mesh(const Options& options);

/// What `distance` and `compute` share: read, solve with progress, limits and signals, write, report.
class Solved {
 public:
  Solved(const Options& options, bool diagram);

  const kernel::Mesh& mesh() const noexcept { return mesh_; }
  const kernel::Solution& solution() const noexcept { return solution_; }
  io::ResultView view(const Options& options) const;

  /// If the solution is complete, calls `write`, commits the files and prints the summary. Else, or after a signal, nothing is written.
  /// Returns the exit code.
  int finish(io::StagedFiles& files, const std::function<void()>& write) const;

 private:
  void report_sources() const;

  const Options& options_;
  kernel::Mesh mesh_;
  io::SourceReport source_report_;
  std::vector<kernel::Source> sources_;
  kernel::Solution solution_;
};

}  // namespace gvd::cli
