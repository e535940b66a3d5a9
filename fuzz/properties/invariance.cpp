#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

#include "fuzz/properties/property.hpp"
#include "fuzz/properties/surface_points.hpp"
#include "gvd/kernel/extract.hpp"

namespace gvd::fuzz {
namespace {

using kernel::SourceId;
using kernel::VertexId;

/// The same problem under other names, and how results are mapped back.
struct Altered {
  Case problem;
  std::vector<VertexId> vertex;              ///< first -> altered
  std::vector<SourceId> source;              ///< altered -> first
  std::array<std::size_t, 3> axis{0, 1, 2};  ///< coordinate k of the first is coordinate axis[k] of the altered
  int scale = 0;                             ///< altered = first * 2^scale

  explicit Altered(const Case& c) : problem(c), vertex(c.mesh.points.size()), source(c.sources.size()) {
    std::iota(vertex.begin(), vertex.end(), 0u);
    std::iota(source.begin(), source.end(), 0u);
  }
};

std::vector<std::uint32_t> shuffled(Draw& draw, std::size_t n) {
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[draw.below(static_cast<std::uint32_t>(i))]);
  return order;
}

/// Vertices, faces and sources in another order; every face starts at another corner.
Altered renumbered(Draw& draw, const Case& c) {
  Altered out(c);
  out.vertex = shuffled(draw, c.mesh.points.size());
  out.source = shuffled(draw, c.sources.size());
  const auto face_order = shuffled(draw, c.mesh.faces.size());
  for (std::size_t v = 0; v < c.mesh.points.size(); ++v) out.problem.mesh.points[out.vertex[v]] = c.mesh.points[v];
  std::vector<std::uint32_t> new_face(face_order.size());
  std::vector<std::size_t> turn(face_order.size());
  for (std::uint32_t i = 0; i < face_order.size(); ++i) {
    const auto f = face_order[i];
    new_face[f] = i;
    turn[f] = draw.below(3);
    for (std::size_t k = 0; k < 3; ++k) out.problem.mesh.faces[i][k] = out.vertex[c.mesh.faces[f][(k + turn[f]) % 3]];
  }
  for (std::size_t i = 0; i < out.source.size(); ++i) {
    Place place = c.sources[out.source[i]];
    const auto weights = place.corner_weights;
    for (std::size_t k = 0; k < 3; ++k) place.corner_weights[k] = weights[(k + turn[place.face]) % 3];
    place.face = new_face[place.face];
    out.problem.sources[i] = place;
  }
  return out;
}

Altered with_axes(Draw& draw, const Case& c) {
  constexpr std::array<std::array<std::size_t, 3>, 5> kAxes = {{{1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
  Altered out(c);
  out.axis = kAxes[draw.below(kAxes.size())];
  for (std::size_t v = 0; v < c.mesh.points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) out.problem.mesh.points[v][out.axis[k]] = c.mesh.points[v][k];
  return out;
}

/// The largest and smallest exponent of the numbers other than zero.
std::array<int, 2> exponents(const Case& c) {
  std::array<int, 2> range{0, 0};
  bool first = true;
  const auto see = [&](double x) {
    if (x == 0) return;
    const int e = std::ilogb(x);
    range = first ? std::array{e, e} : std::array{std::min(range[0], e), std::max(range[1], e)};
    first = false;
  };
  for (const auto& p : c.mesh.points)
    for (const double x : p) see(x);
  for (const Place& s : c.sources) see(s.weight);
  return range;
}

/// Times a power of two at which no number gets subnormal or too large, though squares may.
Altered rescaled(Draw& draw, const Case& c) {
  const auto [low, high] = exponents(c);
  constexpr int kFarthest = 900;
  Altered out(c);
  out.scale = draw.between(std::min(0, -kFarthest - low), std::max(0, kFarthest - high));
  for (auto& p : out.problem.mesh.points)
    for (double& x : p) x = std::ldexp(x, out.scale);
  for (Place& s : out.problem.sources) s.weight = std::ldexp(s.weight, out.scale);
  return out;
}

std::string canonical_text(const kernel::Solution& solution, const Altered& altered) {
  kernel::Diagram diagram = solution.diagram();
  for (auto& point : diagram.points) {
    const kernel::Point at = point.position;
    for (std::size_t k = 0; k < 3; ++k) point.position[k] = std::ldexp(at[altered.axis[k]], -altered.scale);
  }
  return canonical(diagram, {altered.source});
}

/// A closed edge starts in its lexicographically least point, which depends on the order of the axes; so does its place among the
/// edges. Its points become a set, and all lines are sorted.
std::string without_starts(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.find("closed") != std::string::npos) {
      std::set<std::string> points;
      for (std::size_t at = line.find('('); at != std::string::npos; at = line.find('(', at + 1))
        points.insert(line.substr(at, line.find(')', at) - at));
      line = "closed";
      for (const auto& point : points) line += " " + point + ")";
    }
    lines.push_back(line);
  }
  std::sort(lines.begin(), lines.end());
  std::string result;
  for (const auto& line : lines) result += line + "\n";
  return result;
}

/// The first line in which two texts differ.
std::string difference(const std::string& a, const std::string& b) {
  const auto end = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  const auto begin = a.rfind('\n', static_cast<std::size_t>(end - a.begin()));
  const std::size_t from = begin == std::string::npos ? 0 : begin + 1;
  return "'" + a.substr(from, 160) + "' and '" + b.substr(std::min(from, b.size()), 160) + "'";
}

Outcome same_results(Trial& t, const Altered& altered, unsigned threads = 1) {
  const kernel::Mesh mesh(altered.problem.mesh);
  const auto other = Trial::solve(mesh, sources_of(mesh, altered.problem.sources), true, threads);
  for (VertexId v = 0; v < altered.vertex.size(); ++v) {
    const double distance = std::ldexp(other.distance(altered.vertex[v]), -altered.scale);
    if (distance != t.solution().distance(v))
      return violated(fmt::format("{}: D was {} and is {}", vertex_name(v), t.solution().distance(v), distance));
  }
  if (!t.certified() || other.status() != kernel::Status::certified) return undecided();
  for (VertexId v = 0; v < altered.vertex.size(); ++v) {
    Sources labels = nearest(other, altered.vertex[v]);
    for (auto& s : labels) s = altered.source[s];
    std::sort(labels.begin(), labels.end());
    if (labels != nearest(t.solution(), v))
      return violated(
          fmt::format("{}: nearest were {} and are {}", vertex_name(v), text_of(nearest(t.solution(), v)), text_of(labels)));
  }
  const std::string first = without_starts(canonical_text(t.solution(), Altered(t.problem()))),
                    second = without_starts(canonical_text(other, altered));
  return first == second ? holds() : violated("the diagrams differ: " + difference(first, second));
}

Outcome renumbering(Trial& t) {
  Draw draw = t.draw("renumbering");
  return same_results(t, renumbered(draw, t.problem()));
}
Outcome axis_permutation(Trial& t) {
  Draw draw = t.draw("axis_permutation");
  return same_results(t, with_axes(draw, t.problem()));
}
Outcome power_of_two_scaling(Trial& t) {
  Draw draw = t.draw("power_of_two_scaling");
  return same_results(t, rescaled(draw, t.problem()));
}
Outcome threads(Trial& t) { return same_results(t, Altered(t.problem()), 3); }

constexpr std::array<Property, 4> kProperties = {{
    {"renumbering", renumbering, 28, "renumbering and turning faces changes nothing, bit for bit"},
    {"axis_permutation", axis_permutation, 29, "nor does permuting the axes"},
    {"power_of_two_scaling", power_of_two_scaling, 31, "nor scaling by a power of two"},
    {"threads", threads, 45, "nor the number of threads"},
}};

}  // namespace

std::span<const Property> invariance_properties() { return kProperties; }

}  // namespace gvd::fuzz
