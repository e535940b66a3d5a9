// Triangle soups of a few small-integer points: Mesh refuses them with InputError, or its half-edges are consistent.
#include "fuzz_input.hpp"
#include "gvd/kernel/error.hpp"
#include "gvd/kernel/mesh.hpp"

namespace {

using gvd::fuzz::Input;
using gvd::fuzz::require;
using namespace gvd::kernel;

MeshArrays soup(Input& input) {
  MeshArrays arrays;
  arrays.points.resize(input.below(12));
  for (Point& p : arrays.points)
    for (double& x : p) x = static_cast<double>(input.below(5));
  while (!input.empty()) {
    // One index in eight or so may be out of range.
    const auto limit = static_cast<std::uint32_t>(arrays.points.size() + (input.below(8) == 0));
    if (limit == 0) continue;
    arrays.faces.push_back({input.below(limit), input.below(limit), input.below(limit)});
  }
  return arrays;
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const MeshArrays arrays = soup(input);
  try {
    const Mesh mesh(arrays);
    require(mesh.face_count() == arrays.faces.size() && mesh.vertex_count() == arrays.points.size(), "nothing is dropped");
    check_halfedges(mesh);
    check_fans(mesh);
  } catch (const gvd::InputError&) {
  }
  return 0;
}
