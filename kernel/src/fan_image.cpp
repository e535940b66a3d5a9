#include "fan_image.hpp"

#include <algorithm>

#include "gvd/predicates/side_tie.hpp"
#include "gvd/robust/rational.hpp"
#include "wave_numbers.hpp"

namespace gvd::kernel {
namespace {

using predicates::PlanePoint;
using predicates::operator-;
using robust::Exact;
using robust::Sign;

/// A complex number x + i y sqrt(radicand).
struct Turn {
  mpq_class x, y, radicand;
};

/// Four times the squared area of a face, and the vector from the origin of its half-edge h to the apex, in units of h.
struct Corner {
  mpq_class radicand, along, length2;
};
Corner corner_at(const Mesh& mesh, HalfedgeId h) {
  const ExactPoint v = mesh.exact_point(mesh.origin(h)), p = mesh.exact_point(mesh.target(h)), q = mesh.exact_point(mesh.apex(h));
  mpq_class dot, square_a, square_b;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class a = p[i] - v[i], b = q[i] - v[i];
    dot += a * b;
    square_a += a * a;
    square_b += b * b;
  }
  return {square_a * square_b - dot * dot, dot, square_a};
}

/// Turns by the corner of the face of h at its origin. False if the face is of another square class.
bool turn_by(const Mesh& mesh, HalfedgeId h, Turn& total) {
  const Corner corner = corner_at(mesh, h);
  const auto root = robust::rational_square_root(corner.radicand / total.radicand);
  if (!root) return false;
  const mpq_class u = corner.along / corner.length2, y = *root / corner.length2;
  const mpq_class x = total.x * u - total.y * y * total.radicand;
  total.y = total.x * y + total.y * u;
  total.x = x;
  return true;
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
  if (a.exact_frame() == nullptr || b.exact_frame() == nullptr) return std::nullopt;
  const std::size_t ka = corner_of(a, v), kb = corner_of(b, v);
  const HalfedgeId last = 3 * b.face + static_cast<HalfedgeId>(kb);
  HalfedgeId h = 3 * a.face + static_cast<HalfedgeId>(ka);
  Turn total{1, 0, corner_at(mesh, h).radicand};
  while (h != last) {
    if (!turn_by(mesh, h, total)) return std::nullopt;
    h = mesh.twin(Mesh::prev(h));
    if (h == kNone) return std::nullopt;
  }
  const PlanePoint<Exact> za = seen_from(a, site_a, ka), zb = seen_from(b, site_b, kb);
  const Exact x(total.x), y = Exact(total.y) * sqrt(Exact(total.radicand));
  const auto dx = maybe_sign(zb.x * x - zb.y * y - za.x), dy = maybe_sign(zb.x * y + zb.y * x - za.y);
  if (!dx || !dy) return std::nullopt;
  return *dx == Sign::zero && *dy == Sign::zero;
}

}  // namespace gvd::kernel
