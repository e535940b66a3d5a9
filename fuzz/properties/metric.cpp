#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "fuzz/properties/property.hpp"
#include "fuzz/properties/surface_points.hpp"

namespace gvd::fuzz {
namespace {

using kernel::SourceId;
using kernel::VertexId;

/// Distances from source to source, each way by the run of the one it starts from.
struct Table {
  explicit Table(Trial& t) {
    const auto n = static_cast<SourceId>(std::min<std::size_t>(t.sources().size(), 4));
    for (SourceId s = 0; s < n; ++s) {
      auto& row = distance.emplace_back();
      for (SourceId u = 0; u < n; ++u) {
        const auto answer = t.alone(s).query(t.sources()[u].at);
        open = open || answer.undecided;
        row.push_back(answer.distance);
      }
    }
  }
  std::vector<std::vector<double>> distance;
  bool open = false;
};

Outcome distances_are_a_metric(Trial& t) {
  if (t.weighted() || t.sources().size() < 2) return skipped();
  const Table table(t);
  if (table.open) return undecided();
  const auto& d = table.distance;
  for (SourceId s = 0; s < d.size(); ++s)
    for (SourceId u = 0; u < d.size(); ++u) {
      const bool same = exact_position(t.mesh(), t.sources()[s].at) == exact_position(t.mesh(), t.sources()[u].at);
      if (d[s][u] != d[u][s]) return violated(fmt::format("from source {} to {}: {}; back: {}", s, u, d[s][u], d[u][s]));
      // Two places of one point of space on different faces are not the same point of the surface.
      if (d[s][u] == 0 && !same) return violated(fmt::format("sources {} and {} are different points at distance 0", s, u));
      for (SourceId w = 0; w < d.size(); ++w)
        if (std::isfinite(d[s][w]) &&
            std::nextafter(d[s][u], 0) > std::nextafter(std::nextafter(d[s][w] + d[w][u], HUGE_VAL), HUGE_VAL))
          return violated(fmt::format("the way from source {} to {} over {} is shorter than the shortest", s, u, w));
    }
  return holds();
}

Outcome distance_is_short_along_edges(Trial& t) {
  const auto& mesh = t.mesh();
  for (kernel::HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    const auto da = t.solution().distance_enclosure(a), db = t.solution().distance_enclosure(b);
    if (std::isinf(da.value) || std::isinf(db.value)) {
      if (da.value != db.value) return violated("an edge joins a reachable and an unreachable vertex");
      continue;
    }
    if (mesh.twin(h) < h) continue;  // seen from the other side
    const auto &far = da.value > db.value ? da : db, &near = da.value > db.value ? db : da;
    if (certainly_exceeds(far.low, near.high, mesh.point(a), mesh.point(b)))
      return violated(fmt::format("D({}) = {} and D({}) = {} differ by more than their edge", a, da.value, b, db.value));
  }
  return holds();
}

Outcome distance_is_short_along_chords(Trial& t) {
  Draw draw = t.draw("distance_is_short_along_chords");
  constexpr int kChords = 2;
  for (int i = 0; i < kChords; ++i) {
    const kernel::FaceId f = draw.below(t.mesh().face_count());
    const auto p = point_in(draw, f), q = point_in(draw, f);
    const auto dp = t.solution().query(p).enclosure, dq = t.solution().query(q).enclosure;
    if (std::isinf(dp.low) || std::isinf(dq.low)) continue;
    const auto chord = squared_distance(exact_position(t.mesh(), p), exact_position(t.mesh(), q));
    if (certainly_exceeds(dp.low, dq.high, chord) || certainly_exceeds(dq.low, dp.high, chord))
      return violated("D at " + text_of(p) + " and " + text_of(q) + " differs by more than their chord");
  }
  return holds();
}

/// D inside a facet is the least over its boundary of D there plus the rest of the way: never more (any boundary point), and
/// attained where the geodesic leaves the facet. A facet with a source inside is left out.
Outcome huygens(Trial& t) {
  Draw draw = t.draw("huygens");
  const kernel::FaceId f = draw.below(t.mesh().face_count());
  for (const auto& s : t.sources())
    if (s.at.face == f) return skipped();
  kernel::SurfacePoint p = point_in(draw, f);
  const auto answer = t.solution().path(p);
  if (std::isinf(answer.distance)) return skipped();
  const auto at = exact_position(t.mesh(), p);
  for (int i = 0; i < 3; ++i) {
    kernel::SurfacePoint q = point_in(draw, f);
    q.bary[static_cast<std::size_t>(i) % 3] = 0;
    const mpq_class sum = q.bary[0] + q.bary[1] + q.bary[2];
    if (sum == 0) continue;
    for (auto& b : q.bary) b /= sum;
    const auto there = t.solution().query(q);
    if (certainly_exceeds(answer.enclosure.low, there.enclosure.high, squared_distance(at, exact_position(t.mesh(), q))))
      return violated("D at " + text_of(p) + " is more than through the boundary point " + text_of(q));
  }
  return holds();
}

/// The legs of a geodesic add up to its distance, but for the rounding of its points.
Outcome paths_are_as_long_as_told(Trial& t) {
  Draw draw = t.draw("paths_are_as_long_as_told");
  const auto at = point_on(draw, t.mesh());
  const auto answer = t.solution().path(at);
  if (answer.undecided) return undecided();
  if (std::isinf(answer.distance)) return answer.path.empty() ? holds() : violated("a path to an unreachable point");
  if (answer.path.empty()) return violated("no path to " + text_of(at));
  double length = 0, size = 0;
  for (std::size_t i = 0; i + 1 < answer.path.size(); ++i) {
    const auto &a = answer.path[i].position, &b = answer.path[i + 1].position;
    length += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    for (std::size_t k = 0; k < 3; ++k) size = std::max({size, std::fabs(a[k]), std::fabs(b[k])});
  }
  const double weight = t.sources()[answer.nearest.front()].weight;  // the path leads to this one
  const double slack = 16 * 0x1p-52 * static_cast<double>(answer.path.size()) * (size + answer.distance);
  if (!(std::fabs(length + weight - answer.distance) <= slack))
    return violated(fmt::format("the path from {} has length {}, D is {}", text_of(at), length + weight, answer.distance));
  return holds();
}

constexpr std::array<Property, 5> kProperties = {{
    {"distance_is_short_along_edges", distance_is_short_along_edges, 1, "D differs along an edge by at most its length"},
    {"distance_is_short_along_chords", distance_is_short_along_chords, 1, "and along a chord of a facet"},
    {"huygens", huygens, 1, "D in a facet is no more than D on its boundary and the rest of the way"},
    {"paths_are_as_long_as_told", paths_are_as_long_as_told, 1, "the legs of a path add up to its distance"},
    {"distances_are_a_metric", distances_are_a_metric, 8, "zero, symmetry bit for bit, triangle inequality between sources"},
}};

}  // namespace

std::span<const Property> metric_properties() { return kProperties; }

}  // namespace gvd::fuzz
