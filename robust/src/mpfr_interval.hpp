#pragma once

#include "gvd/robust/ball.hpp"
#include "gvd/robust/gmp.hpp"
#include "gvd/robust/sign.hpp"

namespace gvd::robust {

/// A closed interval with MPFR ends, rounded outward: unlike a ball its width is not limited by the range of double.
/// An operation that is undefined for some members gives an interval that is not a number.
class MpfrInterval {
 public:
  explicit MpfrInterval(int bits) : low_(0.0, bits), high_(0.0, bits) {}
  MpfrInterval(const mpz_class& n, int bits);

  const Mpfr& low() const noexcept { return low_; }
  const Mpfr& high() const noexcept { return high_; }

  friend MpfrInterval operator-(const MpfrInterval& a);
  friend MpfrInterval operator+(const MpfrInterval& a, const MpfrInterval& b);
  friend MpfrInterval operator-(const MpfrInterval& a, const MpfrInterval& b);
  friend MpfrInterval operator*(const MpfrInterval& a, const MpfrInterval& b);
  friend MpfrInterval operator/(const MpfrInterval& a, const MpfrInterval& b);
  /// The roots of the non-negative part.
  friend MpfrInterval sqrt(const MpfrInterval& a);

  /// Of all members; never zero, which takes a proof.
  MaybeSign sign() const;
  /// high - low <= 2^-bits * the least magnitude of a member, which is not zero.
  bool is_narrow(int bits) const;
  /// Pre: the ends are finite, as those of a narrow interval are.
  Ball<Mpfr> to_ball() const;

 private:
  Mpfr low_, high_;
};

}  // namespace gvd::robust
