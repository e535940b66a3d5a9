#include "fuzz/properties/facets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "fuzz/properties/property.hpp"
#include "gvd/kernel/facet_numbers.hpp"
#include "gvd/kernel/tessellation.hpp"
#include "gvd/predicates/plane.hpp"

namespace gvd::fuzz {
namespace {

using kernel::FaceId;
using kernel::FacetTessellation;
using kernel::FacetWaves;
using kernel::kNone;

/// Whether the arc, seen from the image of the region on its left (right), certainly runs clockwise (counter-clockwise).
bool turns_back(FacetWaves& waves, const FacetTessellation& t, const FacetTessellation::Arc& arc, std::uint32_t site, bool left) {
  using predicates::orientation;
  const auto& image = waves.site(site, FacetWaves::F()).image;
  const auto &from = t.nodes[arc.from], &to = t.nodes[arc.to];
  const auto turn = orientation(image, {from.x, from.y}, {to.x, to.y});
  return maybe_sign(turn) == (left ? robust::Sign::negative : robust::Sign::positive);
}

/// The ends of the arcs and outline pieces of one region pair up: its border is closed.
bool is_closed(const FacetTessellation& t, std::uint32_t region) {
  constexpr auto kNoNode = FacetTessellation::Piece::kNoNode;
  const auto place = [&](std::uint32_t node, std::uint32_t corner) {
    if (node != kNoNode && t.nodes[node].kind == FacetTessellation::Node::Kind::corner)
      corner = t.nodes[node].where, node = kNoNode;
    return node != kNoNode ? node : kNoNode - 1 - corner % 3;
  };
  std::map<std::uint32_t, int> balance;
  for (const auto& arc : t.arcs) {
    const int turns = (arc.left == region ? 1 : 0) - (arc.right == region ? 1 : 0);
    balance[place(arc.from, 0)] += turns;
    balance[place(arc.to, 0)] -= turns;
  }
  for (const auto& piece : t.outline) {
    if (piece.site != region) continue;
    ++balance[place(piece.from, piece.side)];
    --balance[place(piece.to, piece.side + 1u)];
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; });
}

/// Each region of a facet touches the outline, or its own source or relaying corner, and is star-shaped from its image.
Outcome no_enclave(Trial& t) {
  const Facets facets(t);
  bool open = false;
  for (FaceId f = 0; f < facets.mesh().face_count(); ++f) {
    if (!facets.is_reached(f)) continue;
    const auto waves = facets.waves(f);
    if (waves->sites.size() < 2) continue;
    predicates::Decisions decisions;
    const FacetTessellation tess = tessellate(*waves, decisions);
    if (tess.undecided) {
      open = true;
      continue;
    }
    for (const auto& arc : tess.arcs)
      for (const bool left : {true, false}) {
        const std::uint32_t region = left ? arc.left : arc.right;
        const bool on_outline =
            std::any_of(tess.outline.begin(), tess.outline.end(), [&](const auto& piece) { return piece.site == region; });
        const bool at_corner = waves->sites[region].window == kNone;
        if (!on_outline && !at_corner)
          return violated(fmt::format("facet {} of the refined mesh: the region of site {} is an enclave", f, region));
        if (turns_back(*waves, tess, arc, region, left))
          return violated(fmt::format("facet {} of the refined mesh: the region of site {} is not star-shaped", f, region));
        if (on_outline && !is_closed(tess, region))
          return violated(fmt::format("facet {} of the refined mesh: the border of the region of site {} is open", f, region));
      }
  }
  return open ? undecided() : holds();
}

constexpr std::array<Property, 1> kProperties = {{
    {"no_enclave", no_enclave, 24,
     "every region of a facet touches its window, its source or its relaying corner, and is star-shaped from its image"},
}};

}  // namespace

std::span<const Property> facet_properties() { return kProperties; }

}  // namespace gvd::fuzz
