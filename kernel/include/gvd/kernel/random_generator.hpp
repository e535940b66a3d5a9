#pragma once

#include <array>
#include <cstdint>

namespace gvd::kernel {

/// xoshiro256** 1.0 by D. Blackman and S. Vigna (public domain), seeded by splitmix64: the same numbers on every machine.
/// Source: Scrambled linear pseudorandom number generators, ACM TOMS 47(4), 2021.
class RandomGenerator {
 public:
  /// Four successive numbers of splitmix64 from this seed are the state.
  explicit RandomGenerator(std::uint64_t seed) noexcept;
  /// Pre: not all four are zero.
  explicit RandomGenerator(const std::array<std::uint64_t, 4>& state) noexcept : state_(state) {}

  /// 64 random bits.
  std::uint64_t next() noexcept;
  /// The highest `count` of 64 random bits, as a number below 2^count. Pre: 1 <= count <= 64.
  std::uint64_t bits(int count) noexcept { return next() >> (64 - count); }
  /// A number below n, all with the same probability (draws again instead of taking remainders). Pre: n > 0.
  std::uint64_t below(std::uint64_t n) noexcept;

 private:
  std::array<std::uint64_t, 4> state_;
};

/// Steps the state of splitmix64 and returns its next number.
std::uint64_t splitmix64(std::uint64_t& state) noexcept;

}  // namespace gvd::kernel
