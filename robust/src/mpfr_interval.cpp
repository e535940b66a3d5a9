#include "mpfr_interval.hpp"

#include <array>

namespace gvd::robust {

namespace {

using Operation = int(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

// The least (or greatest) of the four combinations of ends, each rounded down (up).
void extend(Mpfr& low, Mpfr& high, Operation* operation, const MpfrInterval& a, const MpfrInterval& b) {
  const std::array<const Mpfr*, 2> as = {&a.low(), &a.high()}, bs = {&b.low(), &b.high()};
  Mpfr end(0.0, low.bits());
  bool first = true;
  for (const Mpfr* x : as)
    for (const Mpfr* y : bs) {
      operation(end.get(), x->get(), y->get(), MPFR_RNDD);
      if (first || mpfr_nan_p(end.get()) || end < low) mpfr_set(low.get(), end.get(), MPFR_RNDD);
      operation(end.get(), x->get(), y->get(), MPFR_RNDU);
      if (first || mpfr_nan_p(end.get()) || end > high) mpfr_set(high.get(), end.get(), MPFR_RNDU);
      first = false;
    }
}

}  // namespace

MpfrInterval::MpfrInterval(const mpz_class& n, int bits) : MpfrInterval(bits) {
  mpfr_set_z(low_.get(), n.get_mpz_t(), MPFR_RNDD);
  mpfr_set_z(high_.get(), n.get_mpz_t(), MPFR_RNDU);
}

MpfrInterval operator-(const MpfrInterval& a) {
  MpfrInterval result(a.low_.bits());
  mpfr_neg(result.low_.get(), a.high_.get(), MPFR_RNDD);
  mpfr_neg(result.high_.get(), a.low_.get(), MPFR_RNDU);
  return result;
}

MpfrInterval operator+(const MpfrInterval& a, const MpfrInterval& b) {
  MpfrInterval result(a.low_.bits());
  mpfr_add(result.low_.get(), a.low_.get(), b.low_.get(), MPFR_RNDD);
  mpfr_add(result.high_.get(), a.high_.get(), b.high_.get(), MPFR_RNDU);
  return result;
}

MpfrInterval operator-(const MpfrInterval& a, const MpfrInterval& b) {
  MpfrInterval result(a.low_.bits());
  mpfr_sub(result.low_.get(), a.low_.get(), b.high_.get(), MPFR_RNDD);
  mpfr_sub(result.high_.get(), a.high_.get(), b.low_.get(), MPFR_RNDU);
  return result;
}

MpfrInterval operator*(const MpfrInterval& a, const MpfrInterval& b) {
  MpfrInterval result(a.low_.bits());
  if (const MaybeSign of_a = a.sign(), of_b = b.sign(); of_a && of_b) {
    const bool positive_a = of_a == Sign::positive, positive_b = of_b == Sign::positive;
    mpfr_mul(result.low_.get(), (positive_b ? a.low_ : a.high_).get(), (positive_a ? b.low_ : b.high_).get(), MPFR_RNDD);
    mpfr_mul(result.high_.get(), (positive_b ? a.high_ : a.low_).get(), (positive_a ? b.high_ : b.low_).get(), MPFR_RNDU);
    return result;
  }
  extend(result.low_, result.high_, &mpfr_mul, a, b);
  return result;
}

MpfrInterval operator/(const MpfrInterval& a, const MpfrInterval& b) {
  MpfrInterval result(a.low_.bits());
  if (!(b.low_.sign() * b.high_.sign() > 0)) {  // may be zero
    mpfr_set_nan(result.low_.get());
    mpfr_set_nan(result.high_.get());
    return result;
  }
  if (const MaybeSign of_a = a.sign()) {
    const bool positive_a = of_a == Sign::positive, positive_b = b.low_.sign() > 0;
    mpfr_div(result.low_.get(), (positive_b ? a.low_ : a.high_).get(), (positive_a ? b.high_ : b.low_).get(), MPFR_RNDD);
    mpfr_div(result.high_.get(), (positive_b ? a.high_ : a.low_).get(), (positive_a ? b.low_ : b.high_).get(), MPFR_RNDU);
    return result;
  }
  extend(result.low_, result.high_, &mpfr_div, a, b);
  return result;
}

MpfrInterval sqrt(const MpfrInterval& a) {
  MpfrInterval result(a.low_.bits());
  if (a.low_.sign() > 0 || mpfr_nan_p(a.low_.get())) mpfr_sqrt(result.low_.get(), a.low_.get(), MPFR_RNDD);
  mpfr_sqrt(result.high_.get(), a.high_.get(), MPFR_RNDU);
  return result;
}

MaybeSign MpfrInterval::sign() const {
  if (!low_.is_finite()) return std::nullopt;  // both ends are numbers, or neither
  if (low_.sign() > 0) return Sign::positive;
  if (high_.sign() < 0) return Sign::negative;
  return std::nullopt;
}

bool MpfrInterval::is_narrow(int bits) const {
  const MaybeSign known = sign();
  if (!known) return false;
  Mpfr width(0.0, low_.bits());
  mpfr_sub(width.get(), high_.get(), low_.get(), MPFR_RNDU);
  const Mpfr least = abs(*known == Sign::positive ? low_ : high_);
  return width.scaled(bits) <= least;
}

Ball<Mpfr> MpfrInterval::to_ball() const {
  Mpfr mid(0.0, low_.bits()), to_low(0.0), to_high(0.0);
  mpfr_add(mid.get(), low_.get(), high_.get(), MPFR_RNDN);
  mpfr_div_2ui(mid.get(), mid.get(), 1, MPFR_RNDN);
  mpfr_sub(to_low.get(), mid.get(), low_.get(), MPFR_RNDU);
  mpfr_sub(to_high.get(), high_.get(), mid.get(), MPFR_RNDU);
  const double rad = (to_low < to_high ? to_high : to_low).to_double(MPFR_RNDU);
  return {std::move(mid), rad};
}

}  // namespace gvd::robust
