#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "gvd/predicates/bisector_piece.hpp"
#include "gvd/predicates/columns.hpp"

namespace gvd::predicates {

/// The waves of a facet side by side, so that one instruction does the same for several of them. What is found at a point serves for every pair that is
/// compared there. Bounds: docs/error-bounds.md#rows-of-waves.
class WaveRow {
 public:
  /// All waves at one point: what is certain of their distances, and their gradients, rounded.
  class Reading {
   public:
    Reading(const WaveRow& row, std::pmr::memory_resource* room) : columns_(kColumns, row.columns_.rows(), room) {}

    /// As predicates::distance.
    double at(std::size_t i) const noexcept { return columns_[0][i]; }
    /// Bounds of the true wave's distance from the very point.
    double low(std::size_t i) const noexcept { return columns_[1][i]; }
    double high(std::size_t i) const noexcept { return columns_[2][i]; }
    DoublePoint gradient(std::size_t i) const noexcept { return {columns_[3][i], columns_[4][i]}; }

   private:
    friend class WaveRow;
    static constexpr std::size_t kColumns = 5;
    Columns columns_;
  };

  /// A flag a wave.
  class Marks {
   public:
    Marks(const WaveRow& row, std::pmr::memory_resource* room) : marks_(row.columns_.rows(), room) {}
    bool operator[](std::size_t i) const noexcept { return marks_[i] != 0; }
    std::int64_t* data() noexcept { return marks_.data(); }

   private:
    std::pmr::vector<std::int64_t> marks_;
  };

  /// A straight stretch: readings at its ends, the way between them, and what the wave compared with is certainly below there.
  struct Stretch {
    const Reading &first, &last;
    DoublePoint way;
    double above_first, above_last;
  };

  WaveRow(std::span<const DoubleWave> waves, std::pmr::memory_resource* room);
  void read(const DoublePoint& p, Reading& reading) const noexcept;
  /// Marks waves that are certainly above the chord of the stretch, by one of their tangents at its ends.
  void mark_above(const Stretch& stretch, Marks& marks) const noexcept;
  /// Marks waves that are certainly farther than wave `left`, of whose bisector it is a piece, all along the piece. Pre: `middle` is read there.
  void mark_farther(const BisectorPiece& piece, const Reading& middle, std::size_t left, Marks& marks) const noexcept;

 private:
  static constexpr std::size_t kColumns = 4;
  Columns columns_;
};

/// Rounding of a gradient times a way, over the length of the way.
inline constexpr double kRiseError = 16 * kUnit;

}  // namespace gvd::predicates
