// Any bytes as a mesh file: the reader refuses them with InputError, or what it returns has finite points and indices in range.
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "fuzz_input.hpp"
#include "gvd/io/mesh_reader.hpp"
#include "gvd/kernel/error.hpp"

namespace {

using gvd::fuzz::require;

struct Format {
  const char* name;
  const char* begin;  ///< put before the input, so that random bytes get past the first look
};
constexpr std::array<Format, 10> kFormats = {{
    {"x.vtk", ""},
    {"x.vtk", "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"},
    {"x.vtk", "# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOINTS 1 double\n"},
    {"x.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"},
    {"x.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\n"
     "element face 1\nproperty list uchar int vertex_indices\nend_header\n"},
    {"x.off", "OFF\n3 1 0\n"},
    {"x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
    {"x.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n"},
    {"x.asc", ""},
    {"x", ""},
}};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Format& format = kFormats[data[0] % kFormats.size()];
  const std::string bytes = format.begin + std::string(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const auto mesh = gvd::io::parse_mesh(bytes, format.name);
    for (const auto& p : mesh.points)
      for (const double x : p) require(std::isfinite(x), "coordinates are finite");
    for (const auto& face : mesh.faces)
      for (const auto v : face) require(v < mesh.points.size(), "indices are in range");
  } catch (const gvd::InputError& refusal) {
    require(refusal.what()[0] != '\0', "a refusal says why");
  }
  return 0;
}
