#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>
#include <thread>

#include "arguments.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "gvd/io/version.hpp"
#include "gvd/io/vtp_writer.hpp"
#include "messages.hpp"
#ifdef GVD_WITH_FUZZ
#include "fuzz/cli/fuzz_command.hpp"
#endif

namespace gvd::cli {

namespace {

constexpr const char* kAbout =
    "gvd: certified geodesic distances and Voronoi diagrams on triangle meshes.\n"
    "Every result is proved, or listed as undecided; nothing depends on a tolerance.";

constexpr const char* kExitCodes =
    "Exit codes: 0 certified; 2 usage; 3 input refused; 4 undecided, or a memory or time limit; 5 internal error;\n"
    "130, 143 stopped by Ctrl-C or SIGTERM.";

constexpr const char* kMeshFormats = "Mesh: VTK legacy polydata, PLY, OFF, OBJ, or an ESRI ASCII grid (.asc)";

constexpr const char* kSourcesHelp =
    "A file with one source a line: v INDEX | e A B T | f FACE B0 B1 B2 | p X Y Z | xy X Y, each with an optional w=WEIGHT; # starts a "
    "comment. Or random:N (uniform over the surface), or vertices:N; both with --seed";

/// An option with a value that `parse` turns into a number or refuses with a sentence.
template <class Value>
void add_parsed(CLI::App& app, const std::string& name, Value& value, Value (*parse)(const std::string&), const std::string& help,
                const std::string& type) {
  app.add_option_function<std::string>(
         name,
         [&value, parse, name](const std::string& text) {
           try {
             value = parse(text);
           } catch (const std::invalid_argument& e) {
             throw CLI::ValidationError(name, e.what());
           }
         },
         help)
      ->type_name(type);
}

void add_mesh(CLI::App& app, Options& options) {
  app.add_option("MESH", options.mesh, kMeshFormats)->required()->type_name("FILE");
  app.add_flag("--json", options.json, "Put exactly one JSON object on the standard output");
  app.add_flag("-q,--quiet", options.quiet, "No progress and no notes on the standard error, only errors");
}

void add_solving(CLI::App& app, Options& options) {
  app.add_option("--sources", options.sources, kSourcesHelp)->required()->type_name("FILE|random:N|vertices:N");
  app.add_option("--seed", options.seed, "Seed of random:N and vertices:N; the same on every machine")->capture_default_str();
  app.add_option("--threads", options.threads, "Threads for all phases but the propagation; results do not depend on it (default: all cores)")
      ->check(CLI::Range(1u, 1024u))
      ->type_name("N");
  add_parsed(app, "--max-memory", options.max_memory_bytes, parse_bytes, "Stop with exit code 4 above this size of the process, as 512M or 4G", "SIZE");
  add_parsed(app, "--time-limit", options.time_limit_seconds, parse_seconds, "Stop with exit code 4 after this time, as 30s, 10m or 1h", "TIME");
}

void add_info(CLI::App& app, Options& options) {
  auto* info = app.add_subcommand("info", "Validate a mesh and count its vertices, faces, edges, boundary loops, saddles, ...");
  add_mesh(*info, options);
  info->footer("Examples:\n  gvd info terrain.vtk\n  gvd info examples/maunga_whau.asc --json\n");
}

void add_distance(CLI::App& app, Options& options) {
  auto* distance = app.add_subcommand("distance", "Correctly rounded geodesic distance and nearest sources of every vertex");
  add_mesh(*distance, options);
  add_solving(*distance, options);
  distance->add_option("--out", options.out, "CSV file with the columns vertex,distance,source")->required()->type_name("FILE.csv");
  distance->footer(
      "Examples:\n"
      "  gvd distance terrain.vtk --sources wells.txt --out distances.csv\n"
      "  gvd distance terrain.ply --sources vertices:100 --seed 7 --out distances.csv --json\n");
}

void add_compute(CLI::App& app, Options& options) {
  auto* compute = app.add_subcommand("compute", "The whole geodesic Voronoi diagram");
  add_mesh(*compute, options);
  add_solving(*compute, options);
  compute
      ->add_option("--out", options.out, "Directory for distances.csv, diagram.json, diagram.vtp, cells.vtp and diagram.svg; made if missing")
      ->required()
      ->type_name("DIR");
  options.deviation = io::kDefaultDeviation;
  compute->add_option("--deviation", options.deviation, "Largest deviation of drawn arcs in the .vtp files, as a part of the longest side of the facet")
      ->check(CLI::Range(io::kLeastDeviation, 1.0))
      ->capture_default_str();
  compute->add_option("--units", options.units, "Name of the mesh's unit of length for the map and diagram.json")->capture_default_str();
  compute->footer(
      "Examples:\n"
      "  gvd compute examples/maunga_whau.asc --sources random:30 --seed 1 --units m --out build/demo\n"
      "  gvd compute terrain.vtk --sources towns.txt --out diagram --threads 4 --max-memory 4G --time-limit 10m\n");
}

int run(int argc, char** argv) {
  Options options;
  options.threads = std::max(1u, std::thread::hardware_concurrency());
  CLI::App app(kAbout, "gvd");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("gvd ") + io::version());
  app.footer(std::string("`gvd COMMAND --help` tells the options and shows examples.\n") + kExitCodes);
  add_info(app, options);
  add_distance(app, options);
  add_compute(app, options);
#ifdef GVD_WITH_FUZZ
  fuzz::FuzzArguments fuzz_arguments;
  fuzz::add_fuzz_command(app, fuzz_arguments);
#endif
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kCertified : kUsage;
  }
  const std::map<std::string, std::function<int(const Options&)>> commands = {
#ifdef GVD_WITH_FUZZ
      {"fuzz", [&](const Options&) { return fuzz::run_fuzz_command(fuzz_arguments); }},
#endif
      {"info", run_info}, {"distance", run_distance}, {"compute", run_compute}};
  try {
    return commands.at(app.get_subcommands().front()->get_name())(options);
  } catch (...) {
    return report_error(options.json);
  }
}

}  // namespace

}  // namespace gvd::cli

int main(int argc, char** argv) { return gvd::cli::run(argc, argv); }
