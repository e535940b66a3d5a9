#pragma once

#include "gvd/kernel/surface_point.hpp"
#include "meshes.hpp"
#include "real.hpp"

/// A rectangle folded along its columns: distances on it are those in the plane, where column c lies at the sum of the widths of the panels before it. Widths
/// are roots of whole numbers, rows whole.
namespace gvd::test {

struct FoldedGrid {
  std::vector<std::array<int, 2>> panels;  ///< run and rise: of width sqrt(run^2 + rise^2)
  std::uint32_t rows;
  kernel::MeshArrays arrays;
  std::vector<std::array<Real, 2>> flat;  ///< per vertex; (column, row) is vertex row (columns + 1) + column

  FoldedGrid(std::vector<std::array<int, 2>> p, std::uint32_t r, Random& random) : panels(std::move(p)), rows(r) {
    std::vector<int> x{0}, z{0};
    std::vector<Real> at{Real(0)};
    for (const auto& [run, rise] : panels) {
      x.push_back(x.back() + run);
      z.push_back(z.back() + (random.below(2) == 0 ? rise : -rise));
      at.push_back(at.back() + sqrt(Real(run * run + rise * rise)));
    }
    for (std::uint32_t row = 0; row <= rows; ++row)
      for (std::size_t c = 0; c < x.size(); ++c) {
        arrays.points.push_back({double(x[c]), double(row), double(z[c])});
        flat.push_back({at[c], Real(row)});
      }
    for (std::uint32_t row = 0; row < rows; ++row)
      for (std::uint32_t c = 0; c < panels.size(); ++c) {
        const std::uint32_t a = vertex(c, row), b = vertex(c + 1, row), d = vertex(c, row + 1), e = vertex(c + 1, row + 1);
        if (random.below(2) == 0)
          arrays.faces.insert(arrays.faces.end(), {{a, b, e}, {a, e, d}});
        else
          arrays.faces.insert(arrays.faces.end(), {{a, b, d}, {b, e, d}});
      }
  }
  std::uint32_t columns() const { return static_cast<std::uint32_t>(panels.size()); }
  kernel::VertexId vertex(std::uint32_t column, std::uint32_t row) const { return row * (columns() + 1) + column; }
  /// The place of a point in the plane.
  std::array<Real, 2> place(const kernel::Mesh& mesh, const kernel::SurfacePoint& at) const {
    if (at.vertex != kernel::kNone) return flat[at.vertex];
    std::array<Real, 2> p{Real(0), Real(0)};
    for (kernel::HalfedgeId k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 2; ++i) p[i] += real(at.bary[k]) * flat[mesh.origin(3 * at.face + k)][i];
    return p;
  }
};

/// Panels of whole width, of one class, or of two, each of them again and again: vertices in line abound.
inline FoldedGrid folded_grid(std::uint32_t rows, Random& random) {
  constexpr std::array<std::array<std::array<int, 2>, 2>, 5> kPanels{{{{{1, 0}, {0, 2}}}, {{{3, 4}, {1, 0}}}, {{{1, 1}, {2, 2}}}, {{{1, 1}, {1, 2}}}, {{{1, 2}, {1, 3}}}}};
  const auto& kinds = kPanels[random.below(5)];
  std::vector<std::array<int, 2>> panels;
  for (std::uint32_t i = 0, n = 4 + random.below(4); i < n; ++i) panels.push_back(kinds[random.below(3) == 0 ? 1 : 0]);
  return {panels, rows, random};
}

}  // namespace gvd::test
