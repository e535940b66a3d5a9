#include <algorithm>
#include <numeric>
#include <string>

#include "gvd/kernel/error.hpp"
#include "subdivision.hpp"

namespace gvd::kernel::subdivision {
namespace {

using Node = FacetTessellation::Node;
using TessPiece = FacetTessellation::Piece;

[[noreturn]] void not_a_subdivision(FaceId face, const char* what) {
  throw InternalError("facet " + std::to_string(face) + ": the tessellation is not a subdivision: " + what);
}

/// An arc as it leaves a node, with the sites clockwise (right) and counter-clockwise (left) of it.
struct SiteSpoke {
  Spoke spoke;
  std::uint32_t right, left;
};

class Builder {
 public:
  Builder(const BoundaryFacet& facet, std::pmr::memory_resource& memory)
      : tess_(*facet.tessellation),
        sites_(facet.waves->sites),
        skeleton_{.face = facet.face,
                  .waves = facet.waves,
                  .tessellation = facet.tessellation,
                  .kept = std::pmr::vector<std::uint32_t>(&memory),
                  .sides = {empty_side(memory), empty_side(memory), empty_side(memory)},
                  .spokes = std::pmr::vector<Spoke>(&memory),
                  .spokes_end = std::pmr::vector<std::uint32_t>(&memory)} {
    skeleton_.kept.reserve(tess_.arcs.size());
    skeleton_.spokes.reserve(2 * tess_.arcs.size());
    skeleton_.spokes_end.reserve(tess_.nodes.size());
  }

  Skeleton build() {
    collect_spokes();
    collect_sides();
    for (std::uint32_t n = 0; n < tess_.nodes.size(); ++n) turn_round(n);
    for (auto& side : skeleton_.sides) mark_essential(side);
    check_corners();
    return std::move(skeleton_);
  }

 private:
  static SideView empty_side(std::pmr::memory_resource& memory) { return {std::pmr::vector<Piece>(&memory), std::pmr::vector<Event>(&memory)}; }
  LabelSetId labels(std::uint32_t site) const { return sites_[site].labels; }

  void collect_spokes() {
    start_.assign(tess_.nodes.size() + 1, 0);
    for (const auto& arc : tess_.arcs) ++start_[arc.from], ++start_[arc.to];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    by_node_.resize(2 * tess_.arcs.size());
    for (auto a = static_cast<std::uint32_t>(tess_.arcs.size()); a-- > 0;) {
      const auto& arc = tess_.arcs[a];
      by_node_[--start_[arc.to]] = {{a, true}, arc.left, arc.right};
      by_node_[--start_[arc.from]] = {{a, false}, arc.right, arc.left};
    }
    for (std::uint32_t a = 0; a < tess_.arcs.size(); ++a)
      if (labels(tess_.arcs[a].left) != labels(tess_.arcs[a].right)) skeleton_.kept.push_back(a);
  }
  std::span<SiteSpoke> at_node(std::uint32_t n) { return std::span(by_node_).subspan(start_[n], start_[n + 1] - start_[n]); }

  bool is_corner(std::uint32_t node) const { return node == TessPiece::kNoNode || tess_.nodes[node].kind == Node::Kind::corner; }

  void collect_sides() {
    std::array<std::size_t, 3> count{};
    for (const auto& piece : tess_.outline) ++count[piece.side];
    for (std::size_t side = 0; side < 3; ++side) {
      skeleton_.sides[side].pieces.reserve(count[side]);
      skeleton_.sides[side].events.reserve(count[side]);
    }
    std::array<std::uint32_t, 3> last_end{TessPiece::kNoNode, TessPiece::kNoNode, TessPiece::kNoNode};
    for (const auto& piece : tess_.outline)
      if (!is_empty(piece)) last_end[piece.side] = add_piece(piece, last_end[piece.side]);
    for (std::size_t side = 0; side < 3; ++side)
      if (skeleton_.sides[side].pieces.empty() || !is_corner(last_end[side])) not_a_subdivision(skeleton_.face, "a side is not covered");
  }

  /// Where it ends. `last_end`: where the one before ended.
  std::uint32_t add_piece(const TessPiece& piece, std::uint32_t last_end) {
    SideView& view = skeleton_.sides[piece.side];
    if (!view.pieces.empty()) {
      if (is_corner(piece.from) || piece.from != last_end) not_a_subdivision(skeleton_.face, "a gap on a side");
      const auto index = static_cast<std::uint32_t>(view.pieces.size());
      view.events.push_back({piece.from, index - 1, index, false});
    }
    view.pieces.push_back({piece.site, labels(piece.site), last_site(piece)});
    return piece.to;
  }

  std::uint32_t last_site(const TessPiece& piece) const {
    return tess_.borders_only && piece.to != TessPiece::kNoNode ? tess_.nodes[piece.to].defining[0] : piece.site;
  }

