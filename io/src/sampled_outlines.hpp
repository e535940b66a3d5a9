#pragma once

#include <cstdint>
#include <vector>

#include "gvd/io/arc_sampler.hpp"

namespace gvd::io {

/// All arcs of a diagram as polylines, and the outlines of the pieces made of them, over one common list of points: the vertices of the
/// mesh, then the points of the diagram, then the inner samples of the arcs. Pieces that share an arc share its samples.
class SampledOutlines {
 public:
  SampledOutlines(const kernel::Mesh& mesh, const kernel::Diagram& diagram, double deviation);

  const std::vector<kernel::Point>& points() const noexcept { return points_; }
  /// By the formulas of the arcs; NaN at vertices and at points that no arc touches.
  const std::vector<double>& distance() const noexcept { return distance_; }
  /// Index of a point of the diagram in the list (that of the mesh vertex if it is one).
  std::int64_t index_of(std::uint32_t diagram_point) const;
  /// Points along an arc, ends included.
  std::vector<std::int64_t> arc(std::uint32_t arc) const;
  /// The closed rings of a piece: the outline, counter-clockwise, then the holes, clockwise; first points not repeated.
  std::vector<std::vector<std::int64_t>> rings(const kernel::CellPiece& piece) const;

 private:
  std::vector<std::int64_t> ring(kernel::FaceId face, const std::vector<kernel::CellPiece::Side>& sides) const;
  void add_arc(std::uint32_t index, const std::vector<ArcSample>& samples);

  const kernel::Mesh& mesh_;
  const kernel::Diagram& diagram_;
  std::vector<kernel::Point> points_;
  std::vector<double> distance_;
  std::vector<std::int64_t> first_sample_;  // of arc i; one more entry at the end
};

}  // namespace gvd::io
