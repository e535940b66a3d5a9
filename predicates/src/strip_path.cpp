#include "gvd/predicates/strip_path.hpp"

#include "gvd/predicates/compare_legs.hpp"
#include "gvd/robust/rounding.hpp"
#include "path_numbers.hpp"

namespace gvd::predicates {

using robust::Ball;
using robust::DoubleDouble;
using robust::Exact;
using robust::MaybeSign;
using robust::Mpfr;
using robust::RootSum;
using robust::Sign;
using robust::SquareClasses;
using robust::Stage;

namespace {

/// What is left of both when equal legs are taken away.
std::pair<Path, Path> without_common_legs(const Path& a, const Path& b) {
  std::pair<Path, Path> rest{{a.given - b.given, {}}, {0, b.legs}};
  for (const Leg& leg : a.legs) {
    const auto twin = std::find(rest.second.legs.begin(), rest.second.legs.end(), leg);
    if (twin == rest.second.legs.end())
      rest.first.legs.push_back(leg);
    else
      rest.second.legs.erase(twin);
  }
  return rest;
}

/// In the square of the caller's units; empty if that is too long a sum.
std::optional<RootSum> exact_squared_length(const Leg& leg) {
  const StripAccess at(leg.strip);
  const auto from_end = [&](auto& numbers) { return numbers.coordinates(at.image(numbers)) - numbers.coordinates(at.in_last_face(numbers, leg.end)); };
  const auto d = with_roots(at, from_end);
  if (!d) return std::nullopt;
  return squared_norm(*d) * (at.last().exact().squared[0] * robust::power_of_two(2 * at.last().exponent()));
}

/// A leg of a comparison.
struct ExactLeg {
  const Leg* leg;
  std::optional<RootSum> squared;  ///< length; empty if that is too long a sum
};
std::vector<ExactLeg> exact_legs(const Path& path) {
  std::vector<ExactLeg> legs;
  for (const Leg& leg : path.legs) legs.push_back({&leg, exact_squared_length(leg)});
  return legs;
}

/// Pre: the leg crosses an edge.
robust::RootProgram squared_length_program(const Leg& leg, SquareClasses& classes) {
  const StripAccess at(leg.strip);
  const std::array<mpq_class, 3> b = at.placed(leg.end);
  return program_of(at, classes).squared_distance(at.last().for_program(classes), 0, b[1], b[2]);
}

/// By sums of roots where both have one, otherwise by the span test. A leg within one face always has one.
bool are_equal(const ExactLeg& a, const ExactLeg& b) {
  if (a.squared && b.squared) return (*a.squared - *b.squared).is_zero();
  if (a.leg->strip.crossings() == 0 || b.leg->strip.crossings() == 0) return false;
  SquareClasses classes;
  const auto first = squared_length_program(*a.leg, classes);
  return robust::are_proved_equal(first, squared_length_program(*b.leg, classes));
}

}  // namespace

Leg::Leg(FaceStrip s, const FacePoint& e) : strip(std::move(s)), end{normalised(e)} {}

bool operator==(const Leg& a, const Leg& b) { return a.strip == b.strip && a.end.weight == b.end.weight; }

std::optional<Exact> exact_length(const Path& path) {
  Exact sum(path.given);
  for (const Leg& leg : path.legs) {
    auto squared = exact_squared_length(leg);
    if (!squared) return std::nullopt;
    sum += sqrt(Exact(std::move(*squared)));
  }
  return sum;
}

MaybeSign compare_lengths_at(const Rung& rung, const Path& a, const Path& b) {
  const auto [first, second] = without_common_legs(a, b);
  if (rung.stage == Stage::identity)
    return first.legs.empty() && second.legs.empty() ? MaybeSign(static_cast<Sign>(sgn(first.given))) : std::nullopt;
  if (rung.stage == Stage::algebra) return compare_legs(first.given, exact_legs(first), exact_legs(second), are_equal);
  const int exponent = largest_exponent(first, second);
  return numeric_stage<Sign>(rung, is_in_range(first) && is_in_range(second), [&, &x = first, &y = second]<class T>(int bits) -> MaybeSign {
    return maybe_sign(length_in<T>(x, bits, exponent) - length_in<T>(y, bits, exponent));
  });
}

Decision compare_lengths(const Path& a, const Path& b) {
  if (const MaybeSign sign = compare_lengths_at({Stage::identity}, a, b)) return {sign, Stage::identity};
  return decide([&](const Rung& rung) { return compare_lengths_at(rung, a, b); });
}

Enclosure length(const Path& path) {
  if (is_in_range(path)) {
    const auto ball = length_in<DoubleDouble>(path, 0);
    if (ball.is_finite()) return {ball.lower(), ball.upper()};
  }
  const auto ball = length_in<Mpfr>(path, 256);
  return {ball.lower(), ball.upper()};
}

RoundedLength rounded_length(const Path& path) {
  for (const Rung& rung : kRungs) {
    if (rung.stage == Stage::algebra) {
      const auto sum = exact_length(path);
      if (const auto value = sum ? robust::rounded(*sum) : std::nullopt) return {value, Stage::algebra};
      continue;
    }
    const auto value = numeric_stage<double>(
        rung, is_in_range(path), [&]<class T>(int bits) -> std::optional<double> { return robust::rounded(length_in<T>(path, bits)); });
    if (value) return {value, rung.stage};
  }
  return {};
}

}  // namespace gvd::predicates
