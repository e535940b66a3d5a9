#include "workload.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "terrain.hpp"

namespace gvd::bench {
namespace {

double area(const kernel::Mesh& mesh, kernel::FaceId f) {
  std::array<double, 3> u, v;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = mesh.point(mesh.origin(3 * f + 1))[k] - mesh.point(mesh.origin(3 * f))[k];
    v[k] = mesh.point(mesh.origin(3 * f + 2))[k] - mesh.point(mesh.origin(3 * f))[k];
  }
  const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  return std::sqrt(x * x + y * y + z * z) / 2;
}

std::string st_helens_path() {
  const char* folder = std::getenv("GVD_TEST_DATA");
  if (folder == nullptr) return {};
  const auto path = std::filesystem::path(folder) / "st_helens_tin.vtk";
  return std::filesystem::exists(path) ? path.string() : std::string();
}

}  // namespace

std::vector<FacePoint> random_points(const kernel::Mesh& mesh, std::uint32_t count, std::uint64_t seed) {
  std::vector<double> upto;
  double total = 0;
  for (kernel::FaceId f = 0; f < mesh.face_count(); ++f) upto.push_back(total += area(mesh, f));
  std::vector<FacePoint> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double at = next_uniform(seed) * total;
    const auto face = static_cast<kernel::FaceId>(std::upper_bound(upto.begin(), upto.end() - 1, at) - upto.begin());
    double s = next_uniform(seed), t = next_uniform(seed);
    if (s + t > 1) {
      s = 1 - s;
      t = 1 - t;
    }
    points.push_back({face, {s, t, 1 - s - t}});
  }
  return points;
}

std::vector<kernel::Source> as_sources(const std::vector<FacePoint>& points) {
  std::vector<kernel::Source> sources;
  for (const FacePoint& p : points) {
    const mpq_class s(p.bary[0]), t(p.bary[1]);
    sources.push_back({{p.face, kernel::kNone, {s, t, 1 - s - t}}, 0});
  }
  return sources;
}

const kernel::Mesh& st_helens() {
  static const kernel::Mesh mesh = [] {
    const std::string path = st_helens_path();
    return kernel::Mesh(generated_terrain(17222, 1));
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
