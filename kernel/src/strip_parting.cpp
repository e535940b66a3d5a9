/// Images and weights of several waves where their strips part, going back from the facet: there they lie in few square classes.
#include "strip_parting.hpp"

#include <algorithm>

#include "facet_waves.hpp"
#include "gvd/robust/rational.hpp"

namespace gvd::kernel {

using robust::Exact;

namespace {

/// Strips as sequences of edges of the input: what inserted vertices split is one edge or one face again.
class InputEdges {
 public:
  InputEdges(const Mesh& mesh, const DistanceField& field) : mesh_(mesh), field_(field) {}

  HalfedgeId edge(WindowId w) const { return field_.windows[w].halfedge(); }
  /// w, or the last window before it, that lies on an edge of the input; kNone if the strip crosses none.
  WindowId crossing(WindowId w) const {
    while (w != kNone && mesh_.is_artificial(edge(w))) w = field_.windows[w].parent;
    return w;
  }
  WindowId before(WindowId w) const { return crossing(field_.windows[w].parent); }
  /// Whether both are parts of one edge of the input, in the same direction.
  bool are_one(HalfedgeId g, HalfedgeId h) const {
    return g == h || (faces(g) == faces(h) && is_in_line(g, mesh_.origin(h)) && is_in_line(g, mesh_.target(h)));
  }
  bool is_in_line(HalfedgeId h, VertexId v) const {
    const ExactPoint u = spoke(h, mesh_.target(h)), w = spoke(h, v);
    for (std::size_t k = 0; k < 3; ++k)
      if (u[k] * w[(k + 1) % 3] != u[(k + 1) % 3] * w[k]) return false;
    return true;
  }
  /// The place of v, which is in line with h: 0 at its origin, 1 at its target.
  mpq_class place(HalfedgeId h, VertexId v) const {
    const ExactPoint u = spoke(h, mesh_.target(h)), w = spoke(h, v);
    return (u[0] * w[0] + u[1] * w[1] + u[2] * w[2]) / (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  }

 private:
  ExactPoint spoke(HalfedgeId h, VertexId v) const {
    const ExactPoint from = mesh_.exact_point(mesh_.origin(h)), to = mesh_.exact_point(v);
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  }
  std::array<FaceId, 2> faces(HalfedgeId h) const {
    return {mesh_.input_face(Mesh::face(h)), mesh_.input_face(Mesh::face(mesh_.twin(h)))};
  }

  const Mesh& mesh_;
  const DistanceField& field_;
};

/// Goes back over the faces of the input that all strips cross. A vertex of the facet that is in line with each of the edges is an end of it, or lies on
/// it: a face has no other points in line with a side.
std::optional<Parting> parting_in_input(const Mesh& mesh, const DistanceField& field, FaceId face, std::vector<WindowId> back, std::span<const VertexId> roots) {
  const InputEdges edges(mesh, field);
  const auto are_together = [&] {
    HalfedgeId common = kNone;
    for (std::size_t n = 0; n < back.size(); ++n) {
      if (back[n] == kNone) continue;
      if (common == kNone) common = edges.edge(back[n]);
      if (!edges.are_one(common, edges.edge(back[n]))) return false;
    }
    for (std::size_t n = 0; common != kNone && n < back.size(); ++n)
      if (back[n] == kNone && !edges.is_in_line(common, roots[n])) return false;
    return common != kNone;
  };
  const auto go_back = [&](bool to_facet) {
    for (WindowId& w : back)
      if (w != kNone && (w = to_facet ? edges.crossing(w) : edges.before(w)) == kNone) return false;
    return true;
  };
  std::vector<WindowId> at;
  for (bool to_facet = true; go_back(to_facet) && are_together(); to_facet = false) at = back;
  const auto first = std::find_if(at.begin(), at.end(), [](WindowId w) { return w != kNone; });
  if (first == at.end() || mesh.input_face(Mesh::face(edges.edge(*first))) == mesh.input_face(face)) return std::nullopt;
  Parting parting{edges.edge(*first), {}};
  for (std::size_t n = 0; n < at.size(); ++n) {
    if (at[n] == kNone) {
      parting.strips.push_back({kNone, edges.place(parting.base, roots[n])});
      continue;
    }
    const HalfedgeId h = edges.edge(at[n]);
    const mpq_class origin = edges.place(parting.base, mesh.origin(h));
    parting.strips.push_back({at[n], origin, edges.place(parting.base, mesh.target(h)) - origin});
  }
  return parting;
}

}  // namespace

/// The half-edge that all windows are on, if the corners among the waves are ends of it; else kNone.
HalfedgeId FieldWaves::common_side(std::span<const WindowId> windows, std::span<const VertexId> roots) const {
  const Mesh& mesh = resolution_.frames().mesh();
  HalfedgeId common = kNone;
  for (const WindowId w : windows) {
    if (w == kNone) continue;
    const HalfedgeId h = field_.windows[w].halfedge();
    if (common != kNone && h != common) return kNone;
    common = h;
  }
  for (std::size_t n = 0; common != kNone && n < roots.size(); ++n)
    if (windows[n] == kNone && roots[n] != mesh.origin(common) && roots[n] != mesh.target(common)) return kNone;
  return common;
}

/// Goes to the parents; false if a strip begins here.
bool FieldWaves::step_back(std::vector<WindowId>& windows) const {
  for (WindowId& w : windows)
    if (w != kNone && (w = field_.windows[w].parent) == kNone) return false;
  return true;
}

/// Goes back to the last side, before those where they are (sides of one face), that the strips of all cross, if every strip sees its root from there where the first one's way
/// would show it. False if there is no such side.
bool FieldWaves::step_over_detours(std::vector<WindowId>& windows) {
  const Mesh& mesh = resolution_.frames().mesh();
  if (std::find(windows.begin(), windows.end(), kNone) != windows.end()) return false;
  const auto crossing = [&](WindowId w, HalfedgeId h) {
    while (w != kNone && field_.windows[w].halfedge() != h) w = field_.windows[w].parent;
    return w;
  };
  const auto way_to = [&](WindowId w) { return sides_of(strip_of(mesh, field_, w)); };
  const Sides first = way_to(windows[0]);
  for (WindowId w = field_.windows[windows[0]].parent; w != kNone; w = field_.windows[w].parent) {
    std::vector<WindowId> met{w};
    for (std::size_t n = 1; n < windows.size() && met.back() != kNone; ++n) met.push_back(crossing(windows[n], field_.windows[w].halfedge()));
    if (met.back() == kNone) continue;
    const std::size_t shared = way_to(w).size();
    const bool alike = std::equal(windows.begin() + 1, windows.end(), met.begin() + 1, [&](WindowId window, WindowId there) {
      const Sides own = way_to(window);
      Sides way = way_to(there);
      way.insert(way.end(), first.begin() + static_cast<std::ptrdiff_t>(shared), first.end());
      return own == way || enclose_only_flat(own, way) || have_one_image_by_algebra(own, way);
    });
    if (!alike) return false;
    windows = std::move(met);
    return true;
  }
  return false;
}

/// Goes back over half-edges of the refined mesh, and over the detours of single strips.
std::optional<Parting> FieldWaves::parting_of_strips(std::vector<WindowId> back, std::span<const VertexId> roots) {
  const Mesh& mesh = resolution_.frames().mesh();
  const auto together = [&] { return common_side(back, roots); };
  std::vector<WindowId> at = back;
  HalfedgeId base = kNone, h = together();
  if (h == kNone && step_over_detours(back)) h = together();
  while (h != kNone) {
    base = h;
    at = back;
    h = step_back(back) ? together() : kNone;
    if (h == kNone && step_over_detours(back = at)) h = together();
  }
  if (base == kNone || Mesh::face(base) == face) return std::nullopt;
  Parting parting{base, {}};
  for (std::size_t n = 0; n < at.size(); ++n) parting.strips.push_back({at[n], at[n] == kNone && roots[n] == mesh.target(base) ? 1 : 0});
  return parting;
}

/// The waves where their strips part, in exact numbers; empty if an image is beyond them.
std::vector<predicates::Site<Exact>> FieldWaves::sites_at(const Parting& parting, std::span<const VertexId> roots) {
  const Exact length = sqrt(Exact(resolution_.frames().exact(Mesh::face(parting.base))->squared[parting.base % 3]));
  std::vector<predicates::Site<Exact>> result;
  for (std::size_t n = 0; n < roots.size(); ++n) {
    const Parting::Strip& strip = parting.strips[n];
    predicates::Site<Exact>& site = result.emplace_back();
    site.weight = exact_weight(roots[n], length);
    site.image = {Exact(strip.origin), Exact(0.0)};
    if (strip.window == kNone) continue;
    const auto unfolding = resolution_.exact_unfolding(strip.window);
    if (!unfolding) return {};
    site.image = {Exact(unfolding->image.x * strip.length + robust::RootSum(strip.origin)), Exact(unfolding->image.y * strip.length)};
  }
  return result;
}

std::vector<predicates::Site<Exact>> FieldWaves::where_they_part(std::span<const std::uint32_t> which) {
  std::vector<WindowId> windows;  // kNone: a corner
  std::vector<VertexId> roots;
  for (const std::uint32_t i : which) windows.push_back(sites[i].window), roots.push_back(sites[i].root);
  if (const auto parting = parting_of_strips(windows, roots))
    if (auto result = sites_at(*parting, roots); !result.empty()) return result;
  const auto parting = parting_in_input(resolution_.frames().mesh(), field_, face, windows, roots);
  return parting ? sites_at(*parting, roots) : std::vector<predicates::Site<Exact>>{};
}

}  // namespace gvd::kernel
