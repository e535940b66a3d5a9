// VTK legacy polydata and PLY in all encodings, the choice of the format, and what is refused before any format is read.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "io/refusal.hpp"
#include "io/sample_meshes.hpp"

namespace gvd::io {
namespace {

using kernel::MeshArrays;
using test::append;
using test::refusal;
using test::with;
using test::with_crlf;

void expect_square(const std::string& bytes, const std::string& name) {
  MeshArrays mesh;
  ASSERT_NO_THROW(mesh = parse_mesh(bytes, name)) << refusal(bytes, name);
  EXPECT_EQ(mesh.points, test::kSquarePoints);
  EXPECT_EQ(mesh.faces, test::kSquareFaces);
}

TEST(Samples, AllAreTheSameSquare) {
  for (const auto& [name, bytes] : test::square_samples()) {
    SCOPED_TRACE(name);
    expect_square(bytes, name);
    expect_square(bytes, "no_extension_" + name.substr(0, name.find('.')) + (name.ends_with(".obj") ? ".obj" : ""));
  }
}

TEST(VtkReader, AsciiVariants) {
  const std::string text = test::vtk_ascii_4();
  expect_square(with_crlf(text), "a.vtk");
  expect_square(text.substr(0, text.size() - 1), "a.vtk");
  expect_square(with(text, "ASCII\nDATASET POLYDATA", "ascii\ndataset PolyData"), "a.vtk");
  expect_square(with(text, "Version 4.2", "Version 3.0"), "a.vtk");
  expect_square(with(text, "double", "float"), "a.vtk");
  expect_square(with(text, "DATASET POLYDATA\n", "DATASET POLYDATA\nFIELD FieldData 2\nTIME 1 1 double\n0.5\nCYCLE 1 2 int\n1 2\n"), "a.vtk");
  expect_square(with(text, "POLYGONS", "METADATA\nINFORMATION 1\nNAME L2 LOCATION x\nDATA 2 1 2\n\nVERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOLYGONS"), "a.vtk");
  expect_square(text + "POINT_DATA 4\nSCALARS s float\nwhatever follows \x01\x02", "a.vtk");
  // 0.1 in a text file that declares float is the double 0.1.
  EXPECT_EQ(parse_mesh(with(with(text, "double", "float"), "1 0 0.5", "1 0 0.1"), "a.vtk").points[1][2], 0.1);
}

TEST(VtkReader, BinaryVariants) {
  for (const bool is_double : {false, true}) {
    expect_square(test::vtk_binary_4(is_double), "a.vtk");
    for (const bool wide : {false, true}) expect_square(test::vtk_binary_5(is_double, wide), "a.vtk");
  }
  expect_square(with(test::vtk_binary_4(true), "POLYGONS", "METADATA\nINFORMATION 0\n\nPOLYGONS"), "a.vtk");
  std::string lines = "LINES 2 2\nOFFSETS vtktypeint64\n";
  append<std::int64_t>(lines, 0, true);
  append<std::int64_t>(lines, 2, true);
  lines += "\nCONNECTIVITY vtktypeint64\n";
  append<std::int64_t>(lines, 0, true);
  append<std::int64_t>(lines, 1, true);
  expect_square(with(test::vtk_binary_5(true, true), "POLYGONS", lines + "\nPOLYGONS"), "a.vtk");
  expect_square(test::vtk_binary_4(false) + "\nCELL_DATA 2\n", "a.vtk");
}

TEST(VtkReader, Refusals) {
  const std::string text = test::vtk_ascii_4();
  EXPECT_EQ(refusal(with(text, "POLYDATA", "UNSTRUCTURED_GRID"), "a.vtk"), "a.vtk, line 4: data set 'UNSTRUCTURED_GRID' is not read, only POLYDATA");
  EXPECT_EQ(refusal(with(text, "ASCII", "BASE64"), "a.vtk"), "a.vtk, line 3: ASCII or BINARY is expected");
  EXPECT_EQ(refusal(with(text, "POLYGONS 2 8", "TRIANGLE_STRIPS 1 5"), "a.vtk"), "a.vtk, line 10: TRIANGLE_STRIPS are not read (save separate triangles)");
  EXPECT_EQ(refusal(with(text, "double", "quad"), "a.vtk"), "a.vtk, line 5: unknown data type 'quad'");
  EXPECT_EQ(refusal(with(text, "POINTS 4", "POINTS 4294967295"), "a.vtk"),
            "a.vtk, line 5: number of points '4294967295' is not in the range 0 to 4294967294");
  EXPECT_EQ(refusal(with(text, "POINTS 4", "POINTS 40000"), "a.vtk"), "a.vtk, line 5: number of points is 40000, but only 60 bytes of the file are left");
  EXPECT_EQ(refusal(with(text, "POINTS 4", "POINTS 3"), "a.vtk"), "a.vtk, line 9: unknown section '0'");
  EXPECT_EQ(refusal(with(text, "POINTS 4", "POINTS 5"), "a.vtk"), "a.vtk, line 10: coordinate is not a number: 'POLYGONS'");
  EXPECT_EQ(refusal(with(text, "1 0 0.5", "1 0 nan"), "a.vtk"), "a.vtk, line 7: coordinate is not finite: 'nan'");
  EXPECT_EQ(refusal(with(text, "POLYGONS 2 8", "POLYGONS 2 7"), "a.vtk"), "a.vtk, line 12: polygon 1 is not inside the 7 numbers declared");
  EXPECT_EQ(refusal(with(text, "POLYGONS 2 8", "POLYGONS 2 9"), "a.vtk"), "a.vtk, line 12: 2 triangles take 8 numbers, but 9 are declared");
  EXPECT_EQ(refusal(with(text, "POLYGONS 2 8", "POLYGONS 9 8"), "a.vtk"), "a.vtk, line 10: 9 cells cannot be in 8 numbers");
  EXPECT_EQ(refusal(with(text, "3 0 2 3", "4 0 1 2 3"), "a.vtk"), "a.vtk, line 12: polygon 1 has 4 corners; only triangles are read");
  EXPECT_EQ(refusal(with(text, "3 0 2 3", "3 0 2 4"), "a.vtk"), "a.vtk, line 13: polygon 1: vertex 4 does not exist (there are 4 vertices)");
  EXPECT_EQ(refusal(with(text, "3 0 2 3", "3 0 2 -1"), "a.vtk"), "a.vtk, line 12: polygon 1: vertex -1 does not exist");
  EXPECT_EQ(refusal(with(with(text, "3 0 2 3\n", "3 0 2"), "3 0 1 2\n", "3 00 1 2\n"), "a.vtk"),
            "a.vtk, line 12: the file ends where a vertex of a polygon is expected");
  EXPECT_EQ(refusal(text + text.substr(text.find("POLYGONS")), "a.vtk"), "a.vtk, line 13: a second POLYGONS section");
  EXPECT_EQ(refusal(text.substr(0, text.find("POLYGONS")), "a.vtk"), "a.vtk, line 10: the file has no POLYGONS");
  EXPECT_EQ(refusal("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n", "a.vtk"), "a.vtk, line 5: the file has no POINTS");
  EXPECT_EQ(refusal("# vtk DataFile Version 3.0", "a.vtk"), "a.vtk, line 1: the file ends where ASCII or BINARY is expected");
}

TEST(VtkReader, BinaryRefusals) {
  const std::string four = test::vtk_binary_4(true), five = test::vtk_binary_5(true, true);
  EXPECT_EQ(refusal(four.substr(0, four.find("POLYGONS") - 20), "a.vtk"), "a.vtk, line 5: number of points is 4, but only 77 bytes of the file are left");
  EXPECT_EQ(refusal(four.substr(0, four.size() - 6), "a.vtk").find("a.vtk, line"), 0u);
  EXPECT_EQ(refusal(with(four, "POLYGONS 2 8", "POLYGONS 2 4000000000"), "a.vtk").find("size of the cells is 4000000000, but only") != std::string::npos, true);
  const std::string nan = test::vtk_binary_4(true, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(refusal(nan, "a.vtk"), "a.vtk, byte 83: the coordinate before this byte is not finite");
  EXPECT_NE(refusal(with(five, "OFFSETS vtktypeint64", "OFFSETS double"), "a.vtk").find("offsets are not of an integer type"), std::string::npos);
  EXPECT_NE(refusal(with(five, "POLYGONS 3 6", "POLYGONS 3 5"), "a.vtk").find("2 triangles take 6 corners, but 5 are declared"), std::string::npos);
  EXPECT_NE(refusal(with(five, "POLYGONS 3 6", "POLYGONS 2 6"), "a.vtk").find("connectivity is expected"), std::string::npos);
}

TEST(PlyReader, Variants) {
  const std::string text = test::ply_ascii();
  expect_square(with_crlf(text), "a.ply");
  expect_square(text.substr(0, text.size() - 1), "a.ply");
  expect_square(with(text, "vertex_indices", "vertex_index"), "a.ply");
  expect_square(with(text, "comment", "obj_info by\ncomment"), "a.ply");
  for (const bool big : {false, true}) {
    for (const std::string coordinate : {"float", "float64"}) {
      for (const std::string index : {"uchar", "short", "uint16", "int", "uint", "int64"}) {
        SCOPED_TRACE(coordinate + " " + index);
        expect_square(test::ply_binary(big, coordinate, index), "a.ply");
      }
    }
  }
}

TEST(PlyReader, ExtraElementsAndPropertiesArePassedOver) {
  const std::string text = "ply\nformat ascii 1.0\nelement camera 2\nproperty float a\nproperty list uchar int b\nelement none 7\nelement vertex 4\n"
                           "property uchar red\nproperty double y\nproperty double x\nproperty list int float t\nproperty double z\n"
                           "element face 2\nproperty list uchar float uv\nproperty list uint8 int32 vertex_indices\nproperty int flags\n"
                           "element edge 1\nproperty int from\nend_header\n0.5 2 7 8\n1 0\n255 0 0 0 0\n1 0 1 2 9 9 0.5\n2 1 1 1 9 0\n3 1 0 0 -0.25\n"
                           "0 3 0 1 2 5\n2 .1 .2 3 0 2 3 6\n17\n";
  expect_square(text, "a.ply");
}

TEST(PlyReader, Refusals) {
  const std::string text = test::ply_ascii();
  EXPECT_EQ(refusal(with(text, "format ascii 1.0\n", ""), "a.ply"), "a.ply, line 9: the header has no format");
  EXPECT_EQ(refusal(with(text, "ascii 1.0", "ascii 2.0"), "a.ply"), "a.ply, line 2: unknown PLY version '2.0'");
  EXPECT_EQ(refusal(with(text, "ascii", "utf8"), "a.ply"), "a.ply, line 2: unknown PLY format 'utf8'");
  EXPECT_EQ(refusal(with(text, "property double z", "property double w"), "a.ply"),
            "a.ply, line 10: the element 'vertex' needs the scalar properties x, y and z, once each");
  EXPECT_EQ(refusal(with(text, "property double z", "property real z"), "a.ply"), "a.ply, line 7: unknown property type 'real'");
  EXPECT_EQ(refusal(with(text, "property list uchar int", "property list float int"), "a.ply"),
            "a.ply, line 9: the length of a list is not of an integer type");
  EXPECT_NE(refusal(with(text, "vertex_indices", "corners"), "a.ply").find("needs one list property vertex_indices"), std::string::npos);
  EXPECT_EQ(refusal(with(text, "element vertex 4", "element vertex 4000000"), "a.ply"),
            "a.ply, line 10: number of 'vertex' elements is 4000000, but only 46 bytes of the file are left");
  EXPECT_EQ(refusal(with(text, "element vertex 4", "element vertex -4"), "a.ply"),
            "a.ply, line 4: number of elements '-4' is not in the range 0 to 4294967294");
  EXPECT_EQ(refusal(with(text, "element face 2", "element face 1"), "a.ply"), "a.ply, line 16: there is more after the last element that the header declares");
  EXPECT_EQ(refusal(with(text, "element vertex 4", "element vertex 3"), "a.ply"), "a.ply, line 14: face 0 has 0 corners; only triangles are read");
  EXPECT_EQ(refusal(with(text, "3 0 2 3", "4 0 1 2 3"), "a.ply"), "a.ply, line 16: face 1 has 4 corners; only triangles are read");
  EXPECT_EQ(refusal(with(text, "3 0 2 3", "3 0 2 9"), "a.ply"), "a.ply, line 17: face 1: vertex 9 does not exist (there are 4 vertices)");
  EXPECT_EQ(refusal(with(text, "3 0 2 3", "3 0 2 -1"), "a.ply"), "a.ply, line 16: face 1: vertex -1 does not exist");
  EXPECT_EQ(refusal(with(text, "element face 2", "element vertex 2"), "a.ply"), "a.ply, line 8: a second element 'vertex'");
  EXPECT_EQ(refusal("ply\nproperty int x\n", "a.ply"), "a.ply, line 2: a property before the first element");
  EXPECT_EQ(refusal("ply\nbanana\n", "a.ply"), "a.ply, line 2: unknown header line 'banana'");
  EXPECT_EQ(refusal("ply\n", "a.ply"), "a.ply, line 2: the file ends where end_header is expected");
  const std::string binary = test::ply_binary(false, "double", "int");
  EXPECT_EQ(refusal(binary + "x", "a.ply").find("there is more after the last element") != std::string::npos, true);
  EXPECT_EQ(refusal(binary.substr(0, binary.size() - 1), "a.ply").find("a.ply, byte ") == 0, true);
  EXPECT_NE(refusal(with(test::ply_binary(false, "double", "int"), "int vertex_indices", "float vertex_indices"), "a.ply")
                .find("an integer is expected where a floating-point type is declared"), std::string::npos);
}

TEST(Format, Refusals) {
  EXPECT_EQ(refusal("", "a.off"), "a.off: the file is empty");
  EXPECT_EQ(refusal("solid x\nfacet normal 0 0 1\n", "a.stl").substr(0, 100),
            "a.stl: STL is not read, because it does not say which corners of triangles are the same vertex (conv");
  EXPECT_EQ(refusal("solid x\n", "a.txt").find("STL is not read") != std::string::npos, true);
  EXPECT_EQ(refusal(std::string(84, '\x01'), "A.STL").find("STL is not read") != std::string::npos, true);
  EXPECT_EQ(refusal("<?xml version=\"1.0\"?><VTKFile>", "a.vtp"), "a.vtp: XML files are not read (save it as legacy .vtk or as .ply)");
  EXPECT_EQ(refusal("hello\n", "a.txt"), "a.txt: neither the first bytes nor the extension belong to a format that is read "
                                         "(VTK legacy polydata, PLY, OFF, OBJ, ESRI ASCII grid)");
  for (const std::string name : {"a.vtk", "a.ply", "a.off", "a.obj", "a.asc"}) {
    std::string garbage;
    for (int i = 0; i < 1000; ++i) garbage += static_cast<char>(i * i * 31 + 7 * i);
    EXPECT_TRUE(refusal(garbage, name).starts_with(name)) << refusal(garbage, name);
    EXPECT_TRUE(refusal(std::string(50, '\0'), name).starts_with(name));
    EXPECT_TRUE(refusal("\n\n \n", name).starts_with(name));
  }
}

TEST(ReadMesh, Files) {
  const auto folder = std::filesystem::temp_directory_path() / "gvd_binary_reader_test";
  std::filesystem::create_directories(folder);
  const auto file = folder / "square.vtk";
  std::ofstream(file, std::ios::binary) << test::vtk_binary_5(true, true);
  EXPECT_EQ(read_mesh(file).points, test::kSquarePoints);
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      read_mesh(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message(folder / "missing.off"), (folder / "missing.off").string() + ": no such file");
  EXPECT_EQ(message(folder), folder.string() + ": is a directory, not a mesh file");
  std::ofstream(folder / "empty.off", std::ios::binary).flush();
  EXPECT_EQ(message(folder / "empty.off"), (folder / "empty.off").string() + ": the file is empty");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace gvd::io
