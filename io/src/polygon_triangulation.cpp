#include "gvd/io/polygon_triangulation.hpp"

namespace gvd::io {

namespace {

/// Twice the signed area. Rounded: it chooses triangles for a picture.
double area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

class EarClipper {
 public:
  explicit EarClipper(std::span<const PlanePoint> polygon) : polygon_(polygon) {
    for (std::uint32_t i = 0; i < polygon.size(); ++i) left_.push_back(i);
  }

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

  std::span<const PlanePoint> polygon_;
  std::vector<std::uint32_t> left_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(std::span<const PlanePoint> polygon) {
  return EarClipper(polygon).run();
}

}  // namespace gvd::io
