#include <algorithm>
#include <string>

#include "face_map.hpp"
#include "gvd/kernel/error.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "gvd/robust/root_sum.hpp"
#include "point_answer.hpp"
#include "strip_crossings.hpp"

namespace gvd::kernel {
namespace {

double nearest_double(const mpq_class& q) { return robust::RootSum(q).rounded(); }

/// A given point of the input as an end of a path.
PathPoint end_point(const Mesh& input, const SurfacePoint& at) {
  PathPoint point;
  const Location where = locate(input, at);
  const ExactPoint position = exact_position(input, at);
  for (std::size_t i = 0; i < 3; ++i) point.position[i] = nearest_double(position[i]);
  point.vertex = where.vertex;
  if (where.kind != Location::Kind::edge) return point;
  const VertexId a = input.origin(where.halfedge), b = input.target(where.halfedge);
  point.edge = {std::min(a, b), std::max(a, b)};
  const mpq_class& t = at.bary[(a < b ? Mesh::next(where.halfedge) : where.halfedge) % 3];
  const auto ball = robust::from<robust::Ball<robust::DoubleDouble>>(t);
  point.t = {nearest_double(t), ball.lower(), ball.upper()};
  return point;
}

/// Follows one geodesic back to its source and notes where it meets the input mesh.
class PathTracer {
 public:
  PathTracer(const Solution::Impl& state, AnsweredPoint& from) : state_(state), resolution_(*state.resolution), from_(from) {
    source_ = from.answer.nearest.front();
  }

  void run(const SurfacePoint& at) {
    path().push_back(end_point(state_.input, at));
    VertexId v = at_ = from_.at.vertex;
    if (v == kNone) v = leave_facet();
    for (std::size_t legs = 0; !has_arrived(v); ++legs) {
      if (legs > state_.refined.vertex_count()) throw InternalError("a path goes round in circles at vertex " + std::to_string(v));
      v = leave_vertex(v);
    }
    // Sources that were inserted inside a face, and passed by, do not show.
    for (std::size_t i = path().size(); i-- > 2;) {
      const PathPoint& inner = path()[i - 1];
      if (inner.vertex == kNone && inner.edge[0] == kNone) path().erase(path().begin() + static_cast<std::ptrdiff_t>(i) - 1);
    }
  }

 private:
  std::vector<PathPoint>& path() { return from_.answer.path; }
  bool leads_to_source(LabelSetId labels) const {
    const auto& set = state_.label_sets[labels];
    return std::binary_search(set.begin(), set.end(), source_);
  }

  /// Whether the source is at v itself.
  bool has_arrived(VertexId v) const {
    if (!resolution_.is_live_source(v)) return false;
    const auto& list = state_.source_vertices;
    const auto found =
        std::lower_bound(list.begin(), list.end(), v, [](const SourceVertex& s, VertexId id) { return s.vertex < id; });
    return leads_to_source(found->labels);
  }

  VertexId leave_facet() {
    const auto& waves = *from_.waves;
    for (const std::uint32_t i : from_.nearest.sites) {
      const FacetSite& site = waves.sites[i];
      if (!leads_to_source(site.labels)) continue;
      if (site.window == kNone)
        visit_vertex(site.root, from_.at.face);
      else
        follow_window(site.window, from_.at.bary);
      return site.root;
    }
    throw InternalError("no wave brings source " + std::to_string(source_) + " to a point of face " +
                        std::to_string(from_.at.face));
  }

  VertexId leave_vertex(VertexId v) {
    const DistanceField& field = state_.field;
    for (std::uint32_t c = field.first_candidate[v]; c != kNone; c = field.candidates[c].next) {
      const Candidate& candidate = field.candidates[c];
      if (candidate.via == v || !leads_to_source(resolution_.labels(candidate.via))) continue;
      if (candidate.window == kNone) {
        visit_vertex(candidate.via, Mesh::face(resolution_.edge_between(candidate.via, v)));
      } else {
        std::array<mpq_class, 3> apex{0, 0, 0};
        apex[Mesh::prev(field.windows[candidate.window].halfedge()) % 3] = 1;
        follow_window(candidate.window, apex);
      }
      return candidate.via;
    }
    throw InternalError("no path leads from vertex " + std::to_string(v) + " to source " + std::to_string(source_));
  }

  void follow_window(WindowId window, const std::array<mpq_class, 3>& bary) {
    const StripCrossings crossings = cross_strip(state_.input, resolution_, window, bary);
    if (crossings.undecided) from_.answer.undecided = true;
    for (const Crossing& crossing : crossings.list) visit_crossing(crossing);
    while (state_.field.windows[window].parent != kNone) window = state_.field.windows[window].parent;
    visit_vertex(state_.field.windows[window].root, Mesh::face(state_.refined.twin(state_.field.windows[window].halfedge())));
  }

  void visit_crossing(const Crossing& crossing) {
    const FaceId face = Mesh::face(crossing.halfedge);
    if (crossing.vertex != kNone) return visit_vertex(crossing.vertex, face);
    path().back().face = state_.refined.input_face(face);
    if (state_.refined.is_artificial(crossing.halfedge)) return;
    PathPoint point;
    point.edge = crossing.edge;
    point.t = crossing.t;
    point.position = crossing.position;
    path().push_back(point);
    at_ = kNone;
  }

  /// A vertex that is reached through the given face. The strip may turn about it: then the path stands still.
  void visit_vertex(VertexId v, FaceId face) {
    if (at_ == v) return;
    at_ = v;
    path().back().face = state_.refined.input_face(face);
    SurfacePoint at;
    at.face = state_.refined.input_face(Mesh::face(state_.refined.outgoing(v)));
    at.bary = barycentric_in_face(state_.input, at.face, state_.refined, v);
    path().push_back(end_point(state_.input, at));
  }

  const Solution::Impl& state_;
  const Resolution& resolution_;
  AnsweredPoint& from_;
  SourceId source_;
  VertexId at_ = kNone;  ///< the vertex of the refined mesh at which the path stands
};

}  // namespace

PointAnswer Solution::path(const SurfacePoint& at) const {
  AnsweredPoint result = answer_point(*impl_, at, true);
  if (result.answer.nearest.empty()) return std::move(result.answer);
  if (result.waves && !result.nearest.is_one_path) result.answer.undecided = true;
  PathTracer(*impl_, result).run(at);
  return std::move(result.answer);
}

}  // namespace gvd::kernel
