#include "commands.hpp"
#include "gvd/io/summary_writer.hpp"
#include "gvd/kernel/mesh_facts.hpp"
#include "messages.hpp"
#include "solving.hpp"

namespace gvd::cli {

int run_info(const Options& options) {
  const kernel::Mesh mesh = load_mesh(options);
  predicates::Decisions decisions;
  const auto facts = kernel::facts(mesh, decisions);
  print(options.json ? io::facts_json(facts) + "\n" : io::facts_text(facts));
  return report_undecided(decisions);
}

}  // namespace gvd::cli
