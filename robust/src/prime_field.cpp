#include "prime_field.hpp"

#include <array>
#include <mutex>
#include <vector>

namespace gvd::robust {

namespace {

bool has_small_factor(std::uint64_t n) {
  constexpr std::array<std::uint64_t, 14> kSmall = {3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47};
  for (const std::uint64_t p : kSmall)
    if (n % p == 0) return true;
  return false;
}

// GMP's test (Baillie, Pomerance, Selfridge, Wagstaff) has no exception below 2^64.
bool passes_test(const mpz_class& n) noexcept { return mpz_probab_prime_p(n.get_mpz_t(), 1) != 0; }

bool is_prime(std::uint64_t n) { return !has_small_factor(n) && passes_test(n); }

}  // namespace

std::uint64_t large_prime(std::size_t n) {
  static std::mutex mutex;
  static std::vector<std::uint64_t> primes;
  const std::scoped_lock lock(mutex);
  std::uint64_t next = primes.empty() ? (std::uint64_t{1} << 62) - 1 : primes.back() - 2;
  for (; primes.size() <= n; next -= 2)
    if (is_prime(next)) primes.push_back(next);
  return primes[n];
}

PrimeField::PrimeField(std::uint64_t p) : p_(p) {
  std::uint64_t inverse = p;  // right modulo 8; each step doubles the bits
  for (int i = 0; i < 5; ++i) inverse *= 2 - p * inverse;
  minus_inverse_ = ~inverse + 1;
  const auto one = static_cast<std::uint64_t>((static_cast<unsigned __int128>(1) << 64) % p);
  square_ = static_cast<std::uint64_t>(static_cast<unsigned __int128>(one) * one % p);
}

}  // namespace gvd::robust
