#include "gvd/kernel/tessellation.hpp"

#include <algorithm>

#include "contenders.hpp"
#include "growth.hpp"
#include "outline.hpp"

namespace gvd::kernel {
namespace {

using Node = FacetTessellation::Node;

/// Whether two vertices are one point: the second one's triple is among the waves that tie at the first, in the same cyclic order. (Three waves
/// have one vertex for each cyclic order.)
bool coincide(const Node& a, const Node& b) {
  if (a.kind != Node::Kind::inside || b.kind != Node::Kind::inside || a.sites.size() < 4 || b.sites.size() != a.sites.size()) return false;
  const auto start = std::find(a.sites.begin(), a.sites.end(), b.sites[0]);
  if (start == a.sites.end()) return false;
  const std::size_t shift = static_cast<std::size_t>(start - a.sites.begin());
  for (std::size_t i = 0; i < b.sites.size(); ++i)
    if (a.sites[(shift + i) % a.sites.size()] != b.sites[i]) return false;
  return true;
}

/// Growth closes a vertex of degree d as d - 2 vertices with arcs of length zero between them: makes it one.
void merge_coincident(FacetTessellation& result) {
  const auto many = [](const Node& node) { return node.kind == Node::Kind::inside && node.sites.size() > 3; };
  if (std::none_of(result.nodes.begin(), result.nodes.end(), many)) return;
  std::vector<std::uint32_t> new_id(result.nodes.size());
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < result.nodes.size(); ++i) {
    const auto same = std::find_if(nodes.begin(), nodes.end(), [&](const Node& node) { return coincide(node, result.nodes[i]); });
    new_id[i] = static_cast<std::uint32_t>(same - nodes.begin());
    if (same == nodes.end()) nodes.push_back(std::move(result.nodes[i]));
  }
  result.nodes = std::move(nodes);
  for (auto& arc : result.arcs) {
    arc.from = new_id[arc.from];
    arc.to = new_id[arc.to];
  }
  std::erase_if(result.arcs, [](const FacetTessellation::Arc& arc) { return arc.from == arc.to; });
  for (auto& piece : result.outline) {
    if (piece.from != FacetTessellation::Piece::kNoNode) piece.from = new_id[piece.from];
    if (piece.to != FacetTessellation::Piece::kNoNode) piece.to = new_id[piece.to];
  }
}

}  // namespace

FacetTessellation tessellate(FacetWaves& waves, predicates::Decisions& decisions) {
  FacetTessellation result;
  FacetLadder ladder(waves, decisions);
  const Contenders contenders(waves, ladder);
  const std::vector<Occurrence> outline = OutlineWalk(waves, contenders, ladder, result).walk();
  if (!ladder.failed()) Growth(waves, contenders, ladder, result).run(outline);
  if (ladder.failed()) {
    result = {};
    result.undecided = true;
    return result;
  }
  merge_coincident(result);
  result.representative = contenders.representatives();
  return result;
}

}  // namespace gvd::kernel
