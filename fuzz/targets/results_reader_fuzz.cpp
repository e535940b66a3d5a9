// Any bytes as a line of JSON results, and as a case file: refused with InputError, or written and read again the same.
#include <string>

#include "fuzz/campaign/case_result.hpp"
#include "fuzz_input.hpp"
#include "gvd/kernel/error.hpp"

namespace {

using namespace gvd::fuzz;

constexpr const char* kResult =
    R"({"version":1,"seed":1,"family":"f","faces":2,"sources":1,"status":"certified","undecided":[],"tags":[],"violated":{},"held":[],"open":[],"skipped":[],"ms":)";

void read_result(const std::string& text) {
  try {
    const CaseResult result = parse_line(text);
    require(to_line(parse_line(to_line(result))) == to_line(result), "a result reads back as what was written");
  } catch (const gvd::InputError&) {
  }
}

void read_case_text(const std::string& text) {
  try {
    const Case c = parse_case(text, "x.off");
    require(source_text(parse_case(case_text(c, {}), "x.off").sources) == source_text(c.sources),
            "sources read back as what was written");
  } catch (const gvd::InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  read_result(data[0] % 2 == 0 ? text : kResult + text);
  read_case_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n# source f 0 " + text);
  return 0;
}
