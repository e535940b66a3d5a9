#pragma once

#include "gvd/predicates/strip_path.hpp"
#include "strip_access.hpp"

namespace gvd::predicates {

inline bool is_in_range(const Path& path) {
  return std::all_of(path.legs.begin(), path.legs.end(), [](const Leg& leg) { return StripAccess(leg.strip).is_in_range(); });
}

/// |b - a| of the entry edge of the last face (its first side), or of side k of that face; caller's units.
template <class T>
robust::Ball<T> side_length(const StripAccess& at, std::size_t k, int bits) {
  const auto of = [&](const auto& frames) { return enclosed_length(frames[k], unit<T>(bits)).scaled(at.last().exponent()); };
  if constexpr (std::is_same_v<T, double>)
    return of(at.last().in_double());
  else if constexpr (std::is_same_v<T, robust::DoubleDouble>)
    return of(at.last().in_double_double());
  else
    return of(at.last().in_mpfr(bits));
}

template <class T>
robust::Ball<T> length_in(const Leg& leg, int bits) {
  const StripAccess at(leg.strip);
  const auto distance = with_numbers<T>(at, bits, [&](auto& numbers) {
    return sqrt(squared_norm(numbers.coordinates(at.image(numbers)) - numbers.coordinates(at.in_last_face(numbers, leg.end))));
  });
  return distance * side_length<T>(at, 0, bits);
}

template <class T>
robust::Ball<T> length_in(const Path& path, int bits) {
  auto sum = robust::from<robust::Ball<T>>(path.given, bits);
  for (const Leg& leg : path.legs) sum = sum + length_in<T>(leg, bits);
  return sum;
}

}  // namespace gvd::predicates
