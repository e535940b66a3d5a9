#include "hill_shade.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gvd::io {

using kernel::Point;

namespace {

constexpr Point kLight = {-0.5, 0.5, 0.7071067811865476};
constexpr double kDarkest = 55, kBrightest = 252;  // grey of the 2nd and the 98th percentile
constexpr double kFlatShare = 0.35;                // how much of the shade is that of the plane of the face: the TIN stays visible

double light_on(const Point& normal) {
  const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  if (!(length > 0)) return 0;
  return std::max(0.0, (normal[0] * kLight[0] + normal[1] * kLight[1] + normal[2] * kLight[2]) / length);
}

std::vector<double> light_at_vertices(const kernel::Mesh& mesh, const PlanView& view) {
  std::vector<Point> normals(mesh.vertex_count(), Point{});
  for (kernel::FaceId f = 0; f < mesh.face_count(); ++f) {
    if (!view.is_seen(f)) continue;
    const Point n = view.normal(f);
    for (unsigned corner = 0; corner < 3; ++corner)
      for (unsigned k = 0; k < 3; ++k) normals[mesh.origin(3 * f + corner)][k] += n[k];
  }
  std::vector<double> light;
  for (const auto& n : normals) light.push_back(light_on(n));
  return light;
}

/// Draws triangles into a raster, the highest surface wins.
class Raster {
 public:
  Raster(std::uint32_t width, std::uint32_t height)
      : width_(width), height_(height), top_(std::size_t{width} * height, -std::numeric_limits<double>::infinity()), light_(top_.size()) {}

  void draw(const std::array<PlanePoint, 3>& p, const std::array<double, 3>& z, const std::array<double, 3>& light) {
    const auto [left, right] = std::minmax({p[0][0], p[1][0], p[2][0]});
    const auto [top, bottom] = std::minmax({p[0][1], p[1][1], p[2][1]});
    const double area = cross(p[0], p[1], p[2]);
    if (area == 0) return;
    for (auto y = first_pixel(top); y < height_ && y + 0.5 <= bottom; ++y)
      for (auto x = first_pixel(left); x < width_ && x + 0.5 <= right; ++x) {
        const PlanePoint centre = {x + 0.5, y + 0.5};
        const std::array<double, 3> b = {cross(centre, p[1], p[2]) / area, cross(p[0], centre, p[2]) / area, cross(p[0], p[1], centre) / area};
        if (std::min({b[0], b[1], b[2]}) >= 0) put(std::size_t{y} * width_ + x, mix(b, z), mix(b, light));
      }
  }

  ShadeImage image() const {
    const auto [dark, bright] = percentiles();
    const double stretch = bright > dark ? (kBrightest - kDarkest) / (bright - dark) : 0;
    ShadeImage image{width_, height_, std::vector<std::uint8_t>(2 * light_.size(), 0)};
    for (std::size_t i = 0; i < light_.size(); ++i) {
      if (!is_drawn(i)) continue;
      const double grey = stretch > 0 ? kDarkest + (light_[i] - dark) * stretch : (kDarkest + kBrightest) / 2;
      image.pixels[2 * i] = static_cast<std::uint8_t>(std::clamp(grey, 0.0, 255.0));
      image.pixels[2 * i + 1] = 255;
    }
    return image;
  }

 private:
  static double cross(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  static double mix(const std::array<double, 3>& b, const std::array<double, 3>& x) { return b[0] * x[0] + b[1] * x[1] + b[2] * x[2]; }
  static std::uint32_t first_pixel(double x) { return static_cast<std::uint32_t>(std::max(0.0, std::ceil(x - 0.5))); }
  bool is_drawn(std::size_t i) const { return top_[i] != -std::numeric_limits<double>::infinity(); }

  void put(std::size_t i, double z, double light) {
    if (z < top_[i]) return;
    top_[i] = z;
    light_[i] = light;
  }

  std::array<double, 2> percentiles() const {
    std::vector<double> drawn;
    for (std::size_t i = 0; i < light_.size(); ++i)
      if (is_drawn(i)) drawn.push_back(light_[i]);
    if (drawn.empty()) return {0, 0};
    std::sort(drawn.begin(), drawn.end());
    return {drawn[drawn.size() * 2 / 100], drawn[drawn.size() * 98 / 100]};
  }

  std::uint32_t width_, height_;
  std::vector<double> top_, light_;
};

}  // namespace

ShadeImage hill_shade(const kernel::Mesh& mesh, const PlanView& view) {
  const auto at_vertex = light_at_vertices(mesh, view);
  Raster raster(std::max(1u, static_cast<std::uint32_t>(std::lround(view.width()))),
                std::max(1u, static_cast<std::uint32_t>(std::lround(view.height()))));
  for (kernel::FaceId f = 0; f < mesh.face_count(); ++f) {
    if (!view.is_seen(f)) continue;
    const double flat = light_on(view.normal(f));
    std::array<PlanePoint, 3> p;
    std::array<double, 3> z, light;
    for (unsigned k = 0; k < 3; ++k) {
      const auto v = mesh.origin(3 * f + k);
      p[k] = view.to_pixels(mesh.point(v));
      z[k] = mesh.point(v)[2];
      light[k] = kFlatShare * flat + (1 - kFlatShare) * at_vertex[v];
    }
    raster.draw(p, z, light);
  }
  return raster.image();
}

}  // namespace gvd::io
