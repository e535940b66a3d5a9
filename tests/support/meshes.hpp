#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "gvd/kernel/mesh.hpp"

/// Small meshes for tests. All coordinates are small integers or dyadic numbers unless said otherwise, so the surfaces are exactly
/// what their names say. Open surfaces are counter-clockwise seen from above, closed ones seen from outside.
namespace gvd::test {

using kernel::MeshArrays;
using kernel::Point;

/// SplitMix64 (Steele, Lea and Flood 2014): the same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in [0, n) up to a bias of n / 2^64.
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(next() % n); }

 private:
  std::uint64_t state_;
};

/// Which diagonal splits the squares of a grid.
enum class Diagonal { rising, falling, alternating };

/// (nx + 1) x (ny + 1) vertices at (i, j) * step with height z(i, j), 2 nx ny faces. Vertex j * (nx + 1) + i; the faces of square
/// (i, j) are 2 (j nx + i) and the next one.
inline MeshArrays grid(std::uint32_t nx, std::uint32_t ny, const std::function<double(std::uint32_t, std::uint32_t)>& z,
                       Diagonal diagonal = Diagonal::rising, double step = 1) {
  MeshArrays mesh;
  for (std::uint32_t j = 0; j <= ny; ++j) {
    for (std::uint32_t i = 0; i <= nx; ++i) mesh.points.push_back({i * step, j * step, z(i, j)});
  }
  for (std::uint32_t j = 0; j < ny; ++j) {
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = j * (nx + 1) + i, b = a + 1, c = b + nx + 1, d = a + nx + 1;
      const bool rising = diagonal == Diagonal::rising || (diagonal == Diagonal::alternating && (i + j) % 2 == 0);
      if (rising) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({a, c, d});
      } else {
        mesh.faces.push_back({a, b, d});
        mesh.faces.push_back({b, c, d});
      }
    }
  }
  return mesh;
}

inline MeshArrays flat_grid(std::uint32_t nx, std::uint32_t ny, Diagonal diagonal = Diagonal::rising, double step = 1) {
  return grid(nx, ny, [](auto, auto) { return 0.0; }, diagonal, step);
}

/// Drops the vertices that belong to no face; the others keep their order.
inline MeshArrays without_isolated(const MeshArrays& mesh) {
  std::vector<std::uint32_t> id(mesh.points.size(), kernel::kNone);
  for (const auto& face : mesh.faces) {
    for (const auto v : face) id[v] = 0;
  }
  MeshArrays out;
  for (std::size_t v = 0; v < id.size(); ++v) {
    if (id[v] == kernel::kNone) continue;
    id[v] = static_cast<std::uint32_t>(out.points.size());
    out.points.push_back(mesh.points[v]);
  }
  for (const auto& face : mesh.faces) out.faces.push_back({id[face[0]], id[face[1]], id[face[2]]});
  return out;
}

/// The flat grid [0, nx] x [0, ny] without the open rectangle (x0, x1) x (y0, y1), 0 < x0 < x1 < nx and so for y.
inline MeshArrays plane_with_hole(std::uint32_t nx, std::uint32_t ny, std::uint32_t x0, std::uint32_t x1, std::uint32_t y0,
                                  std::uint32_t y1) {
  MeshArrays full = flat_grid(nx, ny), mesh;
  mesh.points = full.points;
  for (std::uint32_t j = 0; j < ny; ++j) {
    for (std::uint32_t i = 0; i < nx; ++i) {
      if (i >= x0 && i < x1 && j >= y0 && j < y1) continue;
      mesh.faces.push_back(full.faces[2 * (j * nx + i)]);
      mesh.faces.push_back(full.faces[2 * (j * nx + i) + 1]);
    }
  }
  return without_isolated(mesh);
}

