// CGAL's Surface_mesh_shortest_path for `gvd fuzz --against` (docs/fuzzing.md): distances and nearest sources of all vertices of a
// mesh. Uses a GPL part of CGAL, so it is a program of its own and never installed.
//   cgal_shortest_path [--exact] MESH SOURCES OUT
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>

#include "gvd/io/mesh_reader.hpp"
#include "gvd/io/source_reader.hpp"

namespace {

using namespace gvd;

template <class Kernel>
class Program {
  using CgalMesh = CGAL::Surface_mesh<typename Kernel::Point_3>;
  using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, CgalMesh>;
  using ShortestPath = CGAL::Surface_mesh_shortest_path<Traits>;

 public:
  explicit Program(const kernel::Mesh& mesh) : mesh_(mesh) {
    for (kernel::VertexId v = 0; v < mesh.vertex_count(); ++v)
      cgal_.add_vertex({mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]});
    for (kernel::FaceId f = 0; f < mesh.face_count(); ++f) cgal_.add_face(vertex(3 * f), vertex(3 * f + 1), vertex(3 * f + 2));
  }

  void run(const std::vector<kernel::Source>& sources, std::ostream& out) {
    ShortestPath paths(cgal_);
    std::vector<typename ShortestPath::Source_point_iterator> order;
    for (const auto& source : sources) order.push_back(add(paths, source));
    out.precision(17);
    out << "vertex,distance,source\n";
    for (const auto v : cgal_.vertices()) {
      if (mesh_.is_isolated(static_cast<kernel::VertexId>(v.idx()))) continue;
      const auto [distance, source] = paths.shortest_distance_to_source_points(v);
      out << v.idx() << ',';
      if (source == paths.source_points_end())
        out << "inf,-1\n";
      else
        out << CGAL::to_double(distance) << ',' << std::find(order.begin(), order.end(), source) - order.begin() << '\n';
    }
  }

 private:
  typename CgalMesh::Vertex_index vertex(kernel::HalfedgeId h) const { return typename CgalMesh::Vertex_index(mesh_.origin(h)); }

  /// CGAL counts corners from the source of the face's own half-edge.
  auto add(ShortestPath& paths, const kernel::Source& source) {
    const typename CgalMesh::Face_index face(source.at.face);
    const auto first = cgal_.source(cgal_.halfedge(face)).idx();
    std::size_t shift = 0;
    while (mesh_.origin(3 * source.at.face + static_cast<kernel::HalfedgeId>(shift)) != first) ++shift;
    const auto bary = [&](std::size_t k) { return typename Kernel::FT(source.at.bary[(shift + k) % 3].get_d()); };
    return paths.add_source_point(face, {{bary(0), bary(1), bary(2)}});
  }

  const kernel::Mesh& mesh_;
  CgalMesh cgal_;
};

}  // namespace

int main(int argc, char** argv) {
  const bool exact = argc == 5 && std::strcmp(argv[1], "--exact") == 0;
  if (argc != 4 && !exact) {
    std::cerr << "usage: cgal_shortest_path [--exact] MESH SOURCES OUT\n";
    return 2;
  }
  try {
    char** files = argv + (exact ? 2 : 1);
    const kernel::Mesh mesh(io::read_mesh(files[0]));
    io::SourceReport report;
    const auto sources = io::read_sources(files[1], mesh, report);
    std::ofstream out(files[2]);
    if (exact)
      Program<CGAL::Exact_predicates_exact_constructions_kernel>(mesh).run(sources, out);
    else
      Program<CGAL::Simple_cartesian<double>>(mesh).run(sources, out);
    return out.flush() ? 0 : 1;
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
