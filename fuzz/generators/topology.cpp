#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "fuzz/generators/family.hpp"
#include "fuzz/generators/grids.hpp"

namespace gvd::fuzz {
namespace {

using kernel::MeshArrays;
using kernel::Point;

MeshArrays plain(Draw& draw, std::uint32_t nx, std::uint32_t ny) {
  const int levels = draw.between(1, 4);
  const bool integer = draw.one_in(2);
  return drawn_grid(draw, nx, ny, [&](auto i, auto j) {
    return Point{double(i), double(j), integer ? double(draw.between(0, levels - 1)) : draw.unit()};
  });
}

/// Squares taken out of a grid, no two of them touching, none at the rim (or some there: bays).
MeshArrays holes(Draw& draw, std::uint32_t size) {
  const std::uint32_t n = std::max(4u, size);
  const MeshArrays full = plain(draw, n, n);
  const std::uint32_t shift = draw.below(2);
  std::set<std::size_t> out;
  for (std::uint32_t j = shift; j < n; j += 2)
    for (std::uint32_t i = shift; i < n; i += 2)
      if (draw.one_in(2)) out.insert(std::size_t{j} * n + i);
  return without_faces(full, [&](std::size_t f) { return out.count(f / 2) != 0; });
}

/// Two or three grids that have nothing in common, and an isolated vertex.
MeshArrays components(Draw& draw, std::uint32_t size) {
  MeshArrays mesh;
  const std::uint32_t parts = 2 + draw.below(2);
  for (std::uint32_t k = 0; k < parts; ++k) {
    const MeshArrays part = plain(draw, 1 + draw.below(size), 1 + draw.below(size));
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (Point p : part.points) {
      p[2] += 10.0 * k;  // well apart
      mesh.points.push_back(p);
    }
    for (const auto& f : part.faces) mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  }
  if (draw.one_in(2)) mesh.points.push_back({-1, -1, -1});
  return mesh;
}

/// Two grids joined by a chain of single faces: necks of one edge.
MeshArrays bridges(Draw& draw, std::uint32_t size) {
  const std::uint32_t n = std::max(2u, size / 2);
  const std::uint32_t wide = 2 * n + 2;
  const MeshArrays full = plain(draw, wide, n);
  const std::uint32_t row = draw.below(n);
  return without_faces(full, [&](std::size_t f) {
    const auto square = static_cast<std::uint32_t>(f / 2);
    const std::uint32_t i = square % wide, j = square / wide;
    return i >= n && i < n + 2 && j != row;
  });
}

/// The boundary of a set of unit cubes, each quadrilateral cut in two; corners at place(corner).
MeshArrays voxel_surface(Draw& draw, const std::set<std::array<int, 3>>& cubes, double jitter) {
  MeshArrays mesh;
  std::map<std::array<int, 3>, std::uint32_t> ids;
  const auto id = [&](const std::array<int, 3>& at) {
    const auto [it, fresh] = ids.try_emplace(at, static_cast<std::uint32_t>(mesh.points.size()));
    if (fresh) {
      Point p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = at[k] + (jitter == 0 ? 0 : draw.uniform(-jitter, jitter));
      mesh.points.push_back(p);
    }
    return it->second;
  };
  for (const auto& cube : cubes)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        auto beside = cube;
        beside[axis] += side == 1 ? 1 : -1;
        if (cubes.count(beside) != 0) continue;
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::uint32_t, 4> corner{};
        for (int k = 0; k < 4; ++k) {
          auto at = cube;
          at[axis] += side;
          at[u] += k == 1 || k == 2 ? 1 : 0;
          at[v] += k >= 2 ? 1 : 0;
          corner[static_cast<std::size_t>(k)] = id(at);
        }
        if (side == 0) std::swap(corner[1], corner[3]);
        const auto [a, b, c, d] = corner;
        if (draw.one_in(2)) {
          mesh.faces.push_back({a, b, c});
          mesh.faces.push_back({a, c, d});
        } else {
          mesh.faces.push_back({a, b, d});
          mesh.faces.push_back({b, c, d});
        }
      }
  return mesh;
}

/// A bar with `genus` tunnels, of cubes.
MeshArrays bar(Draw& draw, int genus) {
  std::set<std::array<int, 3>> cubes;
  const int length = genus == 0 ? draw.between(1, 3) : 2 * genus + 1, width = genus == 0 ? draw.between(1, 2) : 3;
  for (int x = 0; x < length; ++x)
    for (int y = 0; y < width; ++y)
      if (genus == 0 || x % 2 == 0 || y != 1) cubes.insert({x, y, 0});
  return voxel_surface(draw, cubes, draw.one_in(2) ? 0 : 0.2);
}
MeshArrays sphere(Draw& draw, std::uint32_t) { return bar(draw, 0); }
MeshArrays torus(Draw& draw, std::uint32_t) { return bar(draw, 1); }
MeshArrays double_torus(Draw& draw, std::uint32_t) { return bar(draw, 2); }

/// A grid without a band, glued to itself: a cylinder (two boundary loops, vertices moved to a prism).
MeshArrays tube(Draw& draw, std::uint32_t size) {
  constexpr std::array<std::array<double, 2>, 4> kCorner = {{{0, 0}, {3, 0}, {3, 3}, {0, 3}}};
  MeshArrays mesh;
  const double twist = draw.between(0, 1);
  for (std::uint32_t j = 0; j <= size; ++j)
    for (const auto& c : kCorner) mesh.points.push_back({c[0] + twist * j, c[1], double(2 * j)});
  for (std::uint32_t j = 0; j < size; ++j)
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t a = 4 * j + i, b = 4 * j + (i + 1) % 4;
      mesh.faces.push_back({a, b, b + 4});
      mesh.faces.push_back({a, b + 4, a + 4});
    }
  return mesh;
}

constexpr std::array<Family, 7> kFamilies = {{
    {"holes", holes, "squares taken out of a grid, bays at its rim"},
    {"components", components, "two or three separate grids, an isolated vertex"},
    {"bridges", bridges, "grids joined by a chain of single squares"},
    {"sphere", sphere, "a box, genus 0"},
    {"torus", torus, "cubes with one tunnel"},
    {"double_torus", double_torus, "cubes with two tunnels"},
    {"tube", tube, "a prism without ends"},
}};

}  // namespace

MeshArrays without_faces(const MeshArrays& mesh, const std::function<bool(std::size_t)>& drop) {
  MeshArrays out;
  std::vector<std::uint32_t> id(mesh.points.size(), kernel::kNone);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (!drop(f)) out.faces.push_back(mesh.faces[f]);
  for (const auto& face : out.faces)
    for (const auto v : face) id[v] = 0;
  for (std::size_t v = 0; v < id.size(); ++v) {
    if (id[v] == kernel::kNone) continue;
    id[v] = static_cast<std::uint32_t>(out.points.size());
    out.points.push_back(mesh.points[v]);
  }
  for (auto& face : out.faces)
    for (auto& v : face) v = id[v];
  return out;
}

std::span<const Family> topology_families() { return kFamilies; }

}  // namespace gvd::fuzz