/// The surface of [0, size[0]] x [0, size[1]] x [0, size[2]], each side cut into parts[k] equal pieces along axis k. Corner (0, 0,
/// 0) is vertex 0. Coordinates are exact if the size is representable divided by the parts.
inline MeshArrays box(const std::array<double, 3>& size, const std::array<std::uint32_t, 3>& parts) {
  MeshArrays mesh;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> ids;
  const auto id = [&](const std::array<std::uint32_t, 3>& at) {
    const auto [it, fresh] = ids.try_emplace(at, static_cast<std::uint32_t>(mesh.points.size()));
    if (fresh) {
      Point p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = size[k] * at[k] / parts[k];
      mesh.points.push_back(p);
    }
    return it->second;
  };
  for (std::size_t normal = 0; normal < 3; ++normal) {
    const std::size_t u = (normal + 1) % 3, v = (normal + 2) % 3;
    for (const bool far : {false, true}) {
      for (std::uint32_t j = 0; j < parts[v]; ++j) {
        for (std::uint32_t i = 0; i < parts[u]; ++i) {
          const auto corner = [&](std::uint32_t di, std::uint32_t dj) {
            std::array<std::uint32_t, 3> at{};
            at[normal] = far ? parts[normal] : 0;
            at[u] = i + di;
            at[v] = j + dj;
            return id(at);
          };
          const std::uint32_t a = corner(0, 0), b = far ? corner(1, 0) : corner(0, 1), c = corner(1, 1),
                              d = far ? corner(0, 1) : corner(1, 0);
          mesh.faces.push_back({a, b, c});
          mesh.faces.push_back({a, c, d});
        }
      }
    }
  }
  return mesh;
}

/// The unit cube, each side cut into n x n squares (n a power of two keeps coordinates exact).
inline MeshArrays cube(std::uint32_t n) { return box({1, 1, 1}, {n, n, n}); }

/// A fan of n >= 3 faces round vertex 0: the apex (0, 0, height); rim vertices 1 .. n at `rim(i)`.
inline MeshArrays fan(std::uint32_t n, const Point& apex, const std::function<Point(std::uint32_t)>& rim) {
  MeshArrays mesh;
  mesh.points.push_back(apex);
  for (std::uint32_t i = 0; i < n; ++i) mesh.points.push_back(rim(i));
  for (std::uint32_t i = 0; i < n; ++i) mesh.faces.push_back({0, 1 + i, 1 + (i + 1) % n});
  return mesh;
}

/// A pyramid over a regular n-gon (coordinates rounded): apex vertex 0 at (0, 0, height), a convex vertex unless height is 0.
inline MeshArrays cone(std::uint32_t n, double radius, double height) {
  return fan(n, {0, 0, height}, [&](std::uint32_t i) {
    const double angle = 6.283185307179586 * i / n;
    return Point{radius * std::cos(angle), radius * std::sin(angle), 0};
  });
}

/// A fan of 2 n faces (n >= 2) round the saddle vertex 0 at the origin: rim vertices alternately up and down by `height` > 0 on
/// the unit circle (coordinates rounded).
inline MeshArrays saddle_fan(std::uint32_t n, double height) {
  return fan(2 * n, {0, 0, 0}, [&](std::uint32_t i) {
    const double angle = 3.141592653589793 * i / n;
    return Point{std::cos(angle), std::sin(angle), i % 2 == 0 ? height : -height};
  });
}

/// The exact saddle of integers: eight faces round vertex 0, corners of the square [-1, 1]^2 up by `height`, side middles down by
/// it.
inline MeshArrays integer_saddle(double height) {
  constexpr int kX[8] = {1, 1, 0, -1, -1, -1, 0, 1}, kY[8] = {0, 1, 1, 1, 0, -1, -1, -1};
  return fan(8, {0, 0, 0}, [&](std::uint32_t i) {
    return Point{double(kX[i]), double(kY[i]), i % 2 == 1 ? height : -height};
  });
}

/// Steps along x: `steps` times a tread of length `tread` and a riser of height `rise`, width ny along y. Developable: isometric to
/// the flat rectangle [0, steps (tread + rise)] x [0, ny] with columns at the fold lines.
inline MeshArrays staircase(std::uint32_t steps, std::uint32_t ny, double tread = 1, double rise = 1) {
  MeshArrays mesh = flat_grid(2 * steps, ny);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto i = static_cast<std::uint32_t>(v % (2 * steps + 1));
    mesh.points[v][0] = tread * ((i + 1) / 2);
    mesh.points[v][2] = rise * (i / 2);
  }
  return mesh;
}

