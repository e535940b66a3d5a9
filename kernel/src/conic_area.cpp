#include "conic_area.hpp"

#include <array>
#include <cmath>

namespace gvd::kernel {
namespace {

struct Direction {
  double cos, sin;
};
Direction turned(const Direction& a, const Direction& by) { return {a.cos * by.cos - a.sin * by.sin, a.sin * by.cos + a.cos * by.sin}; }
Direction direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

double straight_area(PlanePosition from, PlanePosition to) { return 0.5 * (from.x * to.y - from.y * to.x); }

double conic_area(PlanePosition focus, double weight, PlanePosition other_focus, double other_weight, PlanePosition from,
                  PlanePosition to) {
  const double dx = other_focus.x - focus.x, dy = other_focus.y - focus.y, delta = weight - other_weight;
  const double gap = dx * dx + dy * dy - delta * delta;
  const double ax = from.x - focus.x, ay = from.y - focus.y, bx = to.x - focus.x, by = to.y - focus.y;
  if (delta == 0 || !(gap > 0)) return straight_area(from, to);
  // Seen from the focus in direction (cos, sin) the conic is at r = gap / (2 (cos dx + sin dy + delta)); the sector is half the
  // integral of r^2, by Gauss-Legendre quadrature with eight points on each part.
  constexpr std::array<double, 4> kNode = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                           0.96028985649753623168};
  constexpr std::array<double, 4> kWeight = {0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                             0.10122853629037625915};
  const auto reach = [&](const Direction& to_point) { return gap / (2 * (to_point.cos * dx + to_point.sin * dy + delta)); };
  const double turn = std::atan2(ax * by - ay * bx, ax * bx + ay * by), ra = std::sqrt(ax * ax + ay * ay), rb = std::sqrt(bx * bx + by * by);
  const Direction first{ax / ra, ay / ra};
  // Where the reach hardly changes, its pole is at least eight half turns away, and eight points leave an error below 16^-16.
  const double middle = reach(turned(first, direction(0.5 * turn)));
  const bool even = std::fabs(turn) < 0.25 && std::fabs(ra - middle) < middle / 64 && std::fabs(rb - middle) < middle / 64;
  const int parts = even ? 1 : 4;
  const double half = 0.5 * turn / parts;
  std::array<Direction, 4> offset;
  for (std::size_t i = 0; i < kNode.size(); ++i) offset[i] = direction(kNode[i] * half);
  double sum = 0;
  for (int part = 0; part < parts; ++part) {
    const Direction centre = turned(first, direction((2 * part + 1) * half));
    for (std::size_t i = 0; i < kNode.size(); ++i) {
      const double before = reach(turned(centre, {offset[i].cos, -offset[i].sin})), after = reach(turned(centre, offset[i]));
      sum += kWeight[i] * (before * before + after * after);
    }
  }
  const double sector = 0.5 * half * sum;
  return sector + 0.5 * (focus.x * (to.y - from.y) - focus.y * (to.x - from.x));
}

}  // namespace gvd::kernel
