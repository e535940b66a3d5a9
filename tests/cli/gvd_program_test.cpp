// Runs the built program as a user does: arguments, exit codes, messages, and the files it leaves.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "support/json_schema.hpp"
#include "support/program.hpp"
#include "support/xml_file.hpp"

using nlohmann::json;
using Names = std::set<std::string>;
namespace test = gvd::test;

namespace {

class GvdProgram : public testing::Test {
 protected:
  test::Outcome run(std::vector<std::string> arguments) { return test::Program(GVD_EXECUTABLE, arguments, streams_).wait(); }

  std::string path(const std::string& name) const { return (root_ / name).string(); }
  std::string file(const std::string& name, const std::string& text) const {
    test::write_file(root_ / name, text);
    return path(name);
  }
  /// A square of side 4 with its middle lifted: four faces.
  std::string tent() const {
    return file("tent.off", "OFF\n5 4 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n2 2 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n");
  }
  std::string sources() const { return file("sources.txt", "v 0\nv 1 # the second\n"); }

  /// Expects the exit code, a message that holds `part`, and that no file appeared.
  void expect_refusal(int code, const std::string& part, const std::vector<std::string>& arguments) {
    const Names before = root_.names();
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << "the message is: " << outcome.err;
    EXPECT_EQ(root_.names(), before);
  }

