#include "border_outline.hpp"

#include <algorithm>
#include <limits>

namespace gvd::kernel {

using predicates::Bounded;

BorderOutline::BorderOutline(const FacetWaves& waves, const Contenders& contenders, const FacetFilter& filter, FacetLadder& ladder)
    : waves_(waves), contenders_(contenders), filter_(filter), signs_(filter, contenders), labels_(ladder.room()), crossings_(ladder.room()) {
  labels_.reserve(contenders.size());
  for (std::size_t i = 0; i < contenders.size(); ++i) labels_.push_back(waves.sites[contenders[i].site].labels);
}

bool BorderOutline::walk() {
  for (std::size_t c = 0; c < 3; ++c)
    if (!find_at_corner(c)) return false;
  constexpr int kHalvings = 8;
  for (side_ = 0; side_ < 3; ++side_)
    if (!solve({0, 1, labels_[at_corner_[side_]], labels_[at_corner_[(side_ + 1) % 3]]}, kHalvings)) return false;
  return true;
}

/// Whether all that attain the corner have its label set, and the others are certainly farther there.
bool BorderOutline::find_at_corner(std::size_t c) {
  std::uint32_t& own = at_corner_[c];
  for (std::uint32_t i = 0; i < contenders_.size() && own == kNoWave; ++i)
    if (contenders_[i].attains_corner[c] && labels_[i] == waves_.corner_labels[c]) own = i;
  if (own == kNoWave) return false;
  for (std::uint32_t other = 0; other < contenders_.size(); ++other) {
    if (labels_[other] == labels_[own]) continue;
    ++decisions_;
    const auto& wave = filter_[other];
    if (wave.has_cone && (wave.ray[0].at_corner[c].negative() || wave.ray[1].at_corner[c].negative())) continue;
    if (!filter_.lead_at_corner(c, own, other).positive()) return false;
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
  const double middle = 0.5 * (part.begin + part.end);
  const LabelSetId label = only_label_at(middle);
  if (label == kNone) return false;
  return solve({part.begin, middle, part.at_begin, label, part.nearer, part.farther}, halvings - 1) && solve({middle, part.end, label, part.at_end, part.nearer, part.farther}, halvings - 1);
}

/// Whether waves of the label set are certainly nearer than any other all along the part.
bool BorderOutline::is_uniform(const Part& part) {
  for (std::uint32_t other = 0; other < contenders_.size(); ++other) {
    if (labels_[other] == part.at_begin) continue;
    const auto& stretch = filter_[other].stretch[side_];
    const double begin = std::max(part.begin, stretch.low), end = std::min(part.end, stretch.high);
    constexpr int kHalvings = 3;
    if (begin <= end && !keep_off(part, other, begin, end, kHalvings)) return false;
  }
  return true;
}

/// Whether waves of the label set of the part, one after the other, are seen and certainly nearer than `other` from `begin` to `end`, or in each half.
bool BorderOutline::keep_off(const Part& part, std::uint32_t other, double begin, double end, int halvings) {
  for (std::uint32_t guard = 0; guard < contenders_.size(); ++guard) {
    if (labels_[guard] != part.at_begin || !sees(guard, begin, begin)) continue;
    const double to = std::min(end, filter_[guard].seen[side_].high);
    if (to <= begin && begin < end) continue;
    ++decisions_;
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
  std::uint32_t from = nearest(part.at_begin, part.begin), to = nearest(part.at_end, part.end);
  constexpr int kMostPairs = 5;
  for (int pair = 0; pair < kMostPairs && from != kNoWave && to != kNoWave; ++pair) {
    if (!filter_.lead(side_, from, to, part.begin).positive() || !filter_.lead(side_, from, to, part.end).negative()) return false;
    signs_.look_from(side_, from);
    const auto at = signs_.locate(to, part.begin, part.end);
    if (!at) return false;
    const double middle = 0.5 * (at->low + at->high);
    const std::uint32_t nearest_from = nearest(part.at_begin, middle), nearest_to = nearest(part.at_end, middle);
    if (nearest_from == from && nearest_to == to) {
      if (!is_clear(from, to, *at)) return false;
      const std::size_t known = crossings_.size();
      if (solve({part.begin, at->low, part.at_begin, part.at_begin, from, to}, halvings)) {
        crossings_.push_back({static_cast<std::uint8_t>(side_), from, to, *at});
        if (solve({at->high, part.end, part.at_end, part.at_end, to, from}, halvings)) return true;
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
bool BorderOutline::is_clear(std::uint32_t from, std::uint32_t to, const Place& at) {
  if (!sees(from, at.low, at.high) || !sees(to, at.low, at.high)) return false;
  const double room = 2 * (filter_.side(side_).length + filter_.side(side_).error) * (at.high - at.low) * (1 + 0x1p-40);
  for (std::uint32_t other = 0; other < contenders_.size(); ++other) {
    if (other == from || other == to || misses(other, at.low, at.high)) continue;
    ++decisions_;
    const Bounded lead = filter_.lead(side_, from, other, at.low);
    if (!(lead.value - room > lead.error)) return false;
  }
  return true;
}

/// The nearest wave of the label set among those that may be seen, as far as doubles tell; kNoWave if there is none.
std::uint32_t BorderOutline::nearest(LabelSetId labels, double t) const {
  const predicates::DoublePoint p = filter_.side(side_).at(t);
  std::uint32_t best = kNoWave;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < contenders_.size(); ++i) {
    if (labels_[i] != labels || misses(i, t, t)) continue;
    const double d = distance(filter_[i].wave, p);
    if (d < least) least = d, best = i;
  }
  return best;
}

/// The label set of all that may be nearest at a point of the side; kNone if there may be several.
LabelSetId BorderOutline::only_label_at(double t) {
  std::uint32_t best = kNoWave;
  for (std::uint32_t i = 0; i < contenders_.size(); ++i)
    if (sees(i, t, t) && (best == kNoWave || filter_.lead(side_, best, i, t).value < 0)) best = i;
  if (best == kNoWave) return kNone;
  for (std::uint32_t i = 0; i < contenders_.size(); ++i) {
    if (labels_[i] == labels_[best]) continue;
    ++decisions_;
    if (!misses(i, t, t) && !filter_.lead(side_, best, i, t).positive()) return kNone;
  }
  return labels_[best];
}

}  // namespace gvd::kernel