  /// A region that touches the outline in one point only.
  bool is_empty(const TessPiece& piece) const {
    if (is_corner(piece.from) != is_corner(piece.to)) return false;
    if (!is_corner(piece.from)) return piece.from == piece.to;
    return corner_of(piece.from, piece.side) == corner_of(piece.to, static_cast<std::uint8_t>((piece.side + 1) % 3));
  }
  /// The corner a piece begins or ends in; `implied` if no node names it.
  std::uint8_t corner_of(std::uint32_t node, std::uint8_t implied) const {
    return node == TessPiece::kNoNode ? implied : tess_.nodes[node].where;
  }

  /// Brings the arcs at node n into counter-clockwise order by their sites: each region has one sector at a node.
  void turn_round(std::uint32_t n) {
    const std::span<SiteSpoke> spokes = at_node(n);
    skeleton_.spokes_end.push_back(static_cast<std::uint32_t>(skeleton_.spokes.size()));
    const Node& node = tess_.nodes[n];
    if (node.kind == Node::Kind::corner) skeleton_.corner_node[node.where] = n;
    if (spokes.empty()) return;
    const auto [first, last] = outer_sectors(n);
    std::uint32_t sector = first;
    for (std::size_t turned = 0; turned < spokes.size(); ++turned) {
      const auto next = std::find_if(spokes.begin() + static_cast<std::ptrdiff_t>(turned), spokes.end(),
                                     [&](const SiteSpoke& s) { return are_one(s.right, sector); });
      if (next == spokes.end()) not_a_subdivision(skeleton_.face, "arcs at a node do not follow one another");
      std::iter_swap(spokes.begin() + static_cast<std::ptrdiff_t>(turned), next);
      const SiteSpoke& spoke = spokes[turned];
      if (labels(spoke.right) != labels(spoke.left)) skeleton_.spokes.push_back(spoke.spoke);
      sector = spoke.left;
    }
    if (!are_one(sector, last)) not_a_subdivision(skeleton_.face, "arcs at a node do not close");
    skeleton_.spokes_end.back() = static_cast<std::uint32_t>(skeleton_.spokes.size());
  }

  /// Whether two sites at a node stand for one sector.
  bool are_one(std::uint32_t a, std::uint32_t b) const { return a == b || (tess_.borders_only && labels(a) == labels(b)); }

  /// The sites in the first and the last sector of a node, counter-clockwise.
  std::pair<std::uint32_t, std::uint32_t> outer_sectors(std::uint32_t n) {
    const Node& node = tess_.nodes[n];
    const SideView& side = skeleton_.sides[node.where % 3];
    if (node.kind == Node::Kind::corner)
      return {side.pieces.front().site, skeleton_.sides[(node.where + 2) % 3].pieces.back().site};
    if (node.kind == Node::Kind::side) {
      for (const Event& event : side.events)
        if (event.node == n) return {side.pieces[event.after].site, side.pieces[event.before].site};
      not_a_subdivision(skeleton_.face, "a node on a side is not on the outline");
    }
    return {at_node(n).front().right, at_node(n).front().right};
  }

  void mark_essential(SideView& side) const {
    for (Event& event : side.events) {
      event.essential =
          side.pieces[event.before].labels != side.pieces[event.after].labels || !skeleton_.spokes_at(event.node).empty();
    }
  }

  void check_corners() const {
    for (std::size_t k = 0; k < 3; ++k) {
      const LabelSetId first = skeleton_.sides[k].pieces.front().labels;
      const LabelSetId last = skeleton_.sides[(k + 2) % 3].pieces.back().labels;
      const std::uint32_t node = skeleton_.corner_node[k];
      const bool arcs = node != kNone && !skeleton_.spokes_at(node).empty();
      if (first != last && !arcs) not_a_subdivision(skeleton_.face, "the label set changes in a corner without an arc");
    }
  }

  const FacetTessellation& tess_;
  const std::vector<FacetSite>& sites_;
  Skeleton skeleton_;
  // Arcs as they leave their nodes, node by node, in an order of their own at each.
  std::array<std::byte, 2048> room_;
  std::pmr::monotonic_buffer_resource scratch_{room_.data(), room_.size()};
  std::pmr::vector<SiteSpoke> by_node_{&scratch_};
  std::pmr::vector<std::uint32_t> start_{&scratch_};
};

}  // namespace

void SideView::assign_reversed(const SideView& view) {
  pieces.clear();
  events.clear();
  for (auto piece = view.pieces.rbegin(); piece != view.pieces.rend(); ++piece) pieces.push_back({piece->last_site, piece->labels, piece->site});
  const auto last = static_cast<std::uint32_t>(pieces.size() - 1);
  for (auto event = view.events.rbegin(); event != view.events.rend(); ++event)
    events.push_back({event->node, last - event->after, last - event->before, event->essential});
}

Skeleton make_skeleton(const BoundaryFacet& facet, std::pmr::memory_resource& memory) { return Builder(facet, memory).build(); }

Skeleton make_uniform_skeleton(FaceId face, LabelSetId labels) {
  Skeleton skeleton;
  skeleton.face = face;
  skeleton.only_label = labels;
  for (auto& side : skeleton.sides) side.pieces.push_back({kNone, labels, kNone});
  return skeleton;
}

}  // namespace gvd::kernel::subdivision
