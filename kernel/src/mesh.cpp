#include "gvd/kernel/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "gvd/kernel/error.hpp"
#include "most_faces.hpp"

namespace gvd::kernel {
namespace {

using Corners = std::vector<VertexId>;

void check_sizes(const MeshArrays& arrays) {
  if (arrays.faces.empty()) throw InputError("the mesh has no faces");
  if (arrays.points.size() >= kNone) {
    throw InputError(fmt::format("the mesh has {} vertices; at most {} are supported", arrays.points.size(), kNone - 1));
  }
  if (arrays.faces.size() > kMostFaces) {
    throw InputError(fmt::format("the mesh has {} faces; at most {} are supported", arrays.faces.size(), kMostFaces));
  }
}

void check_finite(const std::vector<Point>& points) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Point& p = points[v];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
      throw InputError(fmt::format("vertex {}: coordinate is not finite", v));
    }
  }
}

void check_indices(const MeshArrays& arrays) {
  for (std::size_t f = 0; f < arrays.faces.size(); ++f) {
    const auto& [a, b, c] = arrays.faces[f];
    for (const VertexId v : {a, b, c}) {
      if (v >= arrays.points.size()) {
        throw InputError(fmt::format("face {}: vertex {} does not exist (there are {} vertices)", f, v, arrays.points.size()));
      }
    }
    if (a == b || a == c) throw InputError(fmt::format("face {}: repeated vertex {}", f, a));
    if (b == c) throw InputError(fmt::format("face {}: repeated vertex {}", f, b));
  }
}

/// True only if (b - a) x (c - a) is certainly not zero.
/// Each difference carries a relative error of at most u = 2^-53 and each product one more, so a product is off by less than
/// 3.01 u of its computed size; 8 u leaves room for the roundings of the sum, of the bound and of the comparison. Products that
/// underflow are off by 2^-1075 at most: the smallest normal number covers it. Overflow gives infinity or NaN on both sides: false.
bool certainly_has_area(const Point& a, const Point& b, const Point& c) {
  constexpr double kRelative = 8 * 0x1p-53;
  constexpr double kUnderflow = std::numeric_limits<double>::min();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double p = (b[i] - a[i]) * (c[j] - a[j]);
    const double q = (b[j] - a[j]) * (c[i] - a[i]);
    if (std::abs(p - q) > kRelative * (std::abs(p) + std::abs(q)) + kUnderflow) return true;
  }
  return false;
}

