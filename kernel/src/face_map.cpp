#include "face_map.hpp"

#include "gvd/kernel/error.hpp"
#include "gvd/robust/rational.hpp"

namespace gvd::kernel {

std::array<mpq_class, 3> barycentric_in_face(const Mesh& input, FaceId face, const Mesh& refined, VertexId v) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (input.origin(3 * face + k) != v) continue;
    std::array<mpq_class, 3> bary{0, 0, 0};
    bary[k] = 1;
    return bary;
  }
  const std::array<ExactPoint, 4> exact = {input.exact_point(input.origin(3 * face)), input.exact_point(input.origin(3 * face + 1)),
                                           input.exact_point(input.origin(3 * face + 2)), refined.exact_point(v)};
  robust::CommonDenominator common;
  for (const ExactPoint& q : exact) common.include(q);
  std::array<std::array<mpz_class, 3>, 3> spoke;  // from corner 0 to the others and to v
  for (std::size_t s = 0; s < 3; ++s)
    for (std::size_t i = 0; i < 3; ++i) spoke[s][i] = common.numerator(exact[s + 1][i]) - common.numerator(exact[0][i]);
  for (std::size_t i = 0; i < 3; ++i) {  // drop an axis along which the face does not vanish
    const auto cross = [&, j = (i + 1) % 3](std::size_t s, std::size_t t) { return mpz_class(spoke[s][i] * spoke[t][j] - spoke[s][j] * spoke[t][i]); };
    const mpz_class whole = cross(0, 1);
    if (whole == 0) continue;
    const mpz_class of_1 = cross(2, 1), of_2 = cross(0, 2);
    return {robust::ratio(whole - of_1 - of_2, whole), robust::ratio(of_1, whole), robust::ratio(of_2, whole)};
  }
  throw InternalError("a face of area zero");
}

}  // namespace gvd::kernel
