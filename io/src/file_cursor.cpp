#include "file_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "gvd/kernel/error.hpp"

namespace gvd::io {
namespace {

/// Whether a decimal number that no double can hold is too large (true) or too close to zero (false): the place of its first digit.
bool is_too_large(std::string_view number) {
  constexpr std::int64_t kFar = 1'000'000'000'000;
  std::int64_t exponent = 0;
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  if (e < number.size()) {
    std::string_view digits = number.substr(e + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (error == std::errc::result_out_of_range) exponent = digits.starts_with('-') ? -kFar : kFar;
  }
  const std::string_view mantissa = number.substr(0, e);
  const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  const auto first = static_cast<std::int64_t>(std::min(mantissa.find_first_of("123456789"), mantissa.size()));
  return point - first + std::clamp(exponent, -kFar, kFar) > 0;
}

}  // namespace

std::string quoted(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string out = "'";
  for (const char c : word.substr(0, kMost)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (word.size() > kMost ? "...'" : "'");
}

std::string lower_case(std::string_view word) {
  std::string out(word);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

bool FileCursor::at_space() const noexcept {
  const char c = bytes_[pos_];
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

std::string_view FileCursor::word_on_line() {
  while (pos_ < bytes_.size() && at_space()) ++pos_;
  if (pos_ < bytes_.size() && comment_ != '\0' && bytes_[pos_] == comment_) {
    pos_ = std::min(bytes_.find('\n', pos_), bytes_.size());
  }
  const std::size_t begin = pos_;
  while (pos_ < bytes_.size() && bytes_[pos_] != '\n' && !at_space() && !(comment_ != '\0' && bytes_[pos_] == comment_)) ++pos_;
  last_word_ = begin;
  return bytes_.substr(begin, pos_ - begin);
}

std::string_view FileCursor::word() {
  for (;;) {
    const std::string_view found = word_on_line();
    if (!found.empty() || pos_ == bytes_.size()) return found;
    ++pos_;
  }
}

std::string_view FileCursor::word(std::string_view what) {
  const std::string_view found = word();
  if (found.empty()) refuse(fmt::format("the file ends where {} is expected", what));
  return found;
}

std::string_view FileCursor::line() {
  last_word_ = pos_;
  const std::size_t begin = pos_, end = std::min(bytes_.find('\n', pos_), bytes_.size());
  pos_ = std::min(end + 1, bytes_.size());
  std::string_view text = bytes_.substr(begin, end - begin);
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

bool FileCursor::seek_word() {
  const bool found = !word().empty();
  pos_ = last_word_;
  return found;
}

double FileCursor::real(std::string_view text, std::string_view what) const {
  std::string_view number = text;
  if (number.starts_with('+') && !number.starts_with("+-")) number.remove_prefix(1);
  double value = 0;
  const char* const end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, value);
  if (error == std::errc::invalid_argument || stop != end) refuse(fmt::format("{} is not a number: {}", what, quoted(text)));
  if (error == std::errc::result_out_of_range) {
    if (is_too_large(number)) refuse(fmt::format("{} is too large for a double: {}", what, quoted(text)));
    return number.starts_with('-') ? -0.0 : 0.0;
  }
  if (!std::isfinite(value)) refuse(fmt::format("{} is not finite: {}", what, quoted(text)));
  return value;
}

std::int64_t FileCursor::integer(std::string_view text, std::string_view what, std::int64_t low, std::int64_t high) const {
  std::string_view number = text;
  if (number.starts_with('+') && !number.starts_with("+-")) number.remove_prefix(1);
  std::int64_t value = 0;
  const char* const end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, value);
  if (error == std::errc::invalid_argument || stop != end) refuse(fmt::format("{} is not an integer: {}", what, quoted(text)));
  if (error != std::errc{} || value < low || value > high) {
    refuse(fmt::format("{} {} is not in the range {} to {}", what, quoted(text), low, high));
  }
  return value;
}

std::uint32_t FileCursor::count(std::string_view text, std::string_view what, std::size_t least_bytes) const {
  const auto value = integer(text, what, 0, std::int64_t{kernel::kNone} - 1);
  expect_room(static_cast<std::uint64_t>(value), least_bytes, what);
  return static_cast<std::uint32_t>(value);
}

void FileCursor::expect_room(std::uint64_t count, std::size_t least_bytes, std::string_view what) const {
  // One byte more than remains: the last number of a text file needs nothing behind it.
  if (least_bytes == 0 || count <= (remaining() + 1) / least_bytes) return;
  refuse(fmt::format("{} is {}, but only {} bytes of the file are left", what, count, remaining()));
}

std::uint32_t FileCursor::vertex_index(std::string_view text, std::uint32_t vertices) const {
  const auto value =
      integer(text, "vertex index", std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
  if (value < 0 || value >= vertices) refuse(fmt::format("vertex {} does not exist (there are {} vertices)", value, vertices));
  return static_cast<std::uint32_t>(value);
}

std::string_view FileCursor::take(std::size_t size, std::string_view what) {
  if (size > remaining()) refuse_byte(fmt::format("the file ends inside {} ({} bytes needed, {} left)", what, size, remaining()));
  const std::string_view found = bytes_.substr(pos_, size);
  pos_ += size;
  return found;
}

void FileCursor::refuse(std::string_view what) const {
  const auto lines =
      std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(last_word_, bytes_.size())), '\n');
  throw InputError(fmt::format("{}, line {}: {}", name_, lines + 1, what));
}

void FileCursor::refuse_byte(std::string_view what) const { throw InputError(fmt::format("{}, byte {}: {}", name_, pos_, what)); }

}  // namespace gvd::io
