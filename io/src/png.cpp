#include "png.hpp"

#include <zlib.h>

#include <cstring>
#include <string_view>

#include "gvd/kernel/error.hpp"

namespace gvd::io {

namespace {

void append_uint32(std::vector<std::byte>& out, std::uint32_t x) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(x >> shift & 255));
}

void append_bytes(std::vector<std::byte>& out, std::string_view bytes) {
  for (const char c : bytes) out.push_back(static_cast<std::byte>(c));
}

/// Length, type, data, and the check sum over type and data.
void append_chunk(std::vector<std::byte>& out, std::string_view type, std::span<const std::byte> data) {
  append_uint32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = out.size();
  append_bytes(out, type);
  out.insert(out.end(), data.begin(), data.end());
  append_uint32(out, static_cast<std::uint32_t>(
                         crc32(0, reinterpret_cast<const Bytef*>(out.data() + start), static_cast<uInt>(out.size() - start))));
}

/// Rows with the filter "up": each byte minus the one above it, which suits smooth pictures.
std::vector<std::uint8_t> filtered_rows(std::span<const std::uint8_t> pixels, std::size_t row, std::size_t rows) {
  constexpr std::uint8_t kUp = 2;
  std::vector<std::uint8_t> out;
  out.reserve((row + 1) * rows);
  for (std::size_t y = 0; y < rows; ++y) {
    out.push_back(kUp);
    for (std::size_t x = 0; x < row; ++x) {
      const std::uint8_t above = y == 0 ? std::uint8_t{0} : pixels[(y - 1) * row + x];
      out.push_back(static_cast<std::uint8_t>(pixels[y * row + x] - above));
    }
  }
  return out;
}

std::vector<std::byte> deflated(const std::vector<std::uint8_t>& raw) {
  uLongf size = compressBound(static_cast<uLong>(raw.size()));
  std::vector<std::byte> out(size);
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, raw.data(), static_cast<uLong>(raw.size()), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw InternalError("the hill shade could not be compressed");
  out.resize(size);
  return out;
}

}  // namespace

std::vector<std::byte> encode_png(std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height) {
  std::vector<std::byte> png, header;
  append_bytes(png, std::string_view("\x89PNG\r\n\x1a\n", 8));
  append_uint32(header, width);
  append_uint32(header, height);
  append_bytes(header, std::string_view("\x08\x04\x00\x00\x00", 5));  // 8 bits, grey and alpha, deflate, adaptive filters, not interlaced
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", deflated(filtered_rows(pixels, std::size_t{2} * width, height)));
  append_chunk(png, "IEND", {});
  return png;
}

}  // namespace gvd::io
