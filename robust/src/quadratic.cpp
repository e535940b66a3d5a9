#include "quadratic.hpp"

#include "gvd/robust/rational.hpp"

namespace gvd::robust {

namespace {

// y written with the radicand d, if its field is that of sqrt(d).
std::optional<Quadratic> with_radicand(const Quadratic& y, const mpz_class& d) {
  if (y.is_rational() || y.d == d) return Quadratic{y.a, y.b, d};
  const mpz_class product = y.d * d;
  if (!mpz_perfect_square_p(product.get_mpz_t())) return std::nullopt;
  return Quadratic{y.a, y.b * mpq_class(sqrt(product)) / mpq_class(d), d};  // sqrt(y.d) = sqrt(y.d d) / d * sqrt(d)
}

// Both written with one radicand.
std::optional<std::pair<Quadratic, Quadratic>> in_one_field(const Quadratic& x, const Quadratic& y) {
  const mpz_class& d = x.is_rational() ? y.d : x.d;
  auto other = with_radicand(y, d);
  if (!other) return std::nullopt;
  return std::pair{Quadratic{x.a, x.b, d}, std::move(*other)};
}

mpq_class norm(const Quadratic& x) { return x.a * x.a - x.b * x.b * x.d; }

Quadratic root_of_rational(const mpq_class& q) {
  if (auto root = rational_square_root(q)) return {std::move(*root), 0};
  return {0, mpq_class(1) / q.get_den(), q.get_num() * q.get_den()};
}

}  // namespace

Sign Quadratic::sign() const {
  const int sign_a = sgn(a), sign_b = sgn(b);
  if (sign_b == 0 || sign_a == sign_b) return static_cast<Sign>(sign_a);
  if (sign_a == 0) return static_cast<Sign>(sign_b);
  return static_cast<Sign>(sign_a * sgn(norm(*this)));  // the larger of |a| and |b| sqrt(d) has the sign
}

MpfrInterval Quadratic::enclosure(int bits) const {
  const MpfrInterval constant(a, bits);
  if (is_rational()) return constant;
  return constant + MpfrInterval(b, bits) * sqrt(MpfrInterval(mpq_class(d), bits));
}

bool operator==(const Quadratic& x, const Quadratic& y) {
  const auto both = in_one_field(x, y);
  return both && both->first.a == both->second.a && both->first.b == both->second.b;
}

std::optional<Quadratic> add(const Quadratic& x, const Quadratic& y) {
  const auto both = in_one_field(x, y);
  if (!both) return std::nullopt;
  const auto& [p, q] = *both;
  return Quadratic{p.a + q.a, p.b + q.b, p.d};
}

std::optional<Quadratic> multiply(const Quadratic& x, const Quadratic& y) {
  const auto both = in_one_field(x, y);
  if (!both) return std::nullopt;
  const auto& [p, q] = *both;
  return Quadratic{p.a * q.a + p.b * q.b * p.d, p.a * q.b + p.b * q.a, p.d};
}

std::optional<Quadratic> divide(const Quadratic& x, const Quadratic& y) {
  const mpq_class n = norm(y);
  return multiply(x, Quadratic{y.a / n, -y.b / n, y.d});
}

Quadratic negate(const Quadratic& x) { return {-x.a, -x.b, x.d}; }

std::optional<Quadratic> square_root(const Quadratic& x) {
  if (x.is_rational()) return root_of_rational(x.a);
  // (s + t sqrt d)^2 = x has norm n^2 = norm(x), so s^2 = (a +- n) / 2 and t = b / (2 s); s is not zero because b is not.
  const auto n = rational_square_root(norm(x));
  if (!n) return std::nullopt;
  for (const mpq_class& s_squared : {mpq_class((x.a + *n) / 2), mpq_class((x.a - *n) / 2)}) {
    const auto s = rational_square_root(s_squared);
    if (!s) continue;
    const Quadratic root{*s, x.b / (2 * *s), x.d};
    return root.sign() == Sign::negative ? negate(root) : root;
  }
  return std::nullopt;
}

}  // namespace gvd::robust
