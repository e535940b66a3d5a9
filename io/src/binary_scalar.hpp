#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string_view>

#include "file_cursor.hpp"

namespace gvd::io {

enum class ScalarType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

constexpr std::size_t size_of(ScalarType type) noexcept {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}
constexpr bool is_integer(ScalarType type) noexcept { return type < ScalarType::float32; }

/// The next scalar as a coordinate: to the nearest double (only 64-bit integers can be rounded); refuses infinity and NaN.
double read_coordinate(FileCursor& cursor, ScalarType type, std::endian order);

/// The next scalar, of an integer type, as an integer. Unsigned 64-bit values above 2^63 - 1 become the latter: never a valid
/// count or index.
std::int64_t read_integer(FileCursor& cursor, ScalarType type, std::endian order, std::string_view what);

}  // namespace gvd::io
