#include "fan_image.hpp"

#include <algorithm>

#include "gvd/predicates/root_strip.hpp"
#include "gvd/predicates/side_tie.hpp"
#include "wave_numbers.hpp"

namespace gvd::kernel {
namespace {

using predicates::Complex;
using predicates::PlanePoint;
using predicates::operator-;
using robust::Exact;
using robust::RootSum;
using robust::Sign;

/// The turn from half-edge h to the next edge counter-clockwise round its origin: the apex of its face in units of h.
Complex<RootSum> turn_at(const Mesh& mesh, HalfedgeId h) {
  const ExactPoint v = mesh.exact_point(mesh.origin(h)), p = mesh.exact_point(mesh.target(h)), q = mesh.exact_point(mesh.apex(h));
  mpq_class dot, square_a, square_b;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class a = p[i] - v[i], b = q[i] - v[i];
    dot += a * b;
    square_a += a * a;
    square_b += b * b;
  }
  const mpq_class radicand = square_a * square_b - dot * dot;  // four times the squared area
  return {RootSum(dot / square_a), RootSum(1 / square_a, radicand)};
}

std::size_t corner_of(const FacetWaves& waves, VertexId v) {
  return static_cast<std::size_t>(std::find(waves.corner.begin(), waves.corner.end(), v) - waves.corner.begin());
}

/// The image seen from corner k, in units of the side that starts there.
PlanePoint<Exact> seen_from(FacetWaves& waves, std::uint32_t site, std::size_t k) {
  return seen_from_side(predicates::side_line(*waves.exact_frame(), k), waves.exact_site(site)->image);
}

}  // namespace

std::optional<bool> have_one_image_round(const Mesh& mesh, VertexId v, FacetWaves& a, std::uint32_t site_a, FacetWaves& b,
                                         std::uint32_t site_b) {
  const std::size_t ka = corner_of(a, v), kb = corner_of(b, v);
  const HalfedgeId last = 3 * b.face + static_cast<HalfedgeId>(kb);
  HalfedgeId h = 3 * a.face + static_cast<HalfedgeId>(ka);
  Complex<RootSum> total{RootSum(1), RootSum()};
  while (h != last) {
    const Complex<RootSum> turn = turn_at(mesh, h);
    total = {total.x * turn.x - total.y * turn.y, total.x * turn.y + total.y * turn.x};
    h = mesh.twin(Mesh::prev(h));
    if (h == kNone || total.x.terms().size() > predicates::kMostTerms) return std::nullopt;
  }
  const PlanePoint<Exact> za = seen_from(a, site_a, ka), zb = seen_from(b, site_b, kb);
  const Exact x(total.x), y(total.y);
  const auto dx = maybe_sign(zb.x * x - zb.y * y - za.x), dy = maybe_sign(zb.x * y + zb.y * x - za.y);
  if (!dx || !dy) return std::nullopt;
  return *dx == Sign::zero && *dy == Sign::zero;
}

}  // namespace gvd::kernel
