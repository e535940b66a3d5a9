#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "gvd/kernel/error.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "gvd/robust/root_sum.hpp"
#include "most_faces.hpp"

namespace gvd::kernel {
namespace {

/// A point in the plane of a face: its barycentric coordinates 1 and 2, so corners 0, 1, 2 are (0,0), (1,0), (0,1),
/// counter-clockwise.
using PlanePoint = std::array<mpq_class, 2>;

int orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) {
  return sgn((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]));
}

/// How a face of the given mesh has been split so far: a tree of triangles, whose leaves are faces of the refined mesh.
struct SplitFace {
  struct Part {
    std::array<VertexId, 3> corners;  ///< those of the half-edges 3 face, 3 face + 1, 3 face + 2 when the part was made
    FaceId face;                      ///< in the refined mesh, as long as the part is a leaf
    std::array<std::uint32_t, 3> children{kNone, kNone, kNone};
  };
  std::vector<Part> parts;  ///< the first one is the whole face
  std::unordered_map<VertexId, PlanePoint> position;
};

}  // namespace

/// Inserts surface points of a mesh into a copy of it, one by one.
class MeshRefiner {
 public:
  MeshRefiner(const Mesh& given, std::size_t sources) : given_(given), mesh_(given) {
    mesh_.kept_ = Mesh::nothing_kept();
    if (given.face_count() + 2 * sources > kMostFaces) {
      throw InputError(fmt::format("{} sources on a mesh of {} faces are too many", sources, given.face_count()));
    }
  }

  /// The vertex of the refined mesh at this point, a new one if need be.
  VertexId insert(const SurfacePoint& at);

  Mesh take() { return std::move(mesh_); }

 private:
  struct Leaf {
    FaceId split;        ///< face of the given mesh
    std::uint32_t part;  ///< index into SplitFace::parts
  };

  void start_refinement();
  SplitFace& open(FaceId given_face);
  Leaf leaf(FaceId face);
  std::uint32_t find_leaf(const SplitFace& split, const PlanePoint& p) const;
  VertexId add_vertex(const SurfacePoint& at);
  FaceId add_face(FaceId like);
  void set_halfedge(HalfedgeId h, VertexId origin, HalfedgeId twin, bool artificial);
  void split_face(FaceId face, VertexId v);
  void split_edge(HalfedgeId h, VertexId v);
  FaceId split_side(HalfedgeId h, VertexId v);
  void place_on_edge(HalfedgeId h, VertexId v);
  void update_outgoing(FaceId face);
  void record_children(Leaf parent, std::initializer_list<FaceId> faces);

  const Mesh& given_;
  Mesh mesh_;
  std::unordered_map<FaceId, SplitFace> splits_;  // by face of the given mesh
  std::unordered_map<FaceId, Leaf> leaves_;       // by face of the refined mesh
};

VertexId MeshRefiner::insert(const SurfacePoint& at) {
  const Location where = locate(given_, at);
  if (where.kind == Location::Kind::vertex) return where.vertex;
  start_refinement();
  SplitFace& split = open(at.face);
  const PlanePoint p{at.bary[1], at.bary[2]};
  const SplitFace::Part& part = split.parts[find_leaf(split, p)];
  int zeros = 0, on_side = 0;
  std::array<bool, 3> on{};
  for (int k = 0; k < 3; ++k) {
    const int side = orientation(split.position.at(part.corners[k]), split.position.at(part.corners[(k + 1) % 3]), p);
    if (side < 0) throw InternalError(fmt::format("a point of face {} was not found in any of its parts", at.face));
    if (side > 0) continue;
    on[k] = true;
    on_side = k;
    ++zeros;
  }
  if (zeros == 2) return part.corners[on[0] ? (on[1] ? 1 : 0) : 2];  // the corner that both sides share
  const VertexId v = add_vertex(at);
  split.position.emplace(v, p);
  if (zeros == 1) {
    split_edge(3 * part.face + on_side, v);
  } else {
    split_face(part.face, v);
  }
  return v;
}

/// The arrays that only a refined mesh has.
void MeshRefiner::start_refinement() {
  if (!mesh_.input_face_.empty()) return;
  mesh_.input_face_.resize(mesh_.face_count());
  for (FaceId f = 0; f < mesh_.face_count(); ++f) mesh_.input_face_[f] = f;
  mesh_.artificial_.assign(mesh_.halfedge_count(), 0);
}

