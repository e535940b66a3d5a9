#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "fuzz/campaign/campaign.hpp"
#include "fuzz/properties/planar_layout.hpp"
#include "fuzz/properties/property.hpp"
#include "support/meshes.hpp"
#include "support/temporary_directory.hpp"

namespace gvd::fuzz {
namespace {

constexpr std::uint64_t kSeed = 20230217;

Wish of_size(std::uint32_t size) {
  Wish wish;
  wish.size = size;
  return wish;
}

/// Every property on its own cases; small meshes, so that exact ties are cheap.
class EveryProperty : public testing::TestWithParam<const char*> {};

TEST_P(EveryProperty, Holds) {
  constexpr int kLeast = 8, kMost = 150;
  const Property& property = *find_property(GetParam());
  int held = 0;
  for (std::uint64_t i = 0; i < kMost && held < kLeast; ++i) {
    const std::uint64_t seed = campaign_seed(kSeed, i);
    Wish wish;
    wish.size = 1 + static_cast<std::uint32_t>(i % 3);
    const Case c = make_case(seed, wish);
    Trial trial(c, seed);
    const Outcome outcome = check(property, trial);
    held += outcome.kind == Outcome::Kind::holds ? 1 : 0;
    if (outcome.kind != Outcome::Kind::violated) continue;
    const std::string file = write_finding(c, seed, property.name, outcome.what, testing::TempDir(), 20);
    ADD_FAILURE() << property.name << ": " << outcome.what << "\nseed " << seed << ", mesh and sources in " << file
                  << "\nreplay: gvd fuzz --replay " << file;
  }
  EXPECT_GE(held, kLeast) << "hardly any case for this property";
}

std::vector<const char*> names() {
  std::vector<const char*> list;
  for (const Property& p : properties()) list.push_back(p.name);
  return list;
}
INSTANTIATE_TEST_SUITE_P(Properties, EveryProperty, testing::ValuesIn(names()),
                         [](const auto& entry) { return std::string(entry.param); });

TEST(Campaign, LeavesNoClassEmpty) {
  Tally tally;
  for (std::uint64_t i = 0; i < 250; ++i) {
    Wish wish;
    wish.size = 2 + static_cast<std::uint32_t>(i % 3);
    Choice choice;
    choice.only = "euler";
    const std::uint64_t seed = campaign_seed(kSeed, i);
    tally.add(run_case(seed, wish, choice));
  }
  // Whether anything stays undecided is not for this test to ask for.
  for (const auto& empty : tally.empty_classes())
    if (empty != tag_name(Tag::stage_undecided)) ADD_FAILURE() << "no case has " << empty;
}

TEST(PlanarLayout, KnowsWhatUnfoldsToAConvexRegion) {
  using namespace gvd::test;
  EXPECT_TRUE(planar_layout(kernel::Mesh(flat_grid(3, 2))));
  EXPECT_TRUE(planar_layout(kernel::Mesh(staircase(2, 3))));
  EXPECT_TRUE(planar_layout(kernel::Mesh(roof(2, 3, 8, 6))));
  EXPECT_FALSE(planar_layout(kernel::Mesh(plane_with_hole(5, 5, 2, 3, 2, 3))));
  EXPECT_FALSE(planar_layout(kernel::Mesh(cube(1))));
  EXPECT_FALSE(planar_layout(kernel::Mesh(integer_saddle(1))));
  kernel::MeshArrays bay = flat_grid(3, 3);
  bay.faces.erase(bay.faces.begin() + 2, bay.faces.begin() + 4);
  EXPECT_FALSE(planar_layout(kernel::Mesh(bay)));
}

TEST(Campaign, ResultsReadBackAndMergeIdempotently) {
  std::vector<CaseResult> results;
  Choice choice;
  choice.only = "euler";
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    results.push_back(run_case(seed, of_size(2), choice));
    EXPECT_EQ(parse_line(to_line(results.back())), results.back());
  }
  auto twice = results;
  twice.insert(twice.end(), results.begin(), results.end());
  twice.front().milliseconds += 1;  // run again on another machine
  const auto once = merged(twice);
  EXPECT_EQ(once.size(), results.size());
  EXPECT_EQ(merged(once), once);
  twice.insert(twice.end(), once.begin(), once.end());
  EXPECT_EQ(merged(twice), once);
}

TEST(Campaign, StopsAndGoesOnWithoutLosingOrRepeatingCases) {
  const gvd::test::TemporaryDirectory directory;
  CampaignOptions options;
  options.seed = 5;
  options.cases = 4;
  options.wish.size = 1;
  options.choice.only = "euler";
  options.out = (directory / "results.jsonl").string();
  options.findings = (directory / "findings").string();
  options.quiet = true;
  EXPECT_EQ(run_campaign(options).cases(), 4u);
  const auto first = read_results(options.out);
  std::filesystem::resize_file(options.out, std::filesystem::file_size(options.out) - 10);  // as if it had been killed
  options.cases = 6;
  EXPECT_EQ(run_campaign(options).cases(), 6u);
  const auto all = read_results(options.out);
  ASSERT_EQ(all.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(all[i], first[i]);
  std::set<std::uint64_t> seeds;
  for (const auto& r : all) seeds.insert(r.seed);
  EXPECT_EQ(seeds.size(), 6u);
}

TEST(Campaign, ShardsMakeUpTheWhole) {
  const gvd::test::TemporaryDirectory directory;
  CampaignOptions options;
  options.cases = 5;
  options.wish.size = 1;
  options.choice.only = "euler";
  options.quiet = true;
  options.findings = (directory / "findings").string();
  std::set<std::uint64_t> expected, seen;
  for (std::uint64_t i = 0; i < 5; ++i) expected.insert(campaign_seed(options.seed, i));
  options.shards = 2;
  for (options.shard = 0; options.shard < 2; ++options.shard) {
    options.out = (directory / (std::to_string(options.shard) + ".jsonl")).string();
    run_campaign(options);
    for (const auto& r : read_results(options.out)) EXPECT_TRUE(seen.insert(r.seed).second);
  }
  EXPECT_EQ(seen, expected);
}

TEST(Campaign, AWrittenFindingIsReplayed) {
  const gvd::test::TemporaryDirectory directory;
  const Case c = make_case(11, of_size(2));
  const std::string file = write_finding(c, 11, "renumbering", "made up\nin two lines", directory / "findings", 0);
  const CaseResult again = replay(file, {});
  EXPECT_EQ(again.seed, 11u);
  EXPECT_EQ(again.faces, c.mesh.faces.size());
  EXPECT_EQ(again.held.size() + again.open.size(), 1u);
}

}  // namespace
}  // namespace gvd::fuzz
