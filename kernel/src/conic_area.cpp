#include "conic_area.hpp"

#include <array>
#include <cmath>

namespace gvd::kernel {

double straight_area(PlanePosition from, PlanePosition to) { return 0.5 * (from.x * to.y - from.y * to.x); }

double conic_area(PlanePosition focus, double weight, PlanePosition other_focus, double other_weight, PlanePosition from,
                  PlanePosition to) {
  const double dx = other_focus.x - focus.x, dy = other_focus.y - focus.y, delta = weight - other_weight;
  const double gap = dx * dx + dy * dy - delta * delta;
  const double ax = from.x - focus.x, ay = from.y - focus.y, bx = to.x - focus.x, by = to.y - focus.y;
  if (delta == 0 || !(gap > 0)) return straight_area(from, to);
  // Seen from the focus in direction (cos, sin) the conic is at r = gap / (2 (cos dx + sin dy + delta)); the sector is half the
  // integral of r^2, by Gauss-Legendre quadrature with eight points on each of four parts.
  constexpr std::array<double, 4> kNode = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                           0.96028985649753623168};
  constexpr std::array<double, 4> kWeight = {0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                             0.10122853629037625915};
  constexpr int kParts = 4;
  const double start = std::atan2(ay, ax), turn = std::atan2(ax * by - ay * bx, ax * bx + ay * by), half = 0.5 * turn / kParts;
  double sum = 0;
  for (int part = 0; part < kParts; ++part) {
    const double centre = start + (2 * part + 1) * half;
    for (std::size_t i = 0; i < kNode.size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const double angle = centre + side * kNode[i] * half;
        const double r = gap / (2 * (std::cos(angle) * dx + std::sin(angle) * dy + delta));
        sum += kWeight[i] * r * r;
      }
    }
  }
  const double sector = 0.5 * half * sum;
  return sector + 0.5 * (focus.x * (to.y - from.y) - focus.y * (to.x - from.x));
}

}  // namespace gvd::kernel
