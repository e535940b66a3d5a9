#include "corner_sequence.hpp"

namespace gvd::kernel {
namespace {

using predicates::Predicate;
using predicates::operator-;
using robust::MaybeSign;
using robust::Sign;

/// From corner c along the side that starts there, or back along the side that ends there.
template <class NT>
predicates::PlanePoint<NT> direction_from(const FacetNumbers<NT>& numbers, std::size_t c, CornerOrder::Direction direction) {
  if (direction == CornerOrder::Direction::outgoing) return numbers.side[c].direction;
  const auto& d = numbers.side[(c + 2) % 3].direction;
  return {-d.x, -d.y};
}

}  // namespace

std::string CornerOrder::describe(std::size_t c, std::uint32_t p, std::uint32_t q, const char* what) const {
  return std::string(what) + " at corner " + std::to_string(c) + " (vertex " + std::to_string(waves_.corner[c]) + "), " +
         contenders_.name(p) + " and " + contenders_.name(q);
}

/// The derivative of a distance in a direction is minus the cosine of its angle with the direction to the image.
MaybeSign CornerOrder::nearer_beside(std::size_t c, Direction direction, std::uint32_t p, std::uint32_t q) {
  const Contender &a = contenders_[p], &b = contenders_[q];
  if (a.corner == c || b.corner == c) {  // its own distance grows as fast as a distance can
    ladder_.count(Predicate::corner_order, robust::Stage::identity);
    return a.corner == c ? Sign::negative : Sign::positive;
  }
  const auto test = [&](const auto& numbers) {
    const auto& at = numbers.side[c].origin;
    const auto along = direction_from(numbers, c, direction);
    const auto &ia = numbers.sites[a.site]->image, &ib = numbers.sites[b.site]->image;
    if (a.root == b.root) return maybe_sign(dot(ia - ib, along));
    const auto to_a = ia - at, to_b = ib - at;
    return maybe_sign(dot(to_a, along) * sqrt(squared_norm(to_b)) - dot(to_b, along) * sqrt(squared_norm(to_a)));
  };
  const MaybeSign sign = ladder_.decide(Predicate::corner_order, test, [&] { return describe(c, p, q, "order"); });
  if (sign != Sign::zero || a.root == b.root) return sign;
  // Equal slopes along the side: mirror images if the weights are equal too; otherwise the bisector touches the side.
  const auto weights = [&](const auto& numbers) { return maybe_sign(numbers.sites[a.site]->weight - numbers.sites[b.site]->weight); };
  const MaybeSign difference = ladder_.decide(Predicate::corner_order, weights, [&] { return describe(c, p, q, "weights"); });
  if (difference && *difference != Sign::zero) {
    ladder_.fail(Predicate::corner_order, describe(c, p, q, "bisector tangent to the side"));
    return std::nullopt;
  }
  return difference;
}

/// Orientation of the directions to the images of p and q, seen from corner c. Fails on equal directions: waves that are not one image and
/// yet come along one line tie to second order, which nothing here resolves.
MaybeSign CornerOrder::turn(std::size_t c, std::uint32_t p, std::uint32_t q) {
  const auto test = [&](const auto& numbers) {
    const auto& at = numbers.side[c].origin;
    return maybe_sign(cross(numbers.sites[contenders_[p].site]->image - at, numbers.sites[contenders_[q].site]->image - at));
  };
  const MaybeSign sign = ladder_.decide(Predicate::corner_order, test, [&] { return describe(c, p, q, "turn"); });
  if (sign != Sign::zero) return sign;
  ladder_.fail(Predicate::corner_order, describe(c, p, q, "equal directions"));
  return std::nullopt;
}

/// The same for waves whose images may lie on opposite sides of the corner: half a turn counts as a turn to the left.
MaybeSign CornerOrder::turn_or_half(std::size_t c, std::uint32_t p, std::uint32_t q) {
  const auto test = [&](const auto& numbers) -> MaybeSign {
    const auto& at = numbers.side[c].origin;
    const auto to_p = numbers.sites[contenders_[p].site]->image - at, to_q = numbers.sites[contenders_[q].site]->image - at;
    const MaybeSign sign = maybe_sign(cross(to_p, to_q));
    if (sign != Sign::zero) return sign;
    const MaybeSign same_way = maybe_sign(dot(to_p, to_q));
    return same_way == Sign::negative ? MaybeSign(Sign::positive) : same_way ? sign : std::nullopt;
  };
  const MaybeSign sign = ladder_.decide(Predicate::corner_order, test, [&] { return describe(c, p, q, "turn"); });
  if (sign != Sign::zero) return sign;
  ladder_.fail(Predicate::corner_order, describe(c, p, q, "equal directions"));
  return std::nullopt;
}

/// Whether the ray from p's image through corner c goes on strictly on the inner side of the line of the far side of the corner's angle.
MaybeSign CornerOrder::ray_enters(std::size_t c, std::uint32_t p, Direction far_side) {
  const auto test = [&](const auto& numbers) {
    const auto ray = numbers.side[c].origin - numbers.sites[contenders_[p].site]->image;
    const auto along = direction_from(numbers, c, far_side);
    return maybe_sign(far_side == Direction::incoming ? cross(ray, along) : cross(along, ray));
  };
  return ladder_.decide(Predicate::corner_order, test, [&] { return describe(c, p, p, "shadow"); });
}

CornerOrder::Tied CornerOrder::tied_at(std::size_t c) {
  Tied tied;
  for (std::uint32_t i = 0; i < contenders_.size() && !ladder_.failed(); ++i) {
    const Contender& wave = contenders_[i];
    if (wave.corner == c) {
      tied.own = i;
      continue;
    }
    if (!wave.attains_corner[c]) continue;
    const bool over_outgoing = wave.enters_over(c), over_incoming = wave.enters_over((c + 2) % 3);
    if (over_outgoing && !over_incoming) {  // of several, the one that turns least to enter hides the others
      if (!tied.right || turn(c, *tied.right, i) == Sign::positive) tied.right = i;
    } else if (over_incoming && !over_outgoing) {
      if (!tied.left || turn(c, i, *tied.left) == Sign::positive) tied.left = i;
    } else {
      auto& middle = tied.middle;
      auto at = middle.begin();
      while (at != middle.end() && turn_or_half(c, *at, i) == Sign::positive) ++at;
      middle.insert(at, i);
    }
  }
  return tied;
}

/// Whether the corner's own wave has a wedge of the facet to itself: the part that none of the waves that turn round the corner sees.
std::optional<bool> CornerOrder::shadow_is_open(std::size_t c, const Tied& tied) {
  if (!tied.own || !tied.middle.empty()) return false;
  if (tied.right) {
    const MaybeSign open = ray_enters(c, *tied.right, Direction::incoming);
    if (open != Sign::positive) return open ? std::optional(false) : std::nullopt;
  }
  if (tied.left) {
    const MaybeSign open = ray_enters(c, *tied.left, Direction::outgoing);
    if (open != Sign::positive) return open ? std::optional(false) : std::nullopt;
  }
  if (tied.right && tied.left) {
    const MaybeSign apart = turn(c, *tied.right, *tied.left);
    if (apart != Sign::positive) return apart ? std::optional(false) : std::nullopt;
  }
  const bool right_fits = !tied.right || contenders_.tangent_end(*tied.right, *tied.own) == 0;
  const bool left_fits = !tied.left || contenders_.tangent_end(*tied.left, *tied.own) == 1;
  if (!right_fits || !left_fits) {
    const std::uint32_t wave = right_fits ? *tied.left : *tied.right;
    ladder_.fail(Predicate::corner_order, describe(c, wave, *tied.own, "a shadow that is not bounded by the corner"));
    return std::nullopt;
  }
  return true;
}

/// Keeps those of the contenders, sorted by the direction of their images, that are nearest in some direction of the corner's angle: the
/// boundary between two neighbours is the direction half-way between them.
std::vector<std::uint32_t> CornerOrder::envelope(std::size_t c, const std::vector<std::uint32_t>& sorted, const Tied& tied) {
  // A wave that turns round the corner is not seen at the other side if its ray enters the facet.
  bool right_hidden = false, left_hidden = false;
  if (!tied.middle.empty()) {
    if (tied.right && contenders_[*tied.right].has_cone) right_hidden = ray_enters(c, *tied.right, Direction::incoming) == Sign::positive;
    if (tied.left && contenders_[*tied.left].has_cone) left_hidden = ray_enters(c, *tied.left, Direction::outgoing) == Sign::positive;
  }
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t next : sorted) {
    bool owns_some = true;
    if (!kept.empty()) {
      const std::uint32_t last = kept.back();
      // The boundary lies before the incoming side iff `next` is nearer there, and after the outgoing one iff `last` is nearer there.
      if (!(right_hidden && last == tied.right))
        owns_some = nearer_beside(c, Direction::incoming, next, last) == Sign::positive;
      const bool last_stays = (left_hidden && next == tied.left) || nearer_beside(c, Direction::outgoing, last, next) == Sign::positive;
      if (owns_some && !last_stays) kept.pop_back();  // boundaries are in order, so `last` was the first one
    }
    if (ladder_.failed()) return {};
    if (!owns_some) break;
    kept.push_back(next);
  }
  return kept;
}

