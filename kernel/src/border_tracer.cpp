#include "border_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gvd::kernel {

using predicates::BisectorPiece;
using predicates::Predicate;
using Piece = FacetTessellation::Piece;

namespace {

constexpr double kFar = 0x1p100;

predicates::DoublePoint middle(const FacetTessellation::Node& node) { return {node.x.mid(), node.y.mid()}; }

}  // namespace

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

/// Adds the arc that begins there, if the place where it ends is certain. False if not.
bool BorderTracer::follow(std::size_t start) {
  std::optional<std::size_t> end;
  for (std::size_t s = 0; s < starts_.size(); ++s) {
    if (s == start || starts_[s].left != starts_[start].right || starts_[s].right != starts_[start].left) continue;
    if (end) return false;
    end = s;
  }
  const Start arc = starts_[start];
  thirds_.clear();
  for (std::uint32_t other = 0; other < contenders_.size(); ++other)
    if (other != arc.left && other != arc.right && !is_known(arc.left, arc.right, other)) thirds_.push_back({0, other});
  if (!end) {
    auto vertex = first_vertex(arc);
    if (!vertex) return false;
    end = add_vertex(std::move(*vertex), arc.left, arc.right);
  }
  if (starts_[*end].followed || !are_excluded(arc, result_.nodes[starts_[*end].node])) return false;
  starts_[start].followed = starts_[*end].followed = true;
  result_.arcs.push_back({contenders_[arc.left].site, contenders_[arc.right].site, arc.node, starts_[*end].node, contenders_.tangent(arc.left, arc.right)});
  return true;
}

/// The first vertex found, in the order in which they seem to come. Who has none, or this one, need not be excluded any more.
std::optional<BorderTracer::Found> BorderTracer::first_vertex(const Start& arc) {
  choose_order(arc);
  for (std::size_t n = 0; n < thirds_.size();) {
    auto found = vertices_.find_in_doubles(arc.left, arc.right, thirds_[n].wave);
    if (!found)
      ++n;
    else
      thirds_.erase(thirds_.begin() + static_cast<std::ptrdiff_t>(n));
    if (found && found->exists) return found;
  }
  return std::nullopt;
}

/// Whether no other wave ends the arc before the end found.
bool BorderTracer::are_excluded(const Start& arc, const Node& end) {
  const Node& start = result_.nodes[arc.node];
  const double radius = std::max(start.x.rad() + start.y.rad(), end.x.rad() + end.y.rad());
  const auto piece = BisectorPiece::between(filter_[arc.left].wave, filter_[arc.right].wave, middle(start), middle(end), radius);
  for (const Third& third : thirds_) {
    if (piece && is_off(*piece, third.wave)) {
      ladder_.count(Predicate::conflict, robust::Stage::filter);
      continue;
    }
    const auto found = vertices_.find_in_doubles(arc.left, arc.right, third.wave);
    if (!found || found->exists) return false;
  }
  return true;
}

/// Whether a wave certainly has no part in the piece: it is farther all along, or does not see it.
bool BorderTracer::is_off(const BisectorPiece& piece, std::uint32_t wave) const {
  const auto& other = filter_[wave];
  return piece.is_nearer_than(other.wave) || (other.has_cone && (piece.is_right_of(other.ray[0]) || piece.is_right_of(other.ray[1])));
}

/// Along the tangent of the arc; only an order of asking.
void BorderTracer::choose_order(const Start& arc) {
  const Point p = middle(result_.nodes[arc.node]);
  const Point left = gradient(filter_[arc.left].wave, p), right = gradient(filter_[arc.right].wave, p);
  const Point normal{left.x - right.x, left.y - right.y};
  const double size = std::sqrt(normal.x * normal.x + normal.y * normal.y);
  const Point along{-normal.y / size, normal.x / size};
  for (Third& third : thirds_) third.ahead = tie_ahead(arc, third.wave, p, along);
  std::sort(thirds_.begin(), thirds_.end(), [](const Third& a, const Third& b) { return a.ahead != b.ahead ? a.ahead < b.ahead : a.wave < b.wave; });
}

/// How far ahead a wave seems to tie with the two.
double BorderTracer::tie_ahead(const Start& arc, std::uint32_t other, const Point& p, const Point& along) const {
  for (const std::uint32_t own : {arc.left, arc.right}) {
    if (contenders_.tangent_end(own, other) != Contenders::kNotTangent) return ray_ahead(own, contenders_.tangent_end(own, other), p, along);
    if (contenders_.tangent_end(other, own) != Contenders::kNotTangent) return ray_ahead(other, contenders_.tangent_end(other, own), p, along);
  }
  const auto &own = filter_[arc.left].wave, &wave = filter_[other].wave;
  const Point u = gradient(wave, p), v = gradient(own, p);
  const double lead = distance(wave, p) - distance(own, p), slope = (u.x - v.x) * along.x + (u.y - v.y) * along.y;
  if (!(slope < 0)) return kFar;
  const double ahead = -lead / slope;
  const Point there{p.x + ahead * along.x, p.y + ahead * along.y};
  for (std::size_t end = 0; filter_[other].has_cone && end < 2; ++end)
    if (filter_.cone_side(other, end, there, 0).negative()) return kFar + ahead;
  return ahead;
}

double BorderTracer::ray_ahead(std::uint32_t wave, int end, const Point& p, const Point& along) const {
  const auto& ray = filter_[wave].ray[static_cast<std::size_t>(end)];
  const double side = ray.along.x * (p.y - ray.from.y) - ray.along.y * (p.x - ray.from.x), slope = ray.along.x * along.y - ray.along.y * along.x;
  const double ahead = -side / slope;
  return ahead > 0 ? ahead : kFar;
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
