#include "contenders.hpp"

#include <algorithm>
#include <cmath>

#include "gvd/kernel/unfolding.hpp"

namespace gvd::kernel {
namespace {

using predicates::Predicate;
using predicates::operator-;
using robust::Sign;

/// Whether the points are certainly different, as far as doubles can tell. The difference of the midpoints is rounded once, what pays for that thrice.
bool separated(const predicates::PlanePoint<FacetLadder::F>& a, const predicates::PlanePoint<FacetLadder::F>& b) {
  const auto differ = [](const FacetLadder::F& x, const FacetLadder::F& y) { return std::fabs(x.mid() - y.mid()) > (x.rad() + y.rad()) * (1 + 0x1p-48); };
  return differ(a.x, b.x) || differ(a.y, b.y);
}

/// The turn from the right boundary ray of one to the left one of the other; empty if these numbers cannot tell.
template <class NT>
robust::MaybeSign rays_apart(const FacetNumbers<NT>& numbers, const Contender& left, const Contender& right) {
  const auto& image = numbers.sites[left.site]->image;
  return maybe_sign(predicates::orientation(image, numbers.sites[left.cone_site[1]]->cone[1], numbers.sites[right.cone_site[0]]->cone[0]));
}

}  // namespace

Contenders::Contenders(FacetWaves& waves, FacetLadder& ladder)
    : waves_(waves), list_(ladder.room()), representative_(ladder.room()), pairs_(ladder.room()), may_be_related_(ladder.room()) {
  list_.reserve(waves.sites.size());
  representative_.reserve(waves.sites.size());
  for (std::uint32_t i = 0; i < waves.sites.size(); ++i) {
    const FacetSite& site = waves.sites[i];
    representative_.push_back(i);
    Contender c;
    c.site = i;
    c.corner = site.corner;
    c.entry = site.corner == FacetSite::kNoCorner ? static_cast<std::uint8_t>(1u << site.side) : 0;
    c.root = site.root;
    c.has_cone = ladder.filter().sites[i]->has_cone;
    if (c.has_cone) {
      c.cone = site.cone;
      c.attains_cone = site.attains_cone;
      c.cone_site = {i, i};
    }
    c.attains_corner = site.attains_corner;
    c.path_to_corner = site.path_to_corner;
    list_.push_back(c);
  }
  merge_same_images(ladder);
  find_tangencies(ladder);
}

std::string Contenders::name(std::size_t i) const {
  return "site " + std::to_string(list_[i].site) + " (root " + std::to_string(list_[i].root) + ")";
}

/// As far as doubles can tell.
bool Contenders::may_have_one_image(const FacetLadder& ladder, const Contender& left, const Contender& right) const {
  if (!left.has_cone || !right.has_cone || left.root != right.root) return false;
  return !separated(ladder.filter().sites[left.site]->image, ladder.filter().sites[right.site]->image);
}

/// Pre: doubles do not separate the images. The image is one for windows that come to a flat corner of the facet by one path and pass it on either
/// side: identity. That both attain the corner is not enough, since two geodesics to it may differ by less than doubles can tell. Elsewhere it takes
/// the exact numbers.
bool Contenders::same_image(FacetLadder& ladder, const Contender& left, const Contender& right) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const bool round_corner = left.cone[1] == waves_.corner[k] && right.cone[0] == waves_.corner[k];
    const bool one_path = left.path_to_corner[k] != FacetSite::kNoPath && left.path_to_corner[k] == right.path_to_corner[k];
    if (round_corner && waves_.corner_is_flat[k] && one_path) {
      ladder.count(Predicate::edge_tie, robust::Stage::identity);
      return true;
    }
  }
  if (waves_.have_one_image(left.cone_site[1], right.cone_site[0])) {
    ladder.count(Predicate::edge_tie, robust::Stage::identity);
    return true;
  }
  if (waves_.are_proved_one_wave(left.site, right.site)) {
    ladder.count(Predicate::edge_tie, robust::Stage::algebra);
    return true;
  }
  const auto same = ladder.for_each_stage([&](const auto& numbers, robust::Stage) -> std::optional<bool> {
    const auto &a = numbers.sites[left.site]->image, &b = numbers.sites[right.site]->image;
    const robust::MaybeSign x = maybe_sign(a.x - b.x), y = maybe_sign(a.y - b.y);
    if (x.value_or(Sign::zero) != Sign::zero || y.value_or(Sign::zero) != Sign::zero) return false;
    if (!x || !y) return std::nullopt;
    return true;
  });
  return same.value_or(false);  // two contenders that nobody can tell apart: whatever depends on it will be undecided
}

