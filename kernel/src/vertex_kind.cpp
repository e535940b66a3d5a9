#include "gvd/kernel/vertex_kind.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <mutex>

#include "coplanar_fan.hpp"
#include "gvd/predicates/angle_sum.hpp"

namespace gvd::kernel {
namespace {

using predicates::Decision;
using predicates::AngleSumFilter;
using robust::Sign;
using robust::Stage;

/// Calls visit(p, q) for the corners at v, p and q being their other vertices, counter-clockwise.
template <class Visit>
void for_each_corner(const Mesh& mesh, VertexId v, Visit visit) {
  mesh.for_each_outgoing(v, [&](HalfedgeId h) { visit(mesh.target(h), mesh.apex(h)); });
}

std::array<double, 3> difference(const Point& p, const Point& v) noexcept { return {p[0] - v[0], p[1] - v[1], p[2] - v[2]}; }

/// Bounds |rounded - true position| / |d| for a vertex at difference d.
double position_error(const Mesh& mesh, VertexId p, const std::array<double, 3>& d) {
  if (mesh.is_representable(p)) return 0;
  const Point& at = mesh.point(p);
  // Half an ulp of each coordinate; a little more for the roundings here and for subnormal coordinates.
  const double error = 1.01 * 0x1p-53 * (std::abs(at[0]) + std::abs(at[1]) + std::abs(at[2])) + 0x1p-1070;
  return 1.01 * error / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

AngleSumFilter filter(const Mesh& mesh, VertexId v) {
  AngleSumFilter sum;
  const Point& at = mesh.point(v);
  VertexId known = kNone;  // whose difference and error are in d
  std::array<double, 3> d{}, e{};
  double d_error = 0;
  for_each_corner(mesh, v, [&](VertexId p, VertexId q) {
    if (p != known) {
      d = difference(mesh.point(p), at);
      d_error = position_error(mesh, p, d);
    }
    e = difference(mesh.point(q), at);
    const double e_error = position_error(mesh, q, e);
    sum.add(d, e, d_error + e_error);
    d = e;
    d_error = e_error;
    known = q;
  });
  return sum;
}

/// The neighbours of v as seen from it, all times a common number that makes them whole: sums and products of these need no common divisors.
std::map<VertexId, ExactPoint> whole_spokes(const Mesh& mesh, VertexId v) {
  const ExactPoint at = mesh.exact_point(v);
  std::map<VertexId, ExactPoint> spokes;
  mpz_class common = 1;
  const auto add = [&](VertexId p) {
    const auto [spoke, is_new] = spokes.try_emplace(p, mesh.exact_point(p));
    for (std::size_t k = 0; is_new && k < 3; ++k) {
      spoke->second[k] -= at[k];
      common = lcm(common, spoke->second[k].get_den());
    }
  };
  for_each_corner(mesh, v, [&](VertexId p, VertexId q) {
    add(p);
    add(q);
  });
  for (auto& [p, spoke] : spokes)
    for (mpq_class& x : spoke) x *= common;
  return spokes;
}

Decision decide_exactly(const Mesh& mesh, VertexId v, int quarter_turns) {
  const auto spokes = whole_spokes(mesh, v);
  std::vector<predicates::ExactCorner> fan;
  for_each_corner(mesh, v, [&](VertexId p, VertexId q) { fan.push_back(predicates::exact_corner(spokes.at(p), spokes.at(q))); });
  return predicates::compare_angle_sum(fan, quarter_turns);
}

Decision decide(const Mesh& mesh, VertexId v) {
  if (!mesh.is_representable(v)) return {Sign::zero, Stage::identity};  // inside a face or an edge of the input
  const int quarter_turns = mesh.is_boundary(v) ? 2 : 4;
  const AngleSumFilter sum = filter(mesh, v);
  if (const auto sign = sum.compare(quarter_turns)) return {sign, Stage::filter};
  if (sum.nearest_quarter_turns() == quarter_turns && is_certainly_straight_coplanar_fan(mesh, v))
    return {Sign::zero, Stage::algebra};
  return decide_exactly(mesh, v, quarter_turns);
}

}  // namespace

struct Mesh::Kept {
  std::once_flag once;
  VertexKinds kinds;
};
std::shared_ptr<Mesh::Kept> Mesh::nothing_kept() { return std::make_shared<Kept>(); }

const VertexKinds& kept_vertex_kinds(const Mesh& mesh) {
  VertexKinds& kinds = mesh.kept_->kinds;
  std::call_once(mesh.kept_->once, [&] { kinds.of = classify_vertices(mesh, kinds.decisions); });
  return kinds;
}

std::vector<VertexKind> classify_vertices(const Mesh& mesh, predicates::Decisions& decisions) {
  std::vector<VertexKind> kinds(mesh.vertex_count(), VertexKind::convex);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.is_isolated(v)) continue;
    const Decision decision = decide(mesh, v);
    if (!decision.sign) {
      predicates::undecided(decisions, predicates::Predicate::saddle,
                            fmt::format("vertex {}: total angle against {}", v, mesh.is_boundary(v) ? "pi" : "2 pi"));
      kinds[v] = VertexKind::relay;
      continue;
    }
    predicates::count(decisions, predicates::Predicate::saddle, decision.stage);
    if (*decision.sign == Sign::zero) kinds[v] = VertexKind::flat;
    if (*decision.sign == Sign::positive) kinds[v] = VertexKind::relay;
  }
  return kinds;
}

}  // namespace gvd::kernel
