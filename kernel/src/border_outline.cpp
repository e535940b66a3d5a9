#include "border_outline.hpp"

#include <algorithm>
#include <limits>

namespace gvd::kernel {

BorderOutline::BorderOutline(const FacetWaves& waves, const Contenders& contenders, const FacetFilter& filter, FacetLadder& ladder)
    : waves_(waves), contenders_(contenders), filter_(filter), signs_(filter, contenders), labels_(ladder.room()), crossings_(ladder.room()), readings_(ladder.room()), marks_(filter.row(), ladder.room()) {
  labels_.reserve(contenders.size());
  for (std::size_t i = 0; i < contenders.size(); ++i) labels_.push_back(waves.sites[contenders[i].site].labels);
}

bool BorderOutline::walk() {
  for (std::size_t c = 0; c < 3; ++c)
    if (!find_at_corner(c)) return false;
  constexpr int kHalvings = 8;
  for (side_ = 0; side_ < 3; ++side_) {
    const std::size_t next = (side_ + 1) % 3;
    const Spot first{0, &filter_.at_corner(side_)}, last{1, &filter_.at_corner(next)};
    if (!solve({0, 1, labels_[at_corner_[side_]], labels_[at_corner_[next]], first, last}, kHalvings)) return false;
  }
  return true;
}

/// Whether all that attain the corner have its label set, and the others are certainly farther there.
bool BorderOutline::find_at_corner(std::size_t c) {
  std::uint32_t& own = at_corner_[c];
  for (std::uint32_t i = 0; i < contenders_.size() && own == kNoWave; ++i)
    if (contenders_[i].attains_corner[c] && labels_[i] == waves_.corner_labels[c]) own = i;
  if (own == kNoWave) return false;
  const FacetFilter::Reading& here = filter_.at_corner(c);
  const double at_most = here.high(own) + 2 * filter_.side(c).error;
  for (std::uint32_t other = 0; other < contenders_.size(); ++other) {
    if (labels_[other] == labels_[own]) continue;
    ++decisions_;
    if (here.low(other) > at_most) continue;
    if (!filter_.cones().at_corner(other, 0, c).negative() && !filter_.cones().at_corner(other, 1, c).negative()) return false;
  }
  return true;
}

bool BorderOutline::solve(const Part& part, int halvings) {
  if (parts_++ == kMostParts) return false;
  if (part.at_begin == part.at_end ? is_uniform(part) : cross(part, halvings)) return true;
  return halve(part, halvings);
}

bool BorderOutline::halve(const Part& part, int halvings) {
  if (halvings == 0) return false;
  const Spot middle = spot(0.5 * (part.begin + part.end));
  const LabelSetId label = only_label_at(middle);
  if (label == kNone) return false;
  return solve({part.begin, middle.t, part.at_begin, label, part.first, middle, part.nearer, part.farther}, halvings - 1) &&
         solve({middle.t, part.end, label, part.at_end, middle, part.last, part.nearer, part.farther}, halvings - 1);
}

/// Whether waves of the label set, one after the other, are certainly nearer than any other all along the part.
bool BorderOutline::is_uniform(const Part& part) {
  for (Spot from = part.first; from.t < part.last.t;) {
    const std::uint32_t guard = choose_guard(part, from);
    if (guard == kNoWave) return guards({kNoWave, from, part.last}, part);
    const double seen_to = filter_.cones().seen(guard, side_).high;
    const Spot to = seen_to < part.last.t ? spot(seen_to) : part.last;
    if (!guards({guard, from, to}, part)) return false;
    from = to;
  }
  return true;
}

/// One of the label set that is seen from there on, and near at both ends of what is left; kNoWave if there is none.
std::uint32_t BorderOutline::choose_guard(const Part& part, const Spot& first) const {
  std::uint32_t best = kNoWave;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < labels_.size(); ++i) {
    const double sum = first.waves->at(i) + part.last.waves->at(i);
    if (labels_[i] != part.at_begin || !(sum < least)) continue;
    const auto seen = filter_.cones().seen(i, side_);
    if (seen.low <= first.t && first.t < seen.high) least = sum, best = i;
  }
  return best;
}

/// Whether every other wave is certainly farther than the guard from one end to the other, or kept off by others.
bool BorderOutline::guards(const Guard& guard, const Part& part) {
  const auto &first = *guard.first.waves, &last = *guard.last.waves;
  const double length = guard.last.t - guard.first.t;
  const auto& side = filter_.side(side_);
  const double dx = length * side.direction.x, dy = length * side.direction.y;
  const double margin = (2 * point_error() + predicates::kRiseError * (length * side.length)) * (1 + 0x1p-40);
  const bool any = guard.wave != kNoWave;
  if (any) filter_.row().mark_above({first, last, {dx, dy}, first.high(guard.wave) + margin, last.high(guard.wave) + margin}, marks_);
  for (std::uint32_t other = 0; other < labels_.size(); ++other) {
    if (labels_[other] == part.at_begin) continue;
    ++decisions_;
    if ((any && marks_[other]) || (guard.wave == part.nearer && other == part.farther)) continue;
    const auto stretch = filter_.cones().stretch(other, side_);
    const double begin = std::max({part.begin, guard.first.t, stretch.low}), end = std::min({part.end, guard.last.t, stretch.high});
    constexpr int kHalvings = 3;
    if (begin <= end && !keep_off(part, other, begin, end, kHalvings)) return false;
  }
  return true;
}

