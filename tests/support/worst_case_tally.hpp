#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "gvd/predicates/ladder.hpp"
#include "meshes.hpp"

/// What the tests of worst cases have in common.
namespace gvd::test {

/// Every predicate has so many cases at exact zero, shared out evenly among its families, and a neighbour of each.
#ifdef GVD_COVERAGE  // without optimisation: the same families
inline constexpr int kZerosOfAPredicate = 1500;
#else
inline constexpr int kZerosOfAPredicate = 10000;
#endif
constexpr int zeros_of_a_family(std::size_t families) {
  const int n = static_cast<int>(families);
  return (kZerosOfAPredicate + n - 1) / n;
}

/// Which stages decided the zeros of a family and their neighbours.
struct Tally {
  std::map<robust::Stage, int> zeros, neighbours;

  static int all(const std::map<robust::Stage, int>& counts) {
    int sum = 0;
    for (const auto& [stage, count] : counts) sum += count;
    return sum;
  }
  /// Into the report of the test.
  void record() const {
    for (const auto& [what, counts] : {std::pair{"zeros", &zeros}, {"neighbours", &neighbours}})
      for (const auto& [stage, count] : *counts)
        testing::Test::RecordProperty(std::string(what) + "_" + robust::kStageNames[static_cast<std::size_t>(stage)], count);
  }
};

/// The next double, up or down.
inline double ulp_neighbour(double x, Random& random) { return std::nextafter(x, random.below(2) == 0 ? HUGE_VAL : -HUGE_VAL); }

/// One coordinate of a point by one ulp, one that is not zero: from there an ulp is 2^-1074, which no independent truth of 500 bits sees.
inline void nudge(std::array<double, 3>& p, Random& random) {
  const std::uint32_t first = random.below(3);
  for (std::uint32_t k = 0; k < 3; ++k) {
    double& x = p[(first + k) % 3];
    if (x == 0) continue;
    x = ulp_neighbour(x, random);
    return;
  }
}

/// A distance for a step aside that doubles, double-doubles, or only long numbers can see.
inline mpq_class small_step(Random& random) {
  constexpr std::array<unsigned, 5> kBits{20, 60, 110, 200, 300};
  return mpq_class(1, mpz_class(1) << kBits[random.below(5)]);
}

/// Whether to ask every rung by itself: of one case in sixteen, as that costs most of the time.
inline bool asks_all_rungs(int round) { return round % 16 == 0; }

}  // namespace gvd::test
