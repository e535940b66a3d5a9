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

Yardstick::Yardstick(const kernel::Mesh& mesh, const std::vector<FacePoint>& sources) : impl_(std::make_unique<Impl>(mesh)) {
  for (const FacePoint& p : sources) {
    // CGAL counts corners from the source of the face's own half-edge.
    const CgalMesh::Face_index face(p.face);
    const auto first = impl_->mesh.source(impl_->mesh.halfedge(face)).idx();
    std::size_t shift = 0;
    while (mesh.origin(3 * p.face + static_cast<kernel::HalfedgeId>(shift)) != first) ++shift;
    impl_->paths.add_source_point(face, {{p.bary[shift], p.bary[(shift + 1) % 3], p.bary[(shift + 2) % 3]}});
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
