#include "gvd/io/distances_writer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <sstream>

using namespace gvd;

namespace {

std::string written(std::vector<double> distance, std::vector<std::vector<kernel::SourceId>> nearest) {
  std::ostringstream out;
  io::write_distances(out, {std::move(distance), [&](kernel::VertexId v) { return std::span<const kernel::SourceId>(nearest[v]); }});
  return out.str();
}

TEST(DistancesWriter, WritesTiesAndUnreachableVertices) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(written({0, 0.1 + 0.2, infinity, 1e300}, {{5}, {3, 17}, {}, {0}}),
            "vertex,distance,source\n0,0,5\n1,0.30000000000000004,3;17\n2,inf,-1\n3,1e+300,0\n");
}

TEST(DistancesWriter, WritesTheHeaderOfAnEmptyMesh) { EXPECT_EQ(written({}, {}), "vertex,distance,source\n"); }

RC_GTEST_PROP(DistancesWriter, DistancesComeBackBitForBit, (std::uint64_t bits)) {
  double distance;
  std::memcpy(&distance, &bits, sizeof distance);
  RC_PRE(std::isfinite(distance));
  const std::string text = written({distance}, {{0}});
  const auto comma = text.find("\n0,") + 3;
  RC_ASSERT(std::strtod(text.c_str() + comma, nullptr) == distance);
}

TEST(DistancesWriter, WritesEveryLineOfALongTable) {
  const std::size_t count = 20'000;
  const std::string text = written(std::vector<double>(count, 1.0 / 3), std::vector<std::vector<kernel::SourceId>>(count, {1}));
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), count + 1);
  EXPECT_TRUE(text.ends_with("\n19999,0.3333333333333333,1\n"));
}

}  // namespace
