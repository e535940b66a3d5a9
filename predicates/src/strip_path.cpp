#include "gvd/predicates/strip_path.hpp"

#include "gvd/robust/rounding.hpp"
#include "path_numbers.hpp"

namespace gvd::predicates {

using robust::Ball;
using robust::DoubleDouble;
using robust::MaybeSign;
using robust::Mpfr;
using robust::RootSum;
using robust::Sign;
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

/// In the square of the caller's units; empty if the faces are of several square classes.
std::optional<mpq_class> exact_squared_length(const Leg& leg) {
  const StripAccess at(leg.strip);
  const auto frames = at.rational();
  if (!frames) return std::nullopt;
  return with_rationals(*frames, [&](auto& numbers, const mpq_class& radicand) -> mpq_class {
    const auto d = numbers.coordinates(at.image(numbers)) - numbers.coordinates(at.in_last_face(numbers, leg.end));
    return (d.x * d.x + d.y * d.y * radicand) * at.last().exact().squared[0] * robust::power_of_two(2 * at.last().exponent());
  });
}

}  // namespace

Leg::Leg(FaceStrip s, const FacePoint& e) : strip(std::move(s)), end{normalised(e)} {}

bool operator==(const Leg& a, const Leg& b) { return a.strip == b.strip && a.end.weight == b.end.weight; }

std::optional<RootSum> exact_length(const Path& path) {
  RootSum sum(path.given);
  for (const Leg& leg : path.legs) {
    const auto squared = exact_squared_length(leg);
    if (!squared) return std::nullopt;
    sum.add(1, *squared);
  }
  return sum;
}

MaybeSign compare_lengths_at(const Rung& rung, const Path& a, const Path& b) {
  const auto [first, second] = without_common_legs(a, b);
  if (rung.stage == Stage::identity)
    return first.legs.empty() && second.legs.empty() ? sign_of(first.given) : std::nullopt;
  if (rung.stage == Stage::algebra) {
    const auto x = exact_length(first), y = exact_length(second);
    if (!x || !y) return std::nullopt;
    return compare(*x, *y);
  }
  return numeric_stage<Sign>(rung, is_in_range(first) && is_in_range(second), [&, &x = first, &y = second]<class T>(int bits) -> MaybeSign {
    return maybe_sign(length_in<T>(x, bits) - length_in<T>(y, bits));
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
      if (const auto sum = exact_length(path)) return {sum->rounded(), Stage::algebra};
      continue;
    }
    const auto value = numeric_stage<double>(
        rung, is_in_range(path), [&]<class T>(int bits) -> std::optional<double> { return robust::rounded(length_in<T>(path, bits)); });
    if (value) return {value, rung.stage};
  }
  return {};
}

}  // namespace gvd::predicates
