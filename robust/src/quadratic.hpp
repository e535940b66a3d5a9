#pragma once

#include <optional>

#include "gvd/robust/gmp.hpp"
#include "gvd/robust/sign.hpp"
#include "mpfr_interval.hpp"

namespace gvd::robust {

/// a + b sqrt(d): an element of a real quadratic field, or a rational (b = 0). d is a positive integer that is no square.
struct Quadratic {
  mpq_class a, b;
  mpz_class d = 2;

  bool is_rational() const { return sgn(b) == 0; }
  Sign sign() const;
  MpfrInterval enclosure(int bits) const;
};

bool operator==(const Quadratic& x, const Quadratic& y);

/// Sums, products and quotients; empty if x and y lie in different quadratic fields. Quotient: pre: y is not zero.
std::optional<Quadratic> add(const Quadratic& x, const Quadratic& y);
std::optional<Quadratic> multiply(const Quadratic& x, const Quadratic& y);
std::optional<Quadratic> divide(const Quadratic& x, const Quadratic& y);
Quadratic negate(const Quadratic& x);
/// The non-negative root, if it is again an element of a quadratic field: of the same one, or any for rational x. Pre: x >= 0.
std::optional<Quadratic> square_root(const Quadratic& x);

}  // namespace gvd::robust
