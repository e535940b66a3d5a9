#include "workload.hpp"

#include <cstdlib>
#include <filesystem>

#include "gvd/io/mesh_reader.hpp"
#include "terrain.hpp"

namespace gvd::bench {
namespace {

std::string st_helens_path() {
  const char* folder = std::getenv("GVD_TEST_DATA");
  if (folder == nullptr) return {};
  const auto path = std::filesystem::path(folder) / "st_helens_tin.vtk";
  return std::filesystem::exists(path) ? path.string() : std::string();
}

}  // namespace

const kernel::Mesh& st_helens() {
  static const kernel::Mesh mesh = [] {
    const std::string path = st_helens_path();
    return kernel::Mesh(path.empty() ? generated_terrain(17222, 1) : io::read_mesh(path));
  }();
  return mesh;
}

std::string st_helens_name() { return st_helens_path().empty() ? "generated terrain" : "St Helens TIN"; }

const kernel::Mesh& terrain(std::uint32_t faces) {
  static std::uint32_t kept_faces = 0;
  static kernel::Mesh kept;
  if (kept_faces != faces) kept = kernel::Mesh(generated_terrain(faces, 1));
  kept_faces = faces;
  return kept;
}

}  // namespace gvd::bench
