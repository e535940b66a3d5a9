#pragma once

#include <mpfr.h>

#include "gvd/robust/gmp.hpp"

namespace gvd::robust {

/// A binary floating-point number of its own precision (MPFR), rounded to nearest. The precision of a result is the larger of
/// those of the operands. The exponent range is MPFR's largest, so nothing underflows or overflows in practice; what does is
/// infinite or not a number and reported by the ternary value. No global state; distinct objects may be used by distinct threads.
class Mpfr {
 public:
  static constexpr int kLeastBits = 53;

  Mpfr() : Mpfr(0.0) {}
  /// Exactly x, with at least 53 bits.
  explicit Mpfr(double x, int bits = kLeastBits);
  /// q rounded to nearest; ternary (if asked for) is zero iff exact.
  Mpfr(const mpq_class& q, int bits, int* ternary = nullptr);
  Mpfr(const Mpfr& other);
  Mpfr(Mpfr&& other) noexcept;
  Mpfr& operator=(const Mpfr& other);
  Mpfr& operator=(Mpfr&& other) noexcept;
  ~Mpfr();

  int bits() const noexcept { return static_cast<int>(mpfr_get_prec(value_)); }
  /// The nearest double (ties to even), or the one in the direction asked for.
  double to_double(mpfr_rnd_t rounding = MPFR_RNDN) const noexcept { return mpfr_get_d(value_, rounding); }
  /// Exactly. Pre: finite.
  mpq_class to_mpq() const;
  /// -1, 0 or 1; 0 for not-a-number (ask is_finite).
  int sign() const noexcept { return mpfr_nan_p(value_) ? 0 : (mpfr_sgn)(value_); }
  bool is_finite() const noexcept { return mpfr_number_p(value_) != 0; }
  bool is_zero() const noexcept { return mpfr_zero_p(value_) != 0; }
  /// |this| > bound; false if either is not a number.
  bool magnitude_exceeds(double bound) const noexcept;
  /// A bound, never too small, of the rounding error made when this value was computed with that ternary value.
  double rounding_error(int ternary) const noexcept;

  const __mpfr_struct* get() const noexcept { return value_; }
  __mpfr_struct* get() noexcept { return value_; }

  /// Arithmetic that tells whether the result is exact: ternary is zero iff it is (or not a number).
  static Mpfr add(const Mpfr& a, const Mpfr& b, int& ternary);
  static Mpfr subtract(const Mpfr& a, const Mpfr& b, int& ternary);
  static Mpfr multiply(const Mpfr& a, const Mpfr& b, int& ternary);
  static Mpfr divide(const Mpfr& a, const Mpfr& b, int& ternary);
  static Mpfr square_root(const Mpfr& a, int& ternary);
  /// this * 2^k, exact.
  Mpfr scaled(long k) const;

 private:
  struct Uninitialised {};
  Mpfr(Uninitialised, int bits);

  mpfr_t value_;
};

Mpfr operator-(const Mpfr& a);
Mpfr operator+(const Mpfr& a, const Mpfr& b);
Mpfr operator-(const Mpfr& a, const Mpfr& b);
Mpfr operator*(const Mpfr& a, const Mpfr& b);
Mpfr operator/(const Mpfr& a, const Mpfr& b);
Mpfr sqrt(const Mpfr& a);
Mpfr abs(const Mpfr& a);

inline bool operator==(const Mpfr& a, const Mpfr& b) noexcept { return mpfr_equal_p(a.get(), b.get()) != 0; }
inline bool operator<(const Mpfr& a, const Mpfr& b) noexcept { return mpfr_less_p(a.get(), b.get()) != 0; }
inline bool operator>(const Mpfr& a, const Mpfr& b) noexcept { return b < a; }
inline bool operator<=(const Mpfr& a, const Mpfr& b) noexcept { return mpfr_lessequal_p(a.get(), b.get()) != 0; }
inline bool operator>=(const Mpfr& a, const Mpfr& b) noexcept { return b <= a; }

}  // namespace gvd::robust
