#include "gvd/predicates/wave_row.hpp"

#include "lanes.hpp"

namespace gvd::predicates {

WaveRow::WaveRow(std::span<const DoubleWave> waves, std::pmr::memory_resource* room) : columns_(kColumns, rounded_to_lanes(waves.size()), room) {
  for (std::size_t i = 0; i < columns_.rows(); ++i) {
    const DoubleWave wave = i < waves.size() ? waves[i] : DoubleWave();
    columns_[0][i] = wave.image.x;
    columns_[1][i] = wave.image.y;
    columns_[2][i] = wave.weight;
    columns_[3][i] = wave.error * (1 + 0x1p-48) + 0x1p-320;
  }
}

GVD_ALSO_FOR_AVX void WaveRow::read(const DoublePoint& p, Reading& reading) const noexcept {
  const double *const x = columns_[0], *const y = columns_[1], *const weight = columns_[2], *const error = columns_[3];
  double *const at = reading.columns_[0], *const low = reading.columns_[1], *const high = reading.columns_[2], *const along_x = reading.columns_[3],
                *const along_y = reading.columns_[4];
  for (std::size_t i = 0; i < columns_.rows(); i += kLanes) {
    const Lanes dx = p.x - lanes(x + i), dy = p.y - lanes(y + i), square = dx * dx + dy * dy;
    const Lanes reach{std::sqrt(square[0]), std::sqrt(square[1]), std::sqrt(square[2]), std::sqrt(square[3])};
    const Lanes distance = lanes(weight + i) + reach, off = lanes(error + i) + kDoubleWaveError * distance, inverse = 1 / (reach + 0x1p-400);
    lanes(at + i) = distance;
    lanes(low + i) = distance - off;
    lanes(high + i) = distance + off;
    lanes(along_x + i) = dx * inverse;
    lanes(along_y + i) = dy * inverse;
  }
}

GVD_ALSO_FOR_AVX void WaveRow::mark_above(const Stretch& stretch, Marks& marks) const noexcept {
  const auto &first = stretch.first, &last = stretch.last;
  for (std::size_t i = 0; i < columns_.rows(); i += kLanes) {
    const Lanes rise_first = stretch.way.x * lanes(first.columns_[3] + i) + stretch.way.y * lanes(first.columns_[4] + i);
    const Lanes rise_last = stretch.way.x * lanes(last.columns_[3] + i) + stretch.way.y * lanes(last.columns_[4] + i);
    const Lanes low_first = lanes(first.columns_[1] + i), low_last = lanes(last.columns_[1] + i);
    const LaneMask by_first = (low_first > stretch.above_first) & (low_first + rise_first > stretch.above_last);
    const LaneMask by_last = (low_last > stretch.above_last) & (low_last - rise_last > stretch.above_first);
    lanes(marks.data() + i) = by_first | by_last;
  }
}

GVD_ALSO_FOR_AVX void WaveRow::mark_farther(const BisectorPiece& piece, const Reading& middle, std::size_t left, Marks& marks) const noexcept {
  const DoublePoint of_left = middle.gradient(left);
  const double high = middle.high(left), error = 32 * kUnit * (piece.half_length + piece.half_width) + piece.bend;
  for (std::size_t i = 0; i < columns_.rows(); i += kLanes) {
    const Lanes x = lanes(middle.columns_[3] + i) - of_left.x, y = lanes(middle.columns_[4] + i) - of_left.y;
    Lanes along = x * piece.along.x + y * piece.along.y, across = y * piece.along.x - x * piece.along.y;
    const Lanes range = (make_positive(along) * piece.half_length + make_positive(across) * piece.half_width + error) * (1 + 0x1p-40);
    lanes(marks.data() + i) = lanes(middle.columns_[1] + i) - high > range;
  }
}

}  // namespace gvd::predicates
