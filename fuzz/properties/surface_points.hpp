#pragma once

#include <array>
#include <string>
#include <vector>

#include "fuzz/generators/draw.hpp"
#include "gvd/kernel/solver.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "gvd/robust/rational.hpp"

namespace gvd::fuzz {

using Sources = std::vector<kernel::SourceId>;

/// Somewhere in the face: inside, on a side or on a corner.
inline kernel::SurfacePoint point_in(Draw& draw, kernel::FaceId face) {
  for (;;) {
    const std::array<std::uint32_t, 3> w = {draw.below(9), draw.below(9), draw.below(9)};
    const std::uint32_t sum = w[0] + w[1] + w[2];
    if (sum == 0) continue;
    kernel::SurfacePoint at;
    at.face = face;
    for (std::size_t k = 0; k < 3; ++k) {
      at.bary[k] = mpq_class(w[k], sum);
      at.bary[k].canonicalize();
    }
    return at;
  }
}
inline kernel::SurfacePoint point_on(Draw& draw, const kernel::Mesh& mesh) { return point_in(draw, draw.below(mesh.face_count())); }

inline mpq_class squared_distance(const kernel::ExactPoint& a, const kernel::ExactPoint& b) {
  mpq_class sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const mpq_class d = a[k] - b[k];
    sum += d * d;
  }
  return sum;
}

/// Whether high - low > |chord| for certain, given the squared chord.
inline bool certainly_exceeds(double low_of_far, double high_of_near, const mpq_class& squared_chord) {
  const mpq_class gap = robust::exact_rational(low_of_far) - robust::exact_rational(high_of_near);
  return sgn(gap) > 0 && gap * gap > squared_chord;
}
/// The same for the chord between two points of doubles. Rationals are asked only if doubles leave it open: the gap and each difference of
/// coordinates are rounded once, so squares and sums are within 8 * 2^-53 where nothing underflows; both sides get 2^-45.
inline bool certainly_exceeds(double low_of_far, double high_of_near, const kernel::Point& a, const kernel::Point& b) {
  const double gap = low_of_far - high_of_near;
  if (gap <= 0) return false;
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  if (square > 0x1p-900 && gap * gap * (1 + 0x1p-45) < square * (1 - 0x1p-45)) return false;
  const auto exact = [](const kernel::Point& p) { return kernel::ExactPoint{mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}; };
  return certainly_exceeds(low_of_far, high_of_near, squared_distance(exact(a), exact(b)));
}

inline Sources nearest(const kernel::Solution& solution, kernel::VertexId v) {
  const auto span = solution.nearest(v);
  return {span.begin(), span.end()};
}

inline std::string vertex_name(kernel::VertexId v) { return "vertex " + std::to_string(v); }

inline std::string text_of(const kernel::SurfacePoint& at) {
  return "face " + std::to_string(at.face) + " (" + at.bary[0].get_str() + " " + at.bary[1].get_str() + " " + at.bary[2].get_str() +
         ")";
}

/// A double in digits that read back as the same.
std::string text_of(double x);
std::string text_of(const Sources& sources);

}  // namespace gvd::fuzz
