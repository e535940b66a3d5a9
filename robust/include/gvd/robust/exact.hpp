#pragma once

#include <gmpxx.h>

#include <memory>
#include <utility>

#include "gvd/robust/ball.hpp"
#include "gvd/robust/sign.hpp"

namespace gvd::robust {

/// An exact real number built from rationals by + - * / and square roots; its sign is decidable, zero included.
/// It has the interface that the generic formulas need of `Ball`, so that one template serves both.
///
/// Dividing by zero and the root of a negative number give the *undefined* value, which every operation passes on and whose sign is
/// empty. Elements of one quadratic field Q(sqrt d) stay in normal form (three rationals) and cost a few GMP operations. Everything else
/// is an expression whose sign costs MPFR work that grows with the number of bits of a separation bound, which doubles with every
/// further independent root: meant for short formulas over one square class.
/// Values are immutable; distinct objects may be used by distinct threads, also copies of one another.
class Exact {
 public:
  class Node;

  Exact() : Exact(0.0) {}
  /// Exactly x; undefined if x is not finite.
  Exact(double x);  // NOLINT: as for Ball
  explicit Exact(const mpq_class& q);
  static Exact exact(double x) { return Exact(x); }

  friend Exact operator-(const Exact& a);
  friend Exact operator+(const Exact& a, const Exact& b);
  friend Exact operator-(const Exact& a, const Exact& b);
  friend Exact operator*(const Exact& a, const Exact& b);
  friend Exact operator/(const Exact& a, const Exact& b);
  friend Exact sqrt(const Exact& a);
  friend Exact abs(const Exact& a);
  friend Exact square(const Exact& a) { return a * a; }
  /// 2^k times the number.
  Exact scaled(int k) const;

  Exact& operator+=(const Exact& b) { return *this = *this + b; }
  Exact& operator-=(const Exact& b) { return *this = *this - b; }
  Exact& operator*=(const Exact& b) { return *this = *this * b; }
  Exact& operator/=(const Exact& b) { return *this = *this / b; }

  /// The sign; empty only if undefined.
  friend MaybeSign maybe_sign(const Exact& a);

  bool is_defined() const noexcept { return node_ != nullptr; }
  /// The correctly rounded double (ties to even, subnormals and overflow included). Not a number if undefined.
  double rounded() const;
  /// An enclosure whose midpoint has `bits` bits and a relative error of about 2^-bits (zero is exact). Infinite radius if undefined.
  Ball<Mpfr> enclosure(int bits) const;
  /// Rationals around the number at most 2^-bits times its magnitude apart (equal for rationals). Pre: defined.
  std::pair<mpq_class, mpq_class> bounds(int bits) const;

 private:
  explicit Exact(std::shared_ptr<const Node> node) noexcept : node_(std::move(node)) {}
  std::shared_ptr<const Node> node_;
};

template <>
Exact from<Exact>(const mpq_class& q, int bits);

}  // namespace gvd::robust
