#include "sampled_outlines.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace gvd::io {

SampledOutlines::SampledOutlines(const kernel::Mesh& mesh, const kernel::Diagram& diagram, double deviation)
    : mesh_(mesh), diagram_(diagram) {
  for (kernel::VertexId v = 0; v < mesh.vertex_count(); ++v) points_.push_back(mesh.point(v));
  for (const auto& point : diagram.points) points_.push_back(point.position);
  distance_.assign(points_.size(), std::numeric_limits<double>::quiet_NaN());
  const ArcSampler sampler(mesh, diagram, deviation);
  for (std::uint32_t i = 0; i < diagram.arcs.size(); ++i) add_arc(i, sampler.sample(i));
  first_sample_.push_back(static_cast<std::int64_t>(points_.size()));
}

void SampledOutlines::add_arc(std::uint32_t index, const std::vector<ArcSample>& samples) {
  const auto& node = diagram_.arcs[index].node;
  distance_[mesh_.vertex_count() + node[0]] = samples.front().distance;
  distance_[mesh_.vertex_count() + node[1]] = samples.back().distance;
  first_sample_.push_back(static_cast<std::int64_t>(points_.size()));
  for (std::size_t k = 1; k + 1 < samples.size(); ++k) {
    points_.push_back(samples[k].position);
    distance_.push_back(samples[k].distance);
  }
}

std::int64_t SampledOutlines::index_of(std::uint32_t diagram_point) const {
  const auto vertex = diagram_.points[diagram_point].vertex;
  return vertex != kernel::kNone ? std::int64_t{vertex} : std::int64_t{mesh_.vertex_count()} + diagram_point;
}

std::vector<std::int64_t> SampledOutlines::arc(std::uint32_t index) const {
  const auto& node = diagram_.arcs[index].node;
  std::vector<std::int64_t> chain(2 + static_cast<std::size_t>(first_sample_[index + 1] - first_sample_[index]));
  std::iota(chain.begin() + 1, chain.end() - 1, first_sample_[index]);
  chain.front() = index_of(node[0]);
  chain.back() = index_of(node[1]);
  return chain;
}

std::vector<std::vector<std::int64_t>> SampledOutlines::rings(const kernel::CellPiece& piece) const {
  std::vector<std::vector<std::int64_t>> rings = {ring(piece.face, piece.outline)};
  for (const auto& hole : piece.holes) rings.push_back(ring(piece.face, hole));
  return rings;
}

std::vector<std::int64_t> SampledOutlines::ring(kernel::FaceId face, const std::vector<kernel::CellPiece::Side>& sides) const {
  std::vector<std::int64_t> polygon;
  for (const auto& side : sides) {
    if (side.arc == kernel::kNone) {
      const bool corner = (side.from & kernel::CellPiece::kCorner) != 0;
      const auto k = side.from & ~kernel::CellPiece::kCorner;
      polygon.push_back(corner ? std::int64_t{mesh_.origin(3 * face + k)} : index_of(side.from));
    } else {
      auto chain = arc(side.arc);
      if (side.reversed) std::reverse(chain.begin(), chain.end());
      polygon.insert(polygon.end(), chain.begin(), chain.end() - 1);
    }
  }
  return polygon;
}

}  // namespace gvd::io
