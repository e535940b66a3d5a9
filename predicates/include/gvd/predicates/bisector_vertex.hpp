#pragma once

#include <array>

#include "gvd/predicates/bisector.hpp"
#include "gvd/predicates/construction.hpp"

namespace gvd::predicates {

/// A point of the plane with equal distance to three waves, relative to the image of one of them, the pivot.
template <class NT>
struct BisectorVertex {
  Existence existence = Existence::open;
  PlanePoint<NT> p;  ///< minus the image of the pivot
  NT rho;            ///< distance to the image of the pivot: the common value minus the weight of the pivot
};

/// The two waves beside the pivot, relative to it: a = image - pivot image, s = weight - pivot weight (an exact zero for the same root).
/// They tie with the pivot where  p.a - rho s = c  with c = (|a|^2 - s^2) / 2, together with |p| = rho.
template <class NT>
struct RelativeWave {
  PlanePoint<NT> a;
  NT s;
  bool same_weight = false;  ///< s is zero by identity
  NT gap() const { return squared_norm(a) - square(s); }
};

/// p.a - rho s - c at a vertex: positive iff the wave's distance, taken with the sign of rho - s, is smaller than the vertex's.
/// Law: |p - a|^2 - (rho - s)^2 = -2 excess.
template <class NT>
NT lifted_excess(const RelativeWave<NT>& wave, const BisectorVertex<NT>& vertex) {
  return dot(vertex.p, wave.a) - vertex.rho * wave.s - wave.gap().scaled(-1);
}

/// Whether a further wave conflicts with a vertex: positive iff it is nearer there (its cone aside), zero iff it ties, negative iff it is
/// farther; empty if this number type cannot tell. Pre: the vertex is proved, and `wave` is relative to the same pivot.
/// An excess that is not negative means |p - a| <= |rho - s|, which is a conflict or a tie only if rho - s is not negative.
template <class NT>
robust::MaybeSign conflict(const RelativeWave<NT>& wave, const BisectorVertex<NT>& vertex) {
  const robust::MaybeSign excess = maybe_sign(lifted_excess(wave, vertex));
  if (excess == robust::Sign::negative) return excess;
  const robust::MaybeSign reach = maybe_sign(vertex.rho - wave.s);
  if (reach == robust::Sign::negative) return reach;
  return reach ? excess : std::nullopt;
}

namespace detail {

template <class NT>
struct Lifted {
  NT x, y, r;
};
template <class NT>
Lifted<NT> cross(const Lifted<NT>& a, const Lifted<NT>& b) {
  return {a.y * b.r - a.r * b.y, a.r * b.x - a.x * b.r, a.x * b.y - a.y * b.x};
}
/// The form x x' + y y' - r r' whose null cone |p| = rho is.
template <class NT>
NT form(const Lifted<NT>& a, const Lifted<NT>& b) {
  return a.x * b.x + a.y * b.y - a.r * b.r;
}

/// Three equal weights: the centre of the circle, which is the vertex iff the images i, pivot, k are counter-clockwise.
template <class NT>
BisectorVertex<NT> circumcentre(const RelativeWave<NT>& i, const RelativeWave<NT>& k) {
  BisectorVertex<NT> vertex;
  const NT turn = predicates::cross(k.a, i.a);
  Conditions conditions;
  conditions.require_positive(maybe_sign(turn));
  vertex.existence = conditions.result();
  if (vertex.existence != Existence::proved) return vertex;
  const NT half = NT(0.5) / turn;
  const NT ci = squared_norm(i.a) * half, ck = squared_norm(k.a) * half;
  vertex.p = {ck * i.a.y - ci * k.a.y, ci * k.a.x - ck * i.a.x};
  vertex.rho = sqrt(squared_norm(vertex.p));
  return vertex;
}

}  // namespace detail

/// The vertex with the regions of i, the pivot and k counter-clockwise round it (cones aside). There is at most one:
/// its point X = (p, rho) lies on the line X0 + t D in which the two planes of the ties meet, D = n_i x n_k with n = (a, -s), and on the cone
/// Q(X) = x^2 + y^2 - rho^2 = 0; of the two roots it is the one with Q(X, D) = +sqrt(delta), because
///
///     Q(X, D) = rho (rho - s_i) (rho - s_k) det[(u_i,1), (u_j,1), (u_k,1)],   u = unit directions from p to the images,
///
/// and delta = gap_ij gap_jk gap_ki / 4 has no cancellation: it is positive iff all three bisectors exist.
/// Cyclic permutation of the three gives the same point; a transposition gives the other root. A triple may have both, one or none.
/// Pre: no two of the waves are tangent (a relay and its parent), whose gap is zero: see tangent_vertex.
template <class NT>
BisectorVertex<NT> bisector_vertex(const RelativeWave<NT>& i, const RelativeWave<NT>& k) {
  using detail::form;
  if (i.same_weight && k.same_weight) return detail::circumcentre(i, k);
  BisectorVertex<NT> vertex;
  Conditions conditions;
  const NT gap_i = i.gap(), gap_k = k.gap(), gap_ik = bisector_gap(i.a, k.a, i.s - k.s);
  for (const NT* gap : {&gap_i, &gap_k, &gap_ik}) conditions.require_positive(maybe_sign(*gap));
  vertex.existence = conditions.result();
  if (vertex.existence != Existence::proved) return vertex;

  const detail::Lifted<NT> ni{i.a.x, i.a.y, -i.s}, nk{k.a.x, k.a.y, -k.s};
  const detail::Lifted<NT> d = cross(ni, nk);
  const NT norm = square(d.x) + square(d.y) + square(d.r);
  // The point of the line nearest to the origin, times norm.
  const detail::Lifted<NT> to_i = cross(nk, d), to_k = cross(d, ni);
  const NT ci = gap_i.scaled(-1), ck = gap_k.scaled(-1);
  const detail::Lifted<NT> x0{ci * to_i.x + ck * to_k.x, ci * to_i.y + ck * to_k.y, ci * to_i.r + ck * to_k.r};
  const NT root = norm * sqrt(gap_i * gap_k * gap_ik).scaled(-1);
  const NT b = form(x0, d);
  NT t;
  if (likely_positive(b)) {
    t = -form(x0, x0) / (b + root);
  } else {
    const NT a = form(d, d);
    if (maybe_sign(a) == robust::Sign::zero) {  // the vertex is at infinity
      vertex.existence = Existence::impossible;
      return vertex;
    }
    t = (root - b) / a;
  }
  vertex.p = {(x0.x + t * d.x) / norm, (x0.y + t * d.y) / norm};
  vertex.rho = (x0.r + t * d.r) / norm;
  conditions.require_positive(maybe_sign(vertex.rho));
  conditions.require_positive(maybe_sign(vertex.rho - i.s));
  conditions.require_positive(maybe_sign(vertex.rho - k.s));
  vertex.existence = conditions.result();
  return vertex;
}

/// The point where wave `other` ties with a relay and its parent on the boundary ray of the parent's cone, beyond the relay.
/// `ray` = relay's point minus the parent's image; the pivot of the result and of `other` is the relay.
/// On that ray relay and parent are equal by identity, and the other wave's lead can only grow along it: at most one point, and linear.
/// Pre: `other` does not attain the relay (then the point is the relay itself, which does not count). `length` is |ray|.
template <class NT>
BisectorVertex<NT> tangent_vertex(const PlanePoint<NT>& ray, const NT& length, const RelativeWave<NT>& other) {
  BisectorVertex<NT> vertex;
  const NT gap = other.gap();
  const NT slope = dot(ray, other.a) - other.s * length;  // gap / 2 at the distance of one ray length
  Conditions conditions;
  conditions.require_positive(maybe_sign(gap));
  conditions.require_positive(maybe_sign(slope));
  vertex.existence = conditions.result();
  if (vertex.existence != Existence::proved) return vertex;
  const NT t = gap.scaled(-1) / slope;
  vertex.p = t * ray;
  vertex.rho = t * length;
  return vertex;
}

}  // namespace gvd::predicates
