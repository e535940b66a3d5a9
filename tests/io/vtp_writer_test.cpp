#include "gvd/io/vtp_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "support/square_diagram.hpp"
#include "support/xml_file.hpp"

using namespace gvd;
using test::data_array;
using test::Xml;

namespace {

using Writer = void (*)(std::ostream&, const io::ResultView&, double);

Xml written(Writer write, const io::ResultView& view, double deviation) {
  std::ostringstream out;
  write(out, view, deviation);
  return test::parse_xml(out.str()).get_child("VTKFile.PolyData");
}

std::size_t declared(const Xml& file, const std::string& what) { return file.get<std::size_t>("Piece.<xmlattr>.NumberOf" + what); }

TEST(DiagramVtp, HasOnePolylineAnEdgeWithItsTwoSources) {
  const test::SquareDiagram square;
  const Xml file = written(io::write_diagram_vtp, square.view(), 1e-4);
  EXPECT_EQ(declared(file, "Lines"), 1u);
  EXPECT_EQ(declared(file, "Polys"), 0u);
  const Xml& cells = file.get_child("Piece.CellData");
  EXPECT_EQ(data_array<std::int32_t>(cells, "left_source"), std::vector<std::int32_t>{0});
  EXPECT_EQ(data_array<std::int32_t>(cells, "right_source"), std::vector<std::int32_t>{1});
  EXPECT_EQ(data_array<std::int32_t>(cells, "edge"), std::vector<std::int32_t>{0});
  const auto line = data_array<std::int64_t>(file.get_child("Piece.Lines"), "connectivity");
  EXPECT_EQ(data_array<std::int64_t>(file.get_child("Piece.Lines"), "offsets").back(), static_cast<std::int64_t>(line.size()));
  EXPECT_EQ(line.size(), declared(file, "Points")) << "the line runs once through every point";
}

TEST(DiagramVtp, PolylineKeepsTheStatedDeviation) {
  const test::SquareDiagram square(1.5);
  for (const double deviation : {1e-2, 1e-4, 1e-6}) {
    const Xml file = written(io::write_diagram_vtp, square.view(), deviation);
    const auto p = data_array<double>(file.get_child("Piece.Points"), "Points");
    const double allowed = data_array<double>(file.get_child("FieldData"), "max_deviation").at(0);
    EXPECT_DOUBLE_EQ(allowed, deviation * std::hypot(4, 4));
    const auto line = data_array<std::int64_t>(file.get_child("Piece.Lines"), "connectivity");
    double worst = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const double* a = &p[3 * static_cast<std::size_t>(line[i])];
      const double* b = &p[3 * static_cast<std::size_t>(line[i + 1])];
      EXPECT_NEAR(a[0], square.bisector(a[1]), 1e-12);
      for (double t = 0.1; t < 1; t += 0.1) {  // horizontal distance: not less than the deviation
        const double x = a[0] + t * (b[0] - a[0]), y = a[1] + t * (b[1] - a[1]);
        worst = std::max(worst, std::abs(x - square.bisector(y)) * std::abs(b[1] - a[1]) / std::hypot(b[0] - a[0], b[1] - a[1]));
      }
    }
    EXPECT_LE(worst, 1.01 * allowed);
    EXPECT_GE(worst, allowed / 30) << "far too many points";
  }
}

TEST(DiagramVtp, NamesTheKindsOfPoints) {
  test::SquareDiagram square;
  square.diagram.break_points = {{1, 0}};
  const Xml file = written(io::write_diagram_vtp, square.view(), 1);
  EXPECT_EQ(data_array<std::int32_t>(file.get_child("Piece.PointData"), "kind"), (std::vector<std::int32_t>{4, 2, 4}));
  const auto distance = data_array<double>(file.get_child("Piece.PointData"), "distance");
  EXPECT_NEAR(distance[0], square.distance(square.diagram.points[0].position), 1e-14);
}

struct Triangles {
  std::vector<double> points, distance;
  std::vector<std::int64_t> corners;
  std::vector<std::int32_t> source;

  double area(std::size_t t) const {
    const double* p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = &points[3 * static_cast<std::size_t>(corners[3 * t + k])];
    return ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])) / 2;
  }
};

Triangles cells(const test::SquareDiagram& square, double deviation) {
  const Xml file = written(io::write_cells_vtp, square.view(), deviation);
  Triangles t{data_array<double>(file.get_child("Piece.Points"), "Points"),
              data_array<double>(file.get_child("Piece.PointData"), "distance"),
              data_array<std::int64_t>(file.get_child("Piece.Polys"), "connectivity"),
              data_array<std::int32_t>(file.get_child("Piece.CellData"), "source")};
  EXPECT_EQ(declared(file, "Polys"), t.source.size());
  EXPECT_EQ(declared(file, "Points"), t.distance.size());
  EXPECT_EQ(t.corners.size(), 3 * t.source.size());
  return t;
}

TEST(CellsVtp, TrianglesTileTheSurfaceAndTheCells) {
  const test::SquareDiagram square;
  const Triangles t = cells(square, 1e-6);
  std::array<double, 2> area{};
  for (std::size_t i = 0; i < t.source.size(); ++i) {
    EXPECT_GT(t.area(i), 0);
    area[static_cast<std::size_t>(t.source[i])] += t.area(i);
  }
  double left = 0;
  constexpr int kSteps = 100'000;
  for (int i = 0; i < kSteps; ++i) left += square.bisector((i + 0.5) * 4 / kSteps) * 4 / kSteps;
  EXPECT_NEAR(area[0] + area[1], 16, 1e-12);
  EXPECT_NEAR(area[0], left, 1e-4);
}

TEST(CellsVtp, PointsCarryTheirDistance) {
  const test::SquareDiagram square;
  const Triangles t = cells(square, 1e-4);
  for (std::size_t i = 0; i < t.distance.size(); ++i)
    EXPECT_NEAR(t.distance[i], square.distance({t.points[3 * i], t.points[3 * i + 1], 0}), 1e-12);
}

TEST(CellsVtp, UnreachableFacesHaveNoSource) {
  test::SquareDiagram square;
  square.diagram.pieces.clear();
  EXPECT_EQ(cells(square, 1e-4).source, (std::vector<std::int32_t>{-1, -1}));
  square.diagram.face_label = {1, kernel::kNone};
  EXPECT_EQ(cells(square, 1e-4).source, (std::vector<std::int32_t>{1, -1}));
}

}  // namespace
