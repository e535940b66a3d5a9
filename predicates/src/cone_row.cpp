#include "gvd/predicates/cone_row.hpp"

#include <algorithm>
#include <limits>

#include "lanes.hpp"

namespace gvd::predicates {

ConeRow::ConeRow(std::size_t count, std::pmr::memory_resource* room) : columns_(kColumns, rounded_to_lanes(count), room) {
  std::fill_n(columns_[0], kAtCorner * columns_.rows(), 0.0);
  for (const std::size_t everything : {kRay - 1, 2 * kRay - 1}) std::fill_n(columns_[everything], columns_.rows(), 1.0);
}

void ConeRow::set(std::size_t i, const std::array<DoubleLine, 2>& rays, const std::array<bool, 3>& sees_corner) noexcept {
  for (std::size_t end = 0; end < 2; ++end) {
    const DoubleLine& ray = rays[end];
    const double numbers[kRay] = {ray.from.x, ray.from.y, ray.along.x, ray.along.y, ray.from_error, ray.along_error, 0};
    for (std::size_t k = 0; k < kRay; ++k) columns_[end * kRay + k][i] = numbers[k];
  }
  for (std::size_t c = 0; c < 3; ++c) columns_[kLeast + c][i] = sees_corner[c] ? 0 : -std::numeric_limits<double>::infinity();
}

/// The side of a boundary ray is linear along a side of the facet, so its bounds at the corners bound it in between.
GVD_ALSO_FOR_AVX void ConeRow::look_at(const std::array<Corner, 3>& corners) noexcept {
  const std::size_t rows = columns_.rows();
  for (std::size_t i = 0; i < rows; i += kLanes) {
    Lanes low[3], high[3], seen_low[3], seen_high[3];
    for (std::size_t k = 0; k < 3; ++k) low[k] = seen_low[k] = Lanes{0, 0, 0, 0}, high[k] = seen_high[k] = Lanes{1, 1, 1, 1};
    for (std::size_t end = 0; end < 2; ++end) {
      const double* const ray = columns_[end * kRay] + i;
      const Lanes from_x = lanes(ray), from_y = lanes(ray + rows), x = lanes(ray + 2 * rows), y = lanes(ray + 3 * rows);
      const Lanes from_error = lanes(ray + 4 * rows), error = lanes(ray + 5 * rows), everything = lanes(ray + 6 * rows);
      Lanes size_x = x, size_y = y;
      const Lanes size = make_positive(size_x) + make_positive(size_y);
      Lanes most[3], least[3];
      for (std::size_t c = 0; c < 3; ++c) {  // bounded_cross
        const Lanes px = corners[c].at.x - from_x, py = corners[c].at.y - from_y, apart = (from_error + corners[c].error) * (1 + 0x1p-48);
        Lanes far_x = px, far_y = py;
        const Lanes far = make_positive(far_x) + make_positive(far_y);
        const Lanes value = x * py - y * px + everything;
        const Lanes off = (kOrientationError * size * far + size * apart + far * error + error * apart) * (1 + 0x1p-48) + 0x1p-500;
        double* const at = columns_[kAtCorner + 2 * (3 * end + c)] + i;
        lanes(at) = value;
        lanes(at + rows) = off;
        Lanes magnitude = value;
        const Lanes wide = off + 0x1p-50 * (make_positive(magnitude) + off), floor = lanes(columns_[kLeast + c] + i), bottom = value - wide;
        most[c] = value + wide;
        least[c] = bottom > floor ? bottom : floor;
      }
      for (std::size_t k = 0; k < 3; ++k) {  // below_zero_of and above_zero_of where exactly one end is negative
        const Lanes begin = most[k], last = most[(k + 1) % 3], zero = begin / (begin - last);
        const Lanes from = begin < 0.0 ? (last < 0.0 ? Lanes{2, 2, 2, 2} : zero * (1 - 0x1p-48) - 0x1p-1070) : Lanes{0, 0, 0, 0};
        const Lanes to = last < 0.0 ? (begin < 0.0 ? Lanes{-1, -1, -1, -1} : zero * (1 + 0x1p-48) + 0x1p-1070) : Lanes{1, 1, 1, 1};
        low[k] = low[k] > from ? low[k] : from;
        high[k] = high[k] < to ? high[k] : to;
        const Lanes seen_begin = least[k], seen_last = least[(k + 1) % 3], root = seen_begin / (seen_begin - seen_last);
        const Lanes seen_from = seen_begin < 0.0 ? (seen_last < 0.0 ? Lanes{2, 2, 2, 2} : root * (1 + 0x1p-48) + 0x1p-1070) : Lanes{0, 0, 0, 0};
        const Lanes seen_to = seen_last < 0.0 ? (seen_begin < 0.0 ? Lanes{-1, -1, -1, -1} : root * (1 - 0x1p-48) - 0x1p-1070) : Lanes{1, 1, 1, 1};
        seen_low[k] = seen_low[k] > seen_from ? seen_low[k] : seen_from;
        seen_high[k] = seen_high[k] < seen_to ? seen_high[k] : seen_to;
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      lanes(columns_[kStretch + 2 * k] + i) = low[k];
      lanes(columns_[kStretch + 2 * k + 1] + i) = high[k];
      lanes(columns_[kSeen + 2 * k] + i) = seen_low[k];
      lanes(columns_[kSeen + 2 * k + 1] + i) = seen_high[k];
    }
  }
}

/// The side of a ray is linear, so its least value in the rectangle is that in the middle less what it changes from there to the corners.
GVD_ALSO_FOR_AVX void ConeRow::mark_blind(const BisectorPiece& piece, WaveRow::Marks& marks) const noexcept {
  const std::size_t rows = columns_.rows();
  for (std::size_t i = 0; i < rows; i += kLanes) {
    LaneMask blind = lanes(marks.data() + i);
    if ((blind[0] & blind[1] & blind[2] & blind[3]) != 0) continue;
    for (std::size_t end = 0; end < 2; ++end) {
      const double* const ray = columns_[end * kRay] + i;
      const Lanes x = lanes(ray + 2 * rows), y = lanes(ray + 3 * rows), error = lanes(ray + 5 * rows), everything = lanes(ray + 6 * rows);
      const Lanes px = piece.middle.x - lanes(ray), py = piece.middle.y - lanes(ray + rows), apart = lanes(ray + 4 * rows) * (1 + 0x1p-48);
      Lanes size_x = x, size_y = y, far_x = px, far_y = py, along = x * piece.along.y - y * piece.along.x, across = x * piece.along.x + y * piece.along.y;
      const Lanes size = make_positive(size_x) + make_positive(size_y), far = make_positive(far_x) + make_positive(far_y);
      const Lanes value = x * py - y * px + everything;
      const Lanes off = (kOrientationError * size * far + size * apart + far * error + error * apart) * (1 + 0x1p-48) + 0x1p-500;
      const Lanes of_gradient = error + 8 * kUnit * size;
      const Lanes range = ((make_positive(along) + of_gradient) * piece.half_length + (make_positive(across) + of_gradient) * piece.half_width) * (1 + 0x1p-40);
      blind |= value + range < -off;
    }
    lanes(marks.data() + i) = blind;
  }
}

}  // namespace gvd::predicates
