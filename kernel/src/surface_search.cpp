#include "gvd/kernel/surface_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "gvd/kernel/error.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "gvd/robust/root_sum.hpp"

namespace gvd::kernel {
namespace {

constexpr std::uint32_t kFacesPerLeaf = 4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

ExactPoint exact(const Point& p) { return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}; }
ExactPoint minus(const ExactPoint& a, const ExactPoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
mpq_class dot(const ExactPoint& a, const ExactPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// At most the squared distance of p from the box.
/// With u = 2^-53: a difference has relative error u (none on underflow), so a square is at most (1 + u)^3 too large and the sum (1
/// + u)^5; underflow of the three products adds at most 3 (1 + u)^2 2^-1075. The factor 1 - 16 u makes up for the first, for its
/// own rounding and for that of the subtraction; the subtrahend 2^-1070 makes up for the second. Where something overflowed, the
/// true value is above max / (1 + u)^5.
double squared_distance_below(const Point& low, const Point& high, const Point& p) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = std::max({low[i] - p[i], 0.0, p[i] - high[i]});
    sum += d * d;
  }
  return std::min(sum, std::numeric_limits<double>::max()) * (1 - 0x1p-49) - 0x1p-1070;
}

/// A double that is at least q >= 0.
double rounded_up(const mpq_class& q) { return std::nextafter(robust::RootSum(q).rounded(), kInfinity); }

/// Barycentric coordinates of the point of triangle abc nearest to p: finds in which of the seven Voronoi regions of the triangle p
/// lies (C. Ericson, Real-Time Collision Detection, 2005, 5.1.5), here in rationals.
std::array<mpq_class, 3> nearest_in_triangle(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& p) {
  const ExactPoint ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
  const mpq_class bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
  const mpq_class ab_a = dot(ab, ap), ac_a = dot(ac, ap);  // ab . (p - a), ac . (p - a)
  if (ab_a <= 0 && ac_a <= 0) return {1, 0, 0};
  const mpq_class ab_b = ab_a - bb, ac_b = ac_a - bc;  // ab . (p - b), ac . (p - b)
  if (ab_b >= 0 && ac_b <= ab_b) return {0, 1, 0};
  const mpq_class w_c = ab_a * ac_b - ab_b * ac_a;
  if (w_c <= 0 && ab_a >= 0 && ab_b <= 0) {
    const mpq_class t = ab_a / bb;
    return {1 - t, t, 0};
  }
  const mpq_class ab_c = ab_a - bc, ac_c = ac_a - cc;  // ab . (p - c), ac . (p - c)
  if (ac_c >= 0 && ab_c <= ac_c) return {0, 0, 1};
  const mpq_class w_b = ab_c * ac_a - ab_a * ac_c;
  if (w_b <= 0 && ac_a >= 0 && ac_c <= 0) {
    const mpq_class t = ac_a / cc;
    return {1 - t, 0, t};
  }
  const mpq_class w_a = ab_b * ac_c - ab_c * ac_b;
  const mpq_class from_b = ac_b - ab_b, from_c = ab_c - ac_c;  // (c - b) . (p - b), (b - c) . (p - c)
  if (w_a <= 0 && from_b >= 0 && from_c >= 0) {
    const mpq_class t = from_b / (from_b + from_c);
    return {0, 1 - t, t};
  }
  const mpq_class sum = w_a + w_b + w_c;
  return {w_a / sum, w_b / sum, w_c / sum};
}

void check_finite(double value) {
  if (!std::isfinite(value)) throw InputError(fmt::format("the coordinate {} is not finite", value));
}

using PlanePoint = std::array<mpq_class, 2>;

mpq_class area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Whether p lies on the closed segment ab (which may be a point), given that they are collinear.
bool between(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) {
  return (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]) <= 0;
}

/// How the vertical line (x, y) meets one face.
struct FaceHit {
  enum class Kind { none, point, segment } kind = Kind::none;
  SurfacePoint at;
};

/// A vertical face is met in a segment, or at a corner at most: where no other corner and no inner point of its projection is.
/// Pre: p lies in the box of the corners, which are collinear; so it lies on their segment if it lies on their line.
FaceHit hit_vertical_face(const std::array<PlanePoint, 3>& corner, const PlanePoint& p, SurfacePoint at) {
  for (int k = 0; k < 3; ++k) {
    if (area(corner[k], corner[(k + 1) % 3], p) != 0) return {};
  }
  int single = -1;
  for (int k = 0; k < 3; ++k) {
    if (corner[k] == p && !between(corner[(k + 1) % 3], corner[(k + 2) % 3], p)) single = k;
  }
  if (single < 0) return {FaceHit::Kind::segment, at};
  at.bary[single] = 1;
  return {FaceHit::Kind::point, at};
}

