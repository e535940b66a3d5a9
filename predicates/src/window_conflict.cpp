#include <stdexcept>

#include "gvd/predicates/bisector_vertex.hpp"
#include "gvd/predicates/strip_window.hpp"
#include "gvd/predicates/wave.hpp"
#include "placed_window.hpp"

namespace gvd::predicates {

using robust::MaybeSign;
using robust::Sign;

namespace {

/// A window's points in the frame of the first side of a facet, counter-clockwise.
template <class NT>
Site<NT> seen_in_facet(const Window& window, const WindowNumbers<NT>& numbers, const std::array<std::uint8_t, 3>& place) {
  // Corner k of the facet stands at place[k] of the last face: the same way round, or mirrored.
  const bool mirrored = (place[0] + 1) % 3 != place[1];
  const std::size_t side = side_between(place[0], place[1]);
  const PlanePoint<NT> apex = numbers.apex();
  const auto corner = [&](std::uint8_t p) -> PlanePoint<NT> {
    if (p == 2) return apex;
    return {NT(p == 1 ? 1.0 : 0.0), NT(0.0)};
  };
  const PlanePoint<NT> origin = corner(place[0]), direction = corner(place[1]) - origin;
  const NT square = squared_norm(direction);
  const auto placed = [&](const PlanePoint<NT>& z) -> PlanePoint<NT> {
    if (place[0] == 0 && place[1] == 1) return z;
    const PlanePoint<NT> from_origin = z - origin;
    const NT height = cross(direction, from_origin) / square;
    return {dot(direction, from_origin) / square, mirrored ? -height : height};
  };
  Site<NT> site;
  site.image = placed(numbers.image());
  site.weight = numbers.weight(side);
  if (window.cone) {
    site.has_cone = true;
    for (std::size_t end = 0; end < 2; ++end) site.cone[mirrored ? 1 - end : end] = placed(numbers.vertex((*window.cone)[end]));
  }
  return site;
}

template <class NT>
RelativeWave<NT> relative(const Site<NT>& pivot, const Site<NT>& wave, bool same_weight) {
  return {wave.image - pivot.image, same_weight ? NT(0.0) : wave.weight - pivot.weight, same_weight};
}

template <class NT>
std::optional<Conflict> conflict_in(const std::array<Site<NT>, 4>& site, const std::array<bool, 4>& pivot_weight, bool rival_is_one) {
  const Site<NT>& pivot = site[1];
  const auto vertex = bisector_vertex(relative(pivot, site[0], pivot_weight[0]), relative(pivot, site[2], pivot_weight[2]));
  if (vertex.existence == Existence::impossible) return Conflict::no_vertex;
  if (vertex.existence == Existence::open) return std::nullopt;
  const PlanePoint<NT> p = vertex.p + pivot.image;
  bool is_open = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<bool> seen = cone_contains(site[i], p);
    if (seen == false) return Conflict::no_vertex;
    if (!seen) is_open = true;
  }
  if (is_open) return std::nullopt;
  if (rival_is_one) return Conflict::ties;
  const MaybeSign nearer = conflict(relative(pivot, site[3], pivot_weight[3]), vertex);
  if (nearer == Sign::negative) return Conflict::farther;
  const std::optional<bool> seen = cone_contains(site[3], p);
  if (seen == false) return Conflict::farther;
  if (!nearer || !seen) return std::nullopt;
  return *nearer == Sign::positive ? Conflict::nearer : Conflict::ties;
}

}  // namespace

std::optional<Conflict> conflict_at(const Rung& rung, const FaceCorners& facet, const std::array<const Window*, 3>& ijk, const Window& rival) {
  // The pivot is the middle one; a pivot whose weight another shares makes a simpler formula.
  std::array<const Window*, 4> w{ijk[0], ijk[1], ijk[2], &rival};
  const auto shares = [&](std::size_t i) { return have_equal_weights(rung, *w[i], *w[(i + 1) % 3]) || have_equal_weights(rung, *w[i], *w[(i + 2) % 3]); };
  if (!shares(1) && shares(0)) w = {w[1], w[2], w[0], w[3]};
  std::array<std::array<std::uint8_t, 3>, 4> place;
  std::array<bool, 4> pivot_weight;
  for (std::size_t i = 0; i < 4; ++i) {
    place[i] = places_of(w[i]->strip, facet);
    pivot_weight[i] = have_equal_weights(rung, *w[i], *w[1]);
    if (w[i]->cone)
      for (const std::size_t v : *w[i]->cone) StripAccess(w[i]->strip).require_vertex(v);
  }
  const bool rival_is_one = std::any_of(w.begin(), w.end() - 1, [&](const Window* own) { return *own == rival; });
  return window_stage<Conflict>(rung, w, [&]<class NT>(int bits) -> std::optional<Conflict> {
    std::array<Site<NT>, 4> site;
    for (std::size_t i = 0; i < 4; ++i) {
      const WindowNumbers<NT> numbers(*w[i], bits);
      site[i] = seen_in_facet(*w[i], numbers, place[i]);
    }
    return conflict_in(site, pivot_weight, rival_is_one);
  });
}

ConflictDecision conflict(const FaceCorners& facet, const std::array<const Window*, 3>& ijk, const Window& rival) {
  for (const Rung& rung : kRungs)
    if (const auto verdict = conflict_at(rung, facet, ijk, rival)) return {verdict, rung.stage};
  return {};
}

}  // namespace gvd::predicates