/// A gable roof over [0, 2 half] x [0, ny] with `parts` columns on each slope. The ridge is `height` high; (half / parts, height /
/// parts) from a Pythagorean pair, such as (4, 3), makes it isometric to a flat grid with integer columns. Developable.
inline MeshArrays roof(std::uint32_t parts, std::uint32_t ny, double half, double height) {
  MeshArrays mesh = flat_grid(2 * parts, ny);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto i = static_cast<std::uint32_t>(v % (2 * parts + 1));
    mesh.points[v][0] = half * i / parts;
    mesh.points[v][2] = height * (i <= parts ? i : 2 * parts - i) / parts;
  }
  return mesh;
}

/// A grid of n x n squares with heights uniform in [0, relief), drawn row by row from Random(seed). Alternating diagonals.
inline MeshArrays random_terrain(std::uint32_t n, double relief, std::uint64_t seed) {
  Random random(seed);
  MeshArrays mesh = flat_grid(n, n, Diagonal::alternating);
  for (Point& p : mesh.points) p[2] = relief * random.uniform();
  return mesh;
}

/// As random_terrain, with integer heights 0 .. levels - 1: many exact ties and flat patches.
inline MeshArrays integer_terrain(std::uint32_t n, std::uint32_t levels, std::uint64_t seed) {
  Random random(seed);
  MeshArrays mesh = flat_grid(n, n, Diagonal::alternating);
  for (Point& p : mesh.points) p[2] = random.below(levels);
  return mesh;
}

/// A terrain with hills of all sizes: midpoint displacement (diamond-square) on a grid of 2^level squares a side, step 1. Each
/// halving of the step scales the displacement by `roughness` (0.5 .. 0.7 looks natural); `relief` is the first displacement.
/// Vertices are jittered in x and y by up to 0.3, so that nothing is aligned.
inline MeshArrays fractal_terrain(std::uint32_t level, double relief, double roughness, std::uint64_t seed) {
  Random random(seed);
  const std::uint32_t n = 1u << level;
  std::vector<double> z(std::size_t{n + 1} * (n + 1), 0);
  const auto at = [&](std::uint32_t i, std::uint32_t j) -> double& { return z[std::size_t{j} * (n + 1) + i]; };
  double amplitude = relief;
  const auto displaced = [&](double sum, int count) { return sum / count + random.uniform(-amplitude, amplitude); };
  for (std::uint32_t step = n; step > 1; step /= 2, amplitude *= roughness) {
    const std::uint32_t half = step / 2;
    for (std::uint32_t j = half; j < n; j += step) {
      for (std::uint32_t i = half; i < n; i += step) {
        at(i, j) = displaced(at(i - half, j - half) + at(i + half, j - half) + at(i - half, j + half) + at(i + half, j + half), 4);
      }
    }
    for (std::uint32_t j = 0; j <= n; j += half) {
      for (std::uint32_t i = (j / half) % 2 == 0 ? half : 0; i <= n; i += step) {
        double sum = 0;
        int count = 0;
        if (i >= half) sum += at(i - half, j), ++count;
        if (i + half <= n) sum += at(i + half, j), ++count;
        if (j >= half) sum += at(i, j - half), ++count;
        if (j + half <= n) sum += at(i, j + half), ++count;
        at(i, j) = displaced(sum, count);
      }
    }
  }
  MeshArrays mesh = grid(n, n, [&](std::uint32_t i, std::uint32_t j) { return at(i, j); }, Diagonal::alternating);
  for (Point& p : mesh.points) {
    p[0] += random.uniform(-0.3, 0.3);
    p[1] += random.uniform(-0.3, 0.3);
  }
  return mesh;
}

}  // namespace gvd::test
