#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "face_map.hpp"
#include "gvd/predicates/precise_points.hpp"
#include "subdivision.hpp"

/// The numbers of facets and their waves in double-double, as points and arcs of the diagram are made of them.
namespace gvd::kernel::subdivision {

/// Where the frame of a facet lies, in space and in the frame of its input face.
class PreciseFacet {
 public:
  using NT = FacetWaves::DD;
  using P = predicates::PrecisePoint;

  PreciseFacet(const DiagramInput& in, const Skeleton& facet);

  const predicates::FacetFrame<NT>& frame() const { return frame_; }
  /// In the frame of the input face.
  P placed(const P& p) const { return whole_ ? predicates::multiple(frame_.length, p) : predicates::turned_and_moved(base_, turn_, p); }
  /// Image and weight of a wave: x, y and the weight in mesh units in the first three lanes.
  robust::BallQuad placed(const predicates::PreciseWave& wave) const;
  /// Its coordinates in the first three lanes.
  robust::BallQuad in_space(const P& p);
  /// The same for the point of a side with parameter t.
  robust::BallQuad on_side(std::size_t side, const NT& t) const { return predicates::between(corner_[side], corner_[(side + 1) % 3], t); }

 private:
  predicates::FacetFrame<NT> frame_;
  bool whole_ = true;
  P base_, turn_;
  std::array<robust::BallQuad, 3> corner_;
  std::optional<predicates::FrameInSpace> space_;  // on demand
};

/// The waves of all facets, made on demand and kept. A facet is used by one thread at a time.
class PreciseWaves {
 public:
  explicit PreciseWaves(const Subdivision& s);
  const predicates::PreciseWave& operator()(std::uint32_t facet, std::uint32_t site);

 private:
  const Subdivision& s_;
  std::vector<std::uint32_t> first_;  // per facet: of its sites
  std::vector<std::uint8_t> known_;   // per site
  std::unique_ptr<predicates::PreciseWave[]> waves_;
};

}  // namespace gvd::kernel::subdivision
