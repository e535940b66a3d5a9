#include "gvd/robust/decision.hpp"

#include <gtest/gtest.h>

namespace gvd::robust::test {
namespace {

TEST(DecisionTable, CountsAllButListsNoMoreThanAReaderTakes) {
  using Table = DecisionTable<2>;
  Table a, b;
  for (std::size_t i = 0; i < Table::kMostListed - 1; ++i) a.undecided(0, "a");
  for (int i = 0; i < 3; ++i) b.undecided(1, "b");
  b.count(0, Stage::filter, 5);
  a.merge(b);
  EXPECT_EQ(a(0, Stage::undecided), Table::kMostListed - 1);
  EXPECT_EQ(a(1, Stage::undecided), 3u);
  EXPECT_EQ(a(0, Stage::filter), 5u);
  EXPECT_EQ(a.total(Stage::undecided), Table::kMostListed + 2);
  ASSERT_EQ(a.undecided_list().size(), Table::kMostListed);
  EXPECT_EQ(a.undecided_list().back(), "b");
  a.undecided(1, "one more");
  EXPECT_EQ(a(1, Stage::undecided), 4u);
  EXPECT_EQ(a.undecided_list().back(), "b");
}

}  // namespace
}  // namespace gvd::robust::test
