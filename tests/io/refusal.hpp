#pragma once

#include <string>
#include <string_view>

#include "gvd/io/mesh_reader.hpp"
#include "gvd/kernel/error.hpp"

namespace gvd::test {

/// The sentence with which these bytes are refused as a file of this name, or "accepted".
inline std::string refusal(std::string_view bytes, const std::string& name) {
  try {
    io::parse_mesh(bytes, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// Replaces the first `from` by `to`; the text must contain it.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  return at == text.npos ? "TEXT NOT FOUND: " + std::string(from) : text.replace(at, from.size(), to);
}

inline std::string with_crlf(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

/// Appends the bytes of a scalar, most significant first if `big`.
template <class T>
void append(std::string& bytes, T value, bool big) {
  const char* raw = reinterpret_cast<const char*>(&value);  // tests run on little-endian machines
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes += raw[big ? sizeof(T) - 1 - i : i];
}

}  // namespace gvd::test
