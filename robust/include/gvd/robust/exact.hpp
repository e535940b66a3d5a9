#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "gvd/robust/ball.hpp"
#include "gvd/robust/gmp.hpp"
#include "gvd/robust/root_sum.hpp"
#include "gvd/robust/sign.hpp"

namespace gvd::robust {

/// An exact real number built from rationals by + - * / and square roots; its sign is decidable, zero included.
/// It has the interface that the generic formulas need of `Ball`, so that one template serves both.
///
/// Dividing by zero and the root of a negative number give the *undefined* value, which every operation passes on and whose sign is
/// empty. Sums of roots of rationals, their sums and products stay in normal form (RootSum). Everything else is an expression: its sign is
/// looked for with MPFR, and if 256 bits do not show it, it is brought into the normal form of a tower of quadratic fields, which is zero
/// or not; docs/exactness.md#towers. An element of a tower of n independent roots has 2^n coefficients: meant for formulas over a few. Where the
/// form would be too large the sign may stay empty; such a number as divisor or radicand makes the result undefined. Values are immutable;
/// distinct objects may be used by distinct threads, also copies of one another.
class Exact {
 public:
  class Node;
  Exact() : Exact(0.0) {}
  /// Exactly x; undefined if x is not finite.
  Exact(double x);  // NOLINT: as for Ball
  explicit Exact(const mpq_class& q);
  explicit Exact(RootSum sum);
  static Exact exact(double x) { return Exact(x); }
  static Exact undefined() { return Exact(std::shared_ptr<const Node>()); }
  /// The number that `make` returns, which is called when it is first needed, once, if ever.
  static Exact deferred(std::function<Exact()> make);

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

  /// The sign; empty only if undefined or out of reach (see above). Decided once, then remembered.
  friend MaybeSign maybe_sign(const Exact& a);

  bool is_defined() const { return node() != nullptr; }
  /// The correctly rounded double (ties to even, subnormals and overflow as IEEE 754). Empty only if undefined or out of reach.
  friend std::optional<double> rounded(const Exact& a);
  /// An enclosure of relative radius at most 2^-bits where that is not limited by the range of double (zero is exact). Infinite
  /// radius if undefined or out of reach.
  Ball<Mpfr> enclosure(int bits) const;
  /// Rationals around the number, at most 2^-bits times its magnitude apart (equal for rationals). Empty if undefined or out of
  /// reach.
  std::optional<std::pair<mpq_class, mpq_class>> bounds(int bits) const;
  /// The number itself if it was recognised to be rational (which is always so when no root occurs in it, but not only then).
  std::optional<mpq_class> rational() const;

 private:
  explicit Exact(std::shared_ptr<const Node> node) noexcept : node_(std::move(node)) {}
  const std::shared_ptr<const Node>& node() const;
  std::shared_ptr<const Node> node_;  ///< null: undefined
};

MaybeSign maybe_sign(const Exact& a);
std::optional<double> rounded(const Exact& a);

template <>
Exact from<Exact>(const mpq_class& q, int bits);

}  // namespace gvd::robust
