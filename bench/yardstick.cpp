#include "yardstick.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <limits>

namespace gvd::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, CgalMesh>;
using ShortestPath = CGAL::Surface_mesh_shortest_path<Traits>;

CgalMesh as_cgal(const kernel::Mesh& mesh) {
  CgalMesh out;
  for (kernel::VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const kernel::Point& p = mesh.point(v);
    out.add_vertex({p[0], p[1], p[2]});
  }
  for (kernel::FaceId f = 0; f < mesh.face_count(); ++f)
    out.add_face(CgalMesh::Vertex_index(mesh.origin(3 * f)), CgalMesh::Vertex_index(mesh.origin(3 * f + 1)),
                 CgalMesh::Vertex_index(mesh.origin(3 * f + 2)));
  return out;
}

}  // namespace

struct Yardstick::Impl {
  explicit Impl(const kernel::Mesh& from) : mesh(as_cgal(from)), paths(mesh) {}
  CgalMesh mesh;
  ShortestPath paths;
};

Yardstick::Yardstick(const kernel::Mesh& mesh, const std::vector<kernel::Source>& sources) : impl_(std::make_unique<Impl>(mesh)) {
  for (const kernel::Source& source : sources) {
    // CGAL counts corners from the source of the face's own half-edge.
    const kernel::FaceId f = source.at.face;
    const CgalMesh::Face_index face(f);
    const auto first = impl_->mesh.source(impl_->mesh.halfedge(face)).idx();
    std::size_t shift = 0;
    while (mesh.origin(3 * f + static_cast<kernel::HalfedgeId>(shift)) != first) ++shift;
    const auto bary = [&](std::size_t k) { return source.at.bary[(shift + k) % 3].get_d(); };
    impl_->paths.add_source_point(face, {{bary(0), bary(1), bary(2)}});
  }
}

Yardstick::~Yardstick() = default;

void Yardstick::propagate() { impl_->paths.build_sequence_tree(); }

std::vector<double> Yardstick::distances() {
  std::vector<double> result;
  for (const auto v : impl_->mesh.vertices()) {
    const auto found = impl_->paths.shortest_distance_to_source_points(v);
    result.push_back(found.second == impl_->paths.source_points_end() ? std::numeric_limits<double>::infinity() : found.first);
  }
  return result;
}

}  // namespace gvd::bench