bool has_area_exact(const Point& a, const Point& b, const Point& c) {
  std::array<mpq_class, 3> d, e;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = mpq_class(b[i]) - mpq_class(a[i]);
    e[i] = mpq_class(c[i]) - mpq_class(a[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (d[i] * e[j] != d[j] * e[i]) return true;
  }
  return false;
}

void check_areas(const MeshArrays& arrays) {
  for (std::size_t f = 0; f < arrays.faces.size(); ++f) {
    const auto& [ia, ib, ic] = arrays.faces[f];
    const Point &a = arrays.points[ia], &b = arrays.points[ib], &c = arrays.points[ic];
    if (certainly_has_area(a, b, c) || has_area_exact(a, b, c)) continue;
    throw InputError(fmt::format("face {}: zero area (vertices {}, {}, {} are collinear)", f, ia, ib, ic));
  }
}

/// A half-edge filed under the lower end of its edge.
struct EdgeRecord {
  VertexId high;
  HalfedgeId h;
  auto operator<=>(const EdgeRecord&) const = default;
};

[[noreturn]] void refuse_crowded_edge(VertexId low, std::span<const EdgeRecord> run) {
  std::string faces;
  for (const EdgeRecord& r : run) faces += fmt::format("{}{}", faces.empty() ? "" : ", ", Mesh::face(r.h));
  const std::string count = run.size() == 3 ? "three" : fmt::format("{}", run.size());
  throw InputError(fmt::format("edge {}-{}: {} faces {}", low, run.front().high, count, faces));
}

/// Pairs the half-edges of each edge, whatever their directions. Half-edges are filed by the lower vertex of their edge (a counting
/// sort), and each file, usually of three to six, is sorted: linear on meshes, deterministic always.
std::vector<HalfedgeId> match_edges(const Corners& corners, std::uint32_t vertex_count) {
  const auto ends = [&](HalfedgeId h) { return std::minmax(corners[h], corners[Mesh::next(h)]); };
  const auto halfedges = static_cast<HalfedgeId>(corners.size());
  std::vector<std::uint32_t> begin(std::size_t{vertex_count} + 1, 0);
  for (HalfedgeId h = 0; h < halfedges; ++h) ++begin[std::size_t{ends(h).first} + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
  std::vector<EdgeRecord> records(halfedges);
  std::vector<std::uint32_t> fill(begin.begin(), begin.end() - 1);
  for (HalfedgeId h = 0; h < halfedges; ++h) {
    const auto [low, high] = ends(h);
    records[fill[low]++] = {high, h};
  }
  std::vector<HalfedgeId> twins(halfedges, kNone);
  for (VertexId low = 0; low < vertex_count; ++low) {
    const std::span file(records.data() + begin[low], begin[std::size_t{low} + 1] - begin[low]);
    std::sort(file.begin(), file.end());
    for (std::size_t i = 0, j; i < file.size(); i = j) {
      for (j = i + 1; j < file.size() && file[j].high == file[i].high;) ++j;
      if (j - i > 2) refuse_crowded_edge(low, file.subspan(i, j - i));
      if (j - i == 1) continue;
      twins[file[i].h] = file[i + 1].h;
      twins[file[i + 1].h] = file[i].h;
    }
  }
  return twins;
}

/// Which faces to turn round: floods each component from its lowest face; the majority keeps its orientation, and with it the
/// lowest face on a draw.
std::vector<std::uint8_t> choose_flips(const Corners& corners, const std::vector<HalfedgeId>& twins) {
  constexpr std::uint8_t kUnseen = 2;
  const auto faces = static_cast<FaceId>(corners.size() / 3);
  std::vector<std::uint8_t> flipped(faces, kUnseen);
  std::vector<FaceId> component;
  for (FaceId seed = 0; seed < faces; ++seed) {
    if (flipped[seed] != kUnseen) continue;
    component.assign(1, seed);
    flipped[seed] = 0;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const FaceId f = component[i];
      turned += flipped[f];
      for (HalfedgeId h = 3 * f; h < 3 * f + 3; ++h) {
        const HalfedgeId t = twins[h];
        if (t == kNone) continue;
        const FaceId g = Mesh::face(t);
        const std::uint8_t wanted = flipped[f] ^ static_cast<std::uint8_t>(corners[h] == corners[t]);
        if (flipped[g] == kUnseen) {
          flipped[g] = wanted;
          component.push_back(g);
        } else if (flipped[g] != wanted) {
          const auto [low, high] = std::minmax(corners[h], corners[Mesh::next(h)]);
          throw InputError(fmt::format("faces {} and {}: not orientable (a band of faces across edge {}-{} comes back turned over)",
                                       std::min(f, g), std::max(f, g), low, high));
        }
      }
    }
    if (2 * turned > component.size()) {
      for (const FaceId f : component) flipped[f] ^= 1;
    }
  }
  return flipped;
}

/// Turns the chosen faces round. Swapping corners 1 and 2 sends half-edge k of a face to 2 - k, in the other direction.
void apply_flips(const std::vector<std::uint8_t>& flipped, Corners& corners, std::vector<HalfedgeId>& twins) {
  const auto moved = [&](HalfedgeId h) {
    return h == kNone || !flipped[Mesh::face(h)] ? h : 3 * Mesh::face(h) + (2 - h % 3);
  };
  for (HalfedgeId& t : twins) t = moved(t);
  for (FaceId f = 0; f < flipped.size(); ++f) {
    if (!flipped[f]) continue;
    std::swap(corners[3 * f + 1], corners[3 * f + 2]);
    std::swap(twins[3 * f], twins[3 * f + 2]);
  }
}

/// Names a face of each fan at v: the lowest face at v, then the lowest one that no fan named before contains, and so on.
[[noreturn]] void refuse_fans(VertexId v, const Corners& corners, const std::vector<HalfedgeId>& twins) {
  std::vector<HalfedgeId> open;
  for (HalfedgeId h = 0; h < corners.size(); ++h) {
    if (corners[h] == v) open.push_back(h);
  }
  std::vector<FaceId> named;
  while (!open.empty()) {
    const HalfedgeId first = open.front();
    named.push_back(Mesh::face(first));
    std::vector<HalfedgeId> fan;
    HalfedgeId h = first;
    do {
      fan.push_back(h);
      h = twins[Mesh::prev(h)];
    } while (h != kNone && h != first);
    for (h = first; h != kNone && twins[h] != kNone;) {  // the rest of an open fan, clockwise
      h = Mesh::next(twins[h]);
      if (h == first) break;
      fan.push_back(h);
    }
    std::erase_if(open, [&](HalfedgeId o) { return std::find(fan.begin(), fan.end(), o) != fan.end(); });
  }
  std::string faces;
  for (std::size_t i = 0; i < named.size(); ++i) {
    faces += fmt::format("{}{}", i == 0 ? "" : i + 1 == named.size() ? " and " : ", ", named[i]);
  }
  throw InputError(fmt::format("vertex {}: its faces form {} fans (faces {})", v,
                               named.size() == 2 ? "two" : fmt::format("{}", named.size()), faces));
}

/// Outgoing half-edges, the first one of the fan at boundary vertices. Refuses vertices whose faces are not one fan.
std::vector<HalfedgeId> link_vertices(const Corners& corners, const std::vector<HalfedgeId>& twins, std::uint32_t vertex_count) {
  std::vector<HalfedgeId> outgoing(vertex_count, kNone);
  std::vector<std::uint32_t> degree(vertex_count, 0);
  for (HalfedgeId h = 0; h < corners.size(); ++h) {
    const VertexId v = corners[h];
    ++degree[v];
    if (outgoing[v] == kNone || (twins[h] == kNone && twins[outgoing[v]] != kNone)) outgoing[v] = h;
  }
  for (VertexId v = 0; v < vertex_count; ++v) {
    std::uint32_t reached = 0;
    for (HalfedgeId h = outgoing[v]; h != kNone;) {
      ++reached;
      h = twins[Mesh::prev(h)];
      if (h == outgoing[v]) break;
    }
    if (reached != degree[v]) refuse_fans(v, corners, twins);
  }
  return outgoing;
}

}  // namespace

