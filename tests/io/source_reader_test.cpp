#include "gvd/io/source_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <locale>

#include "gvd/kernel/error.hpp"
#include "gvd/kernel/random_sources.hpp"
#include "gvd/kernel/surface_point.hpp"

namespace gvd::io {
namespace {

using kernel::exact_position;
using kernel::ExactPoint;
using kernel::Mesh;
using kernel::Source;

/// Three faces side by side; face 1 is turned round. Vertex 5 is isolated.
Mesh strip() {
  return Mesh({{{0, 0, 0}, {2, 0, 0}, {0, 2, 1}, {2, 2, 1}, {4, 2, 0}, {9, 9, 9}}, {{0, 1, 2}, {1, 2, 3}, {1, 4, 3}}});
}

std::vector<Source> parse(const std::string& text, const Mesh& mesh = strip()) {
  SourceReport report;
  return parse_sources(text, "s.txt", mesh, report);
}

ExactPoint position(const std::string& line) {
  const Mesh mesh = strip();
  return exact_position(mesh, parse(line, mesh).at(0).at);
}

std::string refusal(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SourceReader, EachKindOfLine) {
  EXPECT_EQ(position("v 4"), (ExactPoint{4, 2, 0}));
  EXPECT_EQ(position("v 5"), (ExactPoint{9, 9, 9}));
  EXPECT_EQ(position("e 0 1 0.25"), (ExactPoint{mpq_class(1, 2), 0, 0}));
  EXPECT_EQ(position("e 1 0 0.25"), (ExactPoint{mpq_class(3, 2), 0, 0}));
  EXPECT_EQ(position("e 2 1 1"), (ExactPoint{2, 0, 0}));
  EXPECT_EQ(position("f 0 1 1 1"), (ExactPoint{mpq_class(2, 3), mpq_class(2, 3), mpq_class(1, 3)}));
  EXPECT_EQ(position("f 1 1 0 3"), (ExactPoint{2, mpq_class(3, 2), mpq_class(3, 4)}));
  EXPECT_EQ(position("p 1 -3 0"), (ExactPoint{1, 0, 0}));
  EXPECT_EQ(position("xy 0.5 1"), (ExactPoint{mpq_class(1, 2), 1, mpq_class(1, 2)}));
}

TEST(SourceReader, WeightsCommentsBlankLinesAndLineEnds) {
  const auto sources = parse("# all\r\n\r\n  v\t0 w=2.5 # the first\r\nv 1#w=3\n\n \t\nv 2 w=0\r\nv 3");
  ASSERT_EQ(sources.size(), 4u);
  EXPECT_EQ(sources[0].weight, 2.5);
  EXPECT_EQ(sources[1].weight, 0);
  EXPECT_EQ(sources[2].weight, 0);
  for (kernel::VertexId v = 0; v < 4; ++v) EXPECT_EQ(sources[v].at.vertex, v);
  EXPECT_EQ(parse("\xef\xbb\xbfv 1\n").size(), 1u);
}

TEST(SourceReader, NumbersAreTheNearestDoublesTakenAsExact) {
  EXPECT_EQ(position("e 0 1 0.1")[0], mpq_class(0.1) * 2);
  EXPECT_EQ(position("f 0 0.1 0.2 0.3")[0], mpq_class(0.2) * 2 / (mpq_class(0.1) + mpq_class(0.2) + mpq_class(0.3)));
  EXPECT_EQ(position("f 0 1e-300 1e300 1")[2], mpq_class(1) / (mpq_class(1e-300) + mpq_class(1e300) + 1));
  EXPECT_EQ(parse("v 0 w=0.1")[0].weight, 0.1);
  EXPECT_EQ(position("e 0 1 +2.5e-1")[0], mpq_class(1, 2));
}

struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(SourceReader, TheLocaleDoesNotMatter) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
  const ExactPoint found = position("e 0 1 0.5");
  const std::string message = refusal("e 0 1 1.5");
  std::locale::global(before);
  EXPECT_EQ(found[0], 1);
  EXPECT_EQ(message, "s.txt, line 1: the parameter 1.5 on edge 0-1 lies outside [0, 1]");
}

TEST(SourceReader, ReportsTheDistanceOfProjectedPoints) {
  SourceReport report;
  const Mesh mesh = strip();
  parse_sources("v 0\np 5 2 0\nxy 1 0\np 2 0 0\np 4 3 -1\n", "s.txt", mesh, report);
  ASSERT_EQ(report.projected.size(), 3u);
  EXPECT_EQ(report.projected[0].source, 1u);
  EXPECT_EQ(report.projected[0].squared_distance, 1);
  EXPECT_EQ(report.projected[0].distance, 1);
  EXPECT_EQ(report.projected[1].source, 3u);
  EXPECT_EQ(report.projected[1].squared_distance, 0);
  EXPECT_EQ(report.projected[2].squared_distance, 2);
  EXPECT_EQ(report.projected[2].distance, std::sqrt(2.0));
}

TEST(SourceReader, RefusesWhatIsNotASource) {
  EXPECT_EQ(refusal(""), "s.txt: there are no sources in the file");
  EXPECT_EQ(refusal("# v 1\n\n"), "s.txt: there are no sources in the file");
  EXPECT_EQ(refusal("v 0\n\nq 1\n"), "s.txt, line 3: a source begins with v, e, f, p or xy, not with 'q'");
  EXPECT_EQ(refusal("1 2 3"), "s.txt, line 1: a source begins with v, e, f, p or xy, not with '1'");
  EXPECT_EQ(refusal("V 1"), "s.txt, line 1: a source begins with v, e, f, p or xy, not with 'V'");
  EXPECT_EQ(refusal(std::string("v 0\n\x01\x80\0z", 8)), "s.txt, line 2: a source begins with v, e, f, p or xy, not with '???z'");
  EXPECT_EQ(refusal("v 0\nv 1 2\n"), "s.txt, line 2: '2' does not belong to the source");
  EXPECT_EQ(refusal("v 1 w=1 w=2"), "s.txt, line 1: 'w=2' does not belong to the source");
  EXPECT_EQ(refusal("v 1 W=1"), "s.txt, line 1: 'W=1' does not belong to the source");
  EXPECT_EQ(refusal("v 1 w = 1"), "s.txt, line 1: 'w' does not belong to the source");
}

TEST(SourceReader, RefusesIncompleteLines) {
  EXPECT_EQ(refusal("v"), "s.txt, line 1: the source is incomplete: expected 'v INDEX'");
  EXPECT_EQ(refusal("v w=1"), "s.txt, line 1: the source is incomplete: expected 'v INDEX'");
  EXPECT_EQ(refusal("e 0 1\n0.5\n"), "s.txt, line 1: the source is incomplete: expected 'e A B T'");
  EXPECT_EQ(refusal("v 0\nf 0 1 1"), "s.txt, line 2: the source is incomplete: expected 'f FACE B0 B1 B2'");
  EXPECT_EQ(refusal("p 0 1"), "s.txt, line 1: the source is incomplete: expected 'p X Y Z'");
  EXPECT_EQ(refusal("xy 0 # 1"), "s.txt, line 1: the source is incomplete: expected 'xy X Y'");
}

TEST(SourceReader, RefusesWrongNumbers) {
  EXPECT_EQ(refusal("v 6"), "s.txt, line 1: vertex 6 does not exist (there are 6 vertices)");
  EXPECT_EQ(refusal("v -1"), "s.txt, line 1: vertex -1 does not exist (there are 6 vertices)");
  EXPECT_EQ(refusal("v 1.0"), "s.txt, line 1: vertex index is not an integer: '1.0'");
  EXPECT_EQ(refusal("e 0 3 0.5"), "s.txt, line 1: no edge joins vertices 0 and 3");
  EXPECT_EQ(refusal("e 0 0 0.5"), "s.txt, line 1: no edge joins vertices 0 and 0");
  EXPECT_EQ(refusal("e 0 1 1.5"), "s.txt, line 1: the parameter 1.5 on edge 0-1 lies outside [0, 1]");
  EXPECT_EQ(refusal("e 0 1 -1e-300"), "s.txt, line 1: the parameter -1e-300 on edge 0-1 lies outside [0, 1]");
  EXPECT_EQ(refusal("e 0 1 nan"), "s.txt, line 1: T is not finite: 'nan'");
  EXPECT_EQ(refusal("e 0 1 0,5"), "s.txt, line 1: T is not a number: '0,5'");
  EXPECT_EQ(refusal("f 3 1 1 1"), "s.txt, line 1: face 3 does not exist (there are 3 faces)");
  EXPECT_EQ(refusal("f 99999999999 1 1 1"), "s.txt, line 1: face index '99999999999' is not in the range 0 to 4294967294");
  EXPECT_EQ(refusal("f 0 1 1 -1"), "s.txt, line 1: face 0: weight -1 of corner 2 is negative");
  EXPECT_EQ(refusal("f 0 0 0 0"), "s.txt, line 1: face 0: the weights of all corners are zero");
  EXPECT_EQ(refusal("p inf 0 0"), "s.txt, line 1: a coordinate is not finite: 'inf'");
  EXPECT_EQ(refusal("p 1e999 0 0"), "s.txt, line 1: a coordinate is too large for a double: '1e999'");
  EXPECT_EQ(refusal("v 0\nxy 77 0"), "s.txt, line 2: the vertical line at (77, 0) misses the surface");
  EXPECT_EQ(refusal("v 0 w=-1"), "s.txt, line 1: the weight is negative: 'w=-1'");
  EXPECT_EQ(refusal("v 0 w="), "s.txt, line 1: the weight is not a number: ''");
  EXPECT_EQ(refusal("v 0 w=inf"), "s.txt, line 1: the weight is not finite: 'inf'");
}

class SourceSpec : public ::testing::Test {
 protected:
  std::string refused(const std::string& spec) {
    try {
      parse_source_spec(spec, 1, mesh_, report_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  const Mesh mesh_ = strip();
  SourceReport report_;
};

TEST_F(SourceSpec, RandomPointsAndVertices) {
  const auto points = parse_source_spec("random:12", 3, mesh_, report_);
  const auto expected = kernel::random_surface_sources(mesh_, 12, 3);
  ASSERT_EQ(points.size(), 12u);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(points[i].at.bary, expected[i].at.bary);
  const auto vertices = parse_source_spec("vertices:5", 3, mesh_, report_);
  ASSERT_EQ(vertices.size(), 5u);
  for (const Source& s : vertices) EXPECT_LT(s.at.vertex, 5u);
}

TEST_F(SourceSpec, Refusals) {
  for (const std::string bad :
       {"random:", "random:x", "random:-1", "random:1.5", "random: 3", "random:99999999999999999999", "vertices:3x"}) {
    EXPECT_EQ(refused(bad), "sources '" + bad + "': not a number of sources");
  }
  EXPECT_EQ(refused("random:0"), "the number of random sources is 0");
  EXPECT_EQ(refused("vertices:6"), "6 random vertices are asked for, but only 5 belong to faces");
  EXPECT_EQ(refused("no/such/file"), "no/such/file: no such file");
  const std::string folder = std::filesystem::temp_directory_path().string();
  EXPECT_EQ(refused(folder), folder + ": is a directory, not a file of sources");
}

TEST_F(SourceSpec, AFile) {
  const auto file = std::filesystem::temp_directory_path() / "gvd_source_reader_test.txt";
  std::ofstream(file) << "v 1\np 5 2 0 w=1\n";
  const auto sources = parse_source_spec(file.string(), 0, mesh_, report_);
  std::filesystem::remove(file);
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_EQ(sources[1].weight, 1);
  EXPECT_EQ(report_.projected.size(), 1u);
}

}  // namespace
}  // namespace gvd::io
