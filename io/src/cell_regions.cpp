#include "cell_regions.hpp"

#include <algorithm>

#include "drawn_source.hpp"

namespace gvd::io {

namespace {

/// The drawn source of each face that belongs to it wholly and is seen; -1 for all others.
std::vector<std::int32_t> sources_of_whole_faces(const kernel::Mesh& mesh, const kernel::Diagram& diagram, const PlanView& view) {
  std::vector<std::int32_t> source(mesh.face_count(), -1);
  for (kernel::FaceId f = 0; f < mesh.face_count(); ++f)
    if (view.is_seen(f)) source[f] = drawn_source(diagram, diagram.face_label[f]);
  return source;
}

}  // namespace

std::vector<std::vector<std::vector<kernel::VertexId>>> whole_face_loops(const kernel::Mesh& mesh, const kernel::Diagram& diagram,
                                                                         const PlanView& view) {
  const auto source = sources_of_whole_faces(mesh, diagram, view);
  const auto same_side = [&](kernel::HalfedgeId h) {
    const auto twin = mesh.twin(h);
    return twin != kernel::kNone && source[mesh.face(twin)] == source[mesh.face(h)];
  };
  std::vector<std::vector<std::vector<kernel::VertexId>>> loops(diagram.cells.size());
  std::vector<char> done(mesh.halfedge_count(), 0);
  for (kernel::HalfedgeId start = 0; start < mesh.halfedge_count(); ++start) {
    const auto s = source[mesh.face(start)];
    if (s < 0 || done[start] != 0 || same_side(start)) continue;
    std::vector<kernel::VertexId> loop;
    for (auto h = start; done[h] == 0;) {
      done[h] = 1;
      loop.push_back(mesh.origin(h));
      h = mesh.next(h);
      while (same_side(h)) h = mesh.next(mesh.twin(h));  // round the target to the next side of the region
    }
    loops[static_cast<std::size_t>(s)].push_back(std::move(loop));
  }
  return loops;
}

std::vector<unsigned> colour_cells(const kernel::Diagram& diagram, unsigned colours) {
  std::vector<unsigned> colour(diagram.cells.size(), colours);
  std::vector<std::size_t> used(colours, 0);
  for (std::size_t c = 0; c < diagram.cells.size(); ++c) {
    std::vector<std::size_t> cost = used;  // prefer a free colour that is rare so far
    for (const auto neighbour : diagram.cells[c].neighbours)
      if (colour[neighbour] < colours) cost[colour[neighbour]] += diagram.cells.size() + 1;
    colour[c] = static_cast<unsigned>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    ++used[colour[c]];
  }
  return colour;
}

}  // namespace gvd::io