/// Whether the right boundary ray of one cone may be the left one of the other, as far as identity and doubles can tell.
bool Contenders::may_touch(const FacetLadder& ladder, const Contender& left, const Contender& right) const {
  return (left.cone[1] == right.cone[0] && left.cone[1] != kNone) || rays_apart(ladder.filter(), left, right).value_or(Sign::zero) == Sign::zero;
}

/// Whether it is. Pre: the images are one. By name only if the two strips see the vertex in one place: as a corner of the facet, or with nothing but
/// flat vertices between them. Curvature may cancel, so that the image is one and the vertex is not.
bool Contenders::touching(FacetLadder& ladder, const Contender& left, const Contender& right) const {
  if (const auto apart = rays_apart(ladder.filter(), left, right)) return *apart == Sign::zero;
  if (left.cone[1] == right.cone[0] && left.cone[1] != kNone) {
    if (std::find(waves_.corner.begin(), waves_.corner.end(), left.cone[1]) != waves_.corner.end()) return true;
    if (waves_.have_one_image(left.cone_site[1], right.cone_site[0])) return true;
  }
  return ladder.for_each_stage([&](const auto& numbers, robust::Stage) { return rays_apart(numbers, left, right); }) == Sign::zero;
}

/// Whoever is related to another has its image as far from the other's as the weights differ, and few are near that.
void Contenders::find_pairs(const FacetLadder& ladder) {
  const auto n = static_cast<std::uint32_t>(list_.size());
  may_be_related_.clear();
  may_be_related_.reserve(4 * list_.size());
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      if (!predicates::certainly_unrelated(ladder.doubles()[list_[i].site], ladder.doubles()[list_[j].site]))
        may_be_related_.insert(may_be_related_.end(), {{i, j}, {j, i}});
  std::sort(may_be_related_.begin(), may_be_related_.end());
}

void Contenders::merge_same_images(FacetLadder& ladder) {
  const auto to_be_merged = [&](const auto& pair) { return are_to_be_merged(ladder, pair[0], pair[1]); };
  for (;;) {  // again: the merged cone may touch another
    find_pairs(ladder);
    const auto found = std::find_if(may_be_related_.begin(), may_be_related_.end(), to_be_merged);
    if (found == may_be_related_.end()) return;
    merge((*found)[0], (*found)[1]);
  }
}

bool Contenders::are_to_be_merged(FacetLadder& ladder, std::size_t i, std::size_t j) const {
  const Contender &left = list_[i], &right = list_[j];
  return may_have_one_image(ladder, left, right) && may_touch(ladder, left, right) && same_image(ladder, left, right) && touching(ladder, left, right);
}

void Contenders::merge(std::size_t i, std::size_t j) {
  Contender &left = list_[i], &right = list_[j];
  left.cone[1] = right.cone[1];
  left.attains_cone[1] = right.attains_cone[1];
  left.cone_site[1] = right.cone_site[1];
  left.entry |= right.entry;
  const std::uint32_t lowest = std::min(left.site, right.site);
  for (std::uint32_t& site : representative_)
    if (site == left.site || site == right.site) site = lowest;
  left.site = lowest;
  for (std::size_t k = 0; k < 3; ++k) {
    left.attains_corner[k] = left.attains_corner[k] || right.attains_corner[k];
    if (left.path_to_corner[k] == FacetSite::kNoPath) left.path_to_corner[k] = right.path_to_corner[k];
  }
  list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(j));
}