/// Pre: p lies in the box of the face.
FaceHit hit_face(const Mesh& mesh, FaceId f, const PlanePoint& p) {
  std::array<PlanePoint, 3> corner;
  for (HalfedgeId k = 0; k < 3; ++k) {
    const Point& v = mesh.point(mesh.origin(3 * f + k));
    corner[k] = {mpq_class(v[0]), mpq_class(v[1])};
  }
  SurfacePoint at;
  at.face = f;
  const mpq_class whole = area(corner[0], corner[1], corner[2]);
  if (whole == 0) return hit_vertical_face(corner, p, at);
  for (int k = 0; k < 3; ++k) {
    at.bary[k] = area(corner[(k + 1) % 3], corner[(k + 2) % 3], p) / whole;
    if (at.bary[k] < 0) return {};
  }
  return {FaceHit::Kind::point, at};
}

/// The same for two hits of one vertical line iff they are the same surface point: the line meets an edge that is not vertical
/// once.
std::array<std::uint32_t, 3> identity(const Mesh& mesh, const SurfacePoint& at) {
  const Location where = locate(mesh, at);
  if (where.kind == Location::Kind::vertex) return {0, where.vertex, 0};
  if (where.kind == Location::Kind::face) return {2, at.face, 0};
  const auto [low, high] = std::minmax({mesh.origin(where.halfedge), mesh.target(where.halfedge)});
  return {1, low, high};
}

std::string list(const std::vector<FaceId>& faces) {
  constexpr std::size_t kMost = 10;
  const auto end = faces.begin() + static_cast<std::ptrdiff_t>(std::min(faces.size(), kMost));
  std::string text = fmt::format("{}", fmt::join(faces.begin(), end, ", "));
  if (faces.size() > kMost) text += fmt::format(" and {} more", faces.size() - kMost);
  return text;
}

}  // namespace

SurfaceSearch::SurfaceSearch(const Mesh& mesh) : mesh_(mesh) {
  if (mesh.face_count() == 0 || mesh.vertex_count() != mesh.input_vertex_count()) {
    throw InternalError("SurfaceSearch needs a mesh with faces that is not refined");
  }
  std::vector<Item> items(mesh.face_count());
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const Box box = face_box(f);
    for (std::size_t i = 0; i < 3; ++i) items[f].middle[i] = box.low[i] / 2 + box.high[i] / 2;
    items[f].face = f;
  }
  build(items, 0);
}

SurfaceSearch::Box SurfaceSearch::face_box(FaceId f) const {
  Box box{mesh_.point(mesh_.origin(3 * f)), mesh_.point(mesh_.origin(3 * f))};
  for (HalfedgeId h = 3 * f + 1; h < 3 * f + 3; ++h) {
    const Point& v = mesh_.point(mesh_.origin(h));
    for (std::size_t i = 0; i < 3; ++i) {
      box.low[i] = std::min(box.low[i], v[i]);
      box.high[i] = std::max(box.high[i], v[i]);
    }
  }
  return box;
}

/// Appends the subtree of these faces, the first of which becomes order_[begin]: halves by their middles along the longest axis.
void SurfaceSearch::build(std::span<Item> items, std::uint32_t begin) {
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  const auto count = static_cast<std::uint32_t>(items.size());
  nodes_.push_back({{}, kNone, begin, begin + count});
  if (count <= kFacesPerLeaf) {
    Box box = face_box(items[0].face);
    for (const Item& item : items) {
      order_.push_back(item.face);
      box = around(box, face_box(item.face));
    }
    nodes_[node].box = box;
    return;
  }
  const std::size_t axis = longest_axis(items);
  const std::uint32_t half = count / 2;
  std::nth_element(items.begin(), items.begin() + half, items.end(), [axis](const Item& a, const Item& b) {
    return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis] : a.face < b.face;
  });
  build(items.first(half), begin);
  const auto right = static_cast<std::uint32_t>(nodes_.size());
  build(items.subspan(half), begin + half);
  nodes_[node].right = right;
  nodes_[node].box = around(nodes_[node + 1].box, nodes_[right].box);
}

SurfaceSearch::Box SurfaceSearch::around(const Box& a, const Box& b) {
  Box box = a;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = std::min(a.low[i], b.low[i]);
    box.high[i] = std::max(a.high[i], b.high[i]);
  }
  return box;
}

