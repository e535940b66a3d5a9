#include "gvd/kernel/large_array.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <new>

namespace gvd::kernel {
namespace {

struct alignas(128) Line {
  std::uint64_t number;
};

template <class T>
bool begins_at(const LargeArray<T>& array, std::size_t alignment) {
  return reinterpret_cast<std::uintptr_t>(array.data()) % alignment == 0;
}

TEST(LargeArray, BeginsOnAHugePageFromHalfAPageOn) {
  constexpr std::size_t page = HugePages<std::uint32_t>::kPage;
  EXPECT_TRUE(begins_at(LargeArray<std::uint32_t>(page / 2 / sizeof(std::uint32_t)), page));
}

TEST(LargeArray, KeepsItsElementsAcrossTheBorder) {
  LargeArray<Line> lines;
  for (std::uint64_t i = 0; i < 40000; ++i) {
    lines.push_back({i});
    ASSERT_TRUE(begins_at(lines, alignof(Line)));
  }
  for (std::uint64_t i = 0; i < 40000; ++i) ASSERT_EQ(lines[i].number, i);
  const LargeArray<Line> copy = lines;
  lines = {};
  EXPECT_EQ(copy[39999].number, 39999u);
}

TEST(LargeArray, RefusesWhatNoMemoryHolds) {
  HugePages<Line> pages;
  EXPECT_THROW(static_cast<void>(pages.allocate(std::numeric_limits<std::size_t>::max() / sizeof(Line))), std::bad_array_new_length);
  EXPECT_THROW(static_cast<void>(pages.allocate(std::numeric_limits<std::size_t>::max() / sizeof(Line) / 4)), std::bad_alloc);
}

}  // namespace
}  // namespace gvd::kernel
