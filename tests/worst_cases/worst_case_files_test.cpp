// Replays the worst cases that were found or made by hand: one a line, tests/worst_cases/*.wc.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "support/laid_path.hpp"

namespace gvd::predicates {
namespace {

using robust::Sign;
using test::LaidOut;
using test::LaidPath;

/// The parts of each line between bars, provenance and comments left out.
std::vector<std::vector<std::string>> lines_of(const std::string& file) {
  std::ifstream in(std::string(GVD_SOURCE_DIR "/tests/worst_cases/") + file);
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(in, line);) {
    line = line.substr(0, line.find('#'));
    if (line.empty()) continue;
    std::istringstream parts(line);
    auto& part = lines.emplace_back();
    for (std::string p; std::getline(parts, p, '|');) part.push_back(p);
  }
  return lines;
}

LaidOut strip_of(const std::string& text) {
  const std::size_t semicolon = text.find(';');
  std::istringstream corners(text.substr(0, semicolon)), edges(text.substr(semicolon + 1));
  LaidOut strip;
  std::vector<double> numbers;
  for (std::string word; corners >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) strip.corner.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  for (std::array<std::size_t, 2> edge{}; edges >> edge[0] >> edge[1];) strip.edge.push_back(edge);
  return strip;
}

/// Undecided is allowed for zeros only; every rung that answers agrees.
void expect_sign(const Decision& d, int expected, const std::string& what) {
  EXPECT_TRUE(d.sign.has_value() || expected == 0) << what;
  EXPECT_EQ(static_cast<int>(d.sign.value_or(static_cast<Sign>(expected))), expected) << what;
}

TEST(WorstCaseFiles, CompareLengths) {
  const auto lines = lines_of("compare_lengths.wc");
  EXPECT_FALSE(lines.empty());
  for (const auto& part : lines) {
    ASSERT_EQ(part.size(), 3u);
    const int expected = std::stoi(part[0]);
    const Path a = LaidPath{0, {strip_of(part[1])}}.described(), b = LaidPath{0, {strip_of(part[2])}}.described();
    expect_sign(compare_lengths(a, b), expected, part[1]);
    for (const Rung& rung : kRungs) expect_sign({compare_lengths_at(rung, a, b).value_or(static_cast<Sign>(expected)), rung.stage}, expected, part[1]);
  }
}

TEST(WorstCaseFiles, RaySide) {
  const auto lines = lines_of("ray_side.wc");
  EXPECT_FALSE(lines.empty());
  for (const auto& part : lines) {
    ASSERT_EQ(part.size(), 3u);
    const int expected = std::stoi(part[0]);
    std::istringstream vertices(part[1]);
    std::size_t through = 0, v = 0;
    vertices >> through >> v;
    const FaceStrip strip = strip_of(part[2]).strip();
    for (const Rung& rung : kRungs) expect_sign({ray_side_at(rung, strip, through, v).value_or(static_cast<Sign>(expected)), rung.stage}, expected, part[2]);
  }
}

}  // namespace
}  // namespace gvd::predicates
