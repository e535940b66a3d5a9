#pragma once

#include <optional>

#include "gvd/predicates/strip_path.hpp"
#include "gvd/robust/rational.hpp"
#include "strip_access.hpp"

namespace gvd::predicates {

inline bool is_in_range(const Path& path) {
  return std::all_of(path.legs.begin(), path.legs.end(), [](const Leg& leg) { return StripAccess(leg.strip).is_in_range(); });
}

/// |b - a| of the entry edge of the last face (its first side), or of side k of that face; in units of 2^exponent of the caller's.
template <class T>
robust::Ball<T> side_length(const StripAccess& at, std::size_t k, int bits, int exponent = 0) {
  const auto of = [&](const auto& frames) { return enclosed_length(frames[k], unit<T>(bits)).scaled(at.last().exponent() - exponent); };
  if constexpr (std::is_same_v<T, double>)
    return of(at.last().in_double());
  else if constexpr (std::is_same_v<T, robust::DoubleDouble>)
    return of(at.last().in_double_double());
  else
    return of(at.last().in_mpfr(bits));
}

template <class T>
robust::Ball<T> length_in(const Leg& leg, int bits, int exponent = 0) {
  const StripAccess at(leg.strip);
  const auto distance = with_numbers<T>(at, bits, [&](auto& numbers) {
    return sqrt(squared_norm(numbers.coordinates(at.image(numbers)) - numbers.coordinates(at.in_last_face(numbers, leg.end))));
  });
  return distance * side_length<T>(at, 0, bits, exponent);
}

template <class T>
robust::Ball<T> length_in(const Path& path, int bits, int exponent = 0) {
  auto sum = robust::from<robust::Ball<T>>(exponent == 0 ? path.given : mpq_class(path.given * robust::power_of_two(-exponent)), bits);
  for (const Leg& leg : path.legs) sum = sum + length_in<T>(leg, bits, exponent);
  return sum;
}

/// That of the largest face and of what is given, in both paths: in its units no length is so small that the radius of a ball, a double, would underflow
/// before it matters.
inline int largest_exponent(const Path& a, const Path& b) {
  std::optional<int> largest;
  const auto consider = [&](int exponent) { largest = std::max(exponent, largest.value_or(exponent)); };
  for (const Path* path : {&a, &b}) {
    const mpq_class& given = path->given;
    if (sgn(given) != 0)
      consider(static_cast<int>(mpz_sizeinbase(given.get_num_mpz_t(), 2)) - static_cast<int>(mpz_sizeinbase(given.get_den_mpz_t(), 2)));
    for (const Leg& leg : path->legs) consider(StripAccess(leg.strip).last().exponent());
  }
  return largest.value_or(0);
}

}  // namespace gvd::predicates
