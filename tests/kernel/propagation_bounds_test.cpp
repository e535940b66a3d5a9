#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "gvd/kernel/distance_field.hpp"
#include "gvd/kernel/resolution.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "gvd/kernel/vertex_kind.hpp"
#include "support/meshes.hpp"

namespace gvd::test {
namespace {

using namespace kernel;
using robust::Ball;
using robust::Mpfr;

constexpr int kTruthBits = 512;

/// A field, its resolution, and the candidates as the propagation left them.
class Run {
 public:
  using Place = std::function<std::vector<Source>(const Mesh&)>;

  Run(const MeshArrays& arrays, const Place& place) : input_(arrays) {
    const std::vector<Source> sources = place(input_);
    mesh_ = refine(input_, sources, where_);
    frames_ = std::make_unique<Frames>(mesh_);
    predicates::Decisions decisions;
    const auto kinds = classify_vertices(mesh_, decisions);
    std::vector<WaveStart> starts;
    for (SourceId i = 0; i < sources.size(); ++i) {
      starts.push_back({where_.vertex[i], std::ldexp(sources[i].weight, -frames_->scale())});
      vertices_.push_back({where_.vertex[i], sources[i].weight, sets_.intern({i})});
    }
    EXPECT_TRUE(propagate(*frames_, starts, kinds, field_, decisions));
    before_ = field_;
    resolution_ = std::make_unique<Resolution>(*frames_, field_, vertices_, sets_);
    resolution_->resolve(decisions);
  }

  const Mesh& mesh() const { return mesh_; }
  const DistanceField& before() const { return before_; }
  Ball<Mpfr> distance(VertexId v) const { return resolution_->distance(v, kTruthBits); }

  /// The length of a candidate's path, its root at its final distance.
  Ball<Mpfr> length(const Candidate& c, VertexId v) const {
    if (c.via == v) return Ball<Mpfr>(Mpfr(c.distance, kTruthBits), 0);
    const Ball<Mpfr> root = distance(c.via);
    if (c.window == kNone) return root + Ball<Mpfr>(edge_length(c.via, v), 0);
    const HalfedgeId h = before_.windows[c.window].halfedge();
    const auto at = unfold_mpfr(*frames_, strip_of(mesh_, before_, c.window), kTruthBits);
    const auto frame = frames_->in_mpfr(Mesh::face(h), kTruthBits)[h % 3];
    const auto dx = predicates::ball_x(at.image) - Ball<Mpfr>(frame.u, 0), dy = predicates::ball_y(at.image) - Ball<Mpfr>(frame.y, 0);
    return root + Ball<Mpfr>(frame.length, 0) * sqrt(square(dx) + square(dy));
  }

  /// Candidates of waves that were sent again are stale.
  bool is_stale(const Candidate& c) const {
    for (WindowId w = c.window; w != kNone; w = before_.windows[w].parent)
      if (before_.windows[w].dead()) return true;
    return false;
  }

 private:
  Mpfr edge_length(VertexId a, VertexId b) const {
    for (HalfedgeId h = 0; h < mesh_.halfedge_count(); ++h)
      if ((mesh_.origin(h) == a && mesh_.target(h) == b) || (mesh_.origin(h) == b && mesh_.target(h) == a))
        return frames_->in_mpfr(Mesh::face(h), kTruthBits)[h % 3].length;
    throw std::logic_error("no such edge");
  }