  test::TemporaryDirectory root_, streams_;
};

TEST_F(GvdProgram, TellsItsVersionAndHelps) {
  EXPECT_EQ(run({"--version"}).out, std::string("gvd ") + GVD_VERSION + "\n");
  for (const std::string command : {"info", "distance", "compute"}) {
    const auto help = run({command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("Examples:\n  gvd " + command), std::string::npos);
    EXPECT_TRUE(help.err.empty());
  }
}

TEST_F(GvdProgram, UsageErrorsEndWithCode2) {
  const std::string mesh = tent(), list = sources(), out = path("out.csv");
  expect_refusal(2, "subcommand", {});
  expect_refusal(2, "subcommand", {"frobnicate"});
  expect_refusal(2, "MESH", {"info"});
  expect_refusal(2, "--sources", {"distance", mesh, "--out", out});
  expect_refusal(2, "--out", {"distance", mesh, "--sources", list});
  expect_refusal(2, "--bogus", {"info", mesh, "--bogus"});
  expect_refusal(2, "'4X' is not a size of memory", {"distance", mesh, "--sources", list, "--out", out, "--max-memory", "4X"});
  expect_refusal(2, "'-1' is not a size of memory", {"distance", mesh, "--sources", list, "--out", out, "--max-memory=-1"});
  expect_refusal(2, "'soon' is not a time", {"distance", mesh, "--sources", list, "--out", out, "--time-limit", "soon"});
  expect_refusal(2, "--threads", {"distance", mesh, "--sources", list, "--out", out, "--threads", "0"});
  expect_refusal(2, "--deviation", {"compute", mesh, "--sources", list, "--out", out, "--deviation", "0"});
}

TEST_F(GvdProgram, OutputPathsThatCannotBeUsedEndWithCode2) {
  const std::string mesh = tent(), list = sources();
  expect_refusal(2, "is not a directory", {"compute", mesh, "--sources", list, "--out", mesh});
  expect_refusal(2, "is not a directory", {"compute", mesh, "--sources", list, "--out", mesh + "/below"});
  expect_refusal(2, "not a regular file", {"distance", mesh, "--sources", list, "--out", root_.path().string()});
  expect_refusal(2, "not a regular file", {"distance", mesh, "--sources", list, "--out", "/dev/null"});
  expect_refusal(2, "names no file", {"distance", mesh, "--sources", list, "--out", path("new/")});
}

TEST_F(GvdProgram, BadInputEndsWithCode3AndWritesNothing) {
  const std::string mesh = tent(), list = sources(), out = path("diagram");
  const std::string letter = file("letter.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 x\n");
  const std::string flat = file("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  const std::string bad = file("bad.txt", "v 0\nv 99\n");
  expect_refusal(3, "missing.vtk", {"compute", path("missing.vtk"), "--sources", list, "--out", out});
  expect_refusal(3, "line 6", {"info", letter});
  expect_refusal(3, "face 0", {"info", flat});
  expect_refusal(3, "line 2", {"compute", mesh, "--sources", bad, "--out", out});
  expect_refusal(3, "0", {"compute", mesh, "--sources", "random:0", "--out", out});
  expect_refusal(3, "nothing.txt", {"compute", mesh, "--sources", path("nothing.txt"), "--out", out});
}

TEST_F(GvdProgram, RefusalWithJsonIsOneObject) {
  const auto outcome = run({"info", path("missing.vtk"), "--json"});
  EXPECT_EQ(outcome.code, 3);
  const json object = json::parse(outcome.out);
  EXPECT_EQ(object["status"], "input_refused");
  EXPECT_NE(object["error"].get<std::string>().find("missing.vtk"), std::string::npos);
}

TEST_F(GvdProgram, InfoCountsTheMesh) {
  const auto outcome = run({"info", tent(), "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json facts = json::parse(outcome.out);
  EXPECT_EQ(facts["vertices"], 5);
  EXPECT_EQ(facts["faces"], 4);
  EXPECT_EQ(facts["edges"], 8);
  EXPECT_EQ(facts["boundary_edges"], 4);
  EXPECT_EQ(facts["euler"], 1);
  EXPECT_EQ(facts["bbox"], json({{0.0, 0.0, 0.0}, {4.0, 4.0, 1.0}}));
  EXPECT_NE(run({"info", tent()}).out.find("boundary_edges        4\n"), std::string::npos);
}

TEST_F(GvdProgram, DistanceWritesTheTable) {
  const auto outcome = run({"distance", tent(), "--sources", sources(), "--out", path("new/d.csv"), "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["status"], "certified");
  EXPECT_EQ(test::read_file(root_ / "new/d.csv"), "vertex,distance,source\n0,0,0\n1,0,1\n2,4,1\n3,4,0\n4,3,0;1\n");
}

TEST_F(GvdProgram, ComputeWritesAllFiles) {
  const auto outcome = run({"compute", tent(), "--sources", sources(), "--out", path("diagram"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["status"], "certified");
  EXPECT_EQ(summary["cells"], 2);
  EXPECT_EQ(summary["gvd_edges"], 1);
  EXPECT_EQ(root_.names(), (Names{"diagram", "diagram/cells.vtp", "diagram/diagram.json", "diagram/diagram.svg", "diagram/diagram.vtp",
                                  "diagram/distances.csv", "sources.txt", "tent.off"}));
  const json diagram = json::parse(test::read_file(root_ / "diagram/diagram.json"));
  const test::SchemaChecker schema(json::parse(test::read_file(GVD_SOURCE_DIR "/docs/diagram-schema.json")));
  EXPECT_EQ(schema.violation(diagram), "");
  EXPECT_EQ(diagram["mesh"]["name"], "tent");
  for (const std::string name : {"diagram.vtp", "cells.vtp", "diagram.svg"})
    EXPECT_NO_THROW(test::parse_xml(test::read_file(root_ / ("diagram/" + name)))) << name;
}

TEST_F(GvdProgram, EqualRunsGiveEqualFilesWhateverTheThreads) {
  const std::string mesh = tent();
  for (const std::string threads : {"1", "2"})
    ASSERT_EQ(run({"compute", mesh, "--sources", "random:3", "--seed", "7", "--out", path("t" + threads), "--threads", threads}).code, 0);
  for (const std::string name : {"distances.csv", "diagram.json", "diagram.vtp", "cells.vtp", "diagram.svg"})
    EXPECT_EQ(test::read_file(root_ / ("t1/" + name)), test::read_file(root_ / ("t2/" + name))) << name;
}

TEST_F(GvdProgram, TellsUnreachableVertices) {
  const std::string mesh = file("two.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 3 4 5\n");
  const auto outcome = run({"compute", mesh, "--sources", file("one.txt", "v 0\n"), "--out", path("diagram")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("3 vertices are unreachable"), std::string::npos);
  EXPECT_TRUE(test::read_file(root_ / "diagram/distances.csv").ends_with("3,inf,-1\n4,inf,-1\n5,inf,-1\n"));
}

TEST_F(GvdProgram, QuietSaysNothingOnStderr) {
  const std::string same = file("same.txt", "v 0\nv 0\n");
  EXPECT_NE(run({"distance", tent(), "--sources", same, "--out", path("d.csv")}).err.find("source 1 lies at the same point as source 0"),
            std::string::npos);
  EXPECT_EQ(run({"distance", tent(), "--sources", same, "--out", path("d.csv"), "--quiet"}).err, "");
}

/// An ASCII grid of n x n heights, rough enough to keep the program busy.
std::string rough_grid(int n) {
  std::string text = "ncols " + std::to_string(n) + "\nnrows " + std::to_string(n) + "\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  unsigned state = 1;
  for (int i = 0; i < n * n; ++i) {
    state = state * 1664525u + 1013904223u;
    text += std::to_string(state >> 16) + "e-5" + ((i + 1) % n == 0 ? "\n" : " ");
  }
  return text;
}

TEST_F(GvdProgram, ATimeLimitEndsWithCode4AndWritesNothing) {
  const std::string mesh = file("rough.asc", rough_grid(200));
  const Names before = root_.names();
  const auto outcome = run({"compute", mesh, "--sources", "random:5", "--out", path("diagram"), "--time-limit", "1ms", "--json"});
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["status"], "time_limit");
  EXPECT_EQ(root_.names(), before);
}

TEST_F(GvdProgram, AMemoryLimitEndsWithCode4AndWritesNothing) {
  const std::string mesh = file("rough.asc", rough_grid(200));
  const Names before = root_.names();
  const auto outcome = run({"compute", mesh, "--sources", "random:5", "--out", path("diagram"), "--max-memory", "1M", "--json"});
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["status"], "memory_limit");
  EXPECT_EQ(root_.names(), before);
}

TEST_F(GvdProgram, SignalsLeaveNothingBehind) {
  const std::string mesh = file("rough.asc", rough_grid(400));
  const Names before = root_.names();
  for (const int signal_number : {SIGINT, SIGTERM}) {
    const test::Program program(GVD_EXECUTABLE, {"compute", mesh, "--sources", "random:5", "--out", path("diagram")}, streams_);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    program.send(signal_number);
    EXPECT_EQ(program.wait().code, 128 + signal_number);
    EXPECT_EQ(root_.names(), before);
  }
}

}  // namespace
