#include "ring.hpp"

#include <algorithm>

#include "gvd/predicates/side_tie.hpp"

namespace gvd::kernel {
namespace {

using predicates::PlanePoint;
using predicates::Predicate;
using predicates::operator-;
using robust::MaybeSign;
using robust::Sign;
using Node = FacetTessellation::Node;

template <class NT>
PlanePoint<NT> negated(const PlanePoint<NT>& v) {
  return {-v.x, -v.y};
}

Predicate predicate_at(Node::Kind kind) {
  return kind == Node::Kind::corner ? Predicate::corner_order
         : kind == Node::Kind::side ? Predicate::edge_tie
                                    : Predicate::conflict;
}

std::string place_name(const Node& node) {
  const char* kind = node.kind == Node::Kind::corner ? "corner "
                     : node.kind == Node::Kind::side ? "a point of side "
                                                     : "a point inside";
  return kind + (node.kind == Node::Kind::inside ? std::string() : std::to_string(node.where));
}

}  // namespace

template <class Test>
MaybeSign Ring::decide(const Test& test) {
  return ladder_.decide(predicate_at(node_->kind), test, [&] {
    std::string text = "the order round " + place_name(*node_) + " of";
    for (const Wave& wave : tied_) text += " " + contenders_.name(wave.contender);
    return text;
  });
}

template <class NT>
PlanePoint<NT> Ring::to_image(const FacetNumbers<NT>& numbers, std::uint32_t wave) const {
  return numbers.sites[contenders_[tied_[wave].contender].site]->image - node_point(waves_, numbers, *node_);
}

/// The unit vector to the image of i minus that of j, times a positive factor. Waves of one root that tie have images at one
/// distance.
template <class NT>
PlanePoint<NT> Ring::difference(const FacetNumbers<NT>& numbers, std::uint32_t i, std::uint32_t j) const {
  const Contender &a = contenders_[tied_[i].contender], &b = contenders_[tied_[j].contender];
  if (a.root == b.root) return numbers.sites[a.site]->image - numbers.sites[b.site]->image;
  const PlanePoint<NT> to_i = to_image(numbers, i), to_j = to_image(numbers, j);
  const NT ri = sqrt(squared_norm(to_i)), rj = sqrt(squared_norm(to_j));
  return {to_i.x * rj - to_j.x * ri, to_i.y * rj - to_j.y * ri};
}

template <class NT>
PlanePoint<NT> Ring::vector(const FacetNumbers<NT>& numbers, const Direction& d) const {
  switch (d.kind) {
    case Direction::Kind::side:
      return numbers.side[d.a].direction;
    case Direction::Kind::back:
      return negated(numbers.side[d.a].direction);
    case Direction::Kind::away:
      return negated(to_image(numbers, d.a));
    case Direction::Kind::towards:
      return to_image(numbers, d.a);
    case Direction::Kind::overtaking:
      break;
  }
  const PlanePoint<NT> gain = difference(numbers, d.b, d.a);
  return {gain.y, -gain.x};
}

/// Whether i and j come along lines that are mirrored in a side, by identity: positive if i comes in over the side, negative if j does.
Sign Ring::mirrored(std::uint32_t i, std::uint32_t j, std::size_t side) {
  for (std::uint32_t a = 0; a < tied_.size(); ++a) {
    for (std::uint32_t b = 0; b < tied_.size(); ++b) {
      const Sign sense = contenders_.mirrored(tied_[a].contender, tied_[b].contender, side);
      if (sense != Sign::zero && alike(i, a) && alike(j, b)) return sense;
    }
  }
  return Sign::zero;
}

/// Turning through the direction of a side, a wave that comes over it gives way to its mirror image.
Sign Ring::along_mirror(const Direction& change, const Direction& side) {
  if (change.kind != Direction::Kind::overtaking || !is_side(side)) return Sign::zero;
  const Sign sense = mirrored(change.a, change.b, side.a);
  return side.kind == Direction::Kind::side ? sense : -sense;
}

/// Whether the waves come along one line, by identity or as found before: what one eclipses ties with it on one line only.
bool Ring::are_known_alike(std::uint32_t i, std::uint32_t j) const {
  const std::uint32_t a = tied_[i].contender, b = tied_[j].contender;
  return same_[i * tied_.size() + j] > 0 || contenders_.eclipses(a, b) || contenders_.eclipses(b, a);
}

/// Waves that come along one line grow alike.
bool Ring::alike(std::uint32_t i, std::uint32_t j) { return i == j || same_direction(i, j) == true; }

/// Whether the two are one line by identity: positive in the same sense, negative in the opposite one; zero if nothing is known.
Sign Ring::same_line(const Direction& a, const Direction& b) {
  using Kind = Direction::Kind;
  if (a == b) return Sign::positive;
  for (const Sign known : {along_mirror(a, b), along_mirror(b, a)})
    if (known != Sign::zero) return known;
  if (a.kind == Kind::overtaking && b.kind == Kind::overtaking) {
    if (alike(a.a, b.b) && alike(a.b, b.a)) return Sign::negative;
    return alike(a.a, b.a) && alike(a.b, b.b) ? Sign::positive : Sign::zero;
  }
  const auto to_an_image = [](Kind kind) { return kind == Kind::away || kind == Kind::towards; };
  if (!to_an_image(a.kind) || !to_an_image(b.kind) || (a.a != b.a && !are_known_alike(a.a, b.a))) return Sign::zero;
  return a.kind == b.kind ? Sign::positive : Sign::negative;
}

/// From a side on which the point lies to the line to an image, or back: on which side of that line the image lies, wherever the point is.
MaybeSign Ring::turn_to_image(const Direction& side, const Direction& image, bool from_side) {
  const bool against = (side.kind == Direction::Kind::back) != (image.kind == Direction::Kind::away);
  const MaybeSign left = decide([&](const auto& numbers) {
    const auto& line = numbers.side[side.a];
    return maybe_sign(cross(line.direction, numbers.sites[contenders_[tied_[image.a].contender].site]->image - line.origin));
  });
  if (!left) return left;
  return against == from_side ? -*left : *left;
}

/// Whether the direction is to or from an image on the line of the side on which the point lies.
bool Ring::is_on_side_line(const Direction& d) {
  if (node_->kind != Node::Kind::side || (d.kind != Direction::Kind::away && d.kind != Direction::Kind::towards)) return false;
  std::optional<bool>& known = tied_[d.a].on_side_line;
  if (!known) {
    const auto off = [&](const auto& numbers, robust::Stage) {
      const auto& line = numbers.side[node_->where];
      return maybe_sign(cross(line.direction, numbers.sites[contenders_[tied_[d.a].contender].site]->image - line.origin));
    };
    const MaybeSign filtered = off(ladder_.filter(), robust::Stage::filter);
    known = (filtered ? filtered : ladder_.for_each_stage(off)) == Sign::zero;
  }
  return *known;
}

MaybeSign Ring::turn(const Direction& a, const Direction& b) {
  if (same_line(a, b) != Sign::zero) return Sign::zero;
  if (is_on_side_line(a) && is_on_side_line(b)) return Sign::zero;
  const Direction &side = is_side(a) ? a : b, &change = is_side(a) ? b : a;
  if (is_side(side) && (change.kind == Direction::Kind::away || change.kind == Direction::Kind::towards))
    return turn_to_image(side, change, is_side(a));
  const auto test = [&](const auto& numbers) { return maybe_sign(cross(vector(numbers, a), vector(numbers, b))); };
  // Mirrored waves take over from one another in the direction of the side.
  if (is_side(side) && change.kind == Direction::Kind::overtaking && !test(ladder_.filter()) &&
      are_mirrored(change.a, change.b, side)) {
    ladder_.count(predicate_at(node_->kind), robust::Stage::algebra);
    return Sign::zero;
  }
  return decide(test);
}

MaybeSign Ring::along(const Direction& a, const Direction& b) {
  if (const Sign known = same_line(a, b); known != Sign::zero) return known;
  return decide([&](const auto& numbers) { return maybe_sign(dot(vector(numbers, a), vector(numbers, b))); });
}

/// Where d lies counter-clockwise from `from`: 0 up to half a turn, 1 half a turn, 2 beyond it, 3 a full turn.
std::optional<int> Ring::quadrant(const Direction& from, const Direction& d) {
  const MaybeSign side = turn(from, d);
  if (!side) return std::nullopt;
  if (*side != Sign::zero) return *side == Sign::positive ? 0 : 2;
  const MaybeSign same_way = along(from, d);
  if (!same_way) return std::nullopt;
  return *same_way == Sign::positive ? 3 : 1;
}

/// Whether one comes to a strictly before b, turning counter-clockwise from `from`; `from` itself comes last.
std::optional<bool> Ring::comes_before(const Direction& from, const Direction& a, const Direction& b) {
  const auto qa = quadrant(from, a), qb = quadrant(from, b);
  if (!qa || !qb) return std::nullopt;
  if (*qa != *qb) return *qa < *qb;
  if (*qa == 1 || *qa == 3) return false;
  const MaybeSign order = turn(a, b);
  if (!order) return std::nullopt;
  return *order == Sign::positive;
}

bool Ring::is_on_node_ray(const Node& node, std::uint32_t wave, std::size_t end) const {
  return node.ray != FacetTessellation::kNoSite && contenders_[wave].has_cone && contenders_.is_on_ray(wave, end, node.ray, node.ray_end);
}

/// A wave ties with a relay of its own on their common ray and nowhere else (but with its other half, beyond the ray, everywhere): whether one that starts on
/// this ray is known to tie too.
template <class Known>
bool Ring::relay_on_ray(std::uint32_t wave, std::size_t end, const Known& is_known) const {
  for (std::uint32_t relay = 0; relay < contenders_.size(); ++relay)
    if (contenders_.tangent_end(wave, relay) == static_cast<int>(end) && !contenders_.eclipses(relay, wave) && is_known(relay)) return true;
  return false;
}

/// On which side of a boundary ray the point lies; zero by identity where the ray is known to pass through it.
MaybeSign Ring::at_ray(std::uint32_t contender, std::size_t end) {
  const Contender& wave = contenders_[contender];
  const auto is_tied = [&](std::uint32_t other) {
    return std::any_of(tied_.begin(), tied_.end(), [&](const Wave& tied) { return tied.contender == other; });
  };
  const bool at_cone_vertex = node_->kind == Node::Kind::corner && wave.cone[end] == waves_.corner[node_->where];
  if (at_cone_vertex || is_on_node_ray(*node_, contender, end) || relay_on_ray(contender, end, is_tied)) return Sign::zero;
  if (node_->kind == Node::Kind::side && contenders_.runs_along(ladder_, contender, end, node_->where)) {
    ladder_.count(Predicate::edge_tie, robust::Stage::identity);
    return Sign::zero;
  }
  return decide(
      [&](const auto& numbers) { return maybe_sign(cone_side(numbers, wave, end, node_point(waves_, numbers, *node_))); });
}

/// Whether two waves have one distance at the node by identity: halves of one wave, mirror images in its side, or a relay and its parent on their common ray, which goes
/// through the node or runs along its side.
bool Ring::tie_by_identity(const Node& node, std::uint32_t i, std::uint32_t j) const {
  const auto on_common_ray = [&](std::uint32_t parent, std::uint32_t relay) {
    const int end = contenders_.tangent_end(parent, relay);
    if (end == Contenders::kNotTangent) return false;
    return is_on_node_ray(node, parent, static_cast<std::size_t>(end)) ||
           (node.kind == Node::Kind::side && contenders_.tie_on_ray_along(ladder_, parent, relay, node.where));
  };
  const bool one_wave = contenders_.eclipses(i, j) && contenders_.eclipses(j, i);
  return one_wave || on_common_ray(i, j) || on_common_ray(j, i) ||
         (node.kind == Node::Kind::side && contenders_.mirrored(i, j, node.where) != Sign::zero);
}

std::optional<bool> Ring::ties(const Node& node, std::span<const std::uint32_t> known, std::uint32_t other) {
  const Contender &a = contenders_[known.front()], &b = contenders_[other];
  const auto is_known = [&](std::uint32_t wave) {
    return std::any_of(known.begin(), known.end(), [&](std::uint32_t i) { return i == wave || tie_by_identity(node, i, wave); });
  };
  const bool as_far = is_known(other);
  std::array<bool, 2> on_ray{};
  for (std::size_t end = 0; b.has_cone && end < 2; ++end)
    on_ray[end] = is_on_node_ray(node, other, end) || (as_far && relay_on_ray(other, end, is_known)) ||
                  (node.kind == Node::Kind::side && contenders_.runs_along(ladder_, other, end, node.where));
  const auto test = [&](const auto& numbers) -> std::optional<bool> {
    const auto p = node_point(waves_, numbers, node);
    const MaybeSign farther =
        as_far ? Sign::zero : maybe_sign(distance(*numbers.sites[b.site], p) - distance(*numbers.sites[a.site], p));
    if (farther == Sign::positive) return false;
    bool open = !farther;
    for (std::size_t end = 0; b.has_cone && end < 2; ++end) {
      if (on_ray[end]) continue;
      const MaybeSign inside = maybe_sign(cone_side(numbers, b, end, p));
      if (inside == Sign::negative) return false;
      open = open || !inside;
    }
    return open ? std::nullopt : std::optional(true);
  };
  return ladder_.decide(predicate_at(node.kind), test, [&] {
    return "whether " + contenders_.name(other) + " ties with " + contenders_.name(known.front()) + " at " + place_name(node);
  });
}

/// Whether doubles show that a wave is farther from the point than another one that is known to tie there, or does not see it.
bool Ring::is_apart(const predicates::PlanePoint<FacetLadder::F>& p, std::uint32_t known, std::uint32_t other) const {
  const auto& numbers = ladder_.filter();
  const Contender& wave = contenders_[other];
  const auto distance_of = [&](const Contender& c) { return distance(*numbers.sites[c.site], p); };
  if (maybe_sign(distance_of(wave) - distance_of(contenders_[known])) == Sign::positive) return true;
  for (std::size_t end = 0; wave.has_cone && end < 2; ++end)
    if (maybe_sign(cone_side(numbers, wave, end, p)) == Sign::negative) return true;
  return false;
}

/// What ties by identity is asked before the rest, whose numbers may be beyond all proof; but first of all what doubles exclude, since that is most.
bool Ring::add_ties(const Node& node, std::vector<std::uint32_t>& known) {
  std::vector<std::uint32_t> others;
  const auto p = node_point(waves_, ladder_.filter(), node);
  for (std::uint32_t i = 0; i < contenders_.size(); ++i) {
    if (std::find(known.begin(), known.end(), i) != known.end()) continue;
    if (is_apart(p, known.front(), i))
      ladder_.count(predicate_at(node.kind), robust::Stage::filter);
    else
      others.push_back(i);
  }
  bool may_be_known = true;
  while (!others.empty()) {
    auto other = others.end();
    if (may_be_known)
      other = std::find_if(others.begin(), others.end(), [&](std::uint32_t i) {
        return std::any_of(known.begin(), known.end(), [&](std::uint32_t j) { return tie_by_identity(node, i, j); });
      });
    may_be_known = other != others.end();
    if (!may_be_known) other = others.begin();
    const auto tied = ties(node, known, *other);
    if (!tied) return false;
    if (*tied) {
      known.push_back(*other);
      may_be_known = true;
    }
    others.erase(other);
  }
  return true;
}

bool Ring::load(const Node& node, std::span<const std::uint32_t> tied) {
  node_ = &node;
  tied_.clear();
  for (const std::uint32_t contender : tied) tied_.push_back({contender, false, {false, false}, std::nullopt});
  same_.assign(tied.size() * tied.size(), 0);
  for (Wave& wave : tied_) {
    const Contender& c = contenders_[wave.contender];
    wave.starts_here = node.kind == Node::Kind::corner && c.corner == node.where;
    for (std::size_t end = 0; c.has_cone && end < 2; ++end) {
      const MaybeSign side = at_ray(wave.contender, end);
      if (!side) return false;
      wave.on_ray[end] = *side == Sign::zero;
    }
  }
  return true;
}

/// Whether the cone goes on from the point in directions right after d, or right before it, counter-clockwise.
std::optional<bool> Ring::seen(std::uint32_t i, const Direction& d, Beside beside) {
  const Direction away{Direction::Kind::away, i, 0};
  for (std::size_t end = 0; end < 2; ++end) {
    if (!tied_[i].on_ray[end]) continue;
    MaybeSign left = turn(away, d);  // of the ray; the cone is on the right of ray 0 and on the left of ray 1
    if (left == Sign::zero) {        // turning on, one leaves it to the left, or to the right if d points back
      left = along(away, d);
      if (left && beside == Beside::before) left = -*left;
    }
    if (!left) return std::nullopt;
    if ((*left == Sign::positive) != (end == 1)) return false;
  }
  return true;
}

std::optional<bool> Ring::same_direction(std::uint32_t i, std::uint32_t j) {
  signed char& known = same_[i * tied_.size() + j];
  if (known == 0) {
    if (are_known_alike(i, j)) {
      known = 1;
    } else {
      const Direction to_i{Direction::Kind::towards, i, 0}, to_j{Direction::Kind::towards, j, 0};
      const MaybeSign apart = turn(to_i, to_j);
      const MaybeSign same_way = apart == Sign::zero ? along(to_i, to_j) : apart;
      if (!same_way) return std::nullopt;
      known = apart == Sign::zero && same_way == Sign::positive ? 1 : -1;
    }
    same_[j * tied_.size() + i] = known;
  }
  return known > 0;
}

/// Of two waves that tie: positive if j has the greater weight. If they come along one line, it started on the way of i, which is
/// nowhere farther.
MaybeSign Ring::behind(std::uint32_t i, std::uint32_t j) {
  const std::uint32_t a = tied_[i].contender, b = tied_[j].contender;
  if (contenders_.eclipses(a, b)) return Sign::positive;
  if (contenders_.eclipses(b, a)) return Sign::negative;
  if (contenders_[a].root == contenders_[b].root) return Sign::zero;
  for (std::size_t side = 0; side < 3; ++side)
    if (contenders_.mirrored(a, b, side) != Sign::zero) return Sign::zero;
  return decide([&](const auto& numbers) {
    return maybe_sign(numbers.sites[contenders_[b].site]->weight - numbers.sites[contenders_[a].site]->weight);
  });
}

/// Whether d is that of a side of the facet on which the point lies.
bool Ring::is_side(const Direction& d) const {
  return node_->kind != Node::Kind::inside && (d.kind == Direction::Kind::side || d.kind == Direction::Kind::back);
}

/// Whether the images of i and j are mirrored in the line of such a side, and the weights equal: then the waves tie
/// along it. Unlike a slope, this needs no number of the point itself.
bool Ring::are_mirrored(std::uint32_t i, std::uint32_t j, const Direction& d) {
  const Contender &a = contenders_[tied_[i].contender], &b = contenders_[tied_[j].contender];
  if (mirrored(i, j, d.a) != Sign::zero) return true;
  const bool same_weight = a.root == b.root;
  const auto gap = [&](const auto& numbers, robust::Stage) {
    return maybe_sign(predicates::mirrored_gap(numbers.side[d.a], *numbers.sites[a.site], *numbers.sites[b.site], same_weight));
  };
  const auto heavier = [&](const auto& numbers, robust::Stage) {
    return maybe_sign(numbers.sites[a.site]->weight - numbers.sites[b.site]->weight);
  };
  const MaybeSign filtered = gap(ladder_.filter(), robust::Stage::filter);
  if ((filtered ? filtered : ladder_.for_each_stage(gap)) != Sign::zero) return false;
  return same_weight || ladder_.for_each_stage(heavier) == Sign::zero;
}

/// Positive if i is nearer than j in direction d, to first order.
MaybeSign Ring::slope(std::uint32_t i, std::uint32_t j, const Direction& d) {
  const auto test = [&](const auto& numbers) { return maybe_sign(dot(vector(numbers, d), difference(numbers, i, j))); };
  if (is_side(d) && !test(ladder_.filter()) && are_mirrored(i, j, d)) {
    ladder_.count(predicate_at(node_->kind), robust::Stage::algebra);
    return Sign::zero;
  }
  return decide(test);
}

/// Positive if i is nearer than j in directions right after d, cones aside; zero if they have one image.
MaybeSign Ring::better_after(std::uint32_t i, std::uint32_t j, const Direction& d) {
  if (tied_[i].starts_here || tied_[j].starts_here) return tied_[i].starts_here ? Sign::negative : Sign::positive;
  const auto same = same_direction(i, j);
  if (!same) return std::nullopt;
  if (*same) return behind(i, j);
  const bool is_change = d.kind == Direction::Kind::overtaking;
  if (is_change && alike(d.a, j) && alike(d.b, i)) return Sign::positive;
  if (is_change && alike(d.a, i) && alike(d.b, j)) return Sign::negative;
  const MaybeSign sign = slope(i, j, d);
  if (sign != Sign::zero) return sign;
  return decide([&](const auto& numbers) { return maybe_sign(cross(vector(numbers, d), difference(numbers, i, j))); });
}

std::optional<std::uint32_t> Ring::winner_after(const Direction& d) {
  std::optional<std::uint32_t> best;
  for (std::uint32_t i = 0; i < tied_.size(); ++i) {
    const auto visible = seen(i, d, Beside::after);
    if (!visible) return std::nullopt;
    if (!*visible) continue;
    const MaybeSign better = best ? better_after(i, *best, d) : Sign::positive;
    if (!better) return std::nullopt;
    if (*better == Sign::positive) best = i;
  }
  if (!best) ladder_.fail(predicate_at(node_->kind), "no wave is seen beside " + place_name(*node_));
  return best;
}

/// The first direction after `from` in which another wave overtakes the winner, or a cone begins or ends.
std::optional<Ring::Direction> Ring::next_change(const Direction& from, std::uint32_t winner) {
  std::vector<Direction> changes;
  for (std::uint32_t i = 0; i < tied_.size(); ++i) {
    if (tied_[i].on_ray[0] || tied_[i].on_ray[1]) {
      changes.push_back({Direction::Kind::away, i, 0});
      changes.push_back({Direction::Kind::towards, i, 0});
    }
    if (i == winner || tied_[i].starts_here || tied_[winner].starts_here) continue;
    const auto same = same_direction(i, winner);
    if (!same) return std::nullopt;
    if (!*same) changes.push_back({Direction::Kind::overtaking, winner, i});
  }
  Direction first = from;  // comes last
  for (const Direction& d : changes) {
    const auto sooner = comes_before(from, d, first);
    if (!sooner) return std::nullopt;
    if (*sooner) first = d;
  }
  return first;
}

/// Along a side d, where two waves with mirrored directions grow alike to first order: the one with the lower weight is nearer
/// there, and keeps a part of the facet between the side and a bisector that touches it. That wave (of several in one line the one that is
/// nowhere farther), if it is not `inward`, the nearest just inside.
std::optional<std::uint32_t> Ring::along_side(const Direction& d, Beside beside, std::uint32_t inward) {
  if (tied_[inward].starts_here) return inward;
  std::uint32_t best = inward;
  for (std::uint32_t i = 0; i < tied_.size(); ++i) {
    const std::uint32_t a = tied_[i].contender, b = tied_[inward].contender;
    if (tied_[i].starts_here || contenders_[a].root == contenders_[b].root) continue;
    if (i == inward) continue;
    const auto one_line = same_direction(i, inward);
    if (!one_line) return std::nullopt;
    if (*one_line) continue;
    const MaybeSign gain = slope(i, inward, d);
    if (gain && *gain != Sign::zero) continue;
    const auto visible = seen(i, d, beside);
    if (!gain || !visible) return std::nullopt;
    if (!*visible) continue;
    const MaybeSign lighter = behind(i, best);
    if (!lighter) return std::nullopt;
    if (*lighter == Sign::positive) best = i;
  }
  return best;
}

/// The regions by direction, between those that have the sides themselves.
bool Ring::add_slivers(const Direction& begin, const Direction& end, std::uint32_t first, std::uint32_t last,
                       std::vector<std::uint32_t>& regions) {
  const auto before = along_side(begin, Beside::after, first), after = along_side(end, Beside::before, last);
  if (!before || !after) return false;
  if (*before != first) regions.insert(regions.begin(), tied_[*before].contender);
  if (*after != last) regions.push_back(tied_[*after].contender);
  return true;
}

std::vector<std::uint32_t> Ring::regions(const Node& node, std::span<const std::uint32_t> tied) {
  if (!load(node, tied)) return {};
  Direction at{Direction::Kind::side, node.kind == Node::Kind::inside ? 0u : node.where, 0};
  Direction end = at;
  if (node.kind == Node::Kind::corner) end = {Direction::Kind::back, (node.where + 2u) % 3, 0};
  if (node.kind == Node::Kind::side) end = {Direction::Kind::back, node.where, 0};
  const Direction begin = at;
  std::vector<std::uint32_t> result;
  auto winner = winner_after(at);
  const std::uint32_t first = winner.value_or(0);
  for (; winner; winner = winner_after(at)) {
    const std::uint32_t contender = tied_[*winner].contender;
    if (result.empty() || result.back() != contender) result.push_back(contender);
    const auto next = next_change(at, *winner);
    if (!next) return {};
    const auto inside = comes_before(at, *next, end);
    if (!inside) return {};
    if (!*inside) {
      if (node.kind != Node::Kind::inside)
        return add_slivers(begin, end, first, *winner, result) ? result : std::vector<std::uint32_t>();
      if (result.size() > 1 && result.front() == result.back()) result.pop_back();
      return result;
    }
    at = *next;
  }
  return {};
}

}  // namespace gvd::kernel
