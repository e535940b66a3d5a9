// Triangle soups over a few points with small integer coordinates: Mesh refuses them with InputError, or its half-edges are
// consistent.
#include <array>
#include <vector>

#include "fuzz_input.hpp"
#include "gvd/kernel/error.hpp"
#include "gvd/kernel/mesh.hpp"

namespace {

using gvd::fuzz::Input;
using gvd::fuzz::require;
using namespace gvd::kernel;

std::vector<Point> points(Input& input) {
  std::vector<Point> result(3 + input.below(8));
  for (Point& p : result)
    for (double& x : p) x = static_cast<double>(input.below(5));
  return result;
}

/// One index in about fifty is out of range.
std::array<std::uint32_t, 3> face(Input& input, std::size_t point_count) {
  const auto limit = static_cast<std::uint32_t>(point_count + (input.below(16) == 0));
  return {input.below(limit), input.below(limit), input.below(limit)};
}

void check_halfedges(const Mesh& mesh) {
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    require(mesh.origin(h) != mesh.target(h), "a half-edge has two ends");
    const HalfedgeId twin = mesh.twin(h);
    if (twin == kNone) continue;
    require(mesh.twin(twin) == h, "the twin of the twin is the half-edge");
    require(mesh.origin(twin) == mesh.target(h) && mesh.target(twin) == mesh.origin(h), "twins run against each other");
  }
}

void check_fans(const Mesh& mesh) {
  std::uint32_t corners = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    mesh.for_each_outgoing(v, [&](HalfedgeId h) {
      require(mesh.origin(h) == v, "an outgoing half-edge starts at its vertex");
      ++corners;
    });
  require(corners == mesh.halfedge_count(), "the fan of each vertex holds every corner once");
}

/// Whether the mesh is accepted; if so it must be consistent.
bool accepted(const MeshArrays& arrays) {
  try {
    const Mesh mesh(arrays);
    require(mesh.face_count() == arrays.faces.size() && mesh.vertex_count() == arrays.points.size(), "nothing is dropped");
    check_halfedges(mesh);
    check_fans(mesh);
    return true;
  } catch (const gvd::InputError&) {
    return false;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostFaces = 30;
  Input input(data, size);
  MeshArrays arrays{points(input), {}};
  // A face that is refused is taken away again, so that meshes grow.
  while (!input.empty() && arrays.faces.size() < kMostFaces) {
    arrays.faces.push_back(face(input, arrays.points.size()));
    if (!accepted(arrays)) arrays.faces.pop_back();
  }
  return 0;
}
