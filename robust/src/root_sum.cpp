#include "gvd/robust/root_sum.hpp"

#include <stdexcept>

#include "correct_rounding.hpp"
#include "gvd/robust/rational.hpp"
#include "perfect_square.hpp"
#include "root_sum_interval.hpp"

namespace gvd::robust {

MpfrInterval evaluated(const RootSum& x, int bits) {
  MpfrInterval sum(x.constant(), bits);
  for (const auto& term : x.terms()) sum = sum + MpfrInterval(term.coefficient, bits) * sqrt(MpfrInterval(mpq_class(term.radicand), bits));
  return sum;
}

namespace {

// An interval of relative width at most 2^-bits. It ends, because a number that is not zero is not zero.
MpfrInterval narrow_interval(const RootSum& x, int bits) {
  if (x.is_zero()) return MpfrInterval(bits);
  for (int working = bits + 32;; working *= 2) {
    const MpfrInterval interval = evaluated(x, working);
    if (interval.is_narrow(bits)) return interval;
  }
}

}  // namespace

RootSum& RootSum::add(const mpq_class& coefficient, const mpq_class& radicand) {
  if (sgn(radicand) < 0) throw std::domain_error("the square root of a negative number is not real");
  if (sgn(radicand) == 0 || sgn(coefficient) == 0) return *this;
  if (const auto root = rational_square_root(radicand)) {
    constant_ += coefficient * *root;
    return *this;
  }
  // sqrt(n / d) = sqrt(n d) / d; the squares of two in n d, all of them if the radicand came from doubles, are taken out.
  mpz_class whole = radicand.get_num() * radicand.get_den();
  const mp_bitcnt_t twos = mpz_scan1(whole.get_mpz_t(), 0) / 2;
  mpz_tdiv_q_2exp(whole.get_mpz_t(), whole.get_mpz_t(), 2 * twos);
  add_class(coefficient / radicand.get_den() * power_of_two(static_cast<long>(twos)), whole, square_class_signature(radicand));
  return *this;
}

void RootSum::add_class(const mpq_class& coefficient, const mpz_class& radicand, std::uint64_t signature) {
  for (auto term = terms_.begin(); term != terms_.end(); ++term) {
    if (term->signature != signature) continue;
    if (term->radicand == radicand) {
      term->coefficient += coefficient;
    } else {
      const mpz_class product = radicand * term->radicand;
      if (!is_perfect_square(product)) continue;
      term->coefficient += coefficient * mpq_class(sqrt(product)) / term->radicand;
    }
    if (sgn(term->coefficient) == 0) terms_.erase(term);
    return;
  }
  terms_.push_back({coefficient, radicand, signature});
}

RootSum& RootSum::operator+=(const RootSum& other) {
  if (this == &other) return *this *= 2;
  constant_ += other.constant_;
  for (const auto& term : other.terms_) add_class(term.coefficient, term.radicand, term.signature);
  return *this;
}

RootSum& RootSum::operator-=(const RootSum& other) { return *this += other * mpq_class(-1); }

RootSum& RootSum::operator*=(const mpq_class& factor) {
  constant_ *= factor;
  if (sgn(factor) == 0) terms_.clear();
  for (auto& term : terms_) term.coefficient *= factor;
  return *this;
}

namespace {

/// The least common denominator of all coefficients.
mpz_class common_denominator(const RootSum& x) {
  mpz_class result = x.constant().get_den();
  for (const auto& term : x.terms())
    if (term.coefficient.get_den() != result) result = lcm(result, term.coefficient.get_den());
  return result;
}

/// q times a multiple of its denominator.
mpq_class whole_multiple(const mpq_class& q, const mpz_class& multiple) {
  mpq_class result(q.get_num());
  if (multiple != q.get_den()) {
    mpz_class factor;
    mpz_divexact(factor.get_mpz_t(), multiple.get_mpz_t(), q.get_den_mpz_t());
    result.get_num() *= factor;
  }
  return result;
}

}  // namespace

/// Of whole coefficients, so that common factors are looked for once a coefficient and not once a product.
RootSum operator*(const RootSum& a, const RootSum& b) {
  const auto whole = [](const RootSum& x, const mpz_class& multiple) {
    RootSum result(whole_multiple(x.constant_, multiple));
    for (const auto& term : x.terms_) result.terms_.push_back({whole_multiple(term.coefficient, multiple), term.radicand, term.signature});
    return result;
  };
  const mpz_class denominator_a = common_denominator(a), denominator_b = common_denominator(b);
  const RootSum of_a = whole(a, denominator_a), of_b = whole(b, denominator_b);
  RootSum product = of_a * of_b.constant_;
  for (const auto& y : of_b.terms_) {
    if (sgn(of_a.constant_) != 0) product.add_class(of_a.constant_ * y.coefficient, y.radicand, y.signature);
    for (const auto& x : of_a.terms_) product.add_product(x, y);
  }
  return product *= mpq_class(1, denominator_a * denominator_b);
}

void RootSum::add_product(const Term& x, const Term& y) {
  if (x.radicand == y.radicand) {
    constant_ += x.coefficient * y.coefficient * x.radicand;
    return;
  }
  const mpz_class common = gcd(x.radicand, y.radicand);
  const mpz_class radicand = (x.radicand / common) * (y.radicand / common);
  const mpq_class coefficient = x.coefficient * y.coefficient * common;
  const std::uint64_t signature = x.signature ^ y.signature;
  if (signature == 0 && is_perfect_square(radicand))
    constant_ += coefficient * sqrt(radicand);
  else
    add_class(coefficient, radicand, signature);
}

Sign RootSum::sign() const {
  if (terms_.empty()) return static_cast<Sign>(sgn(constant_));
  return *narrow_interval(*this, 1).sign();
}

double RootSum::rounded() const {
  return *correctly_rounded([&](int bits) { return narrow_interval(*this, bits); },
                            [&](const mpq_class& q) { return MaybeSign((*this - RootSum(q)).sign()); });
}

Ball<Mpfr> RootSum::enclosure(int bits) const { return narrow_interval(*this, bits).to_ball(); }

}  // namespace gvd::robust
