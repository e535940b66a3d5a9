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

const kernel::MeshArrays& st_helens_arrays() {
  static const kernel::MeshArrays arrays = [] {
    const std::string path = st_helens_path();
    return path.empty() ? generated_terrain(17222, 1) : io::read_mesh(path);
  }();
  return arrays;
}

const kernel::Mesh& st_helens() {
  static const kernel::Mesh mesh(st_helens_arrays());
  return mesh;
}

std::string st_helens_name() { return st_helens_path().empty() ? "generated terrain" : "St Helens TIN"; }

const kernel::MeshArrays& terrain(std::uint32_t faces) {
  static std::uint32_t kept_faces = 0;
  static kernel::MeshArrays kept;
  if (kept_faces != faces) kept = generated_terrain(faces, 1);
  kept_faces = faces;
  return kept;
}

}  // namespace gvd::bench
