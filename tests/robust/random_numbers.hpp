#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "gvd/robust/ball.hpp"
#include "gvd/robust/gmp.hpp"

namespace gvd::robust::test {

/// Doubles drawn at the level of their bits, so that every exponent, subnormals, zeros and long runs of equal bits occur.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : bits_(seed) {}

  std::uint64_t below(std::uint64_t n) { return bits_() % n; }
  bool chance(int percent) { return below(100) < static_cast<std::uint64_t>(percent); }

  /// A significand with structure: random, a few bits set, or all ones above some place.
  std::uint64_t significand() {
    const std::uint64_t all = (std::uint64_t{1} << 52) - 1;
    switch (below(4)) {
      case 0:
        return (std::uint64_t{1} << below(52)) | (std::uint64_t{1} << below(52));
      case 1:
        return all << below(53) & all;
      case 2:
        return all >> below(53);
      default:
        return bits_() & all;
    }
  }

  /// Any finite double.
  double any() {
    if (chance(4)) return chance(50) ? 0.0 : -0.0;
    const std::uint64_t exponent = chance(10) ? 0 : below(2047);
    return std::bit_cast<double>((bits_() << 63) | (exponent << 52) | significand());
  }

  /// Magnitude in [2^low, 2^high).
  double between(int low, int high) {
    const double one_to_two = std::bit_cast<double>((std::uint64_t{1023} << 52) | significand());
    const double magnitude = std::ldexp(one_to_two, low + static_cast<int>(below(static_cast<std::uint64_t>(high - low))));
    return chance(50) ? magnitude : -magnitude;
  }

  /// Mostly of moderate size, so that operations meet each other; sometimes anything.
  double mixed() { return chance(25) ? any() : between(-70, 70); }

  DoubleDouble double_double() {
    const double hi = mixed();
    if (chance(20)) return hi;
    const int gap = chance(50) ? 53 : 53 + static_cast<int>(below(120));
    return two_sum(hi, std::ldexp(between(-1, 0), std::ilogb(hi == 0 ? 1 : hi) - gap));
  }

  Mpfr mpfr() {
    const int bits = 53 + static_cast<int>(below(200));
    Mpfr value(mixed(), bits);
    Mpfr tail(between(-1, 0), bits);
    int ternary;
    value = Mpfr::add(value, tail.scaled(-static_cast<long>(below(300))), ternary);
    return chance(10) ? value.scaled(static_cast<long>(below(4000)) - 2000) : value;
  }

  template <class T>
  T number() {
    if constexpr (std::is_same_v<T, double>)
      return mixed();
    else if constexpr (std::is_same_v<T, DoubleDouble>)
      return double_double();
    else
      return mpfr();
  }

  /// A finite radius: none, tiny, comparable to the midpoint, or anything.
  double radius(double mid) {
    if (chance(25)) return 0;
    if (chance(10)) return std::fabs(any());
    const double scale = mid == 0 ? 1 : std::fabs(mid);
    return std::fmin(std::fabs(std::ldexp(scale, -static_cast<int>(below(120))) * between(-2, 2)),
                     std::numeric_limits<double>::max());
  }

  template <class T>
  Ball<T> ball() {
    T mid = number<T>();
    if (chance(5)) mid = T(0.0);
    const double near = Midpoint<T>::nearest(mid);
    const double rad = radius(std::isfinite(near) ? near : 1.0);
    return {std::move(mid), rad};
  }

 private:
  std::mt19937_64 bits_;
};

inline mpq_class to_mpq(double x) { return mpq_class(x); }
inline mpq_class to_mpq(const DoubleDouble& x) { return mpq_class(x.hi) + mpq_class(x.lo); }
inline mpq_class to_mpq(const Mpfr& x) { return x.to_mpq(); }

/// Whether the ball contains the rational; a ball that knows nothing contains everything.
template <class T>
bool contains(const Ball<T>& ball, const mpq_class& x) {
  return !ball.is_finite() || abs(x - to_mpq(ball.mid())) <= to_mpq(ball.rad());
}

}  // namespace gvd::robust::test
