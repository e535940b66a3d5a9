#include <filesystem>

#include "commands.hpp"
#include "gvd/io/distances_writer.hpp"
#include "gvd/io/staged_files.hpp"
#include "solving.hpp"

namespace gvd::cli {

int run_distance(const Options& options) {
  const std::filesystem::path out = options.out;
  const std::string name = out.filename().string();
  if (name.empty() || name == "." || name == "..") throw io::OutputPathError("--out " + options.out + " names no file");
  io::StagedFiles files(out.parent_path(), {name});
  const Solved solved(options, false);
  return solved.finish(files, [&] {
    files.write(name, [&](std::ostream& stream) { io::write_distances(stream, io::vertex_results(solved.mesh(), solved.solution())); });
  });
}

}  // namespace gvd::cli
