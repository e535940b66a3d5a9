#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gvd/kernel/diagram.hpp"
#include "gvd/kernel/mesh.hpp"

namespace gvd::io {

using PlanePoint = std::array<double, 2>;

/// The plane of a face in doubles: corner 0 is (0,0), corner 1 is (length, 0), corner 2 is (apex[0], apex[1]), mesh units.
class FacePlane {
 public:
  FacePlane(const kernel::Mesh& mesh, kernel::FaceId face);
  PlanePoint to_plane(const kernel::Point& p) const;  ///< of the foot of the perpendicular
  kernel::Point to_space(const PlanePoint& p) const;
  PlanePoint corner(unsigned k) const;
  double longest_side() const;

 private:
  kernel::Point origin_, ex_, ey_;
  double length_;
  PlanePoint apex_;
};

/// A point of a drawn arc. Doubles only: for pictures, not for decisions.
struct ArcSample {
  PlanePoint plane;        ///< frame of the face of the arc
  kernel::Point position;  ///< on the face
  double distance;         ///< from the nearest source
};

/// Turns the conic arcs of a diagram into polylines whose chords are nowhere farther from the arc than a stated fraction of the longest
/// side of the arc's face.
class ArcSampler {
 public:
  /// Pre: 0 < deviation. The mesh is the input mesh; both must outlive the sampler.
  ArcSampler(const kernel::Mesh& mesh, const kernel::Diagram& diagram, double deviation);

  /// Points along the arc from node 0 to node 1, both included; the positions of the ends are those of the diagram.
  std::vector<ArcSample> sample(std::uint32_t arc) const;
  /// Distance from the nearest source at node `end` of the arc, by the formula of the arc.
  double node_distance(std::uint32_t arc, unsigned end) const;
  /// The largest deviation in mesh units which the fraction allows on any face that holds an arc; 0 without arcs.
  double largest_allowed_deviation() const;

 private:
  PlanePoint node_in_plane(const FacePlane& plane, kernel::FaceId face, std::uint32_t node) const;

  const kernel::Mesh& mesh_;
  const kernel::Diagram& diagram_;
  double deviation_;
};

}  // namespace gvd::io
