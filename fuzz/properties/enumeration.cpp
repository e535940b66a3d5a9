#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "fuzz/properties/brute_force.hpp"
#include "fuzz/properties/property.hpp"
#include "fuzz/properties/surface_points.hpp"

namespace gvd::fuzz {
namespace {

using kernel::SourceId;
using kernel::VertexId;

/// Beyond this many faces the number of strips explodes.
constexpr std::uint32_t kMostFaces = 18;
constexpr std::size_t kMostSources = 4;

Outcome all_strips_enumerated(Trial& t) {
  if (t.mesh().face_count() > kMostFaces || t.sources().size() > kMostSources) return skipped();
  ExactMesh exact(t.mesh());
  std::vector<std::uint32_t> roots;
  for (const auto& s : t.sources()) {
    const auto where = locate(t.mesh(), s.at);
    if (where.kind == kernel::Location::Kind::vertex) {
      roots.push_back(where.vertex);
      continue;
    }
    const auto before = exact.faces.size();
    roots.push_back(exact.insert(exact_position(t.mesh(), s.at)));
    const bool on_boundary = where.kind == kernel::Location::Kind::edge && t.mesh().twin(where.halfedge) == kernel::kNone;
    const bool is_known = std::any_of(t.sources().begin(), t.sources().begin() + static_cast<std::ptrdiff_t>(roots.size()) - 1,
                                      [&](const auto& other) { return other.at.face == s.at.face && other.at.bary == s.at.bary; });
    if (exact.faces.size() != before + (is_known ? 0 : on_boundary ? 1 : 2)) return skipped();  // sheets of the surface touch there
  }
  const BruteForce truth(exact);
  std::vector<std::vector<std::optional<robust::Mpfr>>> waves;
  for (SourceId s = 0; s < roots.size(); ++s) waves.push_back(truth.from(roots[s], t.sources()[s].weight));
  for (VertexId v = 0; v < t.mesh().vertex_count(); ++v) {
    std::optional<robust::Mpfr> least;
    for (const auto& wave : waves)
      if (wave[v] && (!least || *wave[v] < *least)) least = *wave[v];
    const double expected = least ? least->to_double() : std::numeric_limits<double>::infinity();
    if (t.solution().distance(v) != expected)
      return violated(
          fmt::format("{}: D is {}, the shortest of all strips {}", vertex_name(v), t.solution().distance(v), expected));
    if (!t.certified()) continue;
    Sources labels;
    for (SourceId s = 0; s < waves.size(); ++s)
      if (waves[s][v] && BruteForce::same(*waves[s][v], *least)) labels.push_back(s);
    if (nearest(t.solution(), v) != labels)
      return violated(
          fmt::format("{}: nearest are {}, by all strips {}", vertex_name(v), text_of(nearest(t.solution(), v)), text_of(labels)));
  }
  return t.certified() ? holds() : undecided();
}

constexpr std::array<Property, 1> kProperties = {{
    {"all_strips_enumerated", all_strips_enumerated, 6,
     "on small meshes, D and labels are those of the straight paths through every strip"},
}};

}  // namespace

std::span<const Property> enumeration_properties() { return kProperties; }

}  // namespace gvd::fuzz
