#include "inserted_positions.hpp"

#include <algorithm>
#include <cmath>

#include "gvd/robust/midpoint.hpp"

namespace gvd::kernel {

using robust::DoubleDouble;
using robust::Mpfr;

namespace {

constexpr int kBits = 512;
constexpr double kMostCancelled = 0x1p-256;  // a difference relative to the coordinates

DoubleDouble nearest(Mpfr x) {
  const double hi = x.to_double();
  mpfr_sub_d(x.get(), x.get(), hi, MPFR_RNDN);
  return robust::fast_two_sum(hi, x.to_double());
}

}  // namespace

InsertedPositions::InsertedPositions(const Mesh& mesh) : mesh_(mesh) {
  positions_.reserve(mesh.vertex_count() - mesh.input_vertex_count());
  for (VertexId v = mesh.input_vertex_count(); v < mesh.vertex_count(); ++v) {
    const ExactPoint p = mesh.exact_point(v);
    positions_.push_back({Mpfr(p[0], kBits), Mpfr(p[1], kBits), Mpfr(p[2], kBits)});
  }
}

Mpfr InsertedPositions::coordinate(VertexId v, std::size_t i) const {
  return v < mesh_.input_vertex_count() ? Mpfr(mesh_.point(v)[i], kBits) : positions_[v - mesh_.input_vertex_count()][i];
}

std::optional<std::array<DoubleDouble, 3>> InsertedPositions::difference(VertexId a, VertexId b, int scale) const {
  std::array<DoubleDouble, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double largest = std::max(std::fabs(mesh_.point(a)[i]), std::fabs(mesh_.point(b)[i]));
    const DoubleDouble d = nearest(coordinate(b, i) - coordinate(a, i));
    if (!(std::fabs(d.hi) >= largest * kMostCancelled && std::fabs(d.hi) >= 0x1p-900)) return std::nullopt;
    result[i] = {robust::times_power_of_two(d.hi, scale), robust::times_power_of_two(d.lo, scale)};
  }
  return result;
}

}  // namespace gvd::kernel
