#include "file_bytes.hpp"

#include <fmt/format.h>

#include <fstream>

#include "gvd/kernel/error.hpp"

namespace gvd::io {

std::string read_bytes(const std::filesystem::path& file, std::string_view what) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(fmt::format("{}: no such file", file.string()));
  if (std::filesystem::is_directory(status)) throw InputError(fmt::format("{}: is a directory, not {}", file.string(), what));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(fmt::format("{}: cannot be opened", file.string()));
  std::string bytes;
  const auto size = std::filesystem::file_size(file, error);
  if (!error) bytes.reserve(static_cast<std::size_t>(size) + 1);
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  while (stream) {
    const std::size_t have = bytes.size();
    bytes.resize(have + kChunk);
    stream.read(bytes.data() + have, kChunk);
    bytes.resize(have + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw InputError(fmt::format("{}: cannot be read", file.string()));
  return bytes;
}

}  // namespace gvd::io
