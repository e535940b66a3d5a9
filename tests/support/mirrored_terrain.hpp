#pragma once

#include <stdexcept>

#include "gvd/kernel/surface_point.hpp"
#include "meshes.hpp"

/// A terrain over more square classes than algebra multiplies out, mirrored, with two sources that are mirror images or a hair off.
namespace gvd::test {

inline constexpr std::uint32_t kWidth = 12, kHeight = 4;

/// Rough heights, the same on both sides of the middle, diagonals too.
inline MeshArrays mirrored_terrain() {
  Random random(31);
  std::vector<double> height((kWidth + 1) * (kHeight + 1));
  for (std::uint32_t y = 0; y <= kHeight; ++y) {
    for (std::uint32_t x = 0; x <= kWidth / 2; ++x)
      height[y * (kWidth + 1) + x] = height[y * (kWidth + 1) + kWidth - x] = 0.05 * random.uniform();
  }
  MeshArrays mesh;
  for (std::uint32_t y = 0; y <= kHeight; ++y)
    for (std::uint32_t x = 0; x <= kWidth; ++x) mesh.points.push_back({double(x), double(y), height[y * (kWidth + 1) + x]});
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const std::uint32_t a = y * (kWidth + 1) + x, b = a + 1, d = a + kWidth + 1, c = d + 1;
      if (x < kWidth / 2)
        mesh.faces.insert(mesh.faces.end(), {{a, b, c}, {a, c, d}});
      else
        mesh.faces.insert(mesh.faces.end(), {{a, b, d}, {b, c, d}});
    }
  }
  return mesh;
}

/// One source in the first square, the other its mirror image, but `step` nearer to the mirror line.
inline std::vector<kernel::Source> mirrored_sources(const kernel::Mesh& mesh, const mpq_class& step) {
  const kernel::Source left{kernel::point_in_face(mesh, 0, {mpq_class(1, 2), mpq_class(1, 4), mpq_class(1, 4)}), 0};
  // Face 0 has the corners (0, 0), (1, 0), (1, 1); its image is found by their images.
  const kernel::Source right = [&] {
    for (kernel::FaceId f = 0; f < mesh.face_count(); ++f) {
      std::array<mpq_class, 3> weight{0, 0, 0};
      bool is_image = true;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const kernel::VertexId v = mesh.origin(3 * f + k);
        if (v == kWidth)
          weight[k] = mpq_class(1, 2) - step;
        else if (v == kWidth - 1)
          weight[k] = mpq_class(1, 4) + step;
        else if (v == 2 * kWidth)
          weight[k] = mpq_class(1, 4);
        else
          is_image = false;
      }
      if (is_image) return kernel::Source{kernel::point_in_face(mesh, f, weight), 0};
    }
    throw std::logic_error("no mirror image");
  }();
  return {left, right};
}

}  // namespace gvd::test
