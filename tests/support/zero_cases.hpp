#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "gvd/predicates/predicate.hpp"
#include "worst_case_tally.hpp"

/// Which test asks which predicate of the kernel about cases at exact zero.
namespace gvd::test {

/// The program of tests/worst_cases that makes the cases: NAME_zeros_test.
enum class ZeroTest { facet, field, surface, none };

/// The ten thousand cases of a predicate are cut into shares, each a test of its own with a seed of its own.
struct ZeroCases {
  predicates::Predicate predicate;
  ZeroTest test;
  int shares;
};
inline constexpr std::array<ZeroCases, predicates::kPredicateCount> kZeroCases = {{
    {predicates::Predicate::window_orientation, ZeroTest::field, 2},
    {predicates::Predicate::window_pruning, ZeroTest::none, 0},  // drops what is certainly longer, in doubles alone: no equality is ever claimed
    {predicates::Predicate::vertex_distance, ZeroTest::field, 3},
    {predicates::Predicate::rounding, ZeroTest::field, 4},
    {predicates::Predicate::saddle, ZeroTest::field, 2},
    {predicates::Predicate::edge_tie, ZeroTest::facet, 3},
    {predicates::Predicate::corner_order, ZeroTest::facet, 2},
    {predicates::Predicate::bisector_vertex, ZeroTest::facet, 3},
    {predicates::Predicate::cone_membership, ZeroTest::facet, 2},
    {predicates::Predicate::conflict, ZeroTest::facet, 2},
    {predicates::Predicate::location, ZeroTest::facet, 2},
    {predicates::Predicate::point_distance, ZeroTest::field, 3},
    {predicates::Predicate::source_location, ZeroTest::surface, 2},
}};

consteval bool every_predicate_has_its_zeros() {
  for (std::size_t p = 0; p < kZeroCases.size(); ++p) {
    const auto& [predicate, test, shares] = kZeroCases[p];
    if (static_cast<std::size_t>(predicate) != p) return false;
    if ((test == ZeroTest::none) != (predicate == predicates::Predicate::window_pruning)) return false;
    if ((shares > 0) != (test != ZeroTest::none)) return false;
  }
  return true;
}
static_assert(every_predicate_has_its_zeros());

struct ZeroShare {
  predicates::Predicate predicate;
  int number;
  /// At exact zero, at least.
  std::uint64_t cases() const { return static_cast<std::uint64_t>(zeros_of_a_family(static_cast<std::size_t>(shares()))); }
  int shares() const { return kZeroCases[static_cast<std::size_t>(predicate)].shares; }
  std::uint64_t seed() const { return 1000 * (static_cast<std::uint64_t>(predicate) + 1) + static_cast<std::uint64_t>(number); }
  friend void PrintTo(const ZeroShare& share, std::ostream* out) { *out << share.name(); }
  std::string name() const { return predicates::kPredicateNames[static_cast<std::size_t>(predicate)] + ("_" + std::to_string(number)); }
};
/// All shares of one program.
inline std::vector<ZeroShare> shares_of(ZeroTest test) {
  std::vector<ZeroShare> list;
  for (const ZeroCases& row : kZeroCases)
    for (int i = 0; row.test == test && i < row.shares; ++i) list.push_back({row.predicate, i});
  return list;
}

/// Decisions at zero, and at their neighbours.
struct ZeroCounts {
  predicates::Decisions zeros, neighbours;

  std::uint64_t at_zero(predicates::Predicate p) const { return zeros(static_cast<std::size_t>(p), robust::Stage::algebra); }
  void expect_neighbours(predicates::Predicate p, const std::vector<robust::Stage>& stages) const {
    for (const robust::Stage s : stages) EXPECT_GT(neighbours(static_cast<std::size_t>(p), s), 0u) << robust::kStageNames[static_cast<std::size_t>(s)];
  }
};

}  // namespace gvd::test
