#include "fuzz/campaign/against.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <string>

#include "support/program.hpp"
#include "support/temporary_directory.hpp"

namespace gvd::fuzz {
namespace {

using test::Outcome;
using test::Program;
using test::TemporaryDirectory;

constexpr const char* kGvd = GVD_EXECUTABLE " distance {mesh} --sources {sources} --out {out} -q";

TEST(External, TellsHowAProgramEnded) {
  Limits limits;
  EXPECT_EQ(run_external("true", limits).kind, ExternalEnd::Kind::ended);
  const auto failed = run_external("exit 3", limits);
  EXPECT_EQ(failed.kind, ExternalEnd::Kind::failed);
  EXPECT_EQ(failed.number, 3);
  const auto crashed = run_external("kill -SEGV $$", limits);
  EXPECT_EQ(crashed.kind, ExternalEnd::Kind::crashed);
  EXPECT_EQ(crashed.number, SIGSEGV);
}

TEST(External, KillsTheWholeGroupWhenTheTimeIsUp) {
  const TemporaryDirectory directory;
  const std::string left = (directory / "left").string();
  Limits limits;
  limits.seconds = 0.3;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(run_external("(sleep 2; touch " + left + ") & sleep 60", limits).kind, ExternalEnd::Kind::hung);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_EQ(run_external("sleep 3", {}).kind, ExternalEnd::Kind::ended);
  EXPECT_FALSE(std::filesystem::exists(left)) << "a process was left behind";
}

TEST(External, LimitsTheMemory) {
  Limits limits;
  limits.bytes = std::uint64_t{64} << 20;
  const std::string hungry = "awk 'BEGIN { s = \"x\"; for (i = 0; i < 28; ++i) s = s s }'";  // a string of 256 MB
  EXPECT_EQ(run_external(hungry, {}).kind, ExternalEnd::Kind::ended);
  EXPECT_NE(run_external(hungry, limits).kind, ExternalEnd::Kind::ended);
}

class Against : public testing::Test {
 protected:
  Judgement judged(const std::string& command) {
    AgainstOptions options;
    options.command = command;
    return judge(problem, options);
  }
  /// A square of two faces with sources at two corners; distances of the vertices: 0, 1, 1, 0.
  Case problem{
      {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}, {{0, {1, 0, 0}, 0}, {1, {0, 0, 1}, 0}}, "square"};
};

TEST_F(Against, TheProgramItselfIsRight) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Wish wish;
    wish.size = 2;
    problem = make_case(seed, wish);
    const Judgement j = judged(kGvd);
    EXPECT_EQ(j.failure, Failure::none) << j.what;
    EXPECT_EQ(j.worst, 0);
  }
}

TEST_F(Against, EveryClassOfFailureIsTold) {
  EXPECT_EQ(judged("printf '0,0,0\\n1,1,0\\n2,1,1\\n3,0,1\\n' > {out}").failure, Failure::none);
  EXPECT_EQ(judged("kill -ABRT $$").failure, Failure::crashed);
  EXPECT_EQ(judged("exit 1").failure, Failure::refused);
  EXPECT_EQ(judged("true").failure, Failure::no_output);
  EXPECT_EQ(judged("printf '0,0\\n1,1\\n2,1\\n' > {out}").failure, Failure::no_output);
  EXPECT_EQ(judged("printf '0,0\\n1,nan\\n2,1\\n3,0\\n' > {out}").failure, Failure::not_a_number);
  EXPECT_EQ(judged("printf '0,0\\n1,inf\\n2,1\\n3,0\\n' > {out}").failure, Failure::reachability);
  EXPECT_EQ(judged("printf '0,0,1\\n1,1,0\\n2,1,1\\n3,0,1\\n' > {out}").failure, Failure::wrong_label);
  EXPECT_EQ(judged("printf '0,0,0\\n1,1,7\\n2,1,1\\n3,0,1\\n' > {out}").failure, Failure::wrong_label);
  const Judgement wrong = judged("printf '0,0\\n1,1.5\\n2,1\\n3,0\\n' > {out}");
  EXPECT_EQ(wrong.failure, Failure::wrong_distance);
  EXPECT_EQ(wrong.worst, 0.5);
}

TEST_F(Against, TheWitnessIsShrunken) {
  const TemporaryDirectory directory;
  CampaignOptions campaign;
  campaign.cases = 1;
  campaign.wish.family = "flat";
  campaign.wish.size = 3;
  campaign.wish.sources = 3;
  campaign.findings = (directory / "findings").string();
  campaign.quiet = true;
  AgainstOptions options;
  options.command = "echo 0,1e300 > {out}";
  const AgainstReport report = run_against(campaign, options);
  EXPECT_EQ(report.counts.at(Failure::no_output), 1u);
  const Case witness = read_case((directory / "findings" / "against-no_output.off").string());
  EXPECT_EQ(witness.mesh.faces.size(), 1u);
  EXPECT_EQ(witness.sources.size(), 1u);
}

TEST(FuzzCommand, RunsListsAndMerges) {
  const TemporaryDirectory directory;
  const auto file = [&](const char* name) { return (directory / name).string(); };
  EXPECT_EQ(Program(GVD_EXECUTABLE, {"fuzz", "--list"}, directory).wait().code, 0);
  const std::vector<std::string> common = {"fuzz",       "--size",         "1",       "--property", "euler", "-q",
                                           "--findings", file("findings"), "--cases", "4"};
  for (const char* shard : {"0/2", "1/2"}) {
    auto arguments = common;
    arguments.insert(arguments.end(), {"--shard", shard, "--out", file(shard[0] == '0' ? "a.jsonl" : "b.jsonl")});
    const Outcome outcome = Program(GVD_EXECUTABLE, arguments, directory).wait();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  const auto merge = [&](const std::string& out) {
    return Program(GVD_EXECUTABLE, {"fuzz", "merge", file("a.jsonl"), file("b.jsonl"), "--out", file(out.c_str())}, directory)
        .wait();
  };
  EXPECT_EQ(merge("once.jsonl").code, 0);
  EXPECT_EQ(merge("twice.jsonl").code, 0);
  EXPECT_EQ(read_results(file("once.jsonl")).size(), 4u);
  EXPECT_EQ(test::read_file(directory / "once.jsonl"), test::read_file(directory / "twice.jsonl"));
  EXPECT_EQ(Program(GVD_EXECUTABLE, {"fuzz", "--property", "none"}, directory).wait().code, 2);
  EXPECT_EQ(Program(GVD_EXECUTABLE, {"fuzz", "--shard", "2/2"}, directory).wait().code, 2);
}

}  // namespace
}  // namespace gvd::fuzz
