#include "arguments.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>

namespace gvd::cli {

namespace {

struct Unit {
  std::string_view suffix;
  double factor;
};

/// A positive decimal number and one of the units.
double parse_quantity(const std::string& text, std::span<const Unit> units, const char* expected) {
  double number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view suffix(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
  if (error == std::errc{} && std::isfinite(number) && number > 0)
    for (const auto& unit : units)
      if (suffix == unit.suffix) return number * unit.factor;
  throw std::invalid_argument(fmt::format("'{}' is not {}", text, expected));
}

}  // namespace

std::uint64_t parse_bytes(const std::string& text) {
  constexpr double k = 1024;
  static constexpr std::array<Unit, 14> kUnits = {{{"", 1}, {"B", 1},
                                                   {"K", k}, {"KB", k}, {"KiB", k},
                                                   {"M", k * k}, {"MB", k * k}, {"MiB", k * k},
                                                   {"G", k * k * k}, {"GB", k * k * k}, {"GiB", k * k * k},
                                                   {"T", k * k * k * k}, {"TB", k * k * k * k}, {"TiB", k * k * k * k}}};
  constexpr const char* kExpected = "a size of memory like 512M or 4G";
  const double bytes = parse_quantity(text, kUnits, kExpected);
  if (!(bytes >= 1 && bytes < 0x1p63)) throw std::invalid_argument(fmt::format("'{}' is not {}", text, kExpected));
  return static_cast<std::uint64_t>(bytes);
}

double parse_seconds(const std::string& text) {
  static constexpr std::array<Unit, 5> kUnits = {{{"", 1}, {"s", 1}, {"ms", 1e-3}, {"m", 60}, {"h", 3600}}};
  return parse_quantity(text, kUnits, "a time like 30s, 10m or 1h");
}

}  // namespace gvd::cli