void Contenders::find_tangent_end(const FacetLadder& ladder, std::size_t p, std::size_t r) {
  const Contender &parent = list_[p], &relay = list_[r];
  for (std::size_t end = 0; parent.has_cone && end < 2; ++end) {
    if (relay.root != parent.cone[end] || !parent.attains_cone[end]) continue;
    const auto& sites = ladder.filter().sites;
    if (separated(sites[relay.site]->image, sites[parent.cone_site[end]]->cone[end])) continue;  // it went another way round
    if (relay.corner == FacetSite::kNoCorner && !waves_.is_at_cone_vertex(parent.cone_site[end], relay.site)) continue;
    pair(p, r).tangent = static_cast<signed char>(end);
  }
}

void Contenders::find_tangencies(FacetLadder& ladder) {
  pairs_.assign(list_.size() * list_.size(), {});
  for (const auto& [p, r] : may_be_related_) find_tangent_end(ladder, p, r);
  for (const auto& [p, r] : may_be_related_)
    pair(p, r).eclipsed = tangent_end(p, r) != kNotTangent || finds_eclipse(ladder, list_[p], list_[r]);
  for (const auto& [p, r] : may_be_related_)
    if (eclipses(p, r) && tangent_end(p, r) == kNotTangent) pair(p, r).tangent = static_cast<signed char>(ray_through(ladder, p, r));
  share_eclipses(ladder);
}

/// Whether the two are one wave, cones aside: windows of one root, or of two that are as far, with one image.
bool Contenders::are_one_wave(FacetLadder& ladder, const Contender& a, const Contender& b) const {
  if (a.root == b.root) return may_have_one_image(ladder, a, b) && same_image(ladder, a, b);
  if (!a.has_cone || !b.has_cone) return false;
  const auto& sites = ladder.filter().sites;
  return !separated(sites[a.site]->image, sites[b.site]->image) && waves_.are_proved_one_wave(a.site, b.site);
}

/// Windows that are one wave and were not merged have one distance everywhere: neither is nearer than the other, and each eclipses, or is eclipsed by,
/// what the other does. Two of different roots whose cones touch part at the common ray, behind a vertex that both reach straight on: the region of the
/// vertex is that ray, no wider.
void Contenders::share_eclipses(FacetLadder& ladder) {
  for (const auto& [i, j] : may_be_related_) {
    const Contender &a = list_[i], &b = list_[j];
    if (!are_one_wave(ladder, a, b)) continue;
    if (a.root != b.root && may_touch(ladder, a, b) && touching(ladder, a, b)) pair(i, j).tangent = 1;
    pair(i, j).eclipsed = true;
    for (std::size_t k = 0; k < list_.size(); ++k) {
      if (k != i && eclipses(j, k)) pair(i, k).eclipsed = true;
      if (k != i && eclipses(k, j)) pair(k, i).eclipsed = true;
    }
  }
  for (const auto& [i, j] : may_be_related_) pair(i, j).related = tangent(i, j) || eclipses(i, j) || eclipses(j, i);
}

/// Asked only where doubles cannot exclude it: the difference of the weights must be the distance of the images. By identity if the
/// path is known to go that way, else by algebra.
bool Contenders::finds_eclipse(FacetLadder& ladder, const Contender& wave, const Contender& relay) const {
  if (relay.corner != FacetSite::kNoCorner && wave.attains_corner[relay.corner]) return true;
  if (!wave.has_cone) return false;
  const auto gap = [&](const auto& numbers) {
    const auto &a = *numbers.sites[wave.site], &b = *numbers.sites[relay.site];
    return maybe_sign(squared_norm(a.image - b.image) - square(b.weight - a.weight));
  };
  const auto heavier = [&](const auto& numbers) {
    return maybe_sign(numbers.sites[relay.site]->weight - numbers.sites[wave.site]->weight);
  };
  const auto is_open = [&](const auto& numbers) { return gap(numbers).value_or(Sign::zero) != Sign::zero; };
  if (wave.root == relay.root || is_open(ladder.filter()) || heavier(ladder.filter()) == Sign::negative) return false;
  if (is_open(ladder.in_double_double())) return false;
  const std::array<std::uint32_t, 3> parts = {wave.site, wave.cone_site[0], wave.cone_site[1]};  // different ones if merged
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (std::find(parts.begin(), parts.begin() + i, parts[i]) == parts.begin() + i && waves_.is_own_relay(parts[i], relay.site)) return true;
  if (is_open(ladder.in_mpfr(kBitsBeforeAlgebra))) return false;
  if (const auto closed = is_gap_closed_where_they_part(wave, relay)) return *closed;
  return ladder.for_each_stage([&](const auto& numbers, robust::Stage) { return gap(numbers); }) == Sign::zero &&
         ladder.for_each_stage([&](const auto& numbers, robust::Stage) { return heavier(numbers); }) == Sign::positive;
}

