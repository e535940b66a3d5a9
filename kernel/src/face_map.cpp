#include "face_map.hpp"

#include "gvd/kernel/error.hpp"

namespace gvd::kernel {

std::array<mpq_class, 3> barycentric_in_face(const Mesh& input, FaceId face, const Mesh& refined, VertexId v) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (input.origin(3 * face + k) != v) continue;
    std::array<mpq_class, 3> bary{0, 0, 0};
    bary[k] = 1;
    return bary;
  }
  const ExactPoint a = input.exact_point(input.origin(3 * face)), b = input.exact_point(input.origin(3 * face + 1)),
                   c = input.exact_point(input.origin(3 * face + 2)), p = refined.exact_point(v);
  for (std::size_t i = 0; i < 3; ++i) {  // drop an axis along which the face does not vanish
    const std::size_t j = (i + 1) % 3;
    const mpq_class det = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    if (det == 0) continue;
    const mpq_class b1 = ((p[i] - a[i]) * (c[j] - a[j]) - (p[j] - a[j]) * (c[i] - a[i])) / det;
    const mpq_class b2 = ((b[i] - a[i]) * (p[j] - a[j]) - (b[j] - a[j]) * (p[i] - a[i])) / det;
    return {mpq_class(1 - b1 - b2), b1, b2};
  }
  throw InternalError("a face of area zero");
}

}  // namespace gvd::kernel
