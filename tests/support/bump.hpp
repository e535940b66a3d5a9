#pragma once

#include <mpfr.h>

#include <boost/multiprecision/mpfr.hpp>

#include "gvd/kernel/surface_point.hpp"
#include "gvd/robust/rational.hpp"
#include "laid_out.hpp"
#include "meshes.hpp"

/// A corner that is hidden behind another one, or not, by as little as is wanted.
namespace gvd::test {

/// A band of faces of many square classes, whose lower bank has a bump. Seen from a place of its first edge, from vertex 0 to vertex 1, the last vertex of the upper
/// bank stands right behind the bump; from above that place a straight line leads there, from below the way bends at the bump.
class Bump {
 public:
  static constexpr kernel::VertexId kBump = 4, kLast = 13;
  kernel::MeshArrays arrays;

  Bump() {
    Random random(1002);
    for (std::uint32_t i = 0; i <= kLast; ++i) arrays.points.push_back({0.5 * i, i % 2 == 1 ? 1 : i == kBump ? 0.4 : 0, 0.1 * random.uniform()});
    for (std::uint32_t i = 0; i + 2 <= kLast; ++i) arrays.faces.push_back(i % 2 == 0 ? std::array{i, i + 2, i + 1} : std::array{i + 1, i + 2, i});
    // The place, unfolding the band: in its numbering vertices 1 and 2 are exchanged.
    LaidOut band;
    const auto& p = arrays.points;
    const auto number = [](std::size_t k) { return k == 1 ? std::size_t{2} : k == 2 ? std::size_t{1} : k; };
    band.corner = {p[0], p[2], p[1]};
    for (std::size_t i = 3; i < p.size(); ++i) {
      band.edge.push_back(i % 2 == 1 ? std::array{number(i - 1), number(i - 2)} : std::array{number(i - 2), number(i - 1)});
      band.corner.push_back(p[i]);
    }
    const auto flat = band.flat<Long>();
    const auto along = flat[kLast] - flat[kBump];
    const Long from = cross(along, flat[0] - flat[kBump]), to = cross(along, flat[2] - flat[kBump]);
    place_ = from / (from - to);
  }
  /// By less than 2^-bits of the edge.
  kernel::SurfacePoint below(const kernel::Mesh& mesh, unsigned bits) const { return at(mesh, bits, 0); }
  kernel::SurfacePoint above(const kernel::Mesh& mesh, unsigned bits) const { return at(mesh, bits, 1); }

 private:
  /// 420 decimal digits.
  using Long = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<420>, boost::multiprecision::et_off>;

  kernel::SurfacePoint at(const kernel::Mesh& mesh, unsigned bits, int up) const {
    const Long scaled = floor(ldexp(place_, static_cast<int>(bits)));
    mpz_class t;
    mpfr_get_z(t.get_mpz_t(), scaled.backend().data(), MPFR_RNDN);
    return kernel::point_on_edge(mesh, 0, 1, mpq_class(t + up) * robust::power_of_two(-static_cast<long>(bits)));
  }
  Long place_;
};

}  // namespace gvd::test
