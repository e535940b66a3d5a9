#pragma once

#include <optional>
#include <vector>

#include "gvd/predicates/face_strip.hpp"
#include "gvd/robust/root_sum.hpp"
#include "meshes.hpp"

/// Strips whose unfolding is known without unfolding: a plane folded along the lines X = 5 i, each panel 5 wide and rising or falling by 3 or 4,
/// so that all corners have integer coordinates in space and (5 column, Y) in the plane.
namespace gvd::test {

struct PlanarPoint {
  mpq_class x, y;
  friend bool operator==(const PlanarPoint&, const PlanarPoint&) = default;
};
inline int turn(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c) {
  return sgn((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}
inline mpq_class squared_distance(const PlanarPoint& a, const PlanarPoint& b) {
  const mpq_class x = a.x - b.x, y = a.y - b.y;
  return x * x + y * y;
}

/// A vertex of the folded plane.
struct FoldedPoint {
  int column, y;
  friend bool operator==(const FoldedPoint&, const FoldedPoint&) = default;
  PlanarPoint planar() const { return {5 * column, y}; }
  /// In space. The folds are a fixed pattern; `offset` moves everything, `scale` is a power of two.
  predicates::SpacePoint in_space(double offset = 0, int scale = 0) const {
    int x = 0, z = 0;
    for (int i = -64; i < column; ++i) {
      const int kind = ((i * 7) % 5 + 5) % 5;
      x += kind < 2 ? 3 : kind < 4 ? 4 : 5;
      z += kind == 0 ? 4 : kind == 1 ? -4 : kind == 2 ? 3 : kind == 3 ? -3 : 0;
    }
    return {std::ldexp(x + offset, scale), std::ldexp(y + offset, scale), std::ldexp(z + offset, scale)};
  }
};
using FoldedFace = std::array<FoldedPoint, 3>;

inline predicates::FaceCorners in_space(const FoldedFace& face, double offset = 0, int scale = 0) {
  return {face[0].in_space(offset, scale), face[1].in_space(offset, scale), face[2].in_space(offset, scale)};
}

/// A face on the right of p -> q, in one panel, as (q, p, apex) counter-clockwise.
inline FoldedFace face_beyond(const FoldedPoint& p, const FoldedPoint& q, Random& random) {
  for (;;) {
    FoldedPoint apex{0, static_cast<int>(random.below(13)) - 6 + (p.y + q.y) / 2};
    if (p.column == q.column)
      apex.column = p.column + (random.below(2) == 0 ? 1 : -1);
    else
      apex.column = random.below(2) == 0 ? p.column : q.column;
    if (turn(q.planar(), p.planar(), apex.planar()) > 0) return {q, p, apex};
  }
}

/// The faces of a strip, each counter-clockwise, each but the first with its entry edge as first side.
struct FoldedStrip {
  std::vector<FoldedFace> faces;
  predicates::FacePoint source;  ///< in the first face
  PlanarPoint image;             ///< where that is

  predicates::FaceStrip described(double offset = 0, int scale = 0, Random* shuffle = nullptr) const {
    predicates::FaceStrip strip(in_space(faces[0], offset, scale), source);
    for (std::size_t i = 1; i < faces.size(); ++i) {
      auto corners = in_space(faces[i], offset, scale);
      if (shuffle != nullptr)
        for (std::size_t k = 2; k > 0; --k) std::swap(corners[k], corners[shuffle->below(static_cast<std::uint32_t>(k + 1))]);
      strip.cross(corners);
    }
    return strip;
  }
  /// Planar positions of the vertices of the strip, in its numbering.
  std::vector<PlanarPoint> vertices() const {
    std::vector<PlanarPoint> list{faces[0][0].planar(), faces[0][1].planar(), faces[0][2].planar()};
    for (std::size_t i = 1; i < faces.size(); ++i) list.push_back(faces[i][2].planar());
    return list;
  }
};

inline PlanarPoint planar_point(const FoldedFace& face, const std::array<mpq_class, 3>& weight) {
  PlanarPoint p{0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const PlanarPoint corner = face[k].planar();
    p.x += weight[k] * corner.x;
    p.y += weight[k] * corner.y;
  }
  const mpq_class sum = weight[0] + weight[1] + weight[2];
  return {p.x / sum, p.y / sum};
}

/// A point of the face that is not on its side 0: a corner, a point of a side, or inside.
inline std::array<mpq_class, 3> random_weights(Random& random) {
  const std::uint32_t kind = random.below(4);
  if (kind == 0) return {0, 0, 1};
  if (kind == 1) return {0, 1 + random.below(4), 1 + random.below(4)};
  return {1 + random.below(4), 1 + random.below(4), 1 + random.below(4)};
}

/// A random strip that leaves its first face over side 0 of that.
inline FoldedStrip random_strip(std::size_t crossings, Random& random) {
  FoldedStrip strip;
  const FoldedPoint p{0, static_cast<int>(random.below(5))}, q{static_cast<int>(random.below(2)), p.y + 1 + static_cast<int>(random.below(5))};
  strip.faces.push_back(face_beyond(p, q, random));
  strip.source.weight = random_weights(random);
  strip.image = planar_point(strip.faces[0], strip.source.weight);
  for (std::size_t i = 0; i < crossings; ++i) {
    const FoldedFace& last = strip.faces.back();
    const std::size_t side = i == 0 ? 0 : 1 + random.below(2);
    strip.faces.push_back(face_beyond(last[side], last[(side + 1) % 3], random));
  }
  return strip;
}

}  // namespace gvd::test
