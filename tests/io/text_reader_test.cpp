// OFF, OBJ and ESRI ASCII grids, and what all text formats share.
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>

#include "gvd/kernel/mesh.hpp"
#include "io/refusal.hpp"
#include "io/sample_meshes.hpp"

namespace gvd::io {
namespace {

using kernel::Mesh;
using kernel::MeshArrays;
using kernel::Point;
using test::refusal;
using test::with;
using test::with_crlf;
using Faces = std::vector<std::array<std::uint32_t, 3>>;

const std::string kOff = test::off_text();
const std::vector<Point>& kPoints = test::kSquarePoints;
const Faces& kFaces = test::kSquareFaces;

void expect_square(const std::string& bytes, const std::string& name) {
  SCOPED_TRACE(bytes);
  MeshArrays mesh;
  ASSERT_NO_THROW(mesh = parse_mesh(bytes, name)) << refusal(bytes, name);
  EXPECT_EQ(mesh.points, kPoints);
  EXPECT_EQ(mesh.faces, kFaces);
}

TEST(OffReader, Variants) {
  expect_square(kOff, "a.off");
  expect_square(kOff, "no_extension");
  expect_square("\xef\xbb\xbf" + kOff, "a.off");
  expect_square(with_crlf(kOff), "a.off");
  expect_square(kOff.substr(0, kOff.size() - 1), "a.off");
  expect_square(kOff.substr(4), "no_keyword.off");
  expect_square(with(kOff, "OFF\n", "OFF "), "a.off");
  expect_square(with(kOff, " 5\n", "\n"), "a.off");
  expect_square(with(kOff, "OFF\n", "# a comment\n\n  off # more\n\n# again\n"), "a.off");
  expect_square(with(kOff, "1 0 0.5\n", "\n\t+1  0.0e5 .5 # half\n\n"), "a.off");
  expect_square(with(kOff, "3 0 1 2\n", "3 0 1 2 255 0 0\n"), "a.off");
  expect_square("COFF\n4 2 5\n0 0 0 1 1 1 1\n1 0 0.5 1 1 1\n1 1 0 9\n0 1 -.25 \n3 0 1 2\n3 0 2 3\n", "a.off");
  expect_square("NOFF\n4 2 5\n0 0 0 1 1 1\n1 0 0.5 1 1 1\n1 1 0 9\n0 1 -.25 \n3 0 1 2\n3 0 2 3\n", "a.off");
  expect_square(with(kOff, "OFF", "STCNOFF"), "a.off");
}

TEST(OffReader, Refusals) {
  EXPECT_EQ(refusal(with(kOff, "OFF", "4OFF"), "a.off"), "a.off, line 1: OFF with '4OFF' is not read (only OFF, COFF, NOFF, CNOFF and STOFF)");
  EXPECT_EQ(refusal(with(kOff, "OFF", "nOFF"), "a.off"), "a.off, line 1: OFF with 'nOFF' is not read (only OFF, COFF, NOFF, CNOFF and STOFF)");
  EXPECT_EQ(refusal(with(kOff, "OFF\n", "OFF BINARY\n"), "a.off"),
            "a.off, line 1: binary OFF is not read (save it as ascii or as binary PLY)");
  EXPECT_EQ(refusal(with(kOff, "4 2 5", "-4 2 5"), "a.off"), "a.off, line 2: number of vertices '-4' is not in the range 0 to 4294967294");
  EXPECT_EQ(refusal(with(kOff, "4 2 5", "4.0 2 5"), "a.off"), "a.off, line 2: number of vertices is not an integer: '4.0'");
  EXPECT_EQ(refusal(with(kOff, "4 2 5", "4 2 5 6"), "a.off"), "a.off, line 2: '6' on the line of the numbers of vertices, faces and edges");
  EXPECT_EQ(refusal(with(kOff, "4 2 5", "4000000000 2 5"), "a.off"),
            "a.off, line 2: number of vertices is 4000000000, but only 53 bytes of the file are left");
  EXPECT_EQ(refusal(with(kOff, "4 2 5", "4 900000000 5"), "a.off"),
            "a.off, line 2: number of faces is 900000000, but only 51 bytes of the file are left");
  EXPECT_EQ(refusal(with(kOff, "4 2 5", "99999999999999999999 2 5"), "a.off"),
            "a.off, line 2: number of vertices '99999999999999999999' is not in the range 0 to 4294967294");
  EXPECT_EQ(refusal(with(kOff, "4 2 5", "3 2 5"), "a.off"), "a.off, line 6: face 0 has 0 corners; only triangles are read");
  EXPECT_EQ(refusal(with(kOff, "4 2 5", "5 2 5"), "a.off"), "a.off, line 7: '2' on the line of vertex 4 after its coordinates");
  EXPECT_EQ(refusal(with(kOff, "4 2 5", "4 1 5"), "a.off"), "a.off, line 8: there is more after the last of the 1 faces declared");
  EXPECT_EQ(refusal(with(kOff, "4 2 5", "4 3 5"), "a.off"), "a.off, line 9: the file ends where face 2 is expected");
  EXPECT_EQ(refusal(with(kOff, "1 1 0", "1 1"), "a.off"), "a.off, line 5: vertex 2 has less than three coordinates");
  EXPECT_EQ(refusal(with(kOff, "1 1 0", "1 1 0 0"), "a.off"), "a.off, line 5: '0' on the line of vertex 2 after its coordinates");
  EXPECT_EQ(refusal(with(kOff, "3 0 1 2", "3 0 1 4"), "a.off"), "a.off, line 7: vertex 4 does not exist (there are 4 vertices)");
  EXPECT_EQ(refusal(with(kOff, "3 0 1 2", "3 0 -1 2"), "a.off"), "a.off, line 7: vertex -1 does not exist (there are 4 vertices)");
  EXPECT_EQ(refusal(with(kOff, "3 0 1 2", "3 0 1"), "a.off"), "a.off, line 7: face 0 has less than three corners");
  EXPECT_EQ(refusal(with(kOff, "3 0 2 3", "4 0 1 2 3"), "a.off"), "a.off, line 8: face 1 has 4 corners; only triangles are read");
  EXPECT_EQ(refusal("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "a.off"), "a.off: the mesh has no triangles");
  EXPECT_EQ(refusal("OFF", "a.off"), "a.off, line 1: the file ends where the number of vertices is expected");
}

TEST(Numbers, NearestDoubleWhateverTheLocale) {
  const char* const before = std::setlocale(LC_ALL, nullptr);
  const std::string saved = before;
  for (const char* name : {"C", "de_DE.UTF-8", "fr_FR.UTF-8"}) {
    std::setlocale(LC_ALL, name);  // where it is not installed, the case repeats the one before
    const auto mesh = parse_mesh(with(kOff, "1 0 0.5",
                                      "0.1 2.2250738585072011e-308 179769313486231570814527423731704356798070567525844996598917476803157260780"
                                      "028538760589558632766878171540458953514382464234321326889464182768467546703537516986049910576551282076245490090389"
                                      "328944075868508455133942304583236903222948165808559332123347747979261441438.0"), "a.off");
    EXPECT_EQ(mesh.points[1][0], 0x1.999999999999ap-4);
    EXPECT_EQ(mesh.points[1][1], 0x1.0p-1022 - 0x1p-1074);
    EXPECT_TRUE(std::isfinite(mesh.points[1][2]));
  }
  std::setlocale(LC_ALL, saved.c_str());
}

TEST(Numbers, UnderflowRoundsToZeroAndOverflowIsRefused) {
  const std::string zeros(400, '0');
  for (const std::string& tiny : {std::string("1e-400"), "0." + zeros + "1", std::string("2e-324"), std::string("1e-99999999999999999999999")}) {
    EXPECT_EQ(parse_mesh(with(kOff, "1 0 0.5", "1 0 " + tiny), "a.off").points[1][2], 0.0);
  }
  for (const std::string& huge : {std::string("1e400"), "1" + zeros, std::string("-1.8e308"), std::string("1e99999999999999999999999")}) {
    EXPECT_TRUE(refusal(with(kOff, "1 0 0.5", "1 0 " + huge), "a.off").starts_with("a.off, line 4: coordinate is too large for a double: '"));
  }
  EXPECT_EQ(parse_mesh(with(kOff, "1 0 0.5", "1 0 5e-324"), "a.off").points[1][2], 0x1p-1074);
  EXPECT_EQ(parse_mesh(with(kOff, "1 0 0.5", "1 0 1" + zeros + "e-400"), "a.off").points[1][2], 1.0);
}

TEST(Numbers, Refusals) {
  for (const std::string bad : {"0,5", "0x10", "1.0f", "1e", "--1", "+-1", "+", ".", "e5", "1_000", "\x01\xff"}) {
    EXPECT_TRUE(refusal(with(kOff, "0.5", bad), "a.off").starts_with("a.off, line 4: coordinate is not a number: '")) << bad;
  }
  for (const std::string bad : {"nan", "NaN", "inf", "-inf", "Infinity", "nan(1)"}) {
    EXPECT_EQ(refusal(with(kOff, "0.5", bad), "a.off"), "a.off, line 4: coordinate is not finite: '" + bad + "'");
  }
}

const std::string kObj = "# square\nmtllib a.mtl\nv 0 0 0\nv 1 0 0.5\nv 1 1 0\nv 0 1 -0.25\nf 1 2 3\nf 1 3 4\n";

TEST(ObjReader, Variants) {
  expect_square(kObj, "a.obj");
  expect_square(with_crlf(kObj), "a.OBJ");
  expect_square(kObj.substr(0, kObj.size() - 1), "a.obj");
  expect_square(with(kObj, "f 1 2 3", "f 1/1 2/2 3/3"), "a.obj");
  expect_square(with(kObj, "f 1 2 3", "f 1//1 2//2 3//3"), "a.obj");
  expect_square(with(kObj, "f 1 2 3", "f 1/4/1 -3/-1/2 3/6/3"), "a.obj");
  expect_square(with(kObj, "f 1 2 3", "usemtl x\ns off\no thing\nvn 0 0 1\nvt 0 0\nl 1 2\np 1\n\nf -4 -3 -2 # comment"), "a.obj");
  expect_square(with(kObj, "v 1 1 0", "v 1 1 0 1.0"), "a.obj");
  expect_square(with(kObj, "v 1 1 0", "v 1 1 0 0.1 0.2 0.3"), "a.obj");
  expect_square(with(kObj, "f 1 2 3", "f 1 \\\n2\\\n 3"), "a.obj");
  expect_square("f 1 2 3\nf 1 3 4\n" + kObj.substr(0, kObj.find("f 1 2 3")), "a.obj");
}

TEST(ObjReader, Refusals) {
  EXPECT_EQ(refusal(with(kObj, "f 1 2 3", "f 1 2 3 4"), "a.obj"), "a.obj, line 7: face 0 has 4 corners; only triangles are read");
  EXPECT_EQ(refusal(with(kObj, "f 1 3 4", "f 1 2"), "a.obj"), "a.obj, line 8: face 1 has 2 corners; only triangles are read");
  EXPECT_EQ(refusal(with(kObj, "f 1 3 4", "f 0 3 4"), "a.obj"),
            "a.obj, line 8: face 1: vertex 0 does not exist (indices begin with 1; 4 vertices so far)");
  EXPECT_EQ(refusal(with(kObj, "f 1 3 4", "f 1 3 -5"), "a.obj"),
            "a.obj, line 8: face 1: vertex -5 does not exist (indices begin with 1; 4 vertices so far)");
  EXPECT_EQ(refusal(with(kObj, "f 1 3 4", "f 1 3 5"), "a.obj"),
            "a.obj, line 9: face 1: vertex 5 does not exist (indices begin with 1; 4 vertices in all)");
  EXPECT_EQ(refusal(with(kObj, "f 1 3 4", "f 1 3 x"), "a.obj"), "a.obj, line 8: vertex index is not an integer: 'x'");
  EXPECT_EQ(refusal(with(kObj, "f 1 3 4", "f 1/ 3 4"), "a.obj"), "a.obj, line 8: a corner of a face is not v, v/vt, v//vn or v/vt/vn: '1/'");
  EXPECT_EQ(refusal(with(kObj, "f 1 3 4", "f 1/1/1/1 3 4"), "a.obj"),
            "a.obj, line 8: a corner of a face is not v, v/vt, v//vn or v/vt/vn: '1/1/1/1'");
  EXPECT_EQ(refusal(with(kObj, "v 1 1 0", "v 1 1"), "a.obj"), "a.obj, line 5: vertex 3 has less than three coordinates");
  EXPECT_EQ(refusal(with(kObj, "v 1 1 0", "v 1 1 inf"), "a.obj"), "a.obj, line 5: coordinate is not finite: 'inf'");
  EXPECT_EQ(refusal("v 0 0 0\n", "a.obj"), "a.obj: the mesh has no triangles");
  EXPECT_EQ(refusal("f 1 2 3\n", "a.obj"), "a.obj, line 2: face 0: vertex 3 does not exist (indices begin with 1; 0 vertices in all)");
  EXPECT_EQ(refusal(std::string("\x80\x00\x01\xfe\n\n\x03", 7), "a.obj"), "a.obj: the mesh has no triangles");
}

const std::string kGridHead = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -9999\n";

TEST(GridReader, PlacesHeightsAtCellCentresFromTheNorth) {
  const auto mesh = parse_mesh(kGridHead + "1 2 3\n4 5 6\n", "a.asc");
  const std::vector<Point> points = {{105, 215, 1}, {115, 215, 2}, {125, 215, 3}, {105, 205, 4}, {115, 205, 5}, {125, 205, 6}};
  EXPECT_EQ(mesh.points, points);
  // |2 - 4| = |1 - 5| / 2: the diagonal from south-west to north-east.
  EXPECT_EQ(mesh.faces, (Faces{{3, 4, 1}, {3, 1, 0}, {4, 5, 2}, {4, 2, 1}}));
  const auto centres = parse_mesh(with(with(kGridHead, "xllcorner", "XLLCENTER"), "cellsize 10", "DX 10\nDY 20") + "1 2 3\n4 5 6\n", "a.asc");
  EXPECT_EQ(centres.points[0], (Point{100, 230, 1}));
  EXPECT_EQ(centres.points[5], (Point{120, 210, 6}));
}

TEST(GridReader, DiagonalRule) {
  const std::string head = "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 1\n";
  EXPECT_EQ(parse_mesh(head + "0 5 5 0", "a.asc").faces, (Faces{{2, 3, 1}, {2, 1, 0}})) << "draw: south-west to north-east";
  EXPECT_EQ(parse_mesh(head + "0 5 4 0", "a.asc").faces, (Faces{{0, 2, 3}, {0, 3, 1}}));
  EXPECT_EQ(parse_mesh(head + "1 5 5 0", "a.asc").faces, (Faces{{2, 3, 1}, {2, 1, 0}}));
  EXPECT_EQ(parse_mesh(head + "3 3 3 3", "a.asc").faces, (Faces{{2, 3, 1}, {2, 1, 0}}));
}

TEST(GridReader, NodataLeavesHoles) {
  const std::string head = "NROWS 2\nNCOLS 2\nxllcenter 0\nyllcenter 0\ncellsize 1\nnodata_VALUE -1\n";
  EXPECT_EQ(parse_mesh(head + "-1 1 1 1", "a.asc").faces, (Faces{{1, 2, 0}}));
  EXPECT_EQ(parse_mesh(head + "1 -1.0 1 1", "a.asc").faces, (Faces{{0, 1, 2}}));
  EXPECT_EQ(parse_mesh(head + "1 1 -1 1", "a.asc").faces, (Faces{{0, 2, 1}}));
  EXPECT_EQ(parse_mesh(head + "1 1 1 -1", "a.asc").faces, (Faces{{2, 1, 0}}));
  EXPECT_EQ(refusal(head + "1 1 -1 -1", "a.asc"), "a.asc: the mesh has no triangles");
  EXPECT_EQ(parse_mesh(with(head, "-1", "nan") + "1 1 1 NaN", "a.asc").faces, (Faces{{2, 1, 0}}));
  const std::string standard = with(head, "nodata_VALUE -1\n", "");
  EXPECT_EQ(parse_mesh(standard + "1 1 1 -9999", "a.asc").faces, (Faces{{2, 1, 0}}));
  // A height that no triangle uses is no vertex.
  const auto lonely = parse_mesh(with(head, "NCOLS 2", "NCOLS 4") + "1 1 -1 8\n1 1 -1 -1\n", "a.asc");
  EXPECT_EQ(lonely.points, (std::vector<Point>{{0, 1, 1}, {1, 1, 1}, {0, 0, 1}, {1, 0, 1}}));
}

TEST(GridReader, TwoFansGetTwoVertices) {
  const std::string head = "ncols 3\nnrows 3\nxllcenter 0\nyllcenter 0\ncellsize 1\nnodata_value -1\n";
  const auto pinched = parse_mesh(head + "1 2 3\n-1 5 -1\n6 7 8\n", "a.asc");
  EXPECT_EQ(pinched.points, (std::vector<Point>{{0, 2, 1}, {1, 2, 2}, {2, 2, 3}, {1, 1, 5}, {0, 0, 6}, {1, 0, 7}, {2, 0, 8}, {1, 1, 5}}));
  EXPECT_EQ(pinched.faces, (Faces{{0, 3, 1}, {3, 2, 1}, {4, 5, 7}, {7, 5, 6}}));
  EXPECT_NO_THROW(Mesh{pinched});
  const auto corners = parse_mesh(head + "1 2 -1\n3 5 -1\n-1 -1 8\n", "a.asc");
  EXPECT_EQ(corners.points.size(), 4u);
}

/// Whatever cells have no height, the triangles are a manifold.
TEST(GridReader, EveryPatternOfNodataIsAManifold) {
  const std::string head = "ncols 4\nnrows 4\nxllcenter 0\nyllcenter 0\ncellsize 1\nnodata_value -1\n";
  std::size_t doubled = 0;
  for (unsigned pattern = 0; pattern < (1u << 16); ++pattern) {
    std::string text = head;
    for (unsigned i = 0; i < 16; ++i) text += (pattern >> i & 1) != 0 ? "-1 " : std::to_string(i * 7 % 5) + " ";
    MeshArrays mesh;
    try {
      mesh = parse_mesh(text, "a.asc");
    } catch (const InputError& error) {
      ASSERT_STREQ(error.what(), "a.asc: the mesh has no triangles");
      continue;
    }
    const std::size_t points = mesh.points.size();
    std::sort(mesh.points.begin(), mesh.points.end());
    const auto distinct = std::unique(mesh.points.begin(), mesh.points.end()) - mesh.points.begin();
    doubled += points - static_cast<std::size_t>(distinct);
    try {
      Mesh checked(parse_mesh(text, "a.asc"));
      ASSERT_EQ(checked.flipped_count(), 0u) << text;
      for (kernel::VertexId v = 0; v < checked.vertex_count(); ++v) ASSERT_FALSE(checked.is_isolated(v));
    } catch (const InputError& error) {
      FAIL() << error.what() << "\n" << text;
    }
  }
  EXPECT_GT(doubled, 0u);
}

TEST(GridReader, Refusals) {
  const std::string grid = kGridHead + "1 2 3\n4 5 6\n";
  EXPECT_EQ(refusal(with(grid, "ncols 3\n", ""), "a.asc"), "a.asc, line 6: the header has no ncols");
  EXPECT_EQ(refusal(with(grid, "cellsize 10\n", ""), "a.asc"), "a.asc, line 6: the header has no cellsize");
  EXPECT_EQ(refusal(with(grid, "xllcorner 100\n", ""), "a.asc"), "a.asc, line 6: the header has neither xllcorner nor xllcenter");
  EXPECT_EQ(refusal(with(grid, "xllcorner 100\n", "xllcorner 100\nxllcenter 1\n"), "a.asc"),
            "a.asc, line 8: both xllcorner and xllcenter");
  EXPECT_EQ(refusal(with(grid, "cellsize 10\n", "cellsize 10\ndx 10\n"), "a.asc"), "a.asc, line 8: both cellsize and dx");
  EXPECT_EQ(refusal(with(grid, "nrows 2\n", "nrows 2\nncols 3\n"), "a.asc"), "a.asc, line 3: a second ncols");
  EXPECT_EQ(refusal(with(grid, "nrows 2\n", "nrows\n"), "a.asc"), "a.asc, line 2: nrows has no value");
  EXPECT_EQ(refusal(with(grid, "nrows 2\n", "nrows 2.5\n"), "a.asc"), "a.asc, line 2: nrows is not an integer: '2.5'");
  EXPECT_EQ(refusal(with(grid, "nrows 2\n", "nrows 0\n"), "a.asc"), "a.asc, line 2: nrows '0' is not in the range 1 to 4294967294");
  EXPECT_EQ(refusal(with(grid, "cellsize 10\n", "cellsize 0\n"), "a.asc"), "a.asc, line 7: cellsize is not positive");
  EXPECT_EQ(refusal(with(grid, "cellsize 10\n", "cellsize nan\n"), "a.asc"), "a.asc, line 5: cellsize is not finite: 'nan'");
  EXPECT_EQ(refusal(with(grid, "cellsize 10\n", "cellsize 10\nzunits m\n"), "a.asc"), "a.asc, line 6: unknown header line 'zunits'");
  EXPECT_EQ(refusal(with(grid, "ncols 3\nnrows 2", "ncols 4000000000\nnrows 4000000000"), "a.asc"),
            "a.asc, line 7: the number of heights is 16000000000000000000, but only 12 bytes of the file are left");
  EXPECT_EQ(refusal(with(grid, "4 5 6\n", "4 55\n"), "a.asc"),
            "a.asc, line 9: the file ends where the height of row 2, column 3 is expected (2 rows of 3 columns, from 1)");
  EXPECT_EQ(refusal(with(grid, "4 5 6\n", "4 5 6 7\n"), "a.asc"), "a.asc, line 8: there is more after 2 rows of 3 heights");
  EXPECT_EQ(refusal(with(grid, "4 5 6\n", "4 nan 6\n"), "a.asc"), "a.asc, line 8: height is not finite: 'nan'");
  EXPECT_EQ(refusal(with(grid, "4 5 6\n", "4 5,5 6\n"), "a.asc"), "a.asc, line 8: height is not a number: '5,5'");
  EXPECT_EQ(refusal("ncols 1\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3", "a.asc"), "a.asc: the mesh has no triangles");
}

}  // namespace
}  // namespace gvd::io
