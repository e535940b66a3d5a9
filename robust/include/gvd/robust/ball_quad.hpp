#pragma once

#include "gvd/robust/ball.hpp"
#include "gvd/robust/double_quad.hpp"

namespace gvd::robust {

/// Four balls in double-double at once: every operation is that of Ball<DoubleDouble> in each lane, bit for bit.
class BallQuad {
 public:
  using B = Ball<DoubleDouble>;

  GVD_QUAD BallQuad(const DoubleDoubleQuad& mid, const DoubleQuad& rad) noexcept : mid_(mid), rad_(rad) {}
  GVD_QUAD BallQuad(const B& a, const B& b, const B& c, const B& d) noexcept
      : mid_(quad(a.mid(), b.mid(), c.mid(), d.mid())), rad_(DoubleQuad{a.rad(), b.rad(), c.rad(), d.rad()}) {}
  /// The same in each lane.
  GVD_QUAD explicit BallQuad(const B& a) noexcept : mid_{quad(a.mid().hi), quad(a.mid().lo)}, rad_(quad(a.rad())) {}

  GVD_QUAD const DoubleDoubleQuad& mid() const noexcept { return mid_; }
  GVD_QUAD const DoubleQuad& rad() const noexcept { return rad_; }
  GVD_QUAD B lane(std::size_t k) const { return {mid_.lane(k), rad_[k]}; }
  /// The lanes i, j, k, l.
  template <int i, int j, int k, int l>
  GVD_QUAD BallQuad lanes() const noexcept {
    return {robust::lanes<i, j, k, l>(mid_), __builtin_shufflevector(rad_, rad_, i, j, k, l)};
  }

  GVD_QUAD friend BallQuad operator-(const BallQuad& a) noexcept { return {-a.mid_, a.rad_}; }

  GVD_QUAD friend BallQuad operator+(const BallQuad& a, const BallQuad& b) noexcept {
    const DoubleDoubleQuad s = a.mid_ + b.mid_;
    const DoubleQuad zero = quad(0), underflow = choose(s.hi == zero, zero, quad(kUnderflow));
    const DoubleQuad error = choose((a.mid_.hi == zero) | (b.mid_.hi == zero), zero * s.hi, quad(kDoubleDoubleAddError) * abs(s.hi) + underflow);
    return {s, inflated(a.rad_ + b.rad_ + error)};
  }
  GVD_QUAD friend BallQuad operator-(const BallQuad& a, const BallQuad& b) noexcept { return a + -b; }

  GVD_QUAD friend BallQuad operator*(const BallQuad& a, const BallQuad& b) noexcept {
    const DoubleDoubleQuad p = a.mid_ * b.mid_;
    const DoubleQuad a_most = magnitude(a.mid_) + a.rad_, b_mid = magnitude(b.mid_), b_most = b_mid + b.rad_;
    const DoubleQuad least = choose(a_most < b_most, a_most, b_most), underflow = choose(least > quad(0), quad(kUnderflow), quad(0));
    return {p, inflated(a_most * b.rad_ + b_mid * a.rad_ + quad(kDoubleDoubleProductError) * abs(p.hi) + underflow)};
  }

  GVD_QUAD friend BallQuad operator/(const BallQuad& a, const BallQuad& b) noexcept {
    const DoubleDoubleQuad q = a.mid_ / b.mid_;
    const DoubleQuad zero = quad(0), of_ball = quad(kUnderflow);
    const DoubleQuad error = quad(kDoubleDoubleQuotientError) * abs(q.hi) + choose(a.mid_.hi == zero, zero, of_ball / abs(b.mid_.hi));
    const DoubleQuad b_least = abs(b.mid_.hi) * quad(1 - 0x1p-52) - b.rad_;
    const DoubleQuad underflow = choose(magnitude(a.mid_) + a.rad_ > zero, of_ball, zero), inner_underflow = choose(b.rad_ > zero, underflow, zero);
    const DoubleQuad numerator = a.rad_ + (magnitude(q) + error + inner_underflow) * b.rad_ + inner_underflow;
    return {q, choose(b_least > zero, inflated(numerator / b_least + error + underflow), quad(std::numeric_limits<double>::infinity()))};
  }

  GVD_QUAD friend BallQuad square(const BallQuad& a) noexcept { return a * a; }

  GVD_QUAD friend BallQuad sqrt(const BallQuad& a) {
    const QuadMask is_positive = a.mid_.hi > a.rad_;
    if (!all(is_positive)) return {sqrt(a.lane(0)), sqrt(a.lane(1)), sqrt(a.lane(2)), sqrt(a.lane(3))};
    const DoubleDoubleQuad root = sqrt(a.mid_);
    const DoubleQuad error = quad(kDoubleDoubleRootError) * root.hi, least = abs(a.mid_.hi) * quad(1 - 0x1p-52), root_least = abs(root.hi) * quad(1 - 0x1p-52);
    const DoubleQuad share = choose(quad(16) * a.rad_ <= least, quad(0.51), quad(1)), of_radius = a.rad_ / root_least * share + error + quad(kUnderflow);
    return {root, inflated(choose(a.rad_ == quad(0), error, of_radius))};
  }

 private:
  GVD_QUAD static DoubleQuad inflated(const DoubleQuad& radius) noexcept { return radius * quad(kRadiusInflation); }
  GVD_QUAD static DoubleQuad magnitude(const DoubleDoubleQuad& a) noexcept { return abs(a.hi) * quad(1 + 0x1p-52); }

  DoubleDoubleQuad mid_;
  DoubleQuad rad_;
};

}  // namespace gvd::robust
