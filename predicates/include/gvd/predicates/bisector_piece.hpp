#pragma once

#include <optional>

#include "gvd/predicates/double_wave.hpp"

namespace gvd::predicates {

/// A directed line through two points that are known up to errors, by one of them and the difference.
struct DoubleLine {
  DoublePoint from{0, 0}, along{0, 0};
  double from_error = 0, along_error = 0;
};
/// On which side of the line a point lies that is known up to `error`: positive on the left.
inline Bounded side_of(const DoubleLine& line, const DoublePoint& p, double error) noexcept {
  const double apart = (line.from_error + error) * (1 + 0x1p-48);
  return bounded_cross(line.along, line.along_error, {p.x - line.from.x, p.y - line.from.y}, apart);
}

/// The gradient of a wave's distance at a point.
inline DoublePoint gradient(const DoubleWave& wave, const DoublePoint& p) noexcept {
  const double dx = p.x - wave.image.x, dy = p.y - wave.image.y, reach = std::sqrt(dx * dx + dy * dy);
  return {dx / reach, dy / reach};
}

/// A piece of the bisector of two waves, enclosed in a thin rectangle in which the bisector is one curve from end to end
/// (docs/error-bounds.md#pieces-of-bisectors).
struct BisectorPiece {
  DoublePoint middle{0, 0}, along{0, 0};  ///< of the rectangle: its middle, and a unit vector
  double half_length = 0, half_width = 0;
  double bend = 0;  ///< by how much the distance of `left` may exceed its tangent plane in the middle

  /// Empty if doubles do not tell that one curve leads from one point to the other with `left` on its left. Pre: the two tie at a point within `radius`
  /// of `from`, and at one of `to`.
  static std::optional<BisectorPiece> between(const DoubleWave& left, const DoubleWave& right, const DoublePoint& from, const DoublePoint& to, double radius);
};

inline std::optional<BisectorPiece> BisectorPiece::between(const DoubleWave& left, const DoubleWave& right, const DoublePoint& from, const DoublePoint& to,
                                                           double radius) {
  const auto one_norm = [](const DoublePoint& p) { return std::fabs(p.x) + std::fabs(p.y); };
  const DoublePoint chord{to.x - from.x, to.y - from.y};
  const double length = std::sqrt(chord.x * chord.x + chord.y * chord.y), off = radius + 4 * kUnit * (one_norm(from) + one_norm(to));
  BisectorPiece piece;
  piece.middle = {0.5 * (from.x + to.x), 0.5 * (from.y + to.y)};
  piece.along = {chord.x / length, chord.y / length};
  piece.half_length = (0.5 * length + off) * (1 + 0x1p-40);
  const double most = 1.25 * piece.half_length;  // half of the diagonal

  const double reach_l = distance({left.image, 0, 0}, piece.middle), reach_r = distance({right.image, 0, 0}, piece.middle);
  if (!(4 * off < piece.half_length && 4 * most < std::fmin(reach_l, reach_r) && 8 * left.error < reach_l && 8 * right.error < reach_r)) return std::nullopt;
  const double turn = (2 * most + 4 * left.error) / reach_l + (2 * most + 4 * right.error) / reach_r + 32 * kUnit;
  const DoublePoint of_left = gradient(left, piece.middle), of_right = gradient(right, piece.middle), rise{of_left.x - of_right.x, of_left.y - of_right.y};
  const double fall = -(piece.along.x * rise.y - piece.along.y * rise.x) - turn;  // of d_left - d_right, to the left
  const double slope = (std::fabs(piece.along.x * rise.x + piece.along.y * rise.y) + turn) / fall;
  if (!(fall > 0 && slope < 0.5)) return std::nullopt;
  piece.half_width = (off + slope * piece.half_length) * (1 + 0x1p-40);
  piece.bend = most * most / reach_l;
  return piece;
}

}  // namespace gvd::predicates
