#include <algorithm>
#include <array>
#include <cmath>

#include "fuzz/generators/family.hpp"

namespace gvd::fuzz {
namespace {

using kernel::FaceId;
using kernel::MeshArrays;
using Places = std::vector<Place>;

FaceId some_face(Draw& draw, const MeshArrays& mesh) { return draw.below(static_cast<std::uint32_t>(mesh.faces.size())); }

/// The weights of `corners` of the corners are not zero; the first of them is corner k.
Place some_place(Draw& draw, FaceId face, std::uint32_t corners, std::uint32_t most) {
  Place place{face, {0, 0, 0}, 0};
  const std::uint32_t k = draw.below(3);
  for (std::uint32_t i = 0; i < corners; ++i) place.corner_weights[(k + i) % 3] = 1 + draw.below(most);
  return place;
}

Places repeated(std::uint32_t count, const auto& one) {
  Places places;
  for (std::uint32_t i = 0; i < count; ++i) places.push_back(one());
  return places;
}

Places vertices(Draw& draw, const MeshArrays& mesh, std::uint32_t count) {
  return repeated(count, [&] { return some_place(draw, some_face(draw, mesh), 1, 1); });
}
Places edges(Draw& draw, const MeshArrays& mesh, std::uint32_t count) {
  return repeated(count, [&] { return some_place(draw, some_face(draw, mesh), 2, 1000); });
}
Places facets(Draw& draw, const MeshArrays& mesh, std::uint32_t count) {
  return repeated(count, [&] { return some_place(draw, some_face(draw, mesh), 3, 1000); });
}
Places anywhere(Draw& draw, const MeshArrays& mesh, std::uint32_t count) {
  return repeated(count, [&] { return some_place(draw, some_face(draw, mesh), 1 + draw.below(3), 100); });
}
/// All in one facet or on its sides.
Places one_facet(Draw& draw, const MeshArrays& mesh, std::uint32_t count) {
  const FaceId face = some_face(draw, mesh);
  return repeated(count, [&] { return some_place(draw, face, 1 + draw.below(3), 7); });
}
/// Barycentric coordinates that are quarters: points of a lattice on flat grids, many exact ties.
Places lattice(Draw& draw, const MeshArrays& mesh, std::uint32_t count) {
  return repeated(count, [&] {
    Place place{some_face(draw, mesh), {0, 0, 0}, 0};
    for (int i = 0; i < 4; ++i) place.corner_weights[draw.below(3)] += 1;
    return place;
  });
}
/// Every place twice, once with its weights turned round: t and 1 - t on an edge.
Places mirrored(Draw& draw, const MeshArrays& mesh, std::uint32_t count) {
  Places places;
  while (places.size() < count) {
    Place place = some_place(draw, some_face(draw, mesh), 1 + draw.below(3), 9);
    places.push_back(place);
    std::swap(place.corner_weights[0], place.corner_weights[1]);
    places.push_back(place);
  }
  return places;
}
/// Some places more than once, also by another name.
Places duplicates(Draw& draw, const MeshArrays& mesh, std::uint32_t count) {
  Places places = anywhere(draw, mesh, count);
  for (std::uint32_t i = 0; i < 1 + count / 3; ++i) {
    Place again = places[draw.below(static_cast<std::uint32_t>(places.size()))];
    if (draw.one_in(2))
      for (double& w : again.corner_weights) w *= 3;
    places.push_back(again);
  }
  return places;
}
/// Close to a vertex or to a side, down to 2^-60 of the facet, from bits.
Places nearby(Draw& draw, const MeshArrays& mesh, std::uint32_t count) {
  return repeated(count, [&] {
    Place place{some_face(draw, mesh), {0, 0, 0}, 0};
    const std::uint32_t k = draw.below(3);
    place.corner_weights[k] = 1;
    for (std::uint32_t i = 1; i < 3; ++i)
      place.corner_weights[(k + i) % 3] = draw.one_in(3) ? 0 : std::fabs(draw.bit_double(-60, 0));
    return place;
  });
}

constexpr std::array<Pattern, 9> kPatterns = {{{"vertices", vertices},
                                               {"edges", edges},
                                               {"facets", facets},
                                               {"anywhere", anywhere},
                                               {"one_facet", one_facet},
                                               {"lattice", lattice},
                                               {"mirrored", mirrored},
                                               {"duplicates", duplicates},
                                               {"nearby", nearby}}};

}  // namespace

std::span<const Pattern> patterns() { return kPatterns; }

}  // namespace gvd::fuzz