/// Whether the wave is as far from the relay's image as the weights differ, by the images alone. Empty if that is not to be had.
std::optional<bool> Contenders::is_gap_closed_where_they_part(const Contender& wave, const Contender& relay) const {
  const auto sites = where_they_part(std::array{wave.site, relay.site});
  if (sites.empty()) return std::nullopt;
  const auto later = sites[1].weight - sites[0].weight;
  const robust::MaybeSign heavier = maybe_sign(later);
  if (!heavier) return std::nullopt;
  if (*heavier != Sign::positive) return false;
  const robust::MaybeSign gap = maybe_sign(squared_norm(sites[0].image - sites[1].image) - square(later));
  return gap ? std::optional(*gap == Sign::zero) : std::nullopt;
}

std::vector<predicates::Site<robust::Exact>> Contenders::where_they_part(std::span<const std::uint32_t> sites) const {
  for (std::uint8_t side = 0; side < 3; ++side) {
    std::vector<std::uint32_t> which;
    for (const std::uint32_t merged : sites)
      for (std::uint32_t site = 0; site < representative_.size(); ++site) {
        const bool fits = waves_.sites[site].window == kNone || waves_.sites[site].side == side;
        if (representative_[site] != merged || !fits) continue;
        which.push_back(site);
        break;
      }
    if (which.size() != sites.size()) continue;
    if (auto parted = waves_.where_they_part(which); !parted.empty()) return parted;
  }
  return waves_.where_they_part(sites);
}

/// Whether a line from the wave's image through the relay's may enter the facet beyond it. The relay lies outside the side that it comes in over, or
/// is a corner: then the wave's image must lie farther out, or not outside the opposite side.
bool Contenders::may_enter_beyond(FacetLadder& ladder, const Contender& wave, const Contender& relay) const {
  if (relay.corner != FacetSite::kNoCorner) return !wave.enters_over((relay.corner + 1u) % 3);
  const auto inwards = [&](const auto& numbers, robust::Stage) {
    const auto &from = numbers.sites[wave.site]->image, &to = numbers.sites[relay.site]->image;
    return maybe_sign(cross(numbers.side[waves_.sites[relay.site].side].direction, to - from));
  };
  const auto known = inwards(ladder.filter(), robust::Stage::filter);
  return (known ? known : ladder.for_each_stage(inwards)).value_or(Sign::positive) == Sign::positive;
}

/// The boundary ray of a wave on which a relay that it eclipses lies and goes on into the facet, if any: several vertices may follow one
/// another on a ray. By identity if another one is known to lie on it and one of the two eclipses the other.
int Contenders::ray_through(FacetLadder& ladder, std::size_t p, std::size_t r) const {
  const Contender &wave = list_[p], &relay = list_[r];
  if (!wave.has_cone || !may_enter_beyond(ladder, wave, relay)) return kNotTangent;
  for (std::size_t other = 0; other < list_.size(); ++other)
    if (tangent_end(p, other) != kNotTangent && (eclipses(r, other) || eclipses(other, r))) return tangent_end(p, other);
  for (std::size_t end = 0; end < 2; ++end) {
    const auto side = [&](const auto& numbers) {
      return maybe_sign(cone_side(numbers, wave, end, numbers.sites[relay.site]->image));
    };
    if (side(ladder.filter()).value_or(Sign::zero) != Sign::zero) continue;
    if (waves_.is_relay_on_ray(wave.cone_site[end], end, relay.site)) return static_cast<int>(end);
    if (ladder.for_each_stage([&](const auto& numbers, robust::Stage) { return side(numbers); }) == Sign::zero) return static_cast<int>(end);
  }
  return kNotTangent;
}

