#include "gvd/io/polygon_triangulation.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace gvd::io {

namespace {

using Ring = std::vector<std::uint32_t>;

/// Twice the signed area. Rounded: it chooses triangles for a picture.
double area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Whether the inner parts of two segments cross.
bool cross(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d) {
  return (area(a, b, c) > 0) != (area(a, b, d) > 0) && (area(c, d, a) > 0) != (area(c, d, b) > 0);
}

/// Joins one hole after the other to the outline, each by the shortest bridge that crosses no ring.
class Bridges {
 public:
  Bridges(const std::vector<PlanePoint>& points, Ring outline, std::vector<Ring> holes)
      : points_(points), outline_(std::move(outline)), holes_(std::move(holes)) {}

  Ring run() {
    while (!holes_.empty()) join_nearest();
    return std::move(outline_);
  }

 private:
  double squared_length(std::uint32_t a, std::uint32_t b) const {
    const double x = points_[a][0] - points_[b][0], y = points_[a][1] - points_[b][1];
    return x * x + y * y;
  }

  bool crosses(const Ring& ring, std::uint32_t a, std::uint32_t b) const {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto c = ring[i], d = ring[(i + 1) % ring.size()];
      if (c == a || c == b || d == a || d == b) continue;
      if (cross(points_[a], points_[b], points_[c], points_[d])) return true;
    }
    return false;
  }

  bool is_free(std::uint32_t a, std::uint32_t b) const {
    return !crosses(outline_, a, b) && std::none_of(holes_.begin(), holes_.end(), [&](const Ring& hole) { return crosses(hole, a, b); });
  }

  void join_nearest() {
    double shortest = std::numeric_limits<double>::infinity();
    std::size_t hole = 0, from = 0, to = 0;
    for (std::size_t h = 0; h < holes_.size(); ++h)
      for (std::size_t j = 0; j < holes_[h].size(); ++j)
        for (std::size_t i = 0; i < outline_.size(); ++i) {
          const double length = squared_length(outline_[i], holes_[h][j]);
          if (length >= shortest || !is_free(outline_[i], holes_[h][j])) continue;
          shortest = length;
          hole = h, from = i, to = j;
        }
    splice(from, holes_[hole], to);
    holes_.erase(holes_.begin() + static_cast<std::ptrdiff_t>(hole));
  }

  /// outline[from], then once round the hole from hole[to] back to it, then outline[from] again.
  void splice(std::size_t from, Ring hole, std::size_t to) {
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(to), hole.end());
    hole.push_back(hole.front());
    hole.push_back(outline_[from]);
    outline_.insert(outline_.begin() + static_cast<std::ptrdiff_t>(from) + 1, hole.begin(), hole.end());
  }

  const std::vector<PlanePoint>& points_;
  Ring outline_;
  std::vector<Ring> holes_;
};

class EarClipper {
 public:
  EarClipper(const std::vector<PlanePoint>& points, Ring outline) : polygon_(points), left_(std::move(outline)) {}

  std::vector<std::array<std::uint32_t, 3>> run() {
    std::size_t start = 0;
    while (left_.size() > 3) {
      const std::size_t i = find_ear(start);
      clip(i);
      start = i + 1;  // go on behind the ear: the triangles become rounder than in a fan
    }
    if (left_.size() == 3) emit(0);
    return std::move(triangles_);
  }

 private:
  std::uint32_t at(std::size_t i) const { return left_[i % left_.size()]; }
  const PlanePoint& point(std::size_t i) const { return polygon_[at(i)]; }
  double corner_area(std::size_t i) const { return area(point(i + left_.size() - 1), point(i), point(i + 1)); }

  bool is_ear(std::size_t i) const {
    if (!(corner_area(i) > 0)) return false;
    const PlanePoint &a = point(i + left_.size() - 1), &b = point(i), &c = point(i + 1);
    for (std::size_t k = 2; k + 1 < left_.size(); ++k) {
      const PlanePoint& p = point(i + k);
      if (p == a || p == b || p == c) continue;
      if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
    }
    return true;
  }

  /// An ear, or, where rounding leaves none, the most convex corner.
  std::size_t find_ear(std::size_t start) const {
    std::size_t best = start % left_.size();
    for (std::size_t k = 0; k < left_.size(); ++k) {
      const std::size_t i = (start + k) % left_.size();
      if (is_ear(i)) return i;
      if (corner_area(i) > corner_area(best)) best = i;
    }
    return best;
  }

  void emit(std::size_t i) {
    if (corner_area(i) > 0) triangles_.push_back({at(i + left_.size() - 1), at(i), at(i + 1)});
  }

  void clip(std::size_t i) {
    emit(i);
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i % left_.size()));
  }

  const std::vector<PlanePoint>& polygon_;
  Ring left_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(const std::vector<std::vector<PlanePoint>>& rings) {
  std::vector<PlanePoint> points;
  std::vector<Ring> indices;
  for (const auto& ring : rings) {
    if (ring.empty()) continue;
    Ring& index = indices.emplace_back(ring.size());
    std::iota(index.begin(), index.end(), static_cast<std::uint32_t>(points.size()));
    points.insert(points.end(), ring.begin(), ring.end());
  }
  if (indices.empty()) return {};
  Ring outline = std::move(indices.front());
  indices.erase(indices.begin());
  return EarClipper(points, Bridges(points, std::move(outline), std::move(indices)).run()).run();
}

}  // namespace gvd::io
