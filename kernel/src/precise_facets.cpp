#include "precise_facets.hpp"

namespace gvd::kernel::subdivision {

namespace {

robust::BallQuad corner_in_lanes(const Mesh& mesh, VertexId v) {
  const auto p = position_in<PreciseFacet::NT>(mesh, v, 0);
  return {p[0], p[1], p[2], PreciseFacet::NT()};
}

}  // namespace

PreciseFacet::PreciseFacet(const DiagramInput& in, const Skeleton& facet)
    : frame_(facet.waves->precise_frame()),
      corner_{corner_in_lanes(in.refined, in.refined.origin(3 * facet.face)), corner_in_lanes(in.refined, in.refined.origin(3 * facet.face + 1)),
              corner_in_lanes(in.refined, in.refined.origin(3 * facet.face + 2))} {
  const FaceId face = in.refined.input_face(facet.face);
  for (std::uint32_t k = 0; k < 3; ++k) whole_ = whole_ && in.refined.origin(3 * facet.face + k) == in.input.origin(3 * face + k);
  if (whole_) return;
  const FaceMap<NT> map(in.input, in.refined, facet.face, &frame_, 0);
  base_ = map.corner(0);
  turn_ = map.turn();
}

robust::BallQuad PreciseFacet::placed(const predicates::PreciseWave& wave) const {
  const robust::BallQuad stretched = predicates::multiple(frame_.length, wave);
  if (whole_) return stretched;
  const P image = predicates::turned_and_moved(base_, turn_, wave.image);
  return {image.x, image.y, stretched.lane(2), NT()};
}

robust::BallQuad PreciseFacet::in_space(const P& p) {
  if (!space_) space_ = predicates::frame_in_space(corner_, frame_.apex);
  return predicates::in_space(*space_, p);
}

PreciseWaves::PreciseWaves(const Subdivision& s) : s_(s) {
  first_.reserve(s.facets.size() + 1);
  std::size_t count = 0;
  for (const Skeleton& facet : s.facets) {
    first_.push_back(static_cast<std::uint32_t>(count));
    if (facet.waves != nullptr) count += facet.waves->sites.size();
  }
  known_.assign(count, 0);
  waves_ = std::make_unique<predicates::PreciseWave[]>(count);
}

const predicates::PreciseWave& PreciseWaves::operator()(std::uint32_t facet, std::uint32_t site) {
  const std::uint32_t at = first_[facet] + site;
  if (known_[at] == 0) waves_[at] = s_.facets[facet].waves->precise_wave(site);
  known_[at] = 1;
  return waves_[at];
}

}  // namespace gvd::kernel::subdivision
