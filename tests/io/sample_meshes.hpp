#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "io/refusal.hpp"

/// One square of two triangles in every format and encoding that is read.
namespace gvd::test {

inline const std::vector<kernel::Point> kSquarePoints = {{0, 0, 0}, {1, 0, 0.5}, {1, 1, 0}, {0, 1, -0.25}};
inline const std::vector<std::array<std::uint32_t, 3>> kSquareFaces = {{0, 1, 2}, {0, 2, 3}};

inline std::string off_text() { return "OFF\n4 2 5\n0 0 0\n1 0 0.5\n1 1 0\n0 1 -2.5e-1\n3 0 1 2\n3 0 2 3\n"; }
inline std::string obj_text() { return "v 0 0 0\nv 1 0 0.5\nv 1 1 0\nv 0 1 -0.25\nf 1/1 2/1 3//1\nf -4 3 4\n"; }

inline std::string vtk_ascii_4() {
  return "# vtk DataFile Version 4.2\na title\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 0\n1 0 0.5\n1 1 0\n0 1 -0.25\n"
         "POLYGONS 2 8\n3 0 1 2\n3 0 2 3\n";
}
inline std::string vtk_ascii_5() {
  return "# vtk DataFile Version 5.1\na title\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0.5 1 1 0\n0 1 -0.25\n\n"
         "METADATA\nINFORMATION 0\n\nPOLYGONS 3 6\nOFFSETS vtktypeint64\n0 3 6\nCONNECTIVITY vtktypeint64\n0 1 2 0 2 3\n";
}

inline std::string vtk_binary_points(const std::string& version, bool is_double, double first = 0) {
  std::string bytes = "# vtk DataFile Version " + version + "\na title\nBINARY\nDATASET POLYDATA\nPOINTS 4 " + (is_double ? "double" : "float") + "\n";
  for (const auto& point : kSquarePoints) {
    for (const double& x : point) {
      const double value = &x == &kSquarePoints[0][0] ? first : x;
      if (is_double) {
        append<double>(bytes, value, true);
      } else {
        append<float>(bytes, static_cast<float>(value), true);
      }
    }
  }
  return bytes + "\n";
}

/// `first` replaces the first coordinate.
inline std::string vtk_binary_4(bool is_double, double first = 0) {
  std::string bytes = vtk_binary_points("3.0", is_double, first) + "POLYGONS 2 8\n";
  for (const auto& face : kSquareFaces) {
    append<std::int32_t>(bytes, 3, true);
    for (const auto v : face) append<std::uint32_t>(bytes, v, true);
  }
  return bytes + "\n";
}

inline std::string vtk_binary_5(bool is_double, bool wide) {
  std::string bytes = vtk_binary_points("5.1", is_double);
  const auto add = [&](std::uint32_t number) { wide ? append<std::int64_t>(bytes, number, true) : append<std::uint32_t>(bytes, number, true); };
  const std::string type = wide ? "vtktypeint64" : "vtktypeint32";
  bytes += "POLYGONS 3 6\nOFFSETS " + type + "\n";
  for (const std::uint32_t offset : {0u, 3u, 6u}) add(offset);
  bytes += "\nCONNECTIVITY " + type + "\n";
  for (const auto& face : kSquareFaces) {
    for (const auto v : face) add(v);
  }
  return bytes + "\n";
}

inline std::string ply_ascii() {
  return "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 2\n"
         "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0.5\n1 1 0\n0 1 -0.25\n3 0 1 2\n3 0 2 3\n";
}

/// Coordinates of type float or double (float64), indices of any integer type.
inline std::string ply_binary(bool big, const std::string& coordinate, const std::string& index) {
  std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\nelement vertex 4\n";
  for (const char axis : {'x', 'y', 'z'}) bytes += "property " + coordinate + " " + axis + "\n";
  bytes += "property uchar red\nelement face 2\nproperty list uchar " + index + " vertex_indices\nend_header\n";
  for (const auto& point : kSquarePoints) {
    for (const double x : point) {
      if (coordinate == "float") {
        append<float>(bytes, static_cast<float>(x), big);
      } else {
        append<double>(bytes, x, big);
      }
    }
    bytes += '\xff';
  }
  for (const auto& face : kSquareFaces) {
    bytes += '\x03';
    for (const auto v : face) {
      if (index == "uchar") append<std::uint8_t>(bytes, static_cast<std::uint8_t>(v), big);
      if (index == "short" || index == "uint16") append<std::uint16_t>(bytes, static_cast<std::uint16_t>(v), big);
      if (index == "int" || index == "uint") append<std::uint32_t>(bytes, v, big);
      if (index == "int64") append<std::uint64_t>(bytes, v, big);
    }
  }
  return bytes;
}

/// File names and bytes.
inline std::map<std::string, std::string> square_samples() {
  return {{"ascii4.vtk", vtk_ascii_4()},
          {"ascii5.vtk", vtk_ascii_5()},
          {"float4.vtk", vtk_binary_4(false)},
          {"double4.vtk", vtk_binary_4(true)},
          {"narrow5.vtk", vtk_binary_5(false, false)},
          {"wide5.vtk", vtk_binary_5(true, true)},
          {"ascii.ply", ply_ascii()},
          {"little.ply", ply_binary(false, "double", "int")},
          {"big.ply", ply_binary(true, "float", "uchar")},
          {"text.off", off_text()},
          {"text.obj", obj_text()}};
}

}  // namespace gvd::test
