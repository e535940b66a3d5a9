#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gvd::io {

/// A PNG file of 8-bit grey and alpha. Pre: pixels.size() == 2 * width * height, rows from the top.
std::vector<std::byte> encode_png(std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height);

}  // namespace gvd::io