/// Whether waves of the label set of the part, one after the other, are seen and certainly nearer than `other` from `begin` to `end`, or in each half.
bool BorderOutline::keep_off(const Part& part, std::uint32_t other, double begin, double end, int halvings) {
  for (std::uint32_t guard = 0; guard < contenders_.size(); ++guard) {
    if (labels_[guard] != part.at_begin || !sees(guard, begin, begin)) continue;
    const double to = std::min(end, filter_.cones().seen(guard, side_).high);
    if (to <= begin && begin < end) continue;
    const bool farther = (guard == part.nearer && other == part.farther) || is_farther(guard, other, begin, to);
    if (farther && (to == end || keep_off(part, other, to, end, 0))) return true;
  }
  const double middle = 0.5 * (begin + end);
  return halvings > 0 && keep_off(part, other, begin, middle, halvings - 1) && keep_off(part, other, middle, end, halvings - 1);
}

bool BorderOutline::is_farther(std::uint32_t guard, std::uint32_t other, double begin, double end) {
  signs_.look_from(side_, guard);
  return signs_.constant_sign(other, begin, end, 0) == robust::Sign::positive;
}

/// Looks for the one place where the label set changes: the tie of the waves that are nearest there, of either set.
bool BorderOutline::cross(const Part& part, int halvings) {
  std::uint32_t from = nearest(part.at_begin, part.first), to = nearest(part.at_end, part.last);
  constexpr int kMostPairs = 5;
  for (int pair = 0; pair < kMostPairs && from != kNoWave && to != kNoWave; ++pair) {
    const auto &first = *part.first.waves, &last = *part.last.waves;
    if (!(first.low(to) > first.high(from) + point_error() && last.low(from) > last.high(to) + point_error())) return false;
    signs_.look_from(side_, from);
    const auto at = signs_.locate(to, part.begin, part.end);
    if (!at) return false;
    const Spot middle = spot(0.5 * (at->low + at->high));
    const std::uint32_t nearest_from = nearest(part.at_begin, middle), nearest_to = nearest(part.at_end, middle);
    if (nearest_from == from && nearest_to == to) {
      if (!is_clear(from, to, *at, middle)) return false;
      const std::size_t known = crossings_.size();
      if (solve({part.begin, at->low, part.at_begin, part.at_begin, part.first, middle, from, to}, halvings)) {
        crossings_.push_back({static_cast<std::uint8_t>(side_), from, to, *at});
        if (solve({at->high, part.end, part.at_end, part.at_end, middle, part.last, to, from}, halvings)) return true;
      }
      crossings_.resize(known);
      return false;
    }
    from = nearest_from;
    to = nearest_to;
  }
  return false;
}

/// Whether the two see the place, and any other is farther there or does not see it.
bool BorderOutline::is_clear(std::uint32_t from, std::uint32_t to, const Place& at, const Spot& middle) {
  if (!sees(from, at.low, at.high) || !sees(to, at.low, at.high)) return false;
  const double at_most = middle.waves->high(from) + (point_error() + 2 * (filter_.side(side_).length + filter_.side(side_).error) * (at.high - at.low)) * (1 + 0x1p-40);
  for (std::uint32_t other = 0; other < contenders_.size(); ++other) {
    if (other == from || other == to) continue;
    ++decisions_;
    if (!(middle.waves->low(other) > at_most) && !misses(other, at.low, at.high)) return false;
  }
  return true;
}

/// The nearest wave of the label set among those that may be seen, as far as doubles tell; kNoWave if there is none.
std::uint32_t BorderOutline::nearest(LabelSetId labels, const Spot& spot) const {
  std::uint32_t best = kNoWave;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < labels_.size(); ++i)
    if (labels_[i] == labels && spot.waves->at(i) < least && !misses(i, spot.t, spot.t)) least = spot.waves->at(i), best = i;
  return best;
}

/// The label set of all that may be nearest at a point of the side; kNone if there may be several.
LabelSetId BorderOutline::only_label_at(const Spot& spot) {
  std::uint32_t best = kNoWave;
  for (std::uint32_t i = 0; i < contenders_.size(); ++i)
    if ((best == kNoWave || spot.waves->at(i) < spot.waves->at(best)) && sees(i, spot.t, spot.t)) best = i;
  if (best == kNoWave) return kNone;
  for (std::uint32_t i = 0; i < contenders_.size(); ++i) {
    if (labels_[i] == labels_[best]) continue;
    ++decisions_;
    if (!(spot.waves->low(i) > spot.waves->high(best) + point_error()) && !misses(i, spot.t, spot.t)) return kNone;
  }
  return labels_[best];
}

}  // namespace gvd::kernel
