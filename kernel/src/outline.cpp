#include "outline.hpp"

#include <algorithm>
#include <cmath>

namespace gvd::kernel {
namespace {

using predicates::Existence;
using predicates::Predicate;
using predicates::operator-;
using robust::MaybeSign;
using robust::Sign;
using Node = FacetTessellation::Node;
using Piece = FacetTessellation::Piece;

}  // namespace

std::string OutlineWalk::describe(std::size_t side, const Event& event, const char* what) const {
  return std::string(what) + " on side " + std::to_string(side) + ", " + contenders_.name(event.from) + " to " +
         contenders_.name(event.to);
}

std::uint32_t OutlineWalk::add_node(Node node) {
  result_.nodes.push_back(std::move(node));
  return static_cast<std::uint32_t>(result_.nodes.size() - 1);
}

void OutlineWalk::enter(std::uint32_t node, std::uint32_t contender) {
  list_.back().node_after = node;
  list_.push_back({contender, Piece::kNoNode});
}

std::vector<Occurrence> OutlineWalk::walk() {
  std::array<std::vector<std::uint32_t>, 3> at_corner;
  for (std::size_t c = 0; c < 3; ++c) {
    at_corner[c] = corners_.sequence(c);
    if (ladder_.failed()) return {};
  }
  list_.push_back({at_corner[0].back(), Piece::kNoNode});
  for (std::size_t side = 0; side < 3; ++side) {
    if (!pass_corner(side, at_corner[side])) return {};
    if (!walk_side(side, at_corner[(side + 1) % 3].back())) return {};
  }
  if (list_.size() > 1) list_.pop_back();  // the walk has come back to the first occurrence
  return std::move(list_);
}

bool OutlineWalk::pass_corner(std::size_t c, const std::vector<std::uint32_t>& sequence) {
  if (sequence.size() == 1) return true;
  Node node;
  node.kind = Node::Kind::corner;
  node.where = static_cast<std::uint8_t>(c);
  for (const std::uint32_t wave : sequence) node.sites.push_back(contenders_[wave].site);
  const auto at = predicates::corner_point(*ladder_.filter().frame, c);
  node.x = at.x;
  node.y = at.y;
  const std::uint32_t id = add_node(std::move(node));
  for (std::size_t i = sequence.size() - 1; i-- > 0;) enter(id, sequence[i]);
  return true;
}

bool OutlineWalk::walk_side(std::size_t side, std::uint32_t last) {
  std::optional<Event> previous;
  passed_.clear();
  std::uint32_t from_node = Piece::kNoNode;
  for (;;) {
    const std::uint32_t current = list_.back().contender;
    auto events = next_events(side, current, previous);
    if (!events) return false;
    if (!complete(side, current, last, previous, *events)) return false;
    if (events->empty()) {
      result_.outline.push_back({static_cast<std::uint8_t>(side), contenders_[current].site, from_node, Piece::kNoNode});
      return true;
    }
    const std::size_t nodes = result_.nodes.size();
    if (!pass_event(side, *events)) return false;
    if (result_.nodes.size() > nodes) {
      const auto to_node = static_cast<std::uint32_t>(nodes);
      result_.outline.push_back({static_cast<std::uint8_t>(side), contenders_[current].site, from_node, to_node});
      from_node = to_node;
    }
    previous = (*events)[0];
    for (const Event& event : *events)
      if (event.to == list_.back().contender) previous = event;
  }
}

/// The only wave that takes over from `from` first after `previous`, or none, if plain doubles can tell.
std::optional<std::vector<OutlineWalk::Event>> OutlineWalk::filtered_events(std::size_t side, std::uint32_t from,
                                                                            const std::optional<Event>& previous) {
  std::optional<OvertakingFilter::Passed> passed;
  if (previous) {
    if (previous->to != from || previous->from == from) return std::nullopt;  // no plain overtaking
    if (!previous->filtered || previous->filtered->existence != Existence::proved) return std::nullopt;
    const auto& t = previous->filtered->t;  // it lies on the side, however wide its enclosure; outside, the filter's arguments do not hold
    passed = {previous->from, {std::max(0.0, t.lower()), std::min(1.0, t.upper())}};
  }
  const auto next = overtaking_.next(side, from, passed);
  if (!next) return std::nullopt;
  ladder_.count(Predicate::edge_tie, robust::Stage::filter, next->decisions);
  std::vector<Event> events;
  if (!next->exists) return events;
  Event event{from, next->to, FacetTessellation::kNoSite, 0, false, false,
              predicates::SideTie<FacetWaves::F>{Existence::proved, next->at.parameter()}};
  if (next->ray) {
    event.ray = contenders_[next->ray->parent].cone_site[next->ray->end];
    event.ray_end = next->ray->end;
  }
  events.push_back(event);
  return events;
}

/// The waves that take over from `from` first after `previous`; several if they do so at the same point.
std::optional<std::vector<OutlineWalk::Event>> OutlineWalk::next_events(std::size_t side, std::uint32_t from,
                                                                        const std::optional<Event>& previous) {
  touched_ = false;
  if (auto filtered = filtered_events(side, from, previous)) return filtered;
  std::vector<Event> first;
  const double low = previous && previous->filtered ? previous->filtered->t.lower() : 0;
  double high = 1;
  for (std::uint32_t to = 0; to < contenders_.size(); ++to) {
    const auto stretch = filter_.cones().stretch(to, side);
    if (to == from || stretch.high < low || stretch.low > high) continue;
    touched_ = touched_ || may_touch(side, from, to);
    std::optional<Event> event = candidate(side, from, to);
    if (!event) {
      if (ladder_.failed()) return std::nullopt;
      continue;
    }
    event->filtered = parameter(ladder_.filter(), side, *event);
    const std::optional<bool> real = happens(side, *event, previous);
    if (!real) return std::nullopt;
    if (!*real) continue;
    const MaybeSign order = first.empty() ? Sign::negative : compare(side, *event, first[0]);
    if (!order) return std::nullopt;
    if (*order == Sign::negative) first.clear();
    if (*order == Sign::positive) continue;
    first.push_back(*event);
    if (first.size() == 1 && event->filtered) high = std::min(1.0, event->filtered->t.upper());
  }
  return first;
}

/// Looks after the view of `from` itself: if it ends before the events found (or before the corner, which `last` comes to), the
/// place where it does is the next event; if it ends in their very point, that is noted.
bool OutlineWalk::complete(std::size_t side, std::uint32_t from, std::uint32_t last, const std::optional<Event>& previous,
                           std::vector<Event>& events) {
  if (events.empty() && from == last) return true;
  for (std::size_t end = 0; contenders_[from].has_cone && end < 2; ++end) {
    const std::uint32_t ray = contenders_[from].cone_site[end];
    if (!events.empty() && events[0].ray != FacetTessellation::kNoSite && contenders_.is_on_ray(from, end, events[0].ray, events[0].ray_end)) {
      if (events[0].ray != ray || events[0].ray_end != end) events[0].on_ray = true;  // another name for it
      continue;
    }
    if (!events.empty() && events[0].filtered && events[0].filtered->existence == Existence::proved) {
      const auto& t = events[0].filtered->t;  // between its bounds the ray's side is linear, and the event lies on the side, however wide they are
      const double low = std::max(0.0, t.lower()), high = std::min(1.0, t.upper());
      if (filter_.cone_side(side, from, end, low).positive() && filter_.cone_side(side, from, end, high).positive()) {
        ladder_.count(Predicate::edge_tie, robust::Stage::filter);
        continue;
      }
    }
    if (!events.empty() && contenders_.runs_along(ladder_, from, end, side)) {
      ladder_.count(Predicate::edge_tie, robust::Stage::identity);
      events[0].on_ray = true;
      continue;
    }
    const MaybeSign seen = ladder_.decide(
        Predicate::edge_tie,
        [&](const auto& numbers) -> MaybeSign {
          if (events.empty()) return maybe_sign(cone_side(numbers, contenders_[from], end, numbers.side[(side + 1) % 3].origin));
          const auto tie = parameter(numbers, side, events[0]);
          if (tie.existence != Existence::proved) return std::nullopt;
          return maybe_sign(cone_side(numbers, contenders_[from], end, predicates::point_at(numbers.side[side], tie.t)));
        },
        [&] { return "the end of the view of " + contenders_.name(from) + " on side " + std::to_string(side); });
    if (!seen) return false;
    if (*seen == Sign::positive) continue;
    if (*seen == Sign::zero && !events.empty()) events[0].on_ray = true;
    if (*seen == Sign::negative) {
      Event view_ends{from, from, ray, static_cast<std::uint8_t>(end), true, false, std::nullopt};
      view_ends.filtered = parameter(ladder_.filter(), side, view_ends);
      const auto real = happens(side, view_ends, previous);
      if (!real) return false;
      view_ends.on_ray = true;
      if (*real) events = {view_ends};
    }
  }
  if (!events.empty()) return true;
  ladder_.fail(Predicate::edge_tie, "the walk ends in " + contenders_.name(from) + " on side " + std::to_string(side) +
                                        ", not in the corner's " + contenders_.name(last));
  return false;
}

/// What would have to happen for `to` to take over from `from` on the side, if identity does not exclude it.
std::optional<OutlineWalk::Event> OutlineWalk::candidate(std::size_t side, std::uint32_t from, std::uint32_t to) {
  const auto [a, b] = twins_that_touch(side, from, to);
  if (!contenders_.tangent(a, b)) {
    if (contenders_.eclipses(a, b) || contenders_.eclipses(b, a)) return std::nullopt;
    if (contenders_.mirrored(from, to, side) != Sign::zero) return contact(side, from, to);
    if (may_touch(side, from, to)) {
      if (auto touch = mirrored_touch(side, from, to); touch.is_known) return touch.event;
      const auto touches = do_touch(side, from, to);
      if (touches == true || ladder_.failed()) return contact(side, from, to);
    }
    const Event event{from, to, FacetTessellation::kNoSite, 0, false, false, std::nullopt};
    if (tie_is_at_corner(side, event)) return std::nullopt;
    return event;
  }
  const auto ray = tangent_event(contenders_, side, a, b);
  if (!ray) return std::nullopt;
  return Event{from, to, contenders_[ray->parent].cone_site[ray->end], ray->end, false, false, std::nullopt};
}

/// Along a side, mirror images in it are as far: `from` and `to`, or mirror images of them which are tangent or one of which eclipses
/// the other. If `from` and `to` are mirror images themselves, they tie all along, whatever else has an image where they have theirs.
std::array<std::uint32_t, 2> OutlineWalk::twins_that_touch(std::size_t side, std::uint32_t from, std::uint32_t to) const {
  const auto touch = [&](std::uint32_t i, std::uint32_t j) {
    return contenders_.tangent(i, j) || contenders_.eclipses(i, j) || contenders_.eclipses(j, i);
  };
  if (touch(from, to) || contenders_.mirrored(from, to, side) != Sign::zero) return {from, to};
  const auto stands_for = [&](std::uint32_t i, std::uint32_t j) { return i != from && i != to && contenders_.mirrored(i, j, side) != Sign::zero; };
  for (std::uint32_t i = 0; i < contenders_.size(); ++i)
    if (touch(i, to) && stands_for(i, from)) return {i, to};
  for (std::uint32_t i = 0; i < contenders_.size(); ++i)
    if (touch(from, i) && stands_for(i, to)) return {from, i};
  return {from, to};
}

/// Whether two waves may touch in a point of the side without crossing there, as far as identity and doubles can tell.
bool OutlineWalk::may_touch(std::size_t side, std::uint32_t from, std::uint32_t to) const {
  const Contender &a = contenders_[from], &b = contenders_[to];
  const auto& numbers = ladder_.filter();
  return contenders_.mirrored(from, to, side) == Sign::zero &&
         maybe_sign(predicates::mirrored_gap(numbers.side[side], *numbers.sites[a.site], *numbers.sites[b.site], a.root == b.root))
                 .value_or(Sign::zero) == Sign::zero;
}

/// A wave against the mirror image of a relay at the vertex of its cone, which is as far as the relay all along the side: they touch on the boundary ray.
OutlineWalk::MirroredTouch OutlineWalk::mirrored_touch(std::size_t side, std::uint32_t from, std::uint32_t to) const {
  for (const bool relay_takes_over : {true, false}) {
    const std::uint32_t parent = relay_takes_over ? from : to;
    const int end = contenders_.mirrored_tangent_end(parent, relay_takes_over ? to : from, side);
    if (end == Contenders::kNotTangent) continue;
    const bool last_ray = end == (contenders_[parent].enters_over(side) ? 1 : 0);
    if (last_ray != relay_takes_over) return {true, {}};
    const auto ray = static_cast<std::size_t>(end);
    return {true, Event{from, to, contenders_[parent].cone_site[ray], static_cast<std::uint8_t>(end), false, false, std::nullopt}};
  }
  return {};
}

/// Whether they do touch, or would on the line of the side. Empty if that is beyond proof: then it matters if `to` may come into view there.
std::optional<bool> OutlineWalk::do_touch(std::size_t side, std::uint32_t from, std::uint32_t to) {
  const Contender &a = contenders_[from], &b = contenders_[to];
  const auto gap = [&](const auto& numbers, robust::Stage stage) {
    const MaybeSign sign =
        maybe_sign(predicates::mirrored_gap(numbers.side[side], *numbers.sites[a.site], *numbers.sites[b.site], a.root == b.root));
    if (sign) ladder_.count(Predicate::edge_tie, stage);
    return sign;
  };
  if (const MaybeSign sign = ladder_.for_each_stage(gap)) return *sign == Sign::zero;
  if (contenders_.mirrored_on_way(from, to, side)) {
    ladder_.count(Predicate::edge_tie, robust::Stage::algebra);
    return true;
  }
  const Event event{from, to, FacetTessellation::kNoSite, 0, true, true, std::nullopt};
  if (b.has_cone) ladder_.fail(Predicate::edge_tie, describe(side, event, "contact"));
  return std::nullopt;
}

/// Mirror images in the side, say, tie along it: `from` may come over the side and `to` be the nearer one just inside as soon as it
/// is seen. Pre: they tie along the side, or touch.
std::optional<OutlineWalk::Event> OutlineWalk::contact(std::size_t side, std::uint32_t from, std::uint32_t to) const {
  const Contender& wave = contenders_[to];
  if (!wave.has_cone || ladder_.failed()) return std::nullopt;
  const std::size_t begins = wave.enters_over(side) ? 0 : 1;  // the ray where, going along the side, its cone begins
  return Event{from, to, wave.cone_site[begins], static_cast<std::uint8_t>(begins), true, true, std::nullopt};
}

/// Two waves that tie at an end of the side, by identity or by algebra of the strips: whether the place where `to` overtakes `from` is that end.
bool OutlineWalk::tie_is_at_corner(std::size_t side, const Event& event) {
  const std::size_t start = side, end = (side + 1) % 3;
  if (contenders_.tie_at_corner(ladder_, event.from, event.to, start)) {
    if (corners_.nearer_beside(start, CornerOrder::Direction::outgoing, event.from, event.to) != Sign::positive) return true;
  }
  if (contenders_.tie_at_corner(ladder_, event.from, event.to, end)) {
    if (corners_.nearer_beside(end, CornerOrder::Direction::incoming, event.from, event.to) != Sign::negative) return true;
  }
  return ladder_.failed();
}

template <class NT>
predicates::SideTie<NT> OutlineWalk::parameter(const FacetNumbers<NT>& numbers, std::size_t side, const Event& event) const {
  if constexpr (std::is_same_v<NT, FacetWaves::F>) {
    if (event.filtered) return *event.filtered;
  }
  if (event.ray != FacetTessellation::kNoSite) {
    const auto& window = *numbers.sites[event.ray];
    return {Existence::proved, predicates::ray_meeting(numbers.side[side], window.image, window.cone[event.ray_end])};
  }
  const Contender &from = contenders_[event.from], &to = contenders_[event.to];
  auto tie = predicates::overtaking(numbers.side[side], *numbers.sites[from.site], *numbers.sites[to.site], from.root == to.root);
  if (tie.existence != Existence::proved) tie.t = NT(0.0) / NT(0.0);  // nothing is known
  return tie;
}

template <class NT>
std::optional<OutlineWalk::Answer> OutlineWalk::happens_in(const FacetNumbers<NT>& numbers, std::size_t side, const Event& event,
                                                           const std::optional<Event>& previous, std::array<bool, 2> along) const {
  bool open = false, on_ray = false;
  const auto excludes = [&](const NT& x) {
    const MaybeSign sign = maybe_sign(x);
    if (!sign) open = true;
    return sign && *sign != Sign::positive;
  };
  if (previous && event.ray != FacetTessellation::kNoSite && event.ray == previous->ray && event.ray_end == previous->ray_end)
    return Answer::no;
  if (event.ray != FacetTessellation::kNoSite) {  // the ray must cross the side, in the right sense
    const auto& parent = *numbers.sites[event.ray];
    const bool view_ends = contenders_[event.from].has_cone && contenders_[event.from].cone_site[event.ray_end] == event.ray;
    const NT before = predicates::cone_side(parent, event.ray_end, numbers.side[side].origin);
    const NT after = predicates::cone_side(parent, event.ray_end, numbers.side[(side + 1) % 3].origin);
    if (excludes(view_ends ? before : -before) || excludes(view_ends ? -after : after)) return Answer::no;
    if (open) return std::nullopt;
  }
  const predicates::SideTie<NT> tie = parameter(numbers, side, event);
  if (tie.existence == Existence::impossible) return Answer::no;
  if (tie.existence == Existence::open) return std::nullopt;
  if (excludes(tie.t) || excludes(NT(1.0) - tie.t)) return Answer::no;
  const Contender& to = contenders_[event.to];
  if (to.has_cone) {
    const auto p = predicates::point_at(numbers.side[side], tie.t);
    for (std::size_t end = 0; end < 2; ++end) {
      if (event.ray != FacetTessellation::kNoSite && contenders_.is_on_ray(event.to, end, event.ray, event.ray_end)) continue;
      const MaybeSign inside = along[end] ? Sign::zero : maybe_sign(cone_side(numbers, to, end, p));
      if (inside == Sign::negative) return Answer::no;
      if (inside == Sign::zero) on_ray = true;
      if (!inside) open = true;
    }
  }
  if (previous) {
    const predicates::SideTie<NT> before = parameter(numbers, side, *previous);
    if (before.existence != Existence::proved)
      open = true;
    else if (excludes(tie.t - before.t))
      return Answer::no;
  }
  if (event.contact) {
    const auto p = predicates::point_at(numbers.side[side], tie.t);
    const MaybeSign farther = maybe_sign(predicates::distance(*numbers.sites[contenders_[event.to].site], p) -
                                         predicates::distance(*numbers.sites[contenders_[event.from].site], p));
    if (farther == Sign::positive) return Answer::no;
    open = open || !farther;
  }
  if (open) return std::nullopt;
  return on_ray ? Answer::on_ray : Answer::yes;
}

/// Mirror images in a side tie all along it, and on the lines of the other sides they tie at its ends.
bool OutlineWalk::ties_at_corners(const Event& event) const {
  for (std::size_t side = 0; side < 3; ++side)
    if (event.ray == FacetTessellation::kNoSite && contenders_.mirrored(event.from, event.to, side) != Sign::zero) return true;
  return false;
}

/// Whether the two are at one point by identity: waves that tie all along a side stand for one another there.
bool OutlineWalk::at_one_point(std::size_t side, const Event& a, const Event& b) {
  const auto alike = [&](std::uint32_t i, std::uint32_t j) {
    return i == j || contenders_.mirrored(i, j, side) != Sign::zero || contenders_.tie_on_ray_along(ladder_, i, j, side) ||
           contenders_.tie_on_ray_along(ladder_, j, i, side);
  };
  const bool on_rays = a.ray != FacetTessellation::kNoSite && b.ray != FacetTessellation::kNoSite;
  if (on_rays && contenders_.are_one_ray(a.ray, a.ray_end, b.ray, b.ray_end)) return true;
  return a.is_tie() && b.is_tie() && (a.ray == FacetTessellation::kNoSite) == (b.ray == FacetTessellation::kNoSite) && alike(a.from, b.from) &&
         alike(a.to, b.to);
}

/// Whether the event's ray meets the line of the side in a corner, the vertex that bounds the cone.
bool OutlineWalk::ray_is_through_corner(std::size_t side, const Event& event) const {
  if (event.ray == FacetTessellation::kNoSite) return false;
  const VertexId v = waves_.sites[event.ray].cone[event.ray_end];
  return v == waves_.corner[side] || v == waves_.corner[(side + 1) % 3];
}

std::optional<bool> OutlineWalk::happens(std::size_t side, Event& event, const std::optional<Event>& previous) {
  // What came into view, or touched, at the last event does not do so again.
  const bool was_there = std::find(passed_.begin(), passed_.end(), event.to) != passed_.end();
  if ((was_there && event.to != event.from && event.ray != FacetTessellation::kNoSite) || ray_is_through_corner(side, event) || ties_at_corners(event) || (previous && at_one_point(side, event, *previous))) return false;
  auto answer = happens_in(ladder_.filter(), side, event, previous, {false, false});
  if (answer) {
    ladder_.count(Predicate::edge_tie, robust::Stage::filter);
  } else {
    std::array<bool, 2> along{};
    for (std::size_t end = 0; contenders_[event.to].has_cone && end < 2; ++end)
      along[end] = contenders_.runs_along(ladder_, event.to, end, side);
    answer = ladder_.decide_beyond_filter(
        Predicate::edge_tie, [&](const auto& numbers) { return happens_in(numbers, side, event, previous, along); },
        [&] { return describe(side, event, "overtaking"); });
  }
  if (!answer) return std::nullopt;
  event.on_ray = event.contact || *answer == Answer::on_ray;
  return *answer != Answer::no;
}

MaybeSign OutlineWalk::compare(std::size_t side, const Event& a, const Event& b) {
  if (at_one_point(side, a, b)) return Sign::zero;
  const auto test = [&](const auto& numbers) -> MaybeSign {
    const auto ta = parameter(numbers, side, a), tb = parameter(numbers, side, b);
    if (ta.existence != Existence::proved || tb.existence != Existence::proved) return std::nullopt;
    return maybe_sign(ta.t - tb.t);
  };
  return ladder_.decide(Predicate::edge_tie, test, [&] { return describe(side, a, "order") + " and " + contenders_.name(b.to); });
}

/// An event on a boundary ray, or several at one point, leave the order of the regions open: nothing but all that tie there tells
/// it.
bool OutlineWalk::pass_event(std::size_t side, const std::vector<Event>& tied) {
  const Event& first = tied[0];
  Node node;
  node.kind = Node::Kind::side;
  node.where = static_cast<std::uint8_t>(side);
  const bool view_ends = first.to == first.from;
  if (!view_ends) node.defining = {contenders_[first.from].site, contenders_[first.to].site, FacetTessellation::kNoSite};
  node.ray = first.ray;
  node.ray_end = first.ray_end;
  std::vector<std::uint32_t> waves{first.from};
  for (const Event& event : tied)
    if (event.to != first.from) waves.push_back(event.to);
  Ring ring(waves_, contenders_, ladder_);
  // Where a view ends, a wave that only touched along the side may be next, without crossing anything; and where another one takes over, a wave that
  // touches `from` in this very point may have a region in between.
  const bool any_ray = std::any_of(tied.begin(), tied.end(), [](const Event& event) { return event.ray != FacetTessellation::kNoSite; });
  if ((any_ray || touched_) && !ring.add_ties(node, waves)) return false;
  passed_ = waves;
  std::vector<std::uint32_t> ahead{first.to, first.from};
  if (waves.size() > 2 || tied.size() > 1 || first.on_ray) {
    ahead = ring.regions(node, waves);
    if (ladder_.failed()) return false;
    if (ahead.back() != first.from) {
      ladder_.fail(Predicate::edge_tie, describe(side, first, "the order of waves that tie at a point"));
      return false;
    }
  }
  if (ahead.size() == 1) return true;
  for (const std::uint32_t wave : ahead) node.sites.push_back(contenders_[wave].site);
  const auto& numbers = ladder_.filter();
  node.t = node_parameter(waves_, numbers, node);
  const auto p = predicates::point_at(numbers.side[side], node.t);
  node.x = p.x;
  node.y = p.y;
  const std::uint32_t id = add_node(std::move(node));
  for (std::size_t i = ahead.size() - 1; i-- > 0;) enter(id, ahead[i]);
  return true;
}

}  // namespace gvd::kernel
