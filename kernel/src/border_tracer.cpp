#include "border_tracer.hpp"

#include <numeric>

namespace gvd::kernel {

using predicates::Predicate;
using Piece = FacetTessellation::Piece;

std::optional<FacetTessellation> BorderTracer::run() {
  const bool walked = outline_.walk();
  ladder_.count(Predicate::edge_tie, robust::Stage::filter, outline_.decisions());
  if (!walked) return std::nullopt;
  constexpr std::size_t kUsual = 8;
  result_.nodes.reserve(kUsual);
  result_.arcs.reserve(kUsual);
  result_.outline.reserve(kUsual);
  starts_.reserve(2 * kUsual);
  add_outline();
  std::vector<std::uint32_t> all(contenders_.size());
  std::iota(all.begin(), all.end(), 0u);
  vertices_.set_rivals(std::move(all));
  for (std::size_t s = 0; s < starts_.size(); ++s)
    if (!starts_[s].followed && !follow(s)) return std::nullopt;
  result_.borders_only = true;
  result_.representative = contenders_.representatives();
  return std::move(result_);
}

void BorderTracer::add_outline() {
  auto next = outline_.crossings().begin();
  for (std::uint8_t side = 0; side < 3; ++side) {
    Piece piece{side, contenders_[outline_.at_corner(side)].site, Piece::kNoNode, Piece::kNoNode};
    for (; next != outline_.crossings().end() && next->side == side; ++next) {
      piece.to = add_crossing(*next);
      result_.outline.push_back(piece);
      piece = {side, contenders_[next->to].site, piece.to, Piece::kNoNode};
    }
    result_.outline.push_back(piece);
  }
}

std::uint32_t BorderTracer::add_crossing(const BorderOutline::Crossing& crossing) {
  Node node;
  node.kind = Node::Kind::side;
  node.where = crossing.side;
  const std::uint32_t from = contenders_[crossing.from].site, to = contenders_[crossing.to].site;
  node.sites = {to, from};
  node.defining = {from, to, FacetTessellation::kNoSite};
  node.t = crossing.at.parameter();
  const auto p = predicates::point_at(ladder_.filter().side[crossing.side], node.t);
  node.x = p.x;
  node.y = p.y;
  const auto id = static_cast<std::uint32_t>(result_.nodes.size());
  result_.nodes.push_back(std::move(node));
  starts_.push_back({crossing.from, crossing.to, id});
  return id;
}

bool BorderTracer::is_known(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
  for (const auto& [a, b, c] : known_)
    if ((a == i && b == j && c == k) || (b == i && c == j && a == k) || (c == i && a == j && b == k)) return true;
  return false;
}

/// Adds the arc that begins there, if all the places where an arc of its waves may end are known to be one. False if not.
bool BorderTracer::follow(std::size_t start) {
  const auto [left, right, from, followed] = starts_[start];
  std::optional<std::size_t> end;
  for (std::size_t s = 0; s < starts_.size(); ++s) {
    if (s == start || starts_[s].left != right || starts_[s].right != left) continue;
    if (end) return false;
    end = s;
  }
  std::optional<Found> vertex;
  for (std::uint32_t other = 0; other < contenders_.size(); ++other) {
    if (other == left || other == right || is_known(left, right, other)) continue;
    auto found = vertices_.find_in_doubles(left, right, other);
    if (!found) return false;
    if (!found->exists) continue;
    if (end || vertex) return false;
    vertex = std::move(found);
  }
  if (vertex) end = add_vertex(std::move(*vertex), left, right);
  if (!end || starts_[*end].followed) return false;
  starts_[start].followed = starts_[*end].followed = true;
  result_.arcs.push_back({contenders_[left].site, contenders_[right].site, from, starts_[*end].node, contenders_.tangent(left, right)});
  return true;
}

/// The border that leaves the new vertex against the one that arrives with `left` and `right`.
std::size_t BorderTracer::add_vertex(Found&& vertex, std::uint32_t left, std::uint32_t right) {
  const std::vector<std::uint32_t> ring = vertex.open;
  known_.push_back({ring[0], ring[1], ring[2]});
  const auto node = static_cast<std::uint32_t>(result_.nodes.size());
  result_.nodes.push_back(std::move(vertex.node));
  std::size_t back = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const std::uint32_t a = ring[n], b = ring[(n + 1) % 3];
    if (outline_.labels(a) == outline_.labels(b)) continue;
    if (a == left && b == right) back = starts_.size();
    starts_.push_back({b, a, node});
  }
  return back;
}

}  // namespace gvd::kernel
