#pragma once

#include <cstdint>
#include <functional>

#include "fuzz/generators/draw.hpp"
#include "gvd/kernel/mesh.hpp"

namespace gvd::fuzz {

enum class Diagonals : std::uint32_t { rising, falling, drawn, even };

/// (nx + 1) x (ny + 1) vertices, vertex j (nx + 1) + i at place(i, j). `even`: the diagonals join the vertices with even i + j,
/// which have eight faces inside the grid.
inline kernel::MeshArrays drawn_grid(Draw& draw, std::uint32_t nx, std::uint32_t ny,
                                     const std::function<kernel::Point(std::uint32_t, std::uint32_t)>& place, Diagonals mode) {
  kernel::MeshArrays mesh;
  for (std::uint32_t j = 0; j <= ny; ++j)
    for (std::uint32_t i = 0; i <= nx; ++i) mesh.points.push_back(place(i, j));
  for (std::uint32_t j = 0; j < ny; ++j)
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = j * (nx + 1) + i, b = a + 1, c = b + nx + 1, d = a + nx + 1;
      const bool rising = mode == Diagonals::rising || (mode == Diagonals::drawn && draw.one_in(2)) ||
                          (mode == Diagonals::even && (i + j) % 2 == 0);
      if (rising) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({a, c, d});
      } else {
        mesh.faces.push_back({a, b, d});
        mesh.faces.push_back({b, c, d});
      }
    }
  return mesh;
}

/// One of the first three ways drawn for the whole grid.
inline kernel::MeshArrays drawn_grid(Draw& draw, std::uint32_t nx, std::uint32_t ny,
                                     const std::function<kernel::Point(std::uint32_t, std::uint32_t)>& place) {
  return drawn_grid(draw, nx, ny, place, static_cast<Diagonals>(draw.below(3)));
}

/// Drops the faces for which `drop` says so, and the vertices that belong to no face then.
kernel::MeshArrays without_faces(const kernel::MeshArrays& mesh, const std::function<bool(std::size_t)>& drop);

}  // namespace gvd::fuzz
