#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>
#include <vector>

#include "gvd/predicates/wave_row.hpp"

namespace gvd::predicates {

/// The boundary rays of the waves of a facet side by side, and what each wave sees of the sides of the facet. Bounds: docs/error-bounds.md#stretches.
class ConeRow {
 public:
  /// A part of a side; empty if low > high.
  struct Stretch {
    double low = 0, high = 1;
    bool contains(double from, double to) const { return low <= from && to <= high; }
    bool misses(double from, double to) const { return to < low || high < from; }
  };
  struct Corner {
    DoublePoint at;
    double error;
  };

  /// Waves that see everything, as yet.
  ConeRow(std::size_t count, std::pmr::memory_resource* room);
  /// The cone is on the left of both lines. `sees_corner`: what is known beforehand.
  void set(std::size_t i, const std::array<DoubleLine, 2>& rays, const std::array<bool, 3>& sees_corner) noexcept;
  /// Finds what is seen of the sides between these corners.
  void look_at(const std::array<Corner, 3>& corners) noexcept;

  DoubleLine ray(std::size_t i, std::size_t end) const noexcept {
    const auto number = [&](std::size_t k) { return columns_[end * kRay + k][i]; };
    return {{number(0), number(1)}, {number(2), number(3)}, number(4), number(5)};
  }
  /// On which side of the ray corner c is.
  Bounded at_corner(std::size_t i, std::size_t end, std::size_t c) const noexcept {
    const std::size_t k = kAtCorner + 2 * (3 * end + c);
    return {columns_[k][i], columns_[k + 1][i]};
  }
  /// Where the wave may be seen on side k, certainly nowhere else.
  Stretch stretch(std::size_t i, std::size_t k) const noexcept { return {columns_[kStretch + 2 * k][i], columns_[kStretch + 2 * k + 1][i]}; }
  /// Where it certainly is.
  Stretch seen(std::size_t i, std::size_t k) const noexcept { return {columns_[kSeen + 2 * k][i], columns_[kSeen + 2 * k + 1][i]}; }
  /// Marks waves, beside those marked already, that certainly do not see the piece.
  void mark_blind(const BisectorPiece& piece, WaveRow::Marks& marks) const noexcept;

 private:
  static constexpr std::size_t kRay = 7;  ///< columns: from, along, their errors, and one for waves that see everything
  static constexpr std::size_t kLeast = 2 * kRay, kAtCorner = kLeast + 3, kStretch = kAtCorner + 12, kSeen = kStretch + 6, kColumns = kSeen + 6;
  Columns columns_;
};

}  // namespace gvd::predicates