/// The waves that are nearest in some direction follow one another counter-clockwise by the directions of their images, beginning with the one
/// that is nearest beside the outgoing side; images may lie all round the corner.
std::vector<std::uint32_t> CornerOrder::from_outgoing(std::size_t c, std::vector<std::uint32_t> waves) {
  for (std::size_t i = 1; i < waves.size(); ++i)
    if (nearer_beside(c, Direction::outgoing, waves[i], waves[0]) == Sign::positive) std::swap(waves[0], waves[i]);
  const auto before = [&](std::uint32_t p, std::uint32_t q) {
    const bool p_near = turn_or_half(c, waves[0], p) == Sign::positive, q_near = turn_or_half(c, waves[0], q) == Sign::positive;
    return p_near != q_near ? p_near : turn_or_half(c, p, q) == Sign::positive;
  };
  for (std::size_t i = 2; i < waves.size() && !ladder_.failed(); ++i)  // few: an insertion sort
    for (std::size_t k = i; k > 1 && before(waves[k], waves[k - 1]); --k) std::swap(waves[k], waves[k - 1]);
  return waves;
}

std::vector<std::uint32_t> CornerOrder::sequence(std::size_t c) {
  const Tied tied = tied_at(c);
  if (ladder_.failed()) return {};
  std::vector<std::uint32_t> sorted;
  if (tied.right) sorted.push_back(*tied.right);
  sorted.insert(sorted.end(), tied.middle.begin(), tied.middle.end());
  if (tied.left) sorted.push_back(*tied.left);
  if (sorted.size() == 1 && !tied.own) return sorted;
  if (sorted.empty() && tied.own) return {*tied.own};
  if (sorted.empty()) {
    ladder_.fail(Predicate::corner_order, "no wave attains corner " + std::to_string(c));
    return {};
  }
  if (!tied.right && !tied.left && sorted.size() > 1) {
    sorted = from_outgoing(c, std::move(sorted));
    if (ladder_.failed()) return {};
  }
  const std::optional<bool> open = shadow_is_open(c, tied);
  if (!open) return {};
  if (!*open) return envelope(c, sorted, tied);
  std::vector<std::uint32_t> shadow;
  if (tied.right) shadow.push_back(*tied.right);
  shadow.push_back(*tied.own);
  if (tied.left) shadow.push_back(*tied.left);
  return shadow;
}

}  // namespace gvd::kernel
