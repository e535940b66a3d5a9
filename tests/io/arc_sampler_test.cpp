#include "gvd/io/arc_sampler.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/square_diagram.hpp"

using namespace gvd;

namespace {

/// One arc in one large triangle, given by its foci, the difference of weights and two directions from the focus inside the branch.
struct OneArc {
  kernel::Mesh mesh{{{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {{0, 1, 2}}}};
  kernel::Diagram diagram;
  io::PlanePoint focus[2];
  double difference;

  OneArc(io::PlanePoint f0, io::PlanePoint f1, double d, double from, double to) : focus{f0, f1}, difference(d) {
    kernel::Arc arc;
    arc.face = 0;
    arc.conic = kernel::Arc::Conic::hyperbola;
    arc.node = {0, 1};
    for (int k = 0; k < 2; ++k) arc.image[k] = {kernel::Enclosed{focus[k][0], 0, 0}, kernel::Enclosed{focus[k][1], 0, 0}};
    arc.weight[1].value = d;
    diagram.arcs = {arc};
    for (const double angle : {from, to}) {
      const auto p = at(angle);
      kernel::DiagramPoint point;
      point.face = 0;
      point.frame = {kernel::Enclosed{p[0], 0, 0}, kernel::Enclosed{p[1], 0, 0}};
      point.position = {p[0], p[1], 0};
      diagram.points.push_back(point);
    }
  }

  /// |p - f0| - |p - f1| = d > 0 in polar coordinates about f1, the angle measured from the direction towards f0:
  /// r^2 + 2 r d + d^2 = r^2 + L^2 - 2 r L cos, so r = (L^2 - d^2) / (2 (d + L cos)).
  io::PlanePoint at(double angle) const {
    const double x = focus[0][0] - focus[1][0], y = focus[0][1] - focus[1][1], length = std::hypot(x, y);
    const double r = (length * length - difference * difference) / (2 * (difference + length * std::cos(angle)));
    const double direction = std::atan2(y, x) + angle;
    return {focus[1][0] + r * std::cos(direction), focus[1][1] + r * std::sin(direction)};
  }
};

double distance_to_segment(const io::PlanePoint& p, const io::PlanePoint& a, const io::PlanePoint& b) {
  const double x = b[0] - a[0], y = b[1] - a[1], square = x * x + y * y;
  const double t = square > 0 ? std::clamp(((p[0] - a[0]) * x + (p[1] - a[1]) * y) / square, 0.0, 1.0) : 0;
  return std::hypot(p[0] - a[0] - t * x, p[1] - a[1] - t * y);
}

double distance_to_polyline(const io::PlanePoint& p, const std::vector<io::ArcSample>& line) {
  double least = 1e300;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) least = std::min(least, distance_to_segment(p, line[i].plane, line[i + 1].plane));
  return least;
}

RC_GTEST_PROP(ArcSampler, ChordsStayWithinTheStatedDeviation, ()) {
  const auto unit = [] { return *rc::gen::inRange(0, 1'000'001) / 1e6; };
  const io::PlanePoint f0 = {unit() * 10 - 5, unit() * 10 - 5}, f1 = {f0[0] + 0.5 + unit() * 4, f0[1] + unit() * 4};
  const double length = std::hypot(f1[0] - f0[0], f1[1] - f0[1]);
  const double d = length * std::pow(10, -4 * unit()) * 0.95;
  const double widest = std::acos(-d / length) * 0.97;
  const double from = (2 * unit() - 1) * widest, to = (2 * unit() - 1) * widest;
  const OneArc arc(f0, f1, d, from, to);
  const double deviation = std::pow(10, -1 - 5 * unit()), allowed = deviation * std::hypot(8, 8);
  const auto line = io::ArcSampler(arc.mesh, arc.diagram, deviation).sample(0);
  for (int i = 0; i <= 200; ++i) RC_ASSERT(distance_to_polyline(arc.at(from + (to - from) * i / 200), line) <= allowed * (1 + 1e-6) + 1e-9);
  for (const auto& sample : line) {
    const double wave = std::hypot(sample.plane[0] - f0[0], sample.plane[1] - f0[1]);
    RC_ASSERT(std::abs(wave - d - std::hypot(sample.plane[0] - f1[0], sample.plane[1] - f1[1])) <= 1e-9 * (1 + wave));
    RC_ASSERT(sample.distance == wave);
  }
}

TEST(ArcSampler, NumberOfChordsGrowsWithTheRootOfTheAccuracy) {
  const OneArc arc({0, 0}, {4, 0}, 2, -1, 1);
  const auto coarse = io::ArcSampler(arc.mesh, arc.diagram, 1e-4).sample(0).size();
  const auto fine = io::ArcSampler(arc.mesh, arc.diagram, 1e-6).sample(0).size();
  EXPECT_GT(fine, 4 * coarse);
  EXPECT_LT(fine, 25 * coarse);
}

TEST(ArcSampler, LinesRaysAndArcsAlongEdgesAreTwoPoints) {
  OneArc arc({0, 0}, {4, 0}, 2, -1, 1);
  auto& conic = arc.diagram.arcs[0].conic;
  conic = kernel::Arc::Conic::line;
  EXPECT_EQ(io::ArcSampler(arc.mesh, arc.diagram, 1e-6).sample(0).size(), 2u);
  conic = kernel::Arc::Conic::ray;
  EXPECT_EQ(io::ArcSampler(arc.mesh, arc.diagram, 1e-6).sample(0).size(), 2u);
  conic = kernel::Arc::Conic::hyperbola;
  arc.diagram.arcs[0].along_edge = true;
  EXPECT_EQ(io::ArcSampler(arc.mesh, arc.diagram, 1e-6).sample(0).size(), 2u);
}

TEST(ArcSampler, APointGivenInAnotherFaceIsFoundByItsPosition) {
  const test::SquareDiagram square;
  const io::ArcSampler sampler(square.mesh, square.diagram, 1e-5);
  for (std::uint32_t arc = 0; arc < 2; ++arc)
    for (const auto& sample : sampler.sample(arc)) EXPECT_NEAR(sample.position[0], square.bisector(sample.position[1]), 1e-12);
  EXPECT_NEAR(sampler.node_distance(1, 0), square.distance(square.diagram.points[1].position), 1e-14);
}

TEST(FacePlane, ComesBackToTheSamePoint) {
  const kernel::Mesh mesh({{{1, 2, 3}, {4, 2, 5}, {0, 7, -1}}, {{0, 1, 2}}});
  const io::FacePlane plane(mesh, 0);
  for (unsigned k = 0; k < 3; ++k) {
    const auto p = plane.to_space(plane.corner(k));
    for (unsigned c = 0; c < 3; ++c) EXPECT_NEAR(p[c], mesh.point(mesh.origin(k))[c], 1e-14);
  }
  EXPECT_EQ(plane.corner(0), (io::PlanePoint{0, 0}));
  EXPECT_EQ(plane.corner(1)[1], 0);
  EXPECT_GT(plane.corner(2)[1], 0);
  EXPECT_NEAR(plane.longest_side(), std::sqrt(16 + 25 + 36), 1e-14);
}

}  // namespace
