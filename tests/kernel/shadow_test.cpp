#include "../../kernel/src/shadow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gvd/kernel/vertex_kind.hpp"
#include "support/meshes.hpp"

namespace gvd::test {
namespace {

using namespace kernel;

constexpr long double kPi = std::numbers::pi_v<long double>;

long double angle(const Mesh& mesh, VertexId at, VertexId from, VertexId to) {
  long double dot = 0, p2 = 0, q2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const long double p = static_cast<long double>(mesh.point(from)[i]) - mesh.point(at)[i];
    const long double q = static_cast<long double>(mesh.point(to)[i]) - mesh.point(at)[i];
    dot += p * q, p2 += p * p, q2 += q * q;
  }
  return std::acos(dot / std::sqrt(p2 * q2));
}

/// Angles about a vertex, counter-clockwise from the first side of its fan.
class Fan {
 public:
  Fan(const Mesh& mesh, VertexId v) : mesh_(mesh), closed_(!mesh.is_boundary(v)) {
    mesh.for_each_outgoing(v, [&](HalfedgeId h) {
      start_.push_back(total_);
      faces_.push_back(h);
      total_ += angle(mesh, v, mesh.target(h), mesh.apex(h));
    });
  }
  const std::vector<HalfedgeId>& faces() const { return faces_; }
  long double total() const { return total_; }
  long double start(HalfedgeId h) const { return start_[static_cast<std::size_t>(std::find(faces_.begin(), faces_.end(), h) - faces_.begin())]; }
  /// From one direction counter-clockwise to another.
  long double turn(long double from, long double to) const { return to >= from || !closed_ ? to - from : to - from + total_; }

 private:
  const Mesh& mesh_;
  bool closed_;
  std::vector<HalfedgeId> faces_;
  std::vector<long double> start_;
  long double total_ = 0;
};

struct Checked {
  int first = 0, last = 0, faces_outside = 0;
};

/// The rays must be half a turn from the arrival, and faces left out must be nearer than that to it.
void expect_shadow(const Mesh& mesh, const Frames& frames, VertexId v, HalfedgeId over, const Candidate& arrival, long double direction,
                   Checked& checked) {
  const Fan fan(mesh, v);
  Shadow shadow;
  shadow_of(mesh, frames.in_double(), v, over, arrival, shadow);
  const auto direction_of = [&](const ShadowRay& ray) { return fan.start(ray.face) + std::atan2(static_cast<long double>(ray.direction.y), static_cast<long double>(ray.direction.x)); };
  const long double own_error = 1e-16L;  // of the truth
  if (shadow.first.face != kNone) {
    ++checked.first;
    ASSERT_LT(shadow.first.error, 1e-10);
    ASSERT_LE(std::fabs(fan.turn(direction, direction_of(shadow.first)) - kPi), 1.5L * shadow.first.error + own_error);
  }
  if (shadow.last.face != kNone) {
    ++checked.last;
    ASSERT_LT(shadow.last.error, 1e-10);
    ASSERT_LE(std::fabs(fan.turn(direction_of(shadow.last), direction) - kPi), 1.5L * shadow.last.error + own_error);
  }
  for (const HalfedgeId h : fan.faces()) {
    if (std::find(shadow.faces.begin(), shadow.faces.end(), h) != shadow.faces.end()) continue;
    ++checked.faces_outside;
    const long double begin = fan.start(h), end = begin + angle(mesh, v, mesh.target(h), mesh.apex(h));
    const bool ccw_side = fan.turn(direction, end) < kPi + own_error && fan.turn(direction, end) >= 0;
    const bool cw_side = fan.turn(begin, direction) < kPi + own_error && fan.turn(begin, direction) >= 0;
    ASSERT_TRUE(ccw_side || cw_side);
  }
}

TEST(Shadow, LiesBeyondHalfATurnOnBothSides) {
  const Mesh mesh(random_terrain(12, 4, 5));
  const Frames frames(mesh);
  Random random(6);
  Checked checked;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const Fan fan(mesh, v);
    if (fan.total() < (mesh.is_boundary(v) ? kPi : 2 * kPi)) continue;
    for (const HalfedgeId h : fan.faces()) {
      expect_shadow(mesh, frames, v, kNone, {kNone, mesh.target(h), kNone, 1, 0x1p-50, {0, 0}}, fan.start(h), checked);
      // Over the opposite side, from an image whose ray to the vertex crosses that side.
      const HalfedgeId over = Mesh::next(h);
      const predicates::EdgeFrame<double>& f = frames(over);
      const double at = random.uniform(0.01, 0.99), further = random.uniform(0.1, 5);
      const predicates::Complex<double> image{f.u + (at - f.u) * (1 + further), -f.y * further};
      const long double to_b = std::atan2(static_cast<long double>(f.y), static_cast<long double>(f.v));  // below the edge's direction
      const long double back = std::atan2(static_cast<long double>(f.y) - image.y, static_cast<long double>(image.x) - f.u);
      // At the apex, counter-clockwise from the edge's origin to its target: that is the end of this face's angle.
      const long double end = fan.start(h) + angle(mesh, v, mesh.target(h), mesh.apex(h));
      expect_shadow(mesh, frames, v, over, {0, 0, kNone, 1, 0x1p-48, image}, end - (back - to_b), checked);
      if (HasFatalFailure()) FAIL() << "vertex " << v;
    }
  }
  EXPECT_GT(checked.first, 500);
  EXPECT_GT(checked.last, 500);
  EXPECT_GT(checked.faces_outside, 1000);
}

// Round the corner of a wall, to a target seen between the ray that grazes the wall and a vertex ever closer to that ray: the relay's window gets there.
TEST(Shadow, IsSentUpToItsBoundary) {
  constexpr VertexId kSource = 0, kRelay = 1, kTarget = 6;
  for (const bool mirrored : {false, true}) {  // the other way round the corner
    for (int k = 1; k <= 44; ++k) {
      const double below = std::ldexp(-1.0, -k);
      MeshArrays arrays{{{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, -1, 0}, {2, below, 0}, {3, below / 2, 0}},
                        {{0, 1, 2}, {1, 3, 2}, {1, 4, 3}, {3, 4, 5}, {3, 5, 6}}};
      if (mirrored)
        for (auto& face : arrays.faces) std::swap(face[1], face[2]);
      const Mesh mesh(arrays);
      const Frames frames(mesh);
      predicates::Decisions decisions;
      DistanceField field;
      const std::vector<WaveStart> start{{kSource, 0}};
      ASSERT_TRUE(propagate(frames, start, classify_vertices(mesh, decisions), field, decisions));
      bool seen = false;
      for (std::uint32_t c = field.first_candidate[kTarget]; c != kNone; c = field.candidates[c].next)
        seen = seen || (field.candidates[c].window != kNone && field.candidates[c].via == kRelay);
      ASSERT_TRUE(seen) << "2^-" << k << ", mirrored " << mirrored;
    }
  }
}

}  // namespace
}  // namespace gvd::test