Mesh::Mesh(MeshArrays arrays) {
  check_sizes(arrays);
  check_finite(arrays.points);
  check_indices(arrays);
  check_areas(arrays);
  vertex_count_ = input_vertex_count_ = static_cast<std::uint32_t>(arrays.points.size());
  corners_.reserve(3 * arrays.faces.size());
  for (const auto& face : arrays.faces) corners_.insert(corners_.end(), face.begin(), face.end());
  points_ = std::move(arrays.points);
  twins_ = match_edges(corners_, vertex_count_);
  flipped_ = choose_flips(corners_, twins_);
  apply_flips(flipped_, corners_, twins_);
  outgoing_ = link_vertices(corners_, twins_, vertex_count_);
}

void Mesh::build_twins() {
  twins_ = match_edges(corners_, vertex_count_);
  for (HalfedgeId h = 0; h < halfedge_count(); ++h) {
    if (twins_[h] != kNone && origin(h) == origin(twins_[h])) {
      throw InternalError(fmt::format("faces {} and {} of a refined mesh are oriented differently", face(h), face(twins_[h])));
    }
  }
  outgoing_ = link_vertices(corners_, twins_, vertex_count_);
}

ExactPoint Mesh::exact_point(VertexId v) const {
  if (!is_representable(v)) return inserted_[v - input_vertex_count_];
  const Point& p = points_[v];
  return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])};
}

std::uint32_t Mesh::flipped_count() const noexcept {
  return static_cast<std::uint32_t>(std::count(flipped_.begin(), flipped_.end(), std::uint8_t{1}));
}

}  // namespace gvd::kernel