std::uint32_t Contenders::starts_on_ray(std::size_t parent, std::size_t relay) const {
  const int end = tangent_end(parent, relay);
  for (std::uint32_t between = 0; eclipses(relay, parent) && between < list_.size(); ++between)
    if (tangent_end(parent, between) == end && !eclipses(between, parent)) return between;
  return static_cast<std::uint32_t>(relay);
}

/// Whether two that are one wave part at these rays of theirs.
bool Contenders::share_ray(std::size_t a, std::size_t end_a, std::size_t b, std::size_t end_b) const {
  if (end_a == end_b || !eclipses(a, b) || !eclipses(b, a)) return false;
  return end_a == 1 ? tangent_end(a, b) == 1 : tangent_end(b, a) == 1;
}

bool Contenders::is_on_ray(std::size_t i, std::size_t end, std::uint32_t site, std::size_t site_end) const {
  if (list_[i].cone_site[end] == site && end == site_end) return true;
  for (std::size_t p = 0; p < list_.size(); ++p) {
    if (!list_[p].has_cone || list_[p].cone_site[site_end] != site || (!eclipses(p, i) && !eclipses(i, p))) continue;
    if (share_ray(p, site_end, i, end)) return true;
    const bool image_on_ray = tangent_end(p, i) == static_cast<int>(site_end) || tangent_end(i, p) == static_cast<int>(end);
    if (image_on_ray && waves_.share_cone_vertex(site, site_end, list_[i].cone_site[end], end)) return true;
    for (std::size_t q = 0; q < list_.size(); ++q)
      if (tangent_end(p, q) == static_cast<int>(site_end) && tangent_end(i, q) == static_cast<int>(end)) return true;
  }
  return false;
}

bool Contenders::are_one_ray(std::uint32_t site, std::size_t end, std::uint32_t other, std::size_t other_end) const {
  for (std::size_t i = 0; i < list_.size(); ++i)
    if (list_[i].has_cone && list_[i].cone_site[end] == site && is_on_ray(i, end, other, other_end)) return true;
  return false;
}

bool Contenders::runs_along(FacetLadder& ladder, std::size_t i, std::size_t end, std::size_t side) const {
  const auto test = [&](const auto& numbers, robust::Stage) -> std::optional<bool> {
    const auto at_start = maybe_sign(cone_side(numbers, list_[i], end, numbers.side[side].origin));
    const auto at_end = maybe_sign(cone_side(numbers, list_[i], end, numbers.side[(side + 1) % 3].origin));
    if (at_start.value_or(Sign::zero) != Sign::zero || at_end.value_or(Sign::zero) != Sign::zero) return false;
    return at_start && at_end ? std::optional(true) : std::nullopt;
  };
  if (const auto known = test(ladder.filter(), robust::Stage::filter)) return *known;
  const auto [known, added] = runs_along_.try_emplace({i, end, side}, false);
  if (added) known->second = ladder.for_each_stage(test).value_or(false);
  return known->second;
}

bool Contenders::tie_on_ray_along(FacetLadder& ladder, std::size_t parent, std::size_t relay, std::size_t side) const {
  const int ray = tangent_end(parent, relay);
  if (ray == kNotTangent || !runs_along(ladder, parent, static_cast<std::size_t>(ray), side)) return false;
  const auto test = [&](const auto& numbers, robust::Stage) -> std::optional<bool> {
    const auto &from = numbers.sites[list_[parent].site]->image, &on = numbers.sites[list_[relay].site]->image;
    bool open = false;
    for (const std::size_t c : {side, (side + 1) % 3}) {
      const robust::MaybeSign beyond = maybe_sign(dot(numbers.side[c].origin - on, on - from));
      if (beyond == Sign::negative) return false;
      open = open || !beyond;
    }
    return open ? std::nullopt : std::optional(true);
  };
  if (const auto known = test(ladder.filter(), robust::Stage::filter)) return *known;
  return ladder.for_each_stage(test).value_or(false);
}

Sign Contenders::mirrored(std::size_t i, std::size_t j, std::size_t side) const {
  const auto proved = [&](std::size_t entering, std::size_t other) {
    if (!list_[entering].enters_over(side) || !may_be_mirror_images(list_[entering], list_[other], side)) return false;
    const auto [known, added] = mirrored_.try_emplace({entering, other, side}, false);
    if (added) known->second = are_mirror_images(list_[entering], list_[other], side);
    return known->second;
  };
  if (proved(i, j)) return Sign::positive;
  return proved(j, i) ? Sign::negative : Sign::zero;
}

