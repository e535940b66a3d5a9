#include "gvd/kernel/mesh_facts.hpp"

#include <algorithm>
#include <numeric>

#include "gvd/kernel/vertex_kind.hpp"

namespace gvd::kernel {
namespace {

std::uint32_t count_components(const Mesh& mesh) {
  std::vector<std::uint8_t> seen(mesh.face_count(), 0);
  std::vector<FaceId> open;
  std::uint32_t components = 0;
  for (FaceId seed = 0; seed < mesh.face_count(); ++seed) {
    if (seen[seed]) continue;
    ++components;
    seen[seed] = 1;
    open.assign(1, seed);
    while (!open.empty()) {
      const FaceId f = open.back();
      open.pop_back();
      for (HalfedgeId h = 3 * f; h < 3 * f + 3; ++h) {
        const HalfedgeId t = mesh.twin(h);
        if (t == kNone || seen[Mesh::face(t)]) continue;
        seen[Mesh::face(t)] = 1;
        open.push_back(Mesh::face(t));
      }
    }
  }
  return components;
}

/// Each boundary vertex starts one boundary half-edge, so the boundary is a permutation of these vertices; its cycles are the
/// loops.
std::uint32_t count_boundary_loops(const Mesh& mesh) {
  std::vector<std::uint8_t> seen(mesh.vertex_count(), 0);
  std::uint32_t loops = 0;
  for (VertexId start = 0; start < mesh.vertex_count(); ++start) {
    if (seen[start] || !mesh.is_boundary(start)) continue;
    ++loops;
    for (VertexId v = start; !seen[v]; v = mesh.target(mesh.outgoing(v))) seen[v] = 1;
  }
  return loops;
}

std::array<Point, 2> bounding_box(const Mesh& mesh) {
  if (mesh.vertex_count() == 0) return {};
  std::array<Point, 2> box{mesh.point(0), mesh.point(0)};
  for (VertexId v = 1; v < mesh.vertex_count(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      box[0][k] = std::min(box[0][k], mesh.point(v)[k]);
      box[1][k] = std::max(box[1][k], mesh.point(v)[k]);
    }
  }
  return box;
}

void count_kinds(const Mesh& mesh, predicates::Decisions& decisions, MeshFacts& facts) {
  const auto& [kinds, found] = kept_vertex_kinds(mesh);
  decisions.merge(found);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.is_isolated(v)) {
      ++facts.isolated_vertices;
    } else if (kinds[v] == VertexKind::relay) {
      ++(mesh.is_boundary(v) ? facts.boundary_relays : facts.saddles);
    } else if (kinds[v] == VertexKind::flat && !mesh.is_boundary(v)) {
      ++facts.flat_vertices;
    }
  }
}

}  // namespace

MeshFacts facts(const Mesh& mesh, predicates::Decisions& decisions) {
  MeshFacts facts{};
  facts.vertices = mesh.vertex_count();
  facts.faces = mesh.face_count();
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) facts.boundary_edges += mesh.twin(h) == kNone ? 1 : 0;
  facts.edges = (mesh.halfedge_count() - facts.boundary_edges) / 2 + facts.boundary_edges;
  facts.boundary_loops = count_boundary_loops(mesh);
  facts.components = count_components(mesh);
  facts.flipped_faces = mesh.flipped_count();
  facts.bbox = bounding_box(mesh);
  count_kinds(mesh, decisions, facts);
  facts.euler = std::int64_t{facts.vertices} - facts.isolated_vertices - facts.edges + facts.faces;
  return facts;
}

}  // namespace gvd::kernel
