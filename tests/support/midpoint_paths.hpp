#pragma once

#include "equal_paths.hpp"
#include "gvd/robust/rational.hpp"

/// Paths whose length lies exactly halfway between two doubles, by construction.
namespace gvd::test {

struct MidpointPath {
  LaidPath path;
  mpq_class length;
};

/// An odd whole number of 54 bits, a midpoint, that is the length of a vector with the legs x sqrt(w) and y.
struct LongVector {
  std::int64_t x, y, length;
};
/// w s^2 + t^2 = 2 length, w s^2 - t^2 = 2 y, s t = x, all times k. w is 1 modulo 4, so that odd s and t make an odd length, 1 modulo 4; k = 3 makes it 3.
/// y and x times `steepest` over `divisor` fit into 53 bits.
inline LongVector long_vector(std::int64_t w, std::int64_t steepest, std::int64_t divisor, Random& random) {
  constexpr std::int64_t kTop = std::int64_t{1} << 53;
  const std::int64_t k = random.below(2) == 0 ? 1 : 3;
  const double most = std::sqrt(4 * 0x1p53 / static_cast<double>(k));
  for (;;) {
    const auto odd = [&](double limit) { return static_cast<std::int64_t>(random.uniform(0.1, 1) * limit) | 1; };
    const std::int64_t s = odd(most / std::sqrt(static_cast<double>(w))), t = odd(most);
    const LongVector v{k * s * t, k * std::abs(w * s * s - t * t) / 2, k * (w * s * s + t * t) / 2};
    if (v.length > kTop && v.length < 2 * kTop && v.x < kTop / steepest * divisor && v.y < kTop && v.y > 9 && v.x % divisor == 0) return v;
  }
}

/// From (0, 0) over columns at 0 < x1 < x to (x, y), by corners on y = 0 and at the height y.
template <class Corner>
LaidOut steep_strip(const Corner& at, double y, bool fold) {
  LaidOut strip;
  strip.corner = {at(0, 0.0), at(1, 0.0), at(1, y)};
  strip.edge = {{1, 2}};
  if (fold) {
    strip.corner.push_back(at(2, 0.0));
    strip.edge.push_back({3, 2});
  }
  strip.corner.push_back(at(2, y));
  return strip;
}

inline Placement axes_and_scale(Random& random) {
  Placement place = Placement::random(random);
  place.offset = {0, 0, 0};
  return place;
}

/// Columns (dx, dz) n and then (dx, +-dz) m, n + m = x / divisor.
inline MidpointPath folded_vector(const LongVector& v, const Panel& slope, std::int64_t divisor, Random& random) {
  const Placement place = axes_and_scale(random);
  const std::int64_t all = v.x / divisor, first = 1 + static_cast<std::int64_t>(random.uniform() * static_cast<double>(all - 1));
  const double turn = random.below(2) == 0 ? 1 : -1;
  const auto at = [&](int column, double y) {
    const double n = column == 0 ? 0 : static_cast<double>(first), m = column == 2 ? static_cast<double>(all - first) : 0;
    return place(slope.dx * (n + m), y, slope.dz * (n + turn * m));
  };
  return {{0, {steep_strip(at, static_cast<double>(v.y), true)}}, mpq_class(static_cast<long>(v.length)) * robust::power_of_two(place.exponent)};
}

inline MidpointPath flat_midpoint(Random& random) { return folded_vector(long_vector(1, 1, 1, random), {1, 0}, 1, random); }
inline MidpointPath pythagorean_midpoint(Random& random) { return folded_vector(long_vector(1, 4, 5, random), {3, 4}, 5, random); }
/// Widths of the classes 5, 13 or 17.
inline MidpointPath coplanar_runs_midpoint(Random& random) {
  constexpr std::array<Panel, 3> kSlopes{{{1, 2}, {2, 3}, {1, 4}}};
  const Panel slope = kSlopes[random.below(3)];
  return folded_vector(long_vector(slope.dx * slope.dx + slope.dz * slope.dz, slope.dz, 1, random), slope, 1, random);
}

/// Angles that add up to an odd multiple of pi, in pairs of one square class each, in any order: the first spoke and the last are opposite.
inline MidpointPath turned_fan_midpoint(Random& random) {
  const auto all = orbit({1, 2, 2});
  const auto choice = dots_of(all);
  for (;;) {
    std::vector<int> dots;
    for (std::uint32_t i = 0, pairs = random.below(2) == 0 ? 1 : 3; i < pairs; ++i) {
      const int d = choice[random.below(static_cast<std::uint32_t>(choice.size()))];
      dots.insert(dots.end(), {d, -d});
    }
    for (std::size_t k = dots.size(); k > 1; --k) std::swap(dots[k - 1], dots[random.below(static_cast<std::uint32_t>(k))]);
    const auto spokes = spokes_with(all, dots, random);
    if (spokes.empty()) continue;
    const std::int64_t size = static_cast<std::int64_t>(random.uniform(0x1.56p51, 0x1.55p52)) | 1;  // three times it has 54 bits
    return {{0, {fan_strip(spokes, {0, 0, 0}, static_cast<double>(size))}}, mpq_class(6 * mpz_class(static_cast<long>(size)))};
  }
}

/// A whole length and what is missing to a midpoint, after a strip of one class.
inline MidpointPath given_midpoint(Random& random) {
  LaidPath path;
  path.legs = {along({{{5, 12}, {3, 4}}, {}}, axes_and_scale(random), 24, false, random)};  // 18 by 24
  const mpq_class whole = robust::exact_rational(std::ldexp(30, std::ilogb(static_cast<double>(path.length() / 30) * 1.5)));
  const double low = whole.get_d() * random.uniform(1, 3);
  const mpq_class midpoint = (mpq_class(low) + mpq_class(std::nextafter(low, HUGE_VAL))) / 2;
  path.given = midpoint - whole;
  return {path, midpoint};
}

struct MidpointFamily {
  const char* name;
  MidpointPath (*make)(Random&);
  bool one_class;  ///< all faces of a leg are of one square class
};
inline constexpr std::array<MidpointFamily, 5> kMidpointFamilies = {{{"integer_grid", flat_midpoint, true},
                                                                    {"pythagorean_folds", pythagorean_midpoint, true},
                                                                    {"coplanar_runs", coplanar_runs_midpoint, true},
                                                                    {"given_lengths", given_midpoint, true},
                                                                    {"turned_fans", turned_fan_midpoint, false}}};

}  // namespace gvd::test