SplitFace& MeshRefiner::open(FaceId given_face) {
  const auto [found, is_new] = splits_.try_emplace(given_face);
  SplitFace& split = found->second;
  if (!is_new) return split;
  const HalfedgeId h = 3 * given_face;
  split.parts.push_back({{given_.origin(h), given_.origin(h + 1), given_.origin(h + 2)}, given_face});
  split.position = {{given_.origin(h), {0, 0}}, {given_.origin(h + 1), {1, 0}}, {given_.origin(h + 2), {0, 1}}};
  leaves_[given_face] = {given_face, 0};
  return split;
}

MeshRefiner::Leaf MeshRefiner::leaf(FaceId face) {
  const auto found = leaves_.find(face);
  if (found != leaves_.end()) return found->second;
  open(face);  // not touched before: a face of the given mesh
  return {face, 0};
}

/// A leaf that contains p (closed). Each step down asks of all children but the last whether they contain p.
std::uint32_t MeshRefiner::find_leaf(const SplitFace& split, const PlanePoint& p) const {
  const auto contains = [&](const SplitFace::Part& part) {
    for (int k = 0; k < 3; ++k) {
      if (orientation(split.position.at(part.corners[k]), split.position.at(part.corners[(k + 1) % 3]), p) < 0) return false;
    }
    return true;
  };
  std::uint32_t at = 0;
  while (split.parts[at].children[0] != kNone) {
    const auto& children = split.parts[at].children;
    const int count = children[2] == kNone ? 2 : 3;
    int k = 0;
    while (k + 1 < count && !contains(split.parts[children[k]])) ++k;
    at = children[k];
  }
  return at;
}

VertexId MeshRefiner::add_vertex(const SurfacePoint& at) {
  mesh_.inserted_.push_back(exact_position(given_, at));
  const ExactPoint& p = mesh_.inserted_.back();
  mesh_.points_.push_back({robust::RootSum(p[0]).rounded(), robust::RootSum(p[1]).rounded(), robust::RootSum(p[2]).rounded()});
  mesh_.outgoing_.push_back(kNone);
  return mesh_.vertex_count_++;
}

/// A new face whose half-edges are still to be set; it is a part of the same input face as `like`.
FaceId MeshRefiner::add_face(FaceId like) {
  const FaceId face = mesh_.face_count();
  mesh_.corners_.resize(mesh_.corners_.size() + 3, kNone);
  mesh_.twins_.resize(mesh_.twins_.size() + 3, kNone);
  mesh_.artificial_.resize(mesh_.artificial_.size() + 3, 0);
  mesh_.flipped_.push_back(std::uint8_t{mesh_.flipped_[like]});
  mesh_.input_face_.push_back(FaceId{mesh_.input_face_[like]});
  return face;
}

void MeshRefiner::set_halfedge(HalfedgeId h, VertexId origin, HalfedgeId twin, bool artificial) {
  mesh_.corners_[h] = origin;
  mesh_.twins_[h] = twin;
  mesh_.artificial_[h] = artificial;
  if (twin != kNone) mesh_.twins_[twin] = h;
}

/// Makes (a, b, c) into (a, b, v), (b, c, v), (c, a, v).
void MeshRefiner::split_face(FaceId face, VertexId v) {
  const Leaf parent = leaf(face);
  const HalfedgeId h0 = 3 * face, h1 = h0 + 1, h2 = h0 + 2;
  const VertexId a = mesh_.origin(h0), b = mesh_.origin(h1), c = mesh_.origin(h2);
  const FaceId f1 = add_face(face), f2 = add_face(face);
  set_halfedge(3 * f1, b, mesh_.twins_[h1], mesh_.artificial_[h1]);
  set_halfedge(3 * f2, c, mesh_.twins_[h2], mesh_.artificial_[h2]);
  mesh_.corners_[h2] = v;
  set_halfedge(h1, b, 3 * f1 + 2, true);          // b -> v
  set_halfedge(3 * f1 + 2, v, h1, true);          // v -> b
  set_halfedge(3 * f1 + 1, c, 3 * f2 + 2, true);  // c -> v
  set_halfedge(3 * f2 + 2, v, 3 * f1 + 1, true);  // v -> c
  set_halfedge(3 * f2 + 1, a, h2, true);          // a -> v
  set_halfedge(h2, v, 3 * f2 + 1, true);          // v -> a
  for (const FaceId f : {face, f1, f2}) update_outgoing(f);
  record_children(parent, {face, f1, f2});
}

