#include "binary_scalar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gvd::io {
namespace {

/// Calls `use` with the next scalar in its own type.
template <class Use>
auto with_scalar(FileCursor& cursor, ScalarType type, std::endian order, std::string_view what, Use use) {
  switch (type) {
    case ScalarType::int8: return use(cursor.scalar<std::int8_t>(order, what));
    case ScalarType::uint8: return use(cursor.scalar<std::uint8_t>(order, what));
    case ScalarType::int16: return use(cursor.scalar<std::int16_t>(order, what));
    case ScalarType::uint16: return use(cursor.scalar<std::uint16_t>(order, what));
    case ScalarType::int32: return use(cursor.scalar<std::int32_t>(order, what));
    case ScalarType::uint32: return use(cursor.scalar<std::uint32_t>(order, what));
    case ScalarType::int64: return use(cursor.scalar<std::int64_t>(order, what));
    case ScalarType::uint64: return use(cursor.scalar<std::uint64_t>(order, what));
    case ScalarType::float32: return use(cursor.scalar<float>(order, what));
    default: return use(cursor.scalar<double>(order, what));
  }
}

}  // namespace

double read_coordinate(FileCursor& cursor, ScalarType type, std::endian order) {
  const double value = with_scalar(cursor, type, order, "the vertices", [](auto scalar) { return static_cast<double>(scalar); });
  if (!std::isfinite(value)) cursor.refuse_byte("the coordinate before this byte is not finite");
  return value;
}

std::int64_t read_integer(FileCursor& cursor, ScalarType type, std::endian order, std::string_view what) {
  if (!is_integer(type)) cursor.refuse_byte("an integer is expected where a floating-point type is declared");
  return with_scalar(cursor, type, order, what, [](auto scalar) -> std::int64_t {
    if constexpr (std::is_same_v<decltype(scalar), std::uint64_t>) {
      return static_cast<std::int64_t>(std::min<std::uint64_t>(scalar, std::numeric_limits<std::int64_t>::max()));
    } else {
      return static_cast<std::int64_t>(scalar);
    }
  });
}

}  // namespace gvd::io
