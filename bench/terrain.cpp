#include "terrain.hpp"

#include <cmath>

namespace gvd::bench {
namespace {

std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}
double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// A number in [0, 1) that belongs to a lattice point.
double lattice(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  return unit(mix(mix(static_cast<std::uint64_t>(x) + seed) + 0x9e3779b97f4a7c15u * static_cast<std::uint64_t>(y)));
}

/// Smooth interpolation between the numbers of the four lattice points around (x, y).
double noise(double x, double y, std::uint64_t seed) {
  const auto i = static_cast<std::int64_t>(std::floor(x)), j = static_cast<std::int64_t>(std::floor(y));
  const double u = x - static_cast<double>(i), v = y - static_cast<double>(j);
  const double s = u * u * (3 - 2 * u), t = v * v * (3 - 2 * v);
  const double low = lattice(i, j, seed) * (1 - s) + lattice(i + 1, j, seed) * s;
  const double high = lattice(i, j + 1, seed) * (1 - s) + lattice(i + 1, j + 1, seed) * s;
  return low * (1 - t) + high * t;
}

/// Octaves from 40 cells to one cell; steep enough for slopes of up to about 45 degrees.
double height(double x, double y, std::uint64_t seed) {
  double sum = 0, wavelength = 40, amplitude = 400;
  for (std::uint64_t octave = 0; octave < 5; ++octave) {
    sum += amplitude * noise(x / wavelength, y / wavelength, seed + 1000 * octave);
    wavelength *= 0.4;
    amplitude *= 0.4;
  }
  return sum;
}

double squared_distance(const kernel::Point& a, const kernel::Point& b) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

}  // namespace

kernel::MeshArrays generated_terrain(std::uint32_t faces, std::uint64_t seed) {
  constexpr double kCell = 20;
  constexpr double kJitter = 0.48;  // below half a cell from end to end: no triangle turns over
  const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(faces / 2.0)));
  kernel::MeshArrays mesh;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = i + kJitter * (lattice(i, j, seed + 1) - 0.5), y = j + kJitter * (lattice(i, j, seed + 2) - 0.5);
      mesh.points.push_back({kCell * x, kCell * y, height(x, y, seed + 3)});
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      if (squared_distance(mesh.points[a], mesh.points[c]) < squared_distance(mesh.points[b], mesh.points[d])) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({a, c, d});
      } else {
        mesh.faces.push_back({a, b, d});
        mesh.faces.push_back({b, c, d});
      }
    }
  return mesh;
}

}  // namespace gvd::bench
