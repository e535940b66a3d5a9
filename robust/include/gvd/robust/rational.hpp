#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "gvd/robust/gmp.hpp"

namespace gvd::robust {

// Rationals are in lowest terms here and everywhere (as GMP's arithmetic leaves them; call canonicalize() after setting parts by
// hand).

/// x as a rational, exactly. Throws std::domain_error if x is not finite.
mpq_class exact_rational(double x);

/// 2^k as a rational.
mpq_class power_of_two(long k);

/// q 2^k.
mpq_class shifted(mpq_class q, long k);

/// The non-negative rational square root of q, if it has one.
std::optional<mpq_class> rational_square_root(const mpq_class& q);

/// Whether q is the square of a rational. Zero is.
bool is_square(const mpq_class& q);

/// Whether a and b differ by the square of a non-zero rational, that is sqrt(a) / sqrt(b) is rational. Pre: neither is zero.
bool same_square_class(const mpq_class& a, const mpq_class& b);

/// Whether n, with all factors p taken out, is no square modulo p. Pre: p is an odd prime; n is not zero.
bool is_non_residue(const mpz_class& n, std::uint64_t p);

/// Bit i < 32 is the Legendre symbol, modulo the i-th of 64 fixed primes p below 2^62, of q with all factors p taken out (1 for a
/// non-residue). Taking the factors out makes it a homomorphism of the non-zero rationals modulo squares, with no exceptions:
/// signature(a b) = signature(a) xor signature(b), signature(square) = 0. So different signatures prove different classes; equal
/// ones say nothing until `same_square_class` confirms it. Pre: q is not zero. Cost: some 3 microseconds.
std::uint64_t square_class_signature(const mpq_class& q);

/// The fixed primes, of which signatures take the first ones.
const std::array<std::uint64_t, 64>& signature_primes();

/// The least common denominator of some rationals, and what stands above it: with integers no common factor is looked for after each operation.
class CommonDenominator {
 public:
  void include(std::span<const mpq_class> all) {
    for (const mpq_class& q : all) denominator_ = lcm(denominator_, q.get_den());
  }
  /// Pre: q was included.
  mpz_class numerator(const mpq_class& q) const { return q.get_num() * mpz_class(denominator_ / q.get_den()); }
  const mpz_class& operator*() const noexcept { return denominator_; }

 private:
  mpz_class denominator_ = 1;
};

/// In lowest terms. Pre: the denominator is not zero.
mpq_class ratio(const mpz_class& numerator, const mpz_class& denominator);

}  // namespace gvd::robust
