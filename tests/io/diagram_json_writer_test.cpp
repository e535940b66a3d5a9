#include "gvd/io/diagram_json_writer.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>

#include "gvd/io/summary_writer.hpp"
#include "support/json_schema.hpp"
#include "support/square_diagram.hpp"

using namespace gvd;
using nlohmann::json;

namespace {

json written(const io::ResultView& view) {
  std::ostringstream out;
  io::write_diagram_json(out, view);
  return json::parse(out.str());
}

test::SchemaChecker schema() { return test::SchemaChecker(json::parse(std::ifstream(GVD_SOURCE_DIR "/docs/diagram-schema.json"))); }

TEST(DiagramJsonWriter, FollowsTheSchema) {
  const test::SquareDiagram square;
  EXPECT_EQ(schema().violation(written(square.view())), "");
}

TEST(DiagramJsonWriter, FollowsTheSchemaWithEverythingThatIsRare) {
  test::SquareDiagram square;
  auto& diagram = square.diagram;
  diagram.label_sets.push_back({0, 1});
  diagram.vertices = {{1, {0, 1}, {0, 0}, true}};
  diagram.break_points = {{1, 0}};
  diagram.open_ends = {{2, 0}};
  diagram.shared = {{2, 1.5}};
  diagram.undecided_faces = {1};
  diagram.pieces[0].holes = {{{1, 0, true}, {0, kernel::kNone, false}}};
  diagram.points[1].vertex = 2;
  diagram.points[0].frame[0].high = std::numeric_limits<double>::infinity();
  diagram.arcs[0].root[1] = 4;
  square.summary.status = kernel::Status::undecided;
  predicates::undecided(square.decisions, predicates::Predicate::conflict, "sites 1, 2, 3 in face 0");
  const json written_json = written(square.view());
  EXPECT_EQ(schema().violation(written_json), "");
  EXPECT_EQ(written_json["summary"]["undecided"], json({"sites 1, 2, 3 in face 0"}));
  EXPECT_EQ(written_json["pieces"][0]["holes"][0][0]["point"], 1);
  EXPECT_TRUE(written_json["arcs"][0]["roots"][1].is_null()) << "a vertex of the refined mesh has no id in the input";
}

TEST(DiagramJsonWriter, TheSchemaRefusesWhatIsWrong) {
  const test::SquareDiagram square;
  const json good = written(square.view());
  const auto refused = [&](const char* pointer, const json& value) {
    json bad = good;
    bad[json::json_pointer(pointer)] = value;
    return !schema().violation(bad).empty();
  };
  EXPECT_TRUE(refused("/extra", 1));
  EXPECT_TRUE(refused("/arcs/0/conic", "parabola"));
  EXPECT_TRUE(refused("/arcs/0/weights", json::array({1})));
  EXPECT_TRUE(refused("/pieces/0/outline/0/arc", -1));
  EXPECT_TRUE(refused("/summary/decisions/conflict/guess", 1));
  json lacking = good;
  lacking["edges"][0].erase("ends");
  EXPECT_FALSE(schema().violation(lacking).empty());
}

TEST(DiagramJsonWriter, NumbersComeBackBitForBit) {
  const test::SquareDiagram square(0.7);
  const json read = written(square.view());
  for (std::size_t i = 0; i < square.diagram.points.size(); ++i) {
    const auto& point = square.diagram.points[i];
    EXPECT_EQ(read["points"][i]["position"].get<kernel::Point>(), point.position);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(read["points"][i]["frame"][k][0].get<double>(), point.frame[k].value);
      EXPECT_EQ(read["points"][i]["frame"][k][1].get<double>(), point.frame[k].low);
      EXPECT_EQ(read["points"][i]["frame"][k][2].get<double>(), point.frame[k].high);
    }
  }
  EXPECT_EQ(read["arcs"][1]["weights"][1][0].get<double>(), 0.7);
  EXPECT_EQ(read["arcs"][1]["images"][1][1][0].get<double>(), square.diagram.arcs[1].image[1][1].value);
  EXPECT_EQ(read["sources"][1]["bary"], json({"0", "1", "0"}));
}

TEST(DiagramJsonWriter, NamesTheFramesOfAllFacesInUse) {
  const test::SquareDiagram square;
  const json read = written(square.view());
  ASSERT_EQ(read["frames"].size(), 2u);
  EXPECT_EQ(read["frames"][1], json({{"face", 1}, {"corners", {0, 2, 3}}, {"flipped", false}}));
}

TEST(DiagramJsonWriter, DoesNotDependOnTimes) {
  test::SquareDiagram square;
  std::ostringstream first, second;
  io::write_diagram_json(first, square.view());
  square.summary.seconds = {{"propagate", 99}};
  square.summary.peak_memory_mb = 1;
  io::write_diagram_json(second, square.view());
  EXPECT_EQ(first.str(), second.str());
}

TEST(SummaryWriter, HasExactlyTheKeysOfTheContract) {
  test::SquareDiagram square;
  const auto keys = [](const json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
  };
  using nlohmann::ordered_json;
  const auto summary = ordered_json::parse(io::summary_json(square.summary, square.decisions));
  std::vector<std::string> names;
  for (const auto& [key, value] : summary.items()) names.push_back(key);
  EXPECT_EQ(names, (std::vector<std::string>{"status", "sources", "components", "unreachable_vertices", "windows_propagated", "windows_kept",
                                             "boundary_facets", "cells", "gvd_edges", "gvd_vertices", "break_points", "dual_edges", "ties",
                                             "decisions", "seconds", "peak_memory_mb"}));
  EXPECT_EQ(keys(summary["decisions"]["conflict"]),
            (std::vector<std::string>{"algebra", "double_double", "filter", "identity", "mpfr", "undecided"}));
  EXPECT_EQ(summary["decisions"]["conflict"]["filter"], 1);
  EXPECT_EQ(summary["seconds"]["propagate"], 0.25);
  square.summary.status = kernel::Status::time_limit;
  EXPECT_EQ(json::parse(io::summary_json(square.summary, square.decisions))["status"], "time_limit");
}

TEST(SummaryWriter, FactsHaveExactlyTheKeysOfTheContract) {
  kernel::MeshFacts facts{};
  facts.bbox = {{{0, 1, 2}, {3, 4, 5}}};
  facts.euler = -1;
  const auto read = nlohmann::ordered_json::parse(io::facts_json(facts));
  std::vector<std::string> names;
  for (const auto& [key, value] : read.items()) names.push_back(key);
  EXPECT_EQ(names, (std::vector<std::string>{"vertices", "faces", "edges", "boundary_edges", "boundary_loops", "components", "saddles",
                                             "boundary_relays", "flat_vertices", "flipped_faces", "isolated_vertices", "bbox", "euler"}));
  EXPECT_EQ(read["bbox"][1][2], 5.0);
  EXPECT_EQ(read["euler"], -1);
}

}  // namespace
