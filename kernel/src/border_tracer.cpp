#include "border_tracer.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

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
  thirds_.assign(contenders_.size(), {});
  thirds_[arc.left].is_candidate = thirds_[arc.right].is_candidate = false;
  for (const auto& ring : known_)
    for (std::size_t n = 0; n < 3; ++n)
      if (ring[n] == arc.left && ring[(n + 1) % 3] == arc.right) thirds_[ring[(n + 2) % 3]].is_candidate = false;
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
    const auto vertex = first_vertex(arc);
    if (!vertex) return false;
    end = add_vertex(*vertex, arc.left, arc.right);
  } else {
    const Node& node = result_.nodes[starts_[*end].node];
    exclude_beside(arc, middle(node), node.x.rad() + node.y.rad());
  }
  if (starts_[*end].followed || !are_excluded(arc)) return false;
  starts_[start].followed = starts_[*end].followed = true;
  result_.arcs.push_back({contenders_[arc.left].site, contenders_[arc.right].site, arc.node, starts_[*end].node, contenders_.tangent(arc.left, arc.right)});
  return true;
}

/// The first vertex found, in the order in which they seem to come. What takes no part in the piece up to there is not nearer in its end either.
std::optional<BorderTracer::Vertex> BorderTracer::first_vertex(const Start& arc) {
  const Point p = middle(result_.nodes[arc.node]);
  const Point along = look_ahead(arc, p);
  for (std::uint32_t next = next_ahead(p, along); next != kNoWave; next = next_ahead(p, along)) {
    thirds_[next].ahead = std::numeric_limits<double>::infinity();
    const auto found = vertices_.find_in_doubles(arc.left, arc.right, next, {});
    if (!found) continue;
    thirds_[next].has_no_vertex = true;
    if (!found->exists) continue;
    exclude_beside(arc, found->at.p, 2 * found->at.radius);
    const std::optional<bool> beaten = is_beaten(*found, next);
    if (beaten == false) return found;
    thirds_[next].has_no_vertex = beaten.has_value();
  }
  return std::nullopt;
}

std::optional<bool> BorderTracer::is_beaten(const Vertex& vertex, std::uint32_t third) {
  std::optional<bool> beaten = false;
  for (std::uint32_t other = 0; other < thirds_.size(); ++other) {
    if (!thirds_[other].is_candidate || thirds_[other].is_off || other == third) continue;
    const std::optional<bool> nearer = vertices_.is_beaten(vertex, other);
    if (nearer == true) return true;
    if (!nearer) beaten = std::nullopt;
  }
  return beaten;
}

/// Finds out who takes no part in the piece of the arc up to a point, that is known up to `radius`.
void BorderTracer::exclude_beside(const Start& arc, const Point& end, double radius) {
  const Node& start = result_.nodes[arc.node];
  const auto piece = BisectorPiece::between(filter_.wave(arc.left), filter_.wave(arc.right), middle(start), end, std::max(start.x.rad() + start.y.rad(), radius));
  if (piece) {
    filter_.row().read(piece->middle, reading_);
    filter_.row().mark_farther(*piece, reading_, arc.left, off_);
    filter_.cones().mark_blind(*piece, off_);
  }
  for (std::uint32_t other = 0; other < thirds_.size(); ++other) thirds_[other].is_off = piece && off_[other];
}

/// Whether no other wave ends the arc before the end found.
bool BorderTracer::are_excluded(const Start& arc) {
  std::uint32_t off = 0;
  for (std::uint32_t other = 0; other < thirds_.size(); ++other) {
    const Third& third = thirds_[other];
    if (!third.is_candidate) continue;
    off += third.is_off ? 1 : 0;
    if (third.is_off || third.has_no_vertex) continue;
    const auto found = vertices_.find_in_doubles(arc.left, arc.right, other, all_);
    if (!found || found->exists) return false;
  }
  ladder_.count(Predicate::conflict, robust::Stage::filter, off);
  return true;
}

/// How far ahead each wave seems to tie with the two, along the tangent of the arc, which is returned; only an order of asking.
BorderTracer::Point BorderTracer::look_ahead(const Start& arc, const Point& p) {
  filter_.row().read(p, reading_);
  const Point of_left = reading_.gradient(arc.left), of_right = reading_.gradient(arc.right), along{of_right.y - of_left.y, of_left.x - of_right.x};
  const double at_p = reading_.at(arc.left), rise = dot(of_left, along);
  for (std::uint32_t other = 0; other < thirds_.size(); ++other) {
    Third& third = thirds_[other];
    if (!third.is_candidate) {
      third.ahead = std::numeric_limits<double>::infinity();
      continue;
    }
    third.is_looked_for = contenders_.related(arc.left, other) || contenders_.related(arc.right, other);
    if (third.is_looked_for) {
      third.ahead = ray_ahead(arc, other, p, along);
      continue;
    }
    const double slope = dot(reading_.gradient(other), along) - rise;
    const double ahead = (at_p - reading_.at(other)) / slope;
    third.ahead = slope < 0 && ahead < kFar ? ahead : kFar;
  }
  return along;
}

/// The next wave to be asked; kNoWave after the last. Those that seem not to see the place come later.
std::uint32_t BorderTracer::next_ahead(const Point& p, const Point& along) {
  for (;;) {
    const auto next = std::min_element(thirds_.begin(), thirds_.end(), [](const Third& a, const Third& b) { return a.ahead < b.ahead; });
    if (!(next->ahead < std::numeric_limits<double>::infinity())) return kNoWave;
    const auto wave = static_cast<std::uint32_t>(next - thirds_.begin());
    if (std::exchange(next->is_looked_for, true) || next->ahead >= kFar || sees(wave, {p.x + next->ahead * along.x, p.y + next->ahead * along.y})) return wave;
    next->ahead += kFar;
  }
}

/// As far as rounded numbers tell.
bool BorderTracer::sees(std::uint32_t wave, const Point& p) const {
  return !filter_.has_cone(wave) || (is_left(filter_.cones().ray(wave, 0), p) && is_left(filter_.cones().ray(wave, 1), p));
}

/// The same for one that ties with them on a boundary ray.
double BorderTracer::ray_ahead(const Start& arc, std::uint32_t other, const Point& p, const Point& along) const {
  for (const std::uint32_t own : {arc.left, arc.right}) {
    const int leaves = contenders_.tangent_end(own, other), arrives = contenders_.tangent_end(other, own);
    if (leaves == Contenders::kNotTangent && arrives == Contenders::kNotTangent) continue;
    const bool is_own = leaves != Contenders::kNotTangent;
    const auto ray = filter_.cones().ray(is_own ? own : other, static_cast<std::size_t>(is_own ? leaves : arrives));
    const double ahead = -cross(ray.along, {p.x - ray.from.x, p.y - ray.from.y}) / cross(ray.along, along);
    return ahead > 0 ? ahead : kFar;
  }
  return kFar;
}

/// The border that leaves the new vertex against the one that arrives with `left` and `right`.
std::size_t BorderTracer::add_vertex(const Vertex& vertex, std::uint32_t left, std::uint32_t right) {
  const auto& ring = vertex.waves();
  known_.push_back(ring);
  const auto node = static_cast<std::uint32_t>(result_.nodes.size());
  result_.nodes.push_back(vertices_.node(vertex));
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
