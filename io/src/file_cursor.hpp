#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "gvd/kernel/mesh.hpp"

namespace gvd::io {

/// A position in the bytes of one file, with what all readers need: words, lines, numbers, binary scalars, and refusals that say
/// where. White space is ' ', '\t', '\r', '\v', '\f'; lines end with '\n'. From `comment` to the end of a line is white space too
/// (0: no comments).
class FileCursor {
 public:
  FileCursor(std::string_view bytes, std::string name, char comment = '\0')
      : bytes_(bytes), name_(std::move(name)), comment_(comment) {}

  std::size_t position() const noexcept { return pos_; }
  std::size_t remaining() const noexcept { return bytes_.size() - pos_; }

  /// The next word of this line; empty at its end (the end of the line is not passed).
  std::string_view word_on_line();
  /// The next word on this or a later line; empty at the end of the file.
  std::string_view word();
  /// The same; refuses at the end of the file. `what` says what was expected there.
  std::string_view word(std::string_view what);
  /// The rest of this line without its end; passes the end. Comments are not cut off.
  std::string_view line();
  /// Goes to a position that `position` gave.
  void seek(std::size_t position) noexcept { pos_ = position; }
  /// Passes to the first word on this or a later line. False if there is none.
  bool seek_word();

  /// The number that `word` spells, to the nearest double. Refuses what is not a finite number in full.
  double real(std::string_view word, std::string_view what) const;
  /// An integer in [low, high]; refuses all else.
  std::int64_t integer(std::string_view word, std::string_view what, std::int64_t low, std::int64_t high) const;
  /// How many of something a file declares: 0 .. 2^32 - 2, and not more than the rest of the file can hold if each one takes
  /// `least_bytes`.
  std::uint32_t count(std::string_view word, std::string_view what, std::size_t least_bytes) const;
  /// Refuses if `count` items of `least_bytes` bytes each cannot be in the rest of the file.
  void expect_room(std::uint64_t count, std::size_t least_bytes, std::string_view what) const;
  /// The index of one of `vertices` vertices.
  std::uint32_t vertex_index(std::string_view word, std::uint32_t vertices) const;

  /// The next `size` bytes; refuses if there are fewer.
  std::string_view take(std::size_t size, std::string_view what);
  /// The next scalar of a binary file.
  template <class T>
  T scalar(std::endian order, std::string_view what);

  /// Throws InputError "NAME, line N: what", the line being that of the last word read.
  [[noreturn]] void refuse(std::string_view what) const;
  /// Throws InputError "NAME, byte N: what" (from 0).
  [[noreturn]] void refuse_byte(std::string_view what) const;

 private:
  bool at_space() const noexcept;

  std::string_view bytes_;
  std::string name_;
  char comment_;
  std::size_t pos_ = 0;
  std::size_t last_word_ = 0;
};

/// A word of the file for a message: in quotes, bounded, printable.
std::string quoted(std::string_view word);
std::string lower_case(std::string_view word);

template <class T>
T FileCursor::scalar(std::endian order, std::string_view what) {
  char raw[sizeof(T)];
  const std::string_view from = take(sizeof(T), what);
  for (std::size_t i = 0; i < sizeof(T); ++i) raw[i] = order == std::endian::native ? from[i] : from[sizeof(T) - 1 - i];
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

}  // namespace gvd::io
