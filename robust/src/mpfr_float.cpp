#include "gvd/robust/mpfr_float.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gvd::robust {

Mpfr::Mpfr(Uninitialised, int bits) { mpfr_init2(value_, bits); }

Mpfr::Mpfr(double x, int bits) : Mpfr(Uninitialised{}, std::max(bits, kLeastBits)) { mpfr_set_d(value_, x, MPFR_RNDN); }

Mpfr::Mpfr(const mpq_class& q, int bits, int* ternary) : Mpfr(Uninitialised{}, std::max(bits, kLeastBits)) {
  const int inexact = mpfr_set_q(value_, q.get_mpq_t(), MPFR_RNDN);
  if (ternary) *ternary = inexact;
}

Mpfr::Mpfr(const Mpfr& other) : Mpfr(Uninitialised{}, other.bits()) { mpfr_set(value_, other.value_, MPFR_RNDN); }

// A moved-from number has no limbs; it may only be destroyed or assigned to.
Mpfr::Mpfr(Mpfr&& other) noexcept {
  value_[0] = other.value_[0];
  other.value_[0]._mpfr_d = nullptr;
}

Mpfr& Mpfr::operator=(const Mpfr& other) {
  if (this != &other) {
    Mpfr copy(other);
    std::swap(value_[0], copy.value_[0]);
  }
  return *this;
}

Mpfr& Mpfr::operator=(Mpfr&& other) noexcept {
  std::swap(value_[0], other.value_[0]);
  return *this;
}

Mpfr::~Mpfr() {
  if (value_[0]._mpfr_d) mpfr_clear(value_);
}

mpq_class Mpfr::to_mpq() const {
  mpq_class q;
  mpfr_get_q(q.get_mpq_t(), value_);
  return q;
}

bool Mpfr::magnitude_exceeds(double bound) const noexcept {
  if (mpfr_nan_p(value_) || std::isnan(bound)) return false;
  __mpfr_struct magnitude = value_[0];  // shares the limbs: |value| without a copy
  magnitude._mpfr_sign = 1;
  return mpfr_cmp_d(&magnitude, bound) > 0;
}

double Mpfr::rounding_error(int ternary) const noexcept {
  if (!is_finite()) return std::numeric_limits<double>::infinity();
  if (ternary == 0) return 0;
  constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
  if (is_zero()) return kSmallest;
  const mpfr_exp_t half_ulp = mpfr_get_exp(value_) - mpfr_get_prec(value_) - 1;  // as a power of two
  if (half_ulp > 1023) return std::numeric_limits<double>::infinity();
  return half_ulp < -1074 ? kSmallest : std::ldexp(1.0, static_cast<int>(half_ulp));
}

Mpfr Mpfr::add(const Mpfr& a, const Mpfr& b, int& ternary) {
  Mpfr result(Uninitialised{}, std::max(a.bits(), b.bits()));
  ternary = mpfr_add(result.value_, a.value_, b.value_, MPFR_RNDN);
  return result;
}

Mpfr Mpfr::subtract(const Mpfr& a, const Mpfr& b, int& ternary) {
  Mpfr result(Uninitialised{}, std::max(a.bits(), b.bits()));
  ternary = mpfr_sub(result.value_, a.value_, b.value_, MPFR_RNDN);
  return result;
}

Mpfr Mpfr::multiply(const Mpfr& a, const Mpfr& b, int& ternary) {
  Mpfr result(Uninitialised{}, std::max(a.bits(), b.bits()));
  ternary = mpfr_mul(result.value_, a.value_, b.value_, MPFR_RNDN);
  return result;
}

Mpfr Mpfr::divide(const Mpfr& a, const Mpfr& b, int& ternary) {
  Mpfr result(Uninitialised{}, std::max(a.bits(), b.bits()));
  ternary = mpfr_div(result.value_, a.value_, b.value_, MPFR_RNDN);
  return result;
}

Mpfr Mpfr::square_root(const Mpfr& a, int& ternary) {
  Mpfr result(Uninitialised{}, a.bits());
  ternary = mpfr_sqrt(result.value_, a.value_, MPFR_RNDN);
  return result;
}

Mpfr Mpfr::scaled(long k) const {
  Mpfr result(Uninitialised{}, bits());
  mpfr_mul_2si(result.value_, value_, k, MPFR_RNDN);
  return result;
}

Mpfr operator-(const Mpfr& a) {
  Mpfr result(a);
  mpfr_neg(result.get(), result.get(), MPFR_RNDN);
  return result;
}

Mpfr operator+(const Mpfr& a, const Mpfr& b) {
  int ternary;
  return Mpfr::add(a, b, ternary);
}

Mpfr operator-(const Mpfr& a, const Mpfr& b) {
  int ternary;
  return Mpfr::subtract(a, b, ternary);
}

Mpfr operator*(const Mpfr& a, const Mpfr& b) {
  int ternary;
  return Mpfr::multiply(a, b, ternary);
}

Mpfr operator/(const Mpfr& a, const Mpfr& b) {
  int ternary;
  return Mpfr::divide(a, b, ternary);
}

Mpfr sqrt(const Mpfr& a) {
  int ternary;
  return Mpfr::square_root(a, ternary);
}

Mpfr abs(const Mpfr& a) { return a.sign() < 0 ? -a : a; }

}  // namespace gvd::robust
