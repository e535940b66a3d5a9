#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "gvd/io/result_view.hpp"

namespace gvd::test {

/// A square of side 4 cut along its rising diagonal, source 0 in the lower left corner, source 1 in the lower right one, with the weight w
/// (0 <= w <= 1.5) for source 1. Their diagram is known in closed form: |p| = w + |p - (4,0)|, one GVD edge of two arcs from the lower to the upper side.
class SquareDiagram {
 public:
  explicit SquareDiagram(double w = 1)
      : mesh({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}}), weight_(w) {
    make_sources();
    make_points();
    make_arcs();
    make_pieces();
    make_summary();
  }

  /// x of the bisector at height y.
  double bisector(double y) const {
    const double a = weight_ / 2;
    return 2 + std::sqrt(a * a * (1 + y * y / (4 - a * a)));
  }
  double distance(const kernel::Point& p) const {
    return std::min(std::hypot(p[0], p[1]), weight_ + std::hypot(p[0] - 4, p[1]));
  }
  io::ResultView view() const {
    io::VertexResults vertices;
    for (kernel::VertexId v = 0; v < 4; ++v) vertices.distance.push_back(distance(mesh.point(v)));
    vertices.nearest = [this](kernel::VertexId v) { return std::span(nearest_[v]); };
    return {mesh, diagram, summary, decisions, sources, vertices, {}, "square <&>", "mesh units"};
  }

  kernel::Mesh mesh;
  kernel::Diagram diagram;
  kernel::Summary summary;
  predicates::Decisions decisions;
  std::vector<kernel::Source> sources;

 private:
  /// The frame of a face: face 0 is the plane itself, that of face 1 is turned by 45 degrees.
  static std::array<kernel::Enclosed, 2> in_frame(kernel::FaceId face, double x, double y) {
    const double r = std::sqrt(0.5);
    const auto enclosed = [](double v) { return kernel::Enclosed{v, std::nextafter(v, -9), std::nextafter(v, 9)}; };
    if (face == 0) return {enclosed(x), enclosed(y)};
    return {enclosed(r * (x + y)), enclosed(r * (y - x))};
  }

  void make_sources() {
    sources.resize(2);
    for (kernel::VertexId v = 0; v < 2; ++v) {
      sources[v].at.face = 0;
      sources[v].at.vertex = v;
      sources[v].at.bary = {v == 0 ? 1 : 0, v == 1 ? 1 : 0, 0};
    }
    sources[1].weight = weight_;
    diagram.label_sets = {{0}, {1}};
  }

  void add_point(kernel::FaceId face, double x, double y, std::array<kernel::VertexId, 2> edge) {
    kernel::DiagramPoint point;
    point.face = face;
    point.frame = in_frame(face, x, y);
    point.position = {x, y, 0};
    point.edge = edge;
    diagram.points.push_back(point);
  }
  void make_points() {
    double low = 2, high = 4;  // where the bisector meets the diagonal
    for (int i = 0; i < 100; ++i) {
      const double y = (low + high) / 2;
      (bisector(y) > y ? low : high) = y;
    }
    add_point(0, bisector(0), 0, {0, 1});
    add_point(0, low, low, {0, 2});
    add_point(1, bisector(4), 4, {2, 3});
  }

  void make_arcs() {
    for (kernel::FaceId face = 0; face < 2; ++face) {
      kernel::Arc arc;
      arc.face = face;
      arc.conic = weight_ > 0 ? kernel::Arc::Conic::hyperbola : kernel::Arc::Conic::line;
      arc.node = {face, face + 1};
      arc.image = {in_frame(face, 0, 0), in_frame(face, 4, 0)};
      arc.weight[1] = {weight_, weight_, weight_};
      arc.labels = {0, 1};
      arc.root = {0, 1};
      diagram.arcs.push_back(arc);
    }
    kernel::GvdEdge edge;
    edge.labels = {0, 1};
    edge.arcs = {0, 1};
    edge.end = {0, 2};
    diagram.edges = {edge};
    diagram.boundary_meetings = {{0, 0}, {2, 0}};
  }

  void make_pieces() {
    constexpr auto kCorner = kernel::CellPiece::kCorner;
    constexpr auto kNone = kernel::kNone;
    const auto piece = [&](kernel::FaceId face, kernel::LabelSetId labels, std::vector<kernel::CellPiece::Side> outline) {
      kernel::CellPiece p;
      p.face = face;
      p.labels = labels;
      p.outline = std::move(outline);
      diagram.pieces.push_back(p);
    };
    piece(0, 0, {{kCorner | 0, kNone, false}, {0, 0, false}, {1, kNone, false}});
    piece(0, 1, {{kCorner | 1, kNone, false}, {kCorner | 2, kNone, false}, {1, 0, true}, {0, kNone, false}});
    piece(1, 0, {{kCorner | 0, kNone, false}, {1, 1, false}, {2, kNone, false}, {kCorner | 2, kNone, false}});
    piece(1, 1, {{kCorner | 1, kNone, false}, {2, 1, true}, {1, kNone, false}});
    diagram.face_label = {kNone, kNone};
    diagram.boundary_facets = 2;
    diagram.cells.resize(2);
    for (kernel::SourceId s = 0; s < 2; ++s) {
      diagram.cells[s].source = s;
      diagram.cells[s].neighbours = {1 - s};
      diagram.cells[s].euler = 1;
    }
    diagram.dual = {{{0, 1}, {0}}};
  }

  void make_summary() {
    summary.status = kernel::Status::certified;
    summary.sources = 2;
    summary.components = 1;
    summary.boundary_facets = 2;
    summary.cells = 2;
    summary.gvd_edges = 1;
    summary.dual_edges = 1;
    summary.seconds = {{"propagate", 0.25}};
    summary.peak_memory_mb = 12.5;
    predicates::count(decisions, predicates::Predicate::conflict, robust::Stage::filter);
    nearest_ = {{0}, {1}, {1}, {0}};
  }

  double weight_;
  std::vector<std::vector<kernel::SourceId>> nearest_;
};

}  // namespace gvd::test
