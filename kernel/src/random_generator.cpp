#include "gvd/kernel/random_generator.hpp"

#include <bit>

namespace gvd::kernel {

std::uint64_t splitmix64(std::uint64_t& state) noexcept {
  state += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

RandomGenerator::RandomGenerator(std::uint64_t seed) noexcept {
  for (std::uint64_t& word : state_) word = splitmix64(seed);
}

std::uint64_t RandomGenerator::next() noexcept {
  auto& s = state_;
  const std::uint64_t result = std::rotl(s[1] * 5, 7) * 9;
  const std::uint64_t t = s[1] << 17;
  s[2] ^= s[0];
  s[3] ^= s[1];
  s[1] ^= s[2];
  s[0] ^= s[3];
  s[2] ^= t;
  s[3] = std::rotl(s[3], 45);
  return result;
}

std::uint64_t RandomGenerator::below(std::uint64_t n) noexcept {
  if (n == 1) return 0;
  const int count = std::bit_width(n - 1);
  for (;;) {
    const std::uint64_t drawn = bits(count);
    if (drawn < n) return drawn;
  }
}

}  // namespace gvd::kernel