/// As far as doubles can tell.
bool Contenders::may_be_mirror_images(const Contender& entering, const Contender& other, std::size_t side) const {
  using F = FacetWaves::F;
  const auto &a = waves_.site(entering.site, F()), &b = waves_.site(other.site, F());
  const auto may_be_zero = [](const F& x) { return maybe_sign(x).value_or(Sign::zero) == Sign::zero; };
  if (!may_be_zero(a.weight - b.weight)) return false;
  const auto line = predicates::side_line(waves_.frame(F()), side);
  const auto apart = a.image - b.image, twice_the_middle = (a.image - line.origin) + (b.image - line.origin);
  return may_be_zero(dot(apart, line.direction)) && may_be_zero(cross(twice_the_middle, line.direction));
}

bool Contenders::are_mirror_images(const Contender& entering, const Contender& other, std::size_t side) const {
  for (std::size_t e = 0; e < waves_.sites.size(); ++e) {
    if (representative_[e] != entering.site || waves_.sites[e].window == kNone || waves_.sites[e].side != side) continue;
    for (std::size_t o = 0; o < waves_.sites.size(); ++o)
      if (representative_[o] == other.site && waves_.are_mirror_images(e, o)) return true;
  }
  return false;
}

/// Whether a test holds for one of the windows merged in i and one of those in j.
template <class Test>
bool Contenders::any_windows(std::size_t i, std::size_t j, const Test& test) const {
  for (std::size_t a = 0; a < waves_.sites.size(); ++a)
    for (std::size_t b = 0; b < waves_.sites.size(); ++b)
      if (representative_[a] == list_[i].site && representative_[b] == list_[j].site && test(a, b)) return true;
  return false;
}

bool Contenders::mirrored_on_way(std::size_t i, std::size_t j, std::size_t side) const {
  const auto proved = [&](std::size_t parent, std::size_t other) {
    const auto [known, added] = on_way_.try_emplace({parent, other, side}, false);
    if (added)
      known->second =
          any_windows(parent, other, [&](std::size_t a, std::size_t b) { return waves_.is_mirrored_on_strip(a, b, static_cast<std::uint8_t>(side)); });
    return known->second;
  };
  return proved(i, j) || proved(j, i);
}

bool Contenders::tie_at_corner(FacetLadder& ladder, std::size_t i, std::size_t j, std::size_t k) const {
  if (list_[i].ties_at_corner(list_[j], k)) return true;
  const auto compare = [&](const auto& numbers) {
    const auto distance = [&](std::size_t wave) { return predicates::distance(*numbers.sites[list_[wave].site], numbers.side[k].origin); };
    return maybe_sign(distance(i) - distance(j));
  };
  if (const robust::MaybeSign known = compare(ladder.filter())) return *known == Sign::zero;
  const auto [known, added] = at_corner_.try_emplace({std::min(i, j), std::max(i, j), k}, false);
  if (!added) return known->second;
  const auto differ = [&](const auto& numbers) { return compare(numbers).value_or(Sign::zero) != Sign::zero; };
  if (differ(ladder.in_double_double()) || differ(ladder.in_mpfr(kBitsBeforeAlgebra))) return false;
  known->second = any_windows(i, j, [&](std::size_t a, std::size_t b) { return waves_.are_as_far_from_corner(a, b, static_cast<std::uint8_t>(k)); });
  return known->second;
}

int Contenders::mirrored_tangent_end(std::size_t parent, std::size_t relay, std::size_t side) const {
  const Contender& wave = list_[parent];
  for (std::size_t end = 0; wave.has_cone && end < 2; ++end)
    for (std::size_t o = 0; o < waves_.sites.size(); ++o)
      if (representative_[o] == list_[relay].site && waves_.is_mirrored_at_cone_vertex(wave.cone_site[end], end, o, static_cast<std::uint8_t>(side)))
        return static_cast<int>(end);
  return kNotTangent;
}

}  // namespace gvd::kernel
