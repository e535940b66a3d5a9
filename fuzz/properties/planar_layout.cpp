#include "fuzz/properties/planar_layout.hpp"

#include <algorithm>

namespace gvd::fuzz {
namespace {

using kernel::ExactPoint;
using kernel::HalfedgeId;
using kernel::kNone;
using kernel::Mesh;
using kernel::VertexId;
using Place = PlanarLayout::Place;

ExactPoint minus(const ExactPoint& a, const ExactPoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
mpq_class dot(const ExactPoint& a, const ExactPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool is_square(const mpq_class& q) {
  return mpz_perfect_square_p(q.get_num_mpz_t()) != 0 && mpz_perfect_square_p(q.get_den_mpz_t()) != 0;
}
mpq_class root(const mpq_class& q) { return mpq_class(sqrt(q.get_num()), sqrt(q.get_den())); }

/// The apex of a half-edge as a multiple of it: along + across * i sqrt(N).
struct Shape {
  mpq_class along, across, radicand;
};
Shape shape(const Mesh& mesh, HalfedgeId h) {
  const ExactPoint a = mesh.exact_point(mesh.origin(h)), ab = minus(mesh.exact_point(mesh.target(h)), a),
                   ac = minus(mesh.exact_point(mesh.apex(h)), a);
  const mpq_class square = dot(ab, ab), inner = dot(ab, ac);
  return {inner / square, 1 / square, square * dot(ac, ac) - inner * inner};
}

class Unfolder {
 public:
  explicit Unfolder(const Mesh& mesh) : mesh_(mesh) {}

  std::optional<PlanarLayout> run() {
    if (!lay_out() || !find_outline() || !is_convex()) return std::nullopt;
    return std::move(layout_);
  }

 private:
  bool lay_out() {
    layout_.vertex.resize(mesh_.vertex_count());
    placed_.assign(mesh_.vertex_count(), false);
    std::vector<bool> done(mesh_.face_count());
    const VertexId a = mesh_.origin(0), b = mesh_.target(0);
    const ExactPoint ab = minus(mesh_.exact_point(b), mesh_.exact_point(a));
    layout_.unit = dot(ab, ab);
    layout_.stretch = shape(mesh_, 0).radicand;
    layout_.vertex[b] = {1, 0};
    placed_[a] = placed_[b] = true;
    std::vector<HalfedgeId> open{0};
    std::uint32_t faces = 0;
    while (!open.empty()) {
      const HalfedgeId h = open.back();
      open.pop_back();
      if (done[h / 3]) continue;
      done[h / 3] = true;
      ++faces;
      if (!place_apex(h)) return false;
      for (HalfedgeId side = 3 * (h / 3); side < 3 * (h / 3) + 3; ++side)
        if (mesh_.twin(side) != kNone) open.push_back(mesh_.twin(side));
    }
    if (faces != mesh_.face_count()) return false;
    // Vertices without a face lie nowhere.
    return std::all_of(placed_.begin(), placed_.end(), [](bool placed) { return placed; });
  }

  /// False if the apex already lies elsewhere, or the face is of another square class.
  bool place_apex(HalfedgeId h) {
    const Shape s = shape(mesh_, h);
    const mpq_class ratio = s.radicand / layout_.stretch;
    if (!is_square(ratio)) return false;
    const Place &a = layout_.vertex[mesh_.origin(h)], &b = layout_.vertex[mesh_.target(h)];
    const mpq_class dx = b[0] - a[0], dy = b[1] - a[1], across = s.across * root(ratio);
    const Place c{a[0] + dx * s.along - layout_.stretch * dy * across, a[1] + dx * across + dy * s.along};
    const VertexId apex = mesh_.apex(h);
    if (placed_[apex]) return layout_.vertex[apex] == c;
    layout_.vertex[apex] = c;
    placed_[apex] = true;
    return true;
  }

  /// One boundary loop that holds all boundary edges.
  bool find_outline() {
    std::vector<VertexId> next(mesh_.vertex_count(), kNone);
    std::size_t edges = 0;
    VertexId first = kNone;
    for (HalfedgeId h = 0; h < mesh_.halfedge_count(); ++h) {
      if (mesh_.twin(h) != kNone) continue;
      next[mesh_.origin(h)] = mesh_.target(h);
      first = mesh_.origin(h);
      ++edges;
    }
    if (first == kNone) return false;
    VertexId v = first;
    do {
      layout_.outline.push_back(v);
      v = next[v];
    } while (v != first);
    return layout_.outline.size() == edges;
  }

  mpq_class turn(const Place& a, const Place& b, const Place& c) const {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  /// Turns left all along, comes down from its highest point only once, and encloses the area of the faces (which are all
  /// counter-clockwise): then the layout covers a convex polygon once.
  bool is_convex() const {
    const std::size_t n = layout_.outline.size();
    const auto at = [&](std::size_t i) -> const Place& { return layout_.vertex[layout_.outline[i % n]]; };
    mpq_class enclosed, covered;
    std::size_t summits = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (sgn(turn(at(i), at(i + 1), at(i + 2))) < 0) return false;
      if (at(i) < at(i + 1) && at(i + 2) < at(i + 1)) ++summits;
      enclosed += at(i)[0] * at(i + 1)[1] - at(i)[1] * at(i + 1)[0];
    }
    for (kernel::FaceId f = 0; f < mesh_.face_count(); ++f)
      covered += turn(layout_.vertex[mesh_.origin(3 * f)], layout_.vertex[mesh_.origin(3 * f + 1)],
                      layout_.vertex[mesh_.origin(3 * f + 2)]);
    return summits == 1 && enclosed == covered;
  }

  const Mesh& mesh_;
  PlanarLayout layout_;
  std::vector<bool> placed_;
};

}  // namespace

PlanarLayout::Place PlanarLayout::place(const Mesh& mesh, const kernel::SurfacePoint& at) const {
  Place p;
  for (HalfedgeId k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 2; ++i) p[i] += at.bary[k] * vertex[mesh.origin(3 * at.face + k)][i];
  return p;
}

std::optional<PlanarLayout> planar_layout(const Mesh& mesh) { return Unfolder(mesh).run(); }

}  // namespace gvd::fuzz
