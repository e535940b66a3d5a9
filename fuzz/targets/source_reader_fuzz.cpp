// Any bytes as a source file: refused with InputError, or every source is a point of the mesh with a weight that is allowed.
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "fuzz_input.hpp"
#include "gvd/io/source_reader.hpp"
#include "gvd/kernel/error.hpp"
#include "gvd/kernel/surface_point.hpp"

namespace {

using gvd::fuzz::require;

/// Put before the input, so that random bytes get past the first word.
constexpr std::array<std::string_view, 8> kBegin = {"", "v ", "e 0 1 ", "f 0 ", "p ", "xy ", "v 1 w=", "f 1 1 1 1\n# "};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const gvd::kernel::Mesh mesh({{{0, 0, 0}, {4, 0, 1}, {4, 4, 0}, {0, 4, 2}}, {{0, 1, 2}, {0, 2, 3}}});
  if (size == 0) return 0;
  const std::string text =
      std::string(kBegin[data[0] % kBegin.size()]) + std::string(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    gvd::io::SourceReport report;
    const auto sources = gvd::io::parse_sources(text, "sources", mesh, report);
    require(!sources.empty(), "a file without a source is refused");
    for (const auto& source : sources) {
      require(std::isfinite(source.weight) && source.weight >= 0, "weights are finite and not negative");
      gvd::kernel::locate(mesh, source.at);  // throws if it is no point of the mesh
    }
  } catch (const gvd::InputError& refusal) {
    require(refusal.what()[0] != '\0', "a refusal says why");
  }
  return 0;
}
