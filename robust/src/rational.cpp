#include "gvd/robust/rational.hpp"

#include <cmath>
#include <stdexcept>

#include "perfect_square.hpp"

namespace gvd::robust {

namespace {

// 2^62 minus these are the 64 largest primes below 2^62.
constexpr std::array<std::uint16_t, 64> kPrimeOffsets = {
    57,   87,   117,  143,  153,  167,  171,  195,  203,  273,  287,  317,  443,  483,  495,  575,
    581,  603,  633,  663,  765,  773,  777,  791,  813,  831,  923,  981,  993,  1001, 1007, 1017,
    1197, 1241, 1293, 1353, 1433, 1515, 1553, 1575, 1581, 1595, 1617, 1673, 1697, 1701, 1703, 1823,
    1881, 1911, 1923, 2043, 2073, 2103, 2141, 2187, 2217, 2247, 2285, 2351, 2367, 2375, 2397, 2421};

}  // namespace

const std::array<std::uint64_t, 64>& signature_primes() {
  static constexpr auto kPrimes = [] {
    std::array<std::uint64_t, 64> primes{};
    for (std::size_t i = 0; i < primes.size(); ++i) primes[i] = (std::uint64_t{1} << 62) - kPrimeOffsets[i];
    return primes;
  }();
  return kPrimes;
}

mpq_class exact_rational(double x) {
  if (!std::isfinite(x)) throw std::domain_error("only a finite double is a rational number");
  return mpq_class(x);
}

mpq_class power_of_two(long k) { return shifted(1, k); }

mpq_class shifted(mpq_class q, long k) {
  if (k >= 0)
    mpq_mul_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(k));
  else
    mpq_div_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(-k));
  return q;
}

mpq_class ratio(const mpz_class& numerator, const mpz_class& denominator) {
  mpq_class result(numerator, denominator);
  result.canonicalize();
  return result;
}

bool is_square(const mpq_class& q) {  // numerator and denominator have no common factor
  return is_perfect_square(q.get_num()) && is_perfect_square(q.get_den());
}

std::optional<mpq_class> rational_square_root(const mpq_class& q) {
  if (!is_square(q)) return std::nullopt;
  mpq_class root;
  mpz_sqrt(root.get_num_mpz_t(), q.get_num_mpz_t());
  mpz_sqrt(root.get_den_mpz_t(), q.get_den_mpz_t());
  return root;
}

bool same_square_class(const mpq_class& a, const mpq_class& b) { return sgn(a) == sgn(b) && is_square(a * b); }

bool is_non_residue(const mpz_class& n, std::uint64_t p) {
  const auto symbol = [p](const mpz_class& m) noexcept { return mpz_kronecker_ui(m.get_mpz_t(), p); };
  if (const int of_n = symbol(n); of_n != 0) return of_n < 0;
  mpz_class rest;
  mpz_remove(rest.get_mpz_t(), n.get_mpz_t(), mpz_class(p).get_mpz_t());
  return symbol(rest) < 0;
}

std::uint64_t square_class_signature(const mpq_class& q) {
  const mpz_class n = q.get_num() * q.get_den();
  constexpr std::size_t kSymbols = 32;
  const auto& primes = signature_primes();
  std::uint64_t signature = 0;
  for (std::size_t i = 0; i < kSymbols; ++i) signature |= std::uint64_t{is_non_residue(n, primes[i])} << i;
  return signature;
}

}  // namespace gvd::robust
