#include "refined_point.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "face_map.hpp"
#include "gvd/kernel/error.hpp"
#include "gvd/kernel/surface_point.hpp"

namespace gvd::kernel {
namespace {

/// The barycentric coordinates of `p`, which are those in an input face, in a part of that face; empty if it lies outside.
std::optional<std::array<mpq_class, 3>> in_part(const Mesh& input, const Mesh& refined, FaceId part,
                                                const std::array<mpq_class, 3>& p) {
  const FaceId face = refined.input_face(part);
  std::array<std::array<mpq_class, 3>, 3> corner;
  for (std::uint32_t k = 0; k < 3; ++k) corner[k] = barycentric_in_face(input, face, refined, refined.origin(3 * part + k));
  const auto twice_area = [](const auto& a, const auto& b, const auto& c) {
    return mpq_class((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]));
  };
  const mpq_class whole = twice_area(corner[0], corner[1], corner[2]);
  std::array<mpq_class, 3> bary;
  for (std::size_t k = 0; k < 3; ++k) {
    bary[k] = twice_area(p, corner[(k + 1) % 3], corner[(k + 2) % 3]) / whole;
    if (sgn(bary[k]) < 0) return std::nullopt;
  }
  return bary;
}

}  // namespace

FaceParts::FaceParts(const Mesh& input, const Mesh& refined) {
  for (FaceId f = input.face_count(); f < refined.face_count(); ++f) parts_.emplace_back(refined.input_face(f), f);
  std::sort(parts_.begin(), parts_.end());
}

FaceParts::List::const_iterator FaceParts::first(FaceId input_face) const {
  return std::lower_bound(parts_.begin(), parts_.end(), std::pair{input_face, FaceId{0}});
}

RefinedPoint find_in_refined(const Mesh& input, const Mesh& refined, const FaceParts& parts, const SurfacePoint& at) {
  const Location where = locate(input, at);
  RefinedPoint point;
  point.vertex = where.vertex;
  if (point.vertex != kNone) return point;
  if (!parts.is_split(at.face)) {
    point.face = at.face;
    point.bary = at.bary;
    return point;
  }
  parts.for_each(at.face, [&](FaceId part) {
    const auto bary = in_part(input, refined, part, at.bary);
    if (!bary) return false;
    point.face = part;
    point.bary = *bary;
    return true;
  });
  if (point.face == kNone) throw InternalError("a point of face " + std::to_string(at.face) + " lies in none of its parts");
  for (std::uint32_t k = 0; k < 3; ++k)
    if (point.bary[k] == 1) point.vertex = refined.origin(3 * point.face + k);
  return point;
}

}  // namespace gvd::kernel
