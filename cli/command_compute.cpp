#include <array>
#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

#include "cancellation.hpp"
#include "commands.hpp"
#include "gvd/io/diagram_json_writer.hpp"
#include "gvd/io/distances_writer.hpp"
#include "gvd/io/staged_files.hpp"
#include "gvd/io/svg_writer.hpp"
#include "gvd/io/vtp_writer.hpp"
#include "solving.hpp"

namespace gvd::cli {

int run_compute(const Options& options) {
  io::StagedFiles files(options.out, {"distances.csv", "diagram.json", "diagram.vtp", "cells.vtp", "diagram.svg"});
  const Solved solved(options, true);
  return solved.finish(files, [&] {
    const io::ResultView view = solved.view(options);
    const std::vector<std::pair<const char*, std::function<void(std::ostream&)>>> writers = {
        {"distances.csv", [&](std::ostream& out) { io::write_distances(out, view.vertices); }},
        {"diagram.json", [&](std::ostream& out) { io::write_diagram_json(out, view); }},
        {"diagram.vtp", [&](std::ostream& out) { io::write_diagram_vtp(out, view, options.deviation); }},
        {"cells.vtp", [&](std::ostream& out) { io::write_cells_vtp(out, view, options.deviation); }},
        {"diagram.svg", [&](std::ostream& out) { io::write_diagram_svg(out, view); }}};
    for (const auto& [name, fill] : writers) {
      if (requested_signal() != 0) return;
      files.write(name, fill);
    }
  });
}

}  // namespace gvd::cli
