#include "overtaking_filter.hpp"

#include <algorithm>
#include <cmath>

#include "gvd/robust/double_pair.hpp"

namespace gvd::kernel {

using predicates::Bounded;
using robust::DoublePair;
using robust::MaybeSign;
using robust::Sign;

namespace {

DoublePair root(DoublePair x) { return DoublePair{std::sqrt(x[0]), std::sqrt(x[1])}; }

}  // namespace

/// A parent wins up to its boundary ray. Along the side over which it comes in, the cone begins at ray 0 and ends at ray 1; along the others
/// the other way round.
std::optional<RayEvent> tangent_event(const Contenders& contenders, std::size_t side, std::uint32_t from, std::uint32_t to) {
  const int leaves = contenders.tangent_end(from, to), arrives = contenders.tangent_end(to, from);
  const bool relay_takes_over = leaves != Contenders::kNotTangent;
  const std::uint32_t parent = relay_takes_over ? from : to, relay = relay_takes_over ? to : from;
  const int end = relay_takes_over ? leaves : arrives;
  const bool last_ray = end == (contenders[parent].enters_over(side) ? 1 : 0);
  if (last_ray != relay_takes_over) return std::nullopt;
  const std::uint8_t corner = contenders[relay].corner;
  if (corner == side || corner == (side + 1) % 3) return std::nullopt;  // the ray meets this side in its corner only
  return RayEvent{parent, static_cast<std::uint8_t>(end)};
}

std::optional<OvertakingFilter::Next> OvertakingFilter::next(std::size_t side, std::uint32_t from, const std::optional<Passed>& passed) {
  side_ = side;
  from_ = from;
  passed_ = passed;
  next_ = {};
  deferred_.clear();
  for (std::uint32_t to = 0; to < filter_.size(); ++to)
    if (to != from && !judge(to)) return std::nullopt;
  for (const std::uint32_t to : deferred_)
    if (!settle(to)) return std::nullopt;
  return next_;
}

/// Judges a deferred wave by what lies between the last event and the next one found. False if it takes more than doubles.
bool OvertakingFilter::settle(std::uint32_t to) {
  const double begin = passed_ ? passed_->at.low : 0, end = next_.exists ? next_.at.high : 1;
  const Bounded at_begin = filter_.lead(side_, from_, to, begin), at_end = filter_.lead(side_, from_, to, end);
  if (at_begin.negative() && at_end.positive()) return true;  // it rises through zero, once
  if (at_begin.positive() && at_end.negative()) {
    const auto at = locate(to, begin, end);
    return at && (!passed_ || at->low > passed_->at.high) && offer(to, *at, std::nullopt);
  }
  constexpr int kHalvings = 5;
  return constant_sign(to, begin, end, kHalvings).has_value();
}

/// False if it takes more than doubles.
bool OvertakingFilter::judge(std::uint32_t to) {
  const auto stretch = filter_.cones().stretch(to, side_);
  if (stretch.high < (passed_ ? passed_->at.low : 0) || stretch.low > (next_.exists ? next_.at.high : 1)) return true;
  if (contenders_.tangent(from_, to)) {
    const auto event = tangent_event(contenders_, side_, from_, to);
    return !event || judge_ray(to, *event);
  }
  if (contenders_.eclipses(from_, to) || contenders_.eclipses(to, from_)) return true;
  ++next_.decisions;
  const Finding finding = ahead(to);
  if (finding == Finding::none) return true;
  if (finding == Finding::unknown) {
    deferred_.push_back(to);
    return true;
  }
  double end = 1;
  if (next_.exists) {
    const Bounded lead = filter_.lead(side_, from_, to, next_.at.high);
    if (lead.positive()) return true;
    if (!lead.negative()) return false;
    end = next_.at.high;
  }
  const auto at = locate(to, passed_ ? passed_->at.high : 0, end);
  return at && offer(to, *at, std::nullopt);
}

bool OvertakingFilter::judge_ray(std::uint32_t to, const RayEvent& event) {
  ++next_.decisions;
  const bool inward = event.parent == to;
  const auto& cones = filter_.cones();
  const Bounded first = cones.at_corner(event.parent, event.end, side_), last = cones.at_corner(event.parent, event.end, (side_ + 1) % 3);
  if (first.positive() && last.positive()) return true;  // it does not cross the side (nor where both are outside: then the parent is not seen there)
  const auto at = locate_ray(event, inward);
  // It is never behind the last event: the relay is not the nearest where the parent is seen, nor the parent where it is not.
  if (!at || (passed_ && !(at->low > passed_->at.high))) return false;
  return offer(to, *at, event);
}

/// Takes the event at `at` if it comes before what was found so far.
bool OvertakingFilter::offer(std::uint32_t to, const Place& at, const std::optional<RayEvent>& ray) {
  if (next_.exists && at.low > next_.at.high) return true;
  const Seen seen = sees(to, at, ray);
  if (seen == Seen::no) return true;
  if (seen == Seen::unknown || (next_.exists && !(at.high < next_.at.low))) return false;
  next_.exists = true;
  next_.to = to;
  next_.at = at;
  next_.ray = ray;
  return true;
}

/// Whether d_to - d_from falls through zero strictly inside the side; by identity it may be zero at one of its ends, and that is one of the two.
OvertakingFilter::Finding OvertakingFilter::falling_zero(std::uint32_t to) const {
  const std::size_t first = side_, last = (side_ + 1) % 3;
  const bool tie_first = contenders_[from_].ties_at_corner(contenders_[to], first);
  const bool tie_last = contenders_[from_].ties_at_corner(contenders_[to], last);
  if (tie_first && tie_last) {  // two zeros, or they tie all along the side
    const Bounded between = filter_.lead(side_, from_, to, 0.5);
    return between.positive() || between.negative() ? Finding::none : Finding::unknown;
  }
  const Bounded at_first = filter_.lead_at_corner(first, from_, to), at_last = filter_.lead_at_corner(last, from_, to);
  if (tie_first) {
    if (at_last.positive()) return Finding::none;
    if (!at_last.negative()) return Finding::unknown;
    const Bounded slope = filter_.slope_at_corner(side_, first, from_, to);
    return slope.positive() ? Finding::one : slope.negative() ? Finding::none : Finding::unknown;
  }
  if (tie_last) {
    if (at_first.negative()) return Finding::none;
    if (!at_first.positive()) return Finding::unknown;
    const Bounded slope = filter_.slope_at_corner(side_, last, from_, to);
    return slope.positive() ? Finding::one : slope.negative() ? Finding::none : Finding::unknown;
  }
  if (at_first.negative() && at_last.positive()) return Finding::none;
  if (at_first.positive() && at_last.negative()) return Finding::one;
  return Finding::unknown;
}

/// Whether the falling zero, if there is one, comes after the last event passed.
OvertakingFilter::Finding OvertakingFilter::ahead(std::uint32_t to) const {
  if (passed_ && passed_->from == to) {  // it rose through zero there, so it can only fall again
    const std::size_t last = (side_ + 1) % 3;
    if (contenders_[from_].ties_at_corner(contenders_[to], last)) return Finding::none;
    const Bounded at_last = filter_.lead_at_corner(last, from_, to);
    return at_last.positive() ? Finding::none : at_last.negative() ? Finding::one : Finding::unknown;
  }
  const Finding finding = falling_zero(to);
  if (finding == Finding::unknown) {  // of one sign at both ends: most keep it
    return constant_sign(to, 0, 1, 0) ? Finding::none : Finding::unknown;
  }
  if (finding == Finding::none || !passed_) return finding;
  if (filter_.lead(side_, from_, to, passed_->at.high).positive()) return Finding::one;
  return filter_.lead(side_, from_, to, passed_->at.low).negative() ? Finding::none : Finding::unknown;
}

/// Distances are convex: one is above its tangents, the other below its chord.
MaybeSign OvertakingFilter::constant_sign(std::uint32_t to, double begin, double end, int halvings) const {
  const auto &a = filter_.wave(from_), &b = filter_.wave(to);
  const auto& side = filter_.side(side_);
  const predicates::DoublePoint p = side.at(begin), q = side.at(end);
  struct Along {
    DoublePair at, rise;  ///< at both ends: the distance, and by how much its tangent rises over the stretch
  };
  const double length = end - begin;
  const auto along = [&](const predicates::DoubleWave& wave) {
    const DoublePair x = DoublePair{p.x, q.x} - wave.image.x, y = DoublePair{p.y, q.y} - wave.image.y, reach = root(x * x + y * y);
    const double dx = side.direction.x * length, dy = side.direction.y * length;
    return Along{wave.weight + reach, (dx * x + dy * y) / reach};
  };
  const Along of_a = along(a), of_b = along(b);
  const Bounded at_begin = predicates::difference(a, of_a.at[0], b, of_b.at[0]), at_end = predicates::difference(a, of_a.at[1], b, of_b.at[1]);
  // Of the tangent's rise over the stretch, 16 u of its length are lost to rounding.
  const double error = at_begin.error + at_end.error + 4 * side.error + 16 * predicates::kUnit * (side.length * length + 2 * side.error);
  const bool ahead = at_begin.value > error && at_end.value > error;
  if (!ahead && !(at_begin.value < -error && at_end.value < -error)) return std::nullopt;
  const Along &convex = ahead ? of_b : of_a, &other = ahead ? of_a : of_b;
  const Sign sign = ahead ? Sign::positive : Sign::negative;
  if (convex.at[0] + convex.rise[0] - other.at[1] > error || convex.at[1] - convex.rise[1] - other.at[0] > error) return sign;
  const double middle = 0.5 * (begin + end);
  if (halvings == 0 || constant_sign(to, begin, middle, halvings - 1) != sign || constant_sign(to, middle, end, halvings - 1) != sign) return std::nullopt;
  return sign;
}

/// Encloses the falling zero between two signs, by Newton's iteration kept inside. Pre: one such zero lies in (begin, end).
std::optional<OvertakingFilter::Place> OvertakingFilter::locate(std::uint32_t to, double begin, double end) const {
  const auto &a = filter_.wave(from_), &b = filter_.wave(to);
  const auto& side = filter_.side(side_);
  double low = begin, high = end, t = 0.5 * (begin + end);
  constexpr int kMostSteps = 12;
  for (int step = 0; step < kMostSteps; ++step) {
    const auto p = side.at(t);
    const DoublePair x = p.x - DoublePair{a.image.x, b.image.x}, y = p.y - DoublePair{a.image.y, b.image.y}, reach = root(x * x + y * y);
    const DoublePair at = DoublePair{a.weight, b.weight} + reach, rise = (side.direction.x * x + side.direction.y * y) / reach;
    const double g = at[1] - at[0], slope = rise[1] - rise[0];
    (g > 0 ? low : high) = t;
    const double next = t - g / slope;
    if (slope < 0 && std::fabs(next - t) < 0x1p-30) {  // the next step would move by the square of that or so: close enough
      const double error = predicates::difference(a, at[0], b, at[1]).error + 2 * side.error;
      const double margin = 2 * error / -slope + 4 * predicates::kUnit;
      const Place place{std::max(begin, next - margin), std::min(end, next + margin)};
      if (!(filter_.lead(side_, from_, to, place.low).positive() && filter_.lead(side_, from_, to, place.high).negative())) return std::nullopt;
      return place;
    }
    t = slope < 0 && next > low && next < high ? next : 0.5 * (low + high);
  }
  return std::nullopt;
}

/// Where the cone of the parent begins (inward) or ends along the side. Only doubles, so by signs again.
std::optional<OvertakingFilter::Place> OvertakingFilter::locate_ray(const RayEvent& event, bool inward) const {
  const auto& cones = filter_.cones();
  const Bounded first = cones.at_corner(event.parent, event.end, side_), last = cones.at_corner(event.parent, event.end, (side_ + 1) % 3);
  const Bounded &outside = inward ? first : last, &inside = inward ? last : first;
  if (!outside.negative() || !inside.positive()) return std::nullopt;
  const double t = first.value / (first.value - last.value), span = std::fabs(first.value - last.value);
  const double margin = 2 * filter_.cone_side(side_, event.parent, event.end, t).error / span + 4 * predicates::kUnit;
  const Place place{std::max(0.0, t - margin), std::min(1.0, t + margin)};
  const Bounded before = filter_.cone_side(side_, event.parent, event.end, place.low);
  const Bounded after = filter_.cone_side(side_, event.parent, event.end, place.high);
  const bool sure = inward ? before.negative() && after.positive() : before.positive() && after.negative();
  return sure ? std::optional(place) : std::nullopt;
}

/// Whether the wave sees all of the stretch (yes) or none of it (no). On `ray` itself the answer is known.
OvertakingFilter::Seen OvertakingFilter::sees(std::uint32_t to, const Place& at, const std::optional<RayEvent>& ray) const {
  if (!contenders_[to].has_cone) return Seen::yes;
  Seen seen = Seen::yes;
  for (std::size_t end = 0; end < 2; ++end) {
    if (ray && contenders_[ray->parent].cone_site[ray->end] == contenders_[to].cone_site[end] && ray->end == end) continue;
    const Bounded low = filter_.cone_side(side_, to, end, at.low), high = filter_.cone_side(side_, to, end, at.high);
    if (low.negative() && high.negative()) return Seen::no;
    if (!low.positive() || !high.positive()) seen = Seen::unknown;
  }
  return seen;
}

}  // namespace gvd::kernel
