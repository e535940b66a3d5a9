#pragma once

#include <memory>

#include "gvd/robust/gmp.hpp"
#include "gvd/robust/sign.hpp"

namespace gvd::test {

/// Exact numbers by Calcium (LGPL), for comparison with the algebra of our own. For one thread.
class Calcium {
 public:
  Calcium(const mpq_class& q = 0);                // NOLINT: every rational is one
  Calcium(double x) : Calcium(mpq_class(x)) {}    // NOLINT
  Calcium(int x) : Calcium(mpq_class(x)) {}       // NOLINT

  friend Calcium operator+(const Calcium& a, const Calcium& b);
  friend Calcium operator-(const Calcium& a, const Calcium& b);
  friend Calcium operator*(const Calcium& a, const Calcium& b);
  friend Calcium operator/(const Calcium& a, const Calcium& b);
  friend Calcium operator-(const Calcium& a) { return Calcium(0) - a; }
  Calcium& operator+=(const Calcium& b) { return *this = *this + b; }
  friend Calcium sqrt(const Calcium& a);
  /// Empty if Calcium does not know.
  friend robust::MaybeSign maybe_sign(const Calcium& a);

 private:
  struct Number;
  explicit Calcium(std::shared_ptr<const Number> number) : number_(std::move(number)) {}
  std::shared_ptr<const Number> number_;
};

Calcium sqrt(const Calcium& a);
robust::MaybeSign maybe_sign(const Calcium& a);

}  // namespace gvd::test