  Mesh input_, mesh_;
  RefinedSources where_;
  std::unique_ptr<Frames> frames_;
  LabelSets sets_;
  std::vector<SourceVertex> vertices_;
  DistanceField field_, before_;
  std::unique_ptr<Resolution> resolution_;
};

/// |computed - truth| / error; the truth's own radius is far below the errors of doubles.
double share(double computed, const Ball<Mpfr>& truth, double error) {
  const double off = (abs(Mpfr(computed, kTruthBits) - truth.mid())).to_double();
  return off == 0 ? 0 : off / error;
}

void expect_errors_cover(const MeshArrays& arrays, const Run::Place& place, const char* what) {
  SCOPED_TRACE(what);
  const Run run(arrays, place);
  double most = 0;
  std::size_t checked = 0;
  for (VertexId v = 0; v < run.mesh().vertex_count(); ++v) {
    const DistanceField& field = run.before();
    if (!std::isfinite(field.distance[v])) continue;
    ASSERT_LE(share(field.distance[v], run.distance(v), field.error[v]), 1) << "vertex " << v;
    for (std::uint32_t c = field.first_candidate[v]; c != kNone; c = field.candidates[c].next) {
      const Candidate& candidate = field.candidates[c];
      if (run.is_stale(candidate)) continue;
      const double used = share(candidate.distance, run.length(candidate, v), candidate.error);
      ASSERT_LE(used, 1) << "vertex " << v << " window " << candidate.window << " via " << candidate.via;
      most = std::max(most, used);
      ++checked;
    }
  }
  EXPECT_GE(checked, run.mesh().vertex_count());
  EXPECT_GT(most, 1e-6);  // the bounds are bounds, not walls a mile away
  ::testing::Test::RecordProperty(std::string(what) + " share", std::to_string(most));
}

Run::Place at_vertices(std::vector<VertexId> ids) {
  return [=](const Mesh& mesh) {
    std::vector<Source> sources;
    for (const VertexId v : ids) sources.push_back({point_at_vertex(mesh, v), 0});
    return sources;
  };
}

MeshArrays changed(MeshArrays mesh, const std::function<void(Point&)>& change) {
  for (Point& p : mesh.points) change(p);
  return mesh;
}

TEST(PropagationBounds, CandidateErrorsCoverTheTruth) {
  const MeshArrays terrain = fractal_terrain(4, 3, 0.6, 11);
  Random ulp(12);
  expect_errors_cover(terrain, at_vertices({0, 100, 200}), "terrain");
  expect_errors_cover(random_terrain(10, 4, 3), at_vertices({60}), "rough");
  expect_errors_cover(changed(terrain, [](Point& p) { p[1] *= 1e-9, p[2] *= 1e-9; }), at_vertices({7, 200}), "slivers");
  expect_errors_cover(changed(terrain, [](Point& p) { p[0] += 1e7, p[1] += 1e7; }), at_vertices({0, 150}), "offset");
  expect_errors_cover(changed(flat_grid(12, 12), [&](Point& p) { p[2] = ulp.uniform(-1, 1) * 0x1p-52; }), at_vertices({0, 80}), "ulps");
  expect_errors_cover(changed(terrain, [](Point& p) { p[0] = std::exp2(p[0] * 2); }), at_vertices({140}), "sizes");
  const auto shrink = [](Point& p) {  // down to 2^-140: below the range of float
    const double factor = std::exp2(std::min(0.0, 20 * (std::hypot(p[0], p[1]) - 7)));
    for (double& x : p) x *= factor;
  };
  expect_errors_cover(changed(fractal_terrain(3, 1, 0.6, 14), shrink), at_vertices({1, 70}), "tiny");
  expect_errors_cover(integer_terrain(8, 3, 4), at_vertices({0, 44}), "integers");
}

TEST(PropagationBounds, ErrorsCoverTheTruthWithSourcesInsideFacesAndWeights) {
  const MeshArrays terrain = changed(fractal_terrain(3, 2, 0.6, 13), [](Point& p) { p[0] += 1e6; });
  const auto place = [](const Mesh& mesh) {
    std::vector<Source> sources;
    for (const FaceId f : {3u, 60u, 100u}) sources.push_back({point_in_face(mesh, f, {mpq_class(1, 3), mpq_class(1, 7), mpq_class(11, 21)}), 0});
    sources[1].weight = 1.3;
    return sources;
  };
  expect_errors_cover(terrain, place, "inside");
}

TEST(PropagationBounds, TheCallerIsAskedByWorkDone) {
  const Mesh mesh(random_terrain(40, 2, 1));
  const Frames frames(mesh);
  predicates::Decisions decisions;
  const auto kinds = classify_vertices(mesh, decisions);
  const std::vector<WaveStart> starts = {{0, 0}};
  DistanceField field;
  std::uint64_t asked = 0;
  const auto count = [](void* user, std::uint64_t, std::uint64_t) { return ++*static_cast<std::uint64_t*>(user) > 0; };
  EXPECT_TRUE(propagate(frames, starts, kinds, field, decisions, count, &asked));
  EXPECT_GE(asked, field.windows_propagated >> 14);
  const auto stop = [](void*, std::uint64_t, std::uint64_t) { return false; };
  DistanceField stopped;
  EXPECT_FALSE(propagate(frames, starts, kinds, stopped, decisions, stop, nullptr));
  EXPECT_LT(stopped.windows.size(), 3u << 14);
}

}  // namespace
}  // namespace gvd::test
