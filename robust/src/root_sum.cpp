#include "gvd/robust/root_sum.hpp"

#include <stdexcept>

#include "correct_rounding.hpp"
#include "gvd/robust/rational.hpp"
#include "perfect_square.hpp"
#include "product_of_root_sums.hpp"
#include "root_sum_interval.hpp"

namespace gvd::robust {

MpfrInterval evaluated(const RootSum& x, int bits) {
  MpfrInterval sum(x.whole_constant(), bits);
  for (const auto& term : x.terms()) sum = sum + MpfrInterval(term.coefficient, bits) * sqrt(MpfrInterval(term.radicand, bits));
  return x.denominator() == 1 ? sum : sum / MpfrInterval(x.denominator(), bits);
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

mpq_class RootSum::over_denominator(const mpz_class& numerator) const {
  mpq_class q(numerator, denominator_);
  q.canonicalize();
  return q;
}

void RootSum::expand(const mpz_class& factor) {
  if (factor == 1) return;
  constant_ *= factor;
  denominator_ *= factor;
  for (auto& term : terms_) term.coefficient *= factor;
}

mpz_class RootSum::make_common(const mpz_class& denominator) {
  if (denominator == denominator_) return 1;
  const mpz_class common = gcd(denominator, denominator_);
  mpz_class result;
  mpz_divexact(result.get_mpz_t(), denominator_.get_mpz_t(), common.get_mpz_t());
  if (common == denominator) return result;
  mpz_class missing;
  mpz_divexact(missing.get_mpz_t(), denominator.get_mpz_t(), common.get_mpz_t());
  expand(missing);
  return result;
}

void RootSum::add_rational(const mpq_class& q) {
  const mpz_class factor = make_common(q.get_den());
  constant_ += q.get_num() * factor;
}

RootSum& RootSum::add(const mpq_class& coefficient, const mpq_class& radicand) {
  if (sgn(radicand) < 0) throw std::domain_error("the square root of a negative number is not real");
  if (sgn(radicand) == 0 || sgn(coefficient) == 0) return *this;
  if (const auto root = rational_square_root(radicand)) {
    add_rational(coefficient * *root);
    reduce();
    return *this;
  }
  // sqrt(n / d) = sqrt(n d) / d; the squares of two in n d, all of them if the radicand came from doubles, are taken out.
  mpz_class whole = radicand.get_num() * radicand.get_den();
  const mp_bitcnt_t twos = mpz_scan1(whole.get_mpz_t(), 0) / 2;
  mpz_tdiv_q_2exp(whole.get_mpz_t(), whole.get_mpz_t(), 2 * twos);
  const mpq_class factor = coefficient / radicand.get_den() * power_of_two(static_cast<long>(twos));
  const mpz_class multiple = make_common(factor.get_den());
  add_class(factor.get_num() * multiple, whole, square_class_signature(radicand));
  reduce();
  return *this;
}

void RootSum::add_class(const mpz_class& coefficient, const mpz_class& radicand, std::uint64_t signature) {
  if (sgn(coefficient) == 0) return;
  for (auto term = terms_.begin(); term != terms_.end(); ++term) {
    if (term->signature != signature) continue;
    if (term->radicand == radicand) {
      term->coefficient += coefficient;
    } else {
      const mpz_class product = radicand * term->radicand;
      if (!is_perfect_square(product)) continue;
      mpq_class multiple(coefficient * sqrt(product), term->radicand * denominator_);
      multiple.canonicalize();
      const mpz_class factor = make_common(multiple.get_den());
      term->coefficient += multiple.get_num() * factor;
    }
    if (sgn(term->coefficient) == 0) terms_.erase(term);
    return;
  }
  terms_.push_back({coefficient, radicand, signature});
}

void RootSum::reduce() {
  mpz_class common = denominator_;
  if (common != 1) mpz_gcd(common.get_mpz_t(), common.get_mpz_t(), constant_.get_mpz_t());
  for (auto term = terms_.begin(); common != 1 && term != terms_.end(); ++term)
    mpz_gcd(common.get_mpz_t(), common.get_mpz_t(), term->coefficient.get_mpz_t());
  if (common == 1) return;
  const auto divide = [&](mpz_class& n) { mpz_divexact(n.get_mpz_t(), n.get_mpz_t(), common.get_mpz_t()); };
  divide(denominator_);
  divide(constant_);
  for (auto& term : terms_) divide(term.coefficient);
}

RootSum& RootSum::operator+=(const RootSum& other) {
  if (this == &other) return *this *= 2;
  const mpz_class factor = make_common(other.denominator_);
  const mpz_class common = denominator_;  // unlike it, denominator_ may grow: where two radicands of one class differ
  constant_ += other.constant_ * factor;
  for (const auto& term : other.terms_) add_class(term.coefficient * factor * (denominator_ / common), term.radicand, term.signature);
  reduce();
  return *this;
}

RootSum operator-(RootSum a) {
  a.constant_ = -a.constant_;
  for (auto& term : a.terms_) term.coefficient = -term.coefficient;
  return a;
}

RootSum& RootSum::operator-=(const RootSum& other) { return *this += -other; }

RootSum& RootSum::operator*=(const mpq_class& factor) {
  if (sgn(factor) == 0) return *this = RootSum();
  constant_ *= factor.get_num();
  for (auto& term : terms_) term.coefficient *= factor.get_num();
  denominator_ *= factor.get_den();
  reduce();
  return *this;
}

RootSum operator*(const RootSum& a, const RootSum& b) {
  if (b.terms_.empty()) return a * b.constant();
  if (a.terms_.empty()) return b * a.constant();
  if (auto product = ProductOfRootSums(a, b).result()) return std::move(*product);
  RootSum product;
  product.constant_ = a.constant_ * b.constant_;
  for (const auto& x : a.terms_) product.add_class(x.coefficient * b.constant_ * product.denominator_, x.radicand, x.signature);
  for (const auto& y : b.terms_) {
    product.add_class(a.constant_ * y.coefficient * product.denominator_, y.radicand, y.signature);
    for (const auto& x : a.terms_) product.add_product(x, y);
  }
  product.denominator_ *= a.denominator_ * b.denominator_;
  product.reduce();
  return product;
}

void RootSum::add_product(const Term& x, const Term& y) {
  if (x.radicand == y.radicand) {
    constant_ += x.coefficient * y.coefficient * x.radicand * denominator_;
    return;
  }
  const mpz_class common = gcd(x.radicand, y.radicand);
  const mpz_class radicand = (x.radicand / common) * (y.radicand / common);
  const mpz_class coefficient = x.coefficient * y.coefficient * common * denominator_;
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