std::size_t SurfaceSearch::longest_axis(std::span<const Item> items) {
  Box box{items[0].middle, items[0].middle};
  for (const Item& item : items) box = around(box, {item.middle, item.middle});
  Point extent;  // halved: it cannot overflow
  for (std::size_t i = 0; i < 3; ++i) extent[i] = box.high[i] / 2 - box.low[i] / 2;
  return static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
}

struct SurfaceSearch::Best {
  ExactPoint p;
  FaceId face = kNone;
  std::array<mpq_class, 3> bary;
  mpq_class squared_distance;
  double above = kInfinity;  ///< at least the squared distance
};

void SurfaceSearch::search(std::uint32_t node, const Point& p, Best& best) const {
  const Node& here = nodes_[node];
  if (squared_distance_below(here.box.low, here.box.high, p) > best.above) return;
  if (here.right != kNone) {
    const auto below = [&](std::uint32_t child) {
      return squared_distance_below(nodes_[child].box.low, nodes_[child].box.high, p);
    };
    const bool left_first = below(node + 1) <= below(here.right);
    search(left_first ? node + 1 : here.right, p, best);
    search(left_first ? here.right : node + 1, p, best);
    return;
  }
  for (std::uint32_t i = here.begin; i < here.end; ++i) {
    const FaceId f = order_[i];
    const Box box = face_box(f);
    if (squared_distance_below(box.low, box.high, p) > best.above) continue;
    std::array<ExactPoint, 3> corner;
    for (HalfedgeId k = 0; k < 3; ++k) corner[k] = exact(mesh_.point(mesh_.origin(3 * f + k)));
    auto bary = nearest_in_triangle(corner[0], corner[1], corner[2], best.p);
    ExactPoint away = best.p;
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c) away[c] -= bary[k] * corner[k][c];
    mpq_class squared = dot(away, away);
    if (best.face != kNone && (squared > best.squared_distance || (squared == best.squared_distance && f > best.face))) continue;
    best.face = f;
    best.bary = std::move(bary);
    best.squared_distance = std::move(squared);
    best.above = rounded_up(best.squared_distance);
  }
}

NearestPoint SurfaceSearch::nearest(const Point& p) const {
  for (const double coordinate : p) check_finite(coordinate);
  Best best;
  best.p = exact(p);
  search(0, p, best);
  NearestPoint found;
  found.at.face = best.face;
  found.at.bary = best.bary;
  found.at.vertex = locate(mesh_, found.at).vertex;
  found.squared_distance = best.squared_distance;
  found.distance = robust::RootSum(1, best.squared_distance).rounded();
  return found;
}

/// The faces whose boxes the vertical line meets.
void SurfaceSearch::collect(std::uint32_t node, double x, double y, std::vector<FaceId>& faces) const {
  const auto meets = [&](const Box& box) { return box.low[0] <= x && x <= box.high[0] && box.low[1] <= y && y <= box.high[1]; };
  const Node& here = nodes_[node];
  if (!meets(here.box)) return;
  if (here.right != kNone) {
    collect(node + 1, x, y, faces);
    collect(here.right, x, y, faces);
    return;
  }
  for (std::uint32_t i = here.begin; i < here.end; ++i) {
    if (meets(face_box(order_[i]))) faces.push_back(order_[i]);
  }
}

SurfacePoint SurfaceSearch::drop(double x, double y) const {
  check_finite(x);
  check_finite(y);
  std::vector<FaceId> candidates, hits;
  collect(0, x, y, candidates);
  std::sort(candidates.begin(), candidates.end());
  const PlanePoint p{mpq_class(x), mpq_class(y)};
  SurfacePoint first;
  bool one_point = true;
  for (const FaceId f : candidates) {
    FaceHit hit = hit_face(mesh_, f, p);
    if (hit.kind == FaceHit::Kind::none) continue;
    if (hit.kind == FaceHit::Kind::segment) {
      throw InputError(fmt::format("the vertical line at ({}, {}) runs along face {}, which is vertical", x, y, f));
    }
    if (hits.empty()) {
      first = hit.at;
    } else if (identity(mesh_, first) != identity(mesh_, hit.at)) {
      one_point = false;
    }
    hits.push_back(f);
  }
  if (hits.empty()) throw InputError(fmt::format("the vertical line at ({}, {}) misses the surface", x, y));
  if (!one_point) {
    throw InputError(fmt::format("the vertical line at ({}, {}) meets the surface at several points (faces {})", x, y, list(hits)));
  }
  first.vertex = locate(mesh_, first).vertex;
  return first;
}

}  // namespace gvd::kernel
