// Bytes as a small integer TIN with sources: all properties hold.
#include <algorithm>
#include <iostream>

#include "fuzz/generators/case.hpp"
#include "fuzz/generators/grids.hpp"
#include "fuzz/properties/property.hpp"
#include "fuzz_input.hpp"
#include "gvd/kernel/error.hpp"

namespace {

using gvd::fuzz::Input;
using namespace gvd::fuzz;

/// A grid of up to 3 x 3 squares with heights 0 .. 3, each diagonal by a bit, some squares taken out.
Case decoded(Input& input) {
  Case c;
  const std::uint32_t nx = 1 + input.below(3), ny = 1 + input.below(3);
  for (std::uint32_t j = 0; j <= ny; ++j)
    for (std::uint32_t i = 0; i <= nx; ++i) c.mesh.points.push_back({double(i), double(j), double(input.below(4))});
  for (std::uint32_t j = 0; j < ny; ++j)
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = j * (nx + 1) + i, b = a + 1, e = b + nx + 1, d = a + nx + 1, kind = input.below(8);
      if (kind == 7 && !c.mesh.faces.empty()) continue;
      if (kind % 2 == 0)
        c.mesh.faces.insert(c.mesh.faces.end(), {{a, b, e}, {a, e, d}});
      else
        c.mesh.faces.insert(c.mesh.faces.end(), {{a, b, d}, {b, e, d}});
    }
  c.mesh = without_faces(c.mesh, [](std::size_t) { return false; });
  const std::uint32_t sources = 1 + input.below(4);
  for (std::uint32_t s = 0; s < sources; ++s) {
    Place place{input.below(static_cast<std::uint32_t>(c.mesh.faces.size())), {}, 0};
    for (double& w : place.corner_weights) w = input.below(4);
    if (place.corner_weights == std::array<double, 3>{0, 0, 0}) place.corner_weights[0] = 1;
    const std::uint32_t weight = input.below(8);
    place.weight = weight < 6 ? 0 : 0.5 * (weight - 5);
    c.sources.push_back(place);
  }
  return c;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const Case c = decoded(input);
  if (!is_valid(c)) return 0;  // two squares may touch in one vertex
  Trial trial(c, input.byte());
  for (const Property& property : properties()) {
    const Outcome outcome = check(property, trial);
    if (outcome.kind == Outcome::Kind::violated)
      std::cerr << case_text(c, {std::string("property ") + property.name, outcome.what});
    require(outcome.kind != Outcome::Kind::violated, property.name);
  }
  return 0;
}
