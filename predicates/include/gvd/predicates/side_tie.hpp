#pragma once

#include "gvd/predicates/bisector.hpp"
#include "gvd/predicates/construction.hpp"

namespace gvd::predicates {

/// A directed side of a facet: the points origin + t direction, 0 <= t <= 1; the facet is on the left.
template <class NT>
struct SideLine {
  PlanePoint<NT> origin, direction;
  NT square;  ///< |direction|^2
};

template <class NT>
SideLine<NT> side_line(const FacetFrame<NT>& frame, std::size_t side) {
  const PlanePoint<NT> origin = corner_point(frame, side);
  const PlanePoint<NT> direction = corner_point(frame, (side + 1) % 3) - origin;
  return {origin, direction, squared_norm(direction)};
}

template <class NT>
PlanePoint<NT> point_at(const SideLine<NT>& side, const NT& t) {
  return side.origin + t * side.direction;
}

template <class NT>
struct SideTie {
  Existence existence = Existence::open;
  NT t;  ///< parameter along the side; it may lie outside [0, 1]
};

/// E (|a|^2 - s^2) for the wave `to` and the image of `from` mirrored in the side; zero if and only if the waves tie along the
/// whole line (mirror images of equal weights) or touch in one point of it without crossing, or never.
template <class NT>
NT mirrored_gap(const SideLine<NT>& side, const Site<NT>& from, const Site<NT>& to, bool same_weight) {
  const PlanePoint<NT> a = to.image - from.image;
  const NT k = cross(side.direction, from.image - side.origin), turn = cross(side.direction, a);
  const NT square_gap = same_weight ? squared_norm(a) : squared_norm(a) - square(to.weight - from.weight);
  return side.square * square_gap + ((k + turn) * k).scaled(2);
}

/// Where, going along the line of the side, wave `to` overtakes wave `from` (cones aside): the zero of d_to - d_from where it
/// falls. It is unique: with X = t minus the foot of `from`'s image, rho = d_from - weight_from, alpha = direction.(to - from), s =
/// weight_to - weight_from and E = |direction|^2, the tie is alpha X - s rho = c, rho^2 = E X^2 + h^2, and the derivative of d_to -
/// d_from has the sign of E s X - alpha rho = -+ w, where w^2 = gap (E gap + 4 k_to k_from) / 4 has no cancellation but in the gaps
/// (k = E times the signed distance to the line). `same_weight`: s is zero by identity.
/// A contact without crossing gives `impossible`, and so do waves that tie along the whole line.
template <class NT>
SideTie<NT> overtaking(const SideLine<NT>& side, const Site<NT>& from, const Site<NT>& to, bool same_weight) {
  SideTie<NT> tie;
  Conditions conditions;
  const PlanePoint<NT> a = to.image - from.image, base = from.image - side.origin;
  const NT alpha = dot(side.direction, a), turn = cross(side.direction, a);
  const NT foot = dot(side.direction, base) / side.square, k = cross(side.direction, base);
  if (same_weight) {  // a line, met at alpha X = c
    conditions.require_positive(maybe_sign(alpha));
    tie.existence = conditions.result();
    if (tie.existence == Existence::proved) tie.t = foot + (squared_norm(a).scaled(-1) + turn * k / side.square) / alpha;
    return tie;
  }
  const NT s = to.weight - from.weight;
  const NT gap = squared_norm(a) - square(s);
  const NT of_mirror_image = mirrored_gap(side, from, to, same_weight);
  conditions.require_positive(maybe_sign(gap));
  conditions.require_positive(maybe_sign(of_mirror_image));
  tie.existence = conditions.result();
  if (tie.existence != Existence::proved) return tie;

  const NT c = gap.scaled(-1) + turn * k / side.square;
  const NT w = sqrt(gap * of_mirror_image).scaled(-1);
  const NT first = w * s, second = alpha * c;
  NT rho;
  if (likely_positive(first) == likely_positive(second)) {
    const NT denominator = square(alpha) - side.square * square(s);
    if (maybe_sign(denominator) == robust::Sign::zero) {  // the crossing is at infinity
      tie.existence = Existence::impossible;
      return tie;
    }
    tie.t = foot + (first + second) / denominator;
    rho = (side.square * (s * c) + alpha * w) / denominator;
  } else {
    const NT h = k / side.square;  // over sqrt(E)
    tie.t = foot + (side.square * square(h * s) - square(c)) / (first - second);
    rho = (square(c) + square(alpha * h)) / (alpha * w / side.square - s * c);
  }
  conditions.require_positive(maybe_sign(rho));
  conditions.require_positive(maybe_sign(rho - s));
  tie.existence = conditions.result();
  return tie;
}

/// Where the line of the side meets the ray from `image` through `vertex`. Pre: the ray is known to cross the line beyond the
/// vertex, or not to meet 0 <= t <= 1 at all.
template <class NT>
NT ray_meeting(const SideLine<NT>& side, const PlanePoint<NT>& image, const PlanePoint<NT>& vertex) {
  const PlanePoint<NT> ray = vertex - image;
  return cross(image - side.origin, ray) / cross(side.direction, ray);
}

}  // namespace gvd::predicates
