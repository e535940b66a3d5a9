#pragma once

#include <vector>

#include "gvd/predicates/strip_path.hpp"
#include "meshes.hpp"

/// Strips of faces with any corners in space, and what is known of them by symmetry: the way back and the mirror image.
namespace gvd::test {

struct SpaceStrip {
  std::vector<predicates::FaceCorners> faces;  ///< each but the first as origin and target of its entry edge and a new corner
  predicates::FacePoint source;

  predicates::FaceStrip described() const {
    predicates::FaceStrip strip(faces[0], source);
    for (std::size_t i = 1; i < faces.size(); ++i) strip.cross(faces[i]);
    return strip;
  }
  predicates::Leg leg_to(const predicates::FacePoint& end) const { return {described(), end}; }
  predicates::Leg back_from(const predicates::FacePoint& end) const {
    predicates::FaceStrip strip(faces.back(), end);
    for (std::size_t i = faces.size() - 1; i-- > 0;) strip.cross(faces[i]);
    return {strip, source};
  }
  /// Unfolded the other way round.
  SpaceStrip mirrored() const {
    SpaceStrip result = *this;
    std::swap(result.faces[0][0], result.faces[0][1]);
    std::swap(result.source.weight[0], result.source.weight[1]);
    return result;
  }
  /// Each coordinate times `factor`.
  SpaceStrip stretched(const std::array<double, 3>& factor) const {
    SpaceStrip result = *this;
    for (auto& face : result.faces)
      for (auto& corner : face)
        for (std::size_t i = 0; i < 3; ++i) corner[i] *= factor[i];
    return result;
  }
};

inline bool has_area(const predicates::FaceCorners& face) {
  try {
    predicates::FaceStrip(face, predicates::FacePoint::corner(0));
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// Beyond side k of a face, from corner k to the next, as (next, k, corner).
template <class CornerSource>
predicates::FaceCorners face_beyond(const predicates::FaceCorners& face, std::size_t k, CornerSource&& corner) {
  for (;;) {
    const predicates::FaceCorners beyond{face[(k + 1) % 3], face[k], corner()};
    if (beyond[2] != face[(k + 2) % 3] && has_area(beyond)) return beyond;
  }
}

/// `corner()` gives the corners. The source is a corner or inside the first face; the strip leaves that over its first side.
template <class CornerSource>
SpaceStrip space_strip(std::size_t crossings, Random& random, CornerSource&& corner) {
  SpaceStrip strip;
  while (strip.faces.empty())
    if (const predicates::FaceCorners first{corner(), corner(), corner()}; has_area(first)) strip.faces.push_back(first);
  strip.source.weight = {random.below(2), random.below(3), 1 + random.below(3)};
  for (std::size_t i = 0; i < crossings; ++i) {
    const predicates::FaceCorners last = strip.faces.back();
    const std::size_t side = i == 0 ? 0 : 1 + random.below(2);
    strip.faces.push_back(face_beyond(last, side, corner));
  }
  return strip;
}

inline predicates::SpacePoint integer_corner(Random& random, std::uint32_t range) {
  predicates::SpacePoint p;
  for (double& x : p) x = static_cast<double>(random.below(range));
  return p;
}
/// All bits of the doubles at random: every face is of a square class of its own.
inline predicates::SpacePoint double_corner(Random& random) {
  predicates::SpacePoint p;
  for (double& x : p) x = 1 + std::ldexp(random.below(1u << 26), -26) + std::ldexp(random.below(1u << 26), -52);
  return p;
}

}  // namespace gvd::test
