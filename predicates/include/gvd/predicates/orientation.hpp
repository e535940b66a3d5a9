#pragma once

#include "gvd/predicates/frame.hpp"
#include "gvd/robust/sign.hpp"

namespace gvd::predicates {

/// Twice the signed area of (p, q, r): positive iff r lies to the left of the directed line p -> q. Swapping two points negates.
/// NT: any number type with + - *; the error is that of NT.
template <class NT>
NT orientation(const Complex<NT>& p, const Complex<NT>& q, const Complex<NT>& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

}  // namespace gvd::predicates