/// Splits the edge of h and the faces on both its sides.
void MeshRefiner::split_edge(HalfedgeId h, VertexId v) {
  const HalfedgeId t = mesh_.twin(h);
  const Leaf parent = leaf(Mesh::face(h));
  if (t == kNone) {
    const FaceId new_face = split_side(h, v);
    update_outgoing(Mesh::face(h));
    update_outgoing(new_face);
    record_children(parent, {Mesh::face(h), new_face});
    return;
  }
  const Leaf twin_parent = leaf(Mesh::face(t));
  if (twin_parent.split != parent.split) place_on_edge(t, v);
  const FaceId f1 = split_side(h, v), g1 = split_side(t, v);
  set_halfedge(h, mesh_.origin(h), 3 * g1, mesh_.artificial_[h]);
  set_halfedge(t, mesh_.origin(t), 3 * f1, mesh_.artificial_[t]);
  for (const FaceId f : {Mesh::face(h), f1, Mesh::face(t), g1}) update_outgoing(f);
  record_children(parent, {Mesh::face(h), f1});
  record_children(twin_parent, {Mesh::face(t), g1});
}

/// Makes (a, b, c), h from a to b, into (a, v, c), with h from a to v, and the new face (v, b, c), which is returned. The twins of
/// the two halves of the edge are left open.
FaceId MeshRefiner::split_side(HalfedgeId h, VertexId v) {
  const HalfedgeId n = Mesh::next(h), p = Mesh::prev(h);
  const VertexId b = mesh_.origin(n), c = mesh_.origin(p);
  const FaceId f1 = add_face(Mesh::face(h));
  set_halfedge(3 * f1, v, kNone, mesh_.artificial_[h]);
  set_halfedge(3 * f1 + 1, b, mesh_.twins_[n], mesh_.artificial_[n]);
  set_halfedge(3 * f1 + 2, c, n, true);  // c -> v
  set_halfedge(n, v, 3 * f1 + 2, true);  // v -> c
  mesh_.twins_[h] = kNone;
  return f1;
}

/// The place of v, which lies on the edge of h, in the plane of the given face that h belongs to: at the same parameter as in the
/// face on the other side.
void MeshRefiner::place_on_edge(HalfedgeId h, VertexId v) {
  SplitFace& here = splits_.at(leaf(Mesh::face(h)).split);
  const SplitFace& there = splits_.at(leaf(Mesh::face(mesh_.twin(h))).split);
  const VertexId a = mesh_.origin(h), b = mesh_.target(h);
  const PlanePoint &a_there = there.position.at(a), &b_there = there.position.at(b), &v_there = there.position.at(v);
  const int i = a_there[0] != b_there[0] ? 0 : 1;
  const mpq_class t = (v_there[i] - a_there[i]) / (b_there[i] - a_there[i]);
  const PlanePoint &a_here = here.position.at(a), &b_here = here.position.at(b);
  const PlanePoint p{a_here[0] + t * (b_here[0] - a_here[0]), a_here[1] + t * (b_here[1] - a_here[1])};
  here.position.emplace(v, p);
}

/// Keeps `Mesh::outgoing` right for the corners of a face that was made or changed.
void MeshRefiner::update_outgoing(FaceId face) {
  for (HalfedgeId h = 3 * face; h < 3 * face + 3; ++h) {
    HalfedgeId& out = mesh_.outgoing_[mesh_.origin(h)];
    if (out == kNone || mesh_.twin(h) == kNone || mesh_.origin(out) != mesh_.origin(h)) out = h;
  }
}

void MeshRefiner::record_children(Leaf parent, std::initializer_list<FaceId> faces) {
  SplitFace& split = splits_.at(parent.split);
  int k = 0;
  for (const FaceId f : faces) {
    const auto index = static_cast<std::uint32_t>(split.parts.size());
    const HalfedgeId h = 3 * f;
    split.parts.push_back({{mesh_.origin(h), mesh_.origin(h + 1), mesh_.origin(h + 2)}, f});
    split.parts[parent.part].children[k++] = index;
    leaves_[f] = {parent.split, index};
  }
}

Mesh refine(const Mesh& mesh, const std::vector<Source>& sources, RefinedSources& where) {
  MeshRefiner refiner(mesh, sources.size());
  where = {};
  std::unordered_map<VertexId, SourceId> first_at;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const auto id = static_cast<SourceId>(i);
    const double weight = sources[i].weight;
    if (!(weight >= 0) || !std::isfinite(weight)) {
      throw InputError(fmt::format("source {}: the weight {} is not a finite number >= 0", id, weight));
    }
    VertexId v = kNone;
    try {
      v = refiner.insert(sources[i].at);
    } catch (const InputError& error) {
      throw InputError(fmt::format("source {}: {}", id, error.what()));
    }
    where.vertex.push_back(v);
    where.weight.push_back(weight);
    const auto [earlier, is_first] = first_at.emplace(v, id);
    if (!is_first) where.duplicates.push_back({id, earlier->second});
  }
  return refiner.take();
}

}  // namespace gvd::kernel
