#include "border_tracer.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace gvd::kernel {

using predicates::BisectorPiece;
using predicates::Predicate;
using Piece = FacetTessellation::Piece;

namespace {

constexpr double kFar = 0x1p100;

using predicates::DoublePoint;

DoublePoint middle(const FacetTessellation::Node& node) { return {node.x.mid(), node.y.mid()}; }
double dot(const DoublePoint& a, const DoublePoint& b) { return a.x * b.x + a.y * b.y; }
double cross(const DoublePoint& a, const DoublePoint& b) { return a.x * b.y - a.y * b.x; }
/// As far as rounded numbers tell.
bool is_left(const predicates::DoubleLine& line, const DoublePoint& p) { return cross(line.along, {p.x - line.from.x, p.y - line.from.y}) >= 0; }

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
  known_.reserve(kUsual);
  thirds_.reserve(contenders_.size());
  add_outline();
  all_.resize(contenders_.size());
  std::iota(all_.begin(), all_.end(), 0u);
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

/// All waves but the two, and but those of which the vertex with them is known.
void BorderTracer::find_thirds(const Start& arc) {
  thirds_.clear();
  for (std::uint32_t other = 0; other < contenders_.size(); ++other)
    if (other != arc.left && other != arc.right) thirds_.push_back({other});
  for (const auto& ring : known_)
    for (std::size_t n = 0; n < 3; ++n)
      if (ring[n] == arc.left && ring[(n + 1) % 3] == arc.right) std::erase_if(thirds_, [&](const Third& third) { return third.wave == ring[(n + 2) % 3]; });
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
  find_thirds(arc);
  if (!end) {
    auto vertex = first_vertex(arc);
    if (!vertex) return false;
    end = add_vertex(std::move(*vertex), arc.left, arc.right);
  } else {
    exclude_beside(arc, result_.nodes[starts_[*end].node]);
  }
  if (starts_[*end].followed || !are_excluded(arc)) return false;
  starts_[start].followed = starts_[*end].followed = true;
  result_.arcs.push_back({contenders_[arc.left].site, contenders_[arc.right].site, arc.node, starts_[*end].node, contenders_.tangent(arc.left, arc.right)});
  return true;
}

/// The first vertex found, in the order in which they seem to come. What takes no part in the piece up to there is not nearer in its end either.
std::optional<BorderTracer::Vertex> BorderTracer::first_vertex(const Start& arc) {
  look_ahead(arc);
  const auto is_before = [](const Third& a, const Third& b) { return a.ahead < b.ahead; };
  for (std::size_t asked = 0; asked < thirds_.size(); ++asked) {
    Third& next = *std::min_element(thirds_.begin(), thirds_.end(), is_before);
    next.ahead = std::numeric_limits<double>::infinity();
    auto found = vertices_.find_in_doubles(arc.left, arc.right, next.wave, {});
    if (!found) continue;
    next.has_no_vertex = true;
    if (!found->exists) continue;
    exclude_beside(arc, found->node);
    const std::optional<bool> beaten = is_beaten(*found);
    if (beaten == false) return found;
    next.has_no_vertex = beaten.has_value();
  }
  return std::nullopt;
}

std::optional<bool> BorderTracer::is_beaten(const Vertex& vertex) {
  std::optional<bool> beaten = false;
  for (const Third& third : thirds_) {
    if (third.is_off || std::find(vertex.waves.begin(), vertex.waves.end(), third.wave) != vertex.waves.end()) continue;
    const std::optional<bool> nearer = vertices_.is_beaten(vertex, third.wave);
    if (nearer == true) return true;
    if (!nearer) beaten = std::nullopt;
  }
  return beaten;
}

/// Finds out who takes no part in the piece of the arc up to a point.
void BorderTracer::exclude_beside(const Start& arc, const Node& end) {
  const Node& start = result_.nodes[arc.node];
  const double radius = std::max(start.x.rad() + start.y.rad(), end.x.rad() + end.y.rad());
  const auto piece = BisectorPiece::between(filter_[arc.left].wave, filter_[arc.right].wave, middle(start), middle(end), radius);
  for (Third& third : thirds_) third.is_off = piece && is_off(*piece, third.wave);
}

/// Whether no other wave ends the arc before the end found.
bool BorderTracer::are_excluded(const Start& arc) {
  for (const Third& third : thirds_) {
    if (third.is_off) ladder_.count(Predicate::conflict, robust::Stage::filter);
    if (third.is_off || third.has_no_vertex) continue;
    const auto found = vertices_.find_in_doubles(arc.left, arc.right, third.wave, all_);
    if (!found || found->exists) return false;
  }
  return true;
}

/// Whether a wave certainly has no part in the piece: it is farther all along, or does not see it.
bool BorderTracer::is_off(const BisectorPiece& piece, std::uint32_t wave) const {
  const auto& other = filter_[wave];
  return piece.is_nearer_than(other.wave) || (other.has_cone && (piece.is_right_of(other.ray[0]) || piece.is_right_of(other.ray[1])));
}

/// How far ahead each wave seems to tie with the two, along the tangent of the arc; only an order of asking.
void BorderTracer::look_ahead(const Start& arc) {
  const Point p = middle(result_.nodes[arc.node]);
  const auto& left = filter_[arc.left].wave;
  const Point of_left = gradient(left, p), of_right = gradient(filter_[arc.right].wave, p), along{of_right.y - of_left.y, of_left.x - of_right.x};
  const double at_p = distance(left, p), rise = dot(of_left, along);
  for (Third& third : thirds_) {
    if (contenders_.related(arc.left, third.wave) || contenders_.related(arc.right, third.wave)) {
      third.ahead = ray_ahead(arc, third.wave, p, along);
      continue;
    }
    const auto& other = filter_[third.wave];
    const double lead = distance(other.wave, p) - at_p, slope = dot(gradient(other.wave, p), along) - rise, ahead = -lead / slope;
    const Point there{p.x + ahead * along.x, p.y + ahead * along.y};
    const bool seen = !other.has_cone || (is_left(other.ray[0], there) && is_left(other.ray[1], there));
    third.ahead = !(slope < 0) ? kFar : seen ? ahead : kFar + ahead;
  }
}

/// The same for one that ties with them on a boundary ray.
double BorderTracer::ray_ahead(const Start& arc, std::uint32_t other, const Point& p, const Point& along) const {
  for (const std::uint32_t own : {arc.left, arc.right}) {
    const int leaves = contenders_.tangent_end(own, other), arrives = contenders_.tangent_end(other, own);
    if (leaves == Contenders::kNotTangent && arrives == Contenders::kNotTangent) continue;
    const auto& ray = leaves != Contenders::kNotTangent ? filter_[own].ray[static_cast<std::size_t>(leaves)] : filter_[other].ray[static_cast<std::size_t>(arrives)];
    const double ahead = -cross(ray.along, {p.x - ray.from.x, p.y - ray.from.y}) / cross(ray.along, along);
    return ahead > 0 ? ahead : kFar;
  }
  return kFar;
}

/// The border that leaves the new vertex against the one that arrives with `left` and `right`.
std::size_t BorderTracer::add_vertex(Vertex&& vertex, std::uint32_t left, std::uint32_t right) {
  const auto& ring = vertex.waves;
  known_.push_back(ring);
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
