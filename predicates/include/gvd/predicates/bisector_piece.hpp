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
class BisectorPiece {
 public:
  /// Empty if doubles do not tell that one curve leads from one point to the other with `left` on its left. Pre: the two tie at a point within `radius`
  /// of `from`, and at one of `to`.
  static std::optional<BisectorPiece> between(const DoubleWave& left, const DoubleWave& right, const DoublePoint& from, const DoublePoint& to, double radius);

  /// Whether another wave is certainly farther than the two all along the piece.
  bool is_nearer_than(const DoubleWave& other) const noexcept;
  /// Whether all of the piece certainly lies on the right of the line.
  bool is_right_of(const DoubleLine& line) const noexcept;

 private:
  double range(const DoublePoint& gradient, double error) const noexcept;

  DoublePoint middle_{0, 0}, along_{0, 0};  ///< of the rectangle: its middle, and a unit vector
  double half_length_ = 0, half_width_ = 0;
  DoubleWave left_;
  DoublePoint gradient_{0, 0};               ///< of the distance of `left_`, in the middle
  double distance_ = 0, bend_ = 0;           ///< of `left_`: to the middle, and by how much it may exceed its tangent plane
};

inline std::optional<BisectorPiece> BisectorPiece::between(const DoubleWave& left, const DoubleWave& right, const DoublePoint& from, const DoublePoint& to,
                                                           double radius) {
  const auto one_norm = [](const DoublePoint& p) { return std::fabs(p.x) + std::fabs(p.y); };
  const DoublePoint chord{to.x - from.x, to.y - from.y};
  const double length = std::sqrt(chord.x * chord.x + chord.y * chord.y), off = radius + 4 * kUnit * (one_norm(from) + one_norm(to));
  BisectorPiece piece;
  piece.middle_ = {0.5 * (from.x + to.x), 0.5 * (from.y + to.y)};
  piece.along_ = {chord.x / length, chord.y / length};
  piece.half_length_ = (0.5 * length + off) * (1 + 0x1p-40);
  const double most = 1.25 * piece.half_length_;  // half of the diagonal

  const double reach_l = distance({left.image, 0, 0}, piece.middle_), reach_r = distance({right.image, 0, 0}, piece.middle_);
  if (!(4 * off < piece.half_length_ && 4 * most < std::fmin(reach_l, reach_r) && 8 * left.error < reach_l && 8 * right.error < reach_r)) return std::nullopt;
  const double turn = (2 * most + 4 * left.error) / reach_l + (2 * most + 4 * right.error) / reach_r + 32 * kUnit;
  piece.gradient_ = gradient(left, piece.middle_);
  const DoublePoint of_right = gradient(right, piece.middle_), rise{piece.gradient_.x - of_right.x, piece.gradient_.y - of_right.y};
  const double fall = -(piece.along_.x * rise.y - piece.along_.y * rise.x) - turn;  // of d_left - d_right, to the left
  const double slope = (std::fabs(piece.along_.x * rise.x + piece.along_.y * rise.y) + turn) / fall;
  if (!(fall > 0 && slope < 0.5)) return std::nullopt;
  piece.half_width_ = (off + slope * piece.half_length_) * (1 + 0x1p-40);
  piece.left_ = left;
  piece.distance_ = left.weight + reach_l;
  piece.bend_ = most * most / reach_l;
  return piece;
}

/// By how much a function of this gradient, known up to `error`, may differ from its value in the middle.
inline double BisectorPiece::range(const DoublePoint& gradient, double error) const noexcept {
  const double along = std::fabs(gradient.x * along_.x + gradient.y * along_.y), across = std::fabs(gradient.y * along_.x - gradient.x * along_.y);
  return ((along + error) * half_length_ + (across + error) * half_width_) * (1 + 0x1p-40);
}

inline bool BisectorPiece::is_nearer_than(const DoubleWave& other) const noexcept {
  const Bounded lead = difference(left_, distance_, other, distance(other, middle_));
  const DoublePoint to = gradient(other, middle_);
  return lead.value - lead.error > range({to.x - gradient_.x, to.y - gradient_.y}, 32 * kUnit) + bend_;
}

inline bool BisectorPiece::is_right_of(const DoubleLine& line) const noexcept {
  const Bounded side = side_of(line, middle_, 0);
  const double error = line.along_error + 8 * kUnit * (std::fabs(line.along.x) + std::fabs(line.along.y));
  return side.value + range({-line.along.y, line.along.x}, error) < -side.error;
}

}  // namespace gvd::predicates
