#include "gvd/predicates/rational_strip.hpp"

namespace gvd::predicates {

std::optional<RationalFrame> rational_frame(const ExactFace& face, std::size_t k, const mpq_class& radicand) {
  const auto root = robust::rational_square_root(face.radicand / radicand);
  if (!root) return std::nullopt;
  const mpq_class& length2 = face.squared[k];
  return RationalFrame{face.dot[k] / length2, face.dot[(k + 1) % 3] / length2, *root / length2};
}

QuadraticPoint turn(const QuadraticPoint& z, const RationalFrame& side, bool left, const mpq_class& n) {
  if (left) return {z.x * side.v + z.y * side.y * n, z.y * side.v - z.x * side.y};
  const mpq_class x = 1 - z.x;
  return {1 - (x * side.u + z.y * side.y * n), z.y * side.u - x * side.y};
}

}  // namespace gvd::predicates
