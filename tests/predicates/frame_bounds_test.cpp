#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gvd/kernel/frames.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "gvd/kernel/unfolding.hpp"
#include "gvd/predicates/enclosed_frame.hpp"
#include "gvd/predicates/filter_error.hpp"
#include "gvd/predicates/landing.hpp"
#include "gvd/predicates/longer.hpp"
#include "gvd/predicates/strip.hpp"
#include "gvd/robust/gmp.hpp"
#include "gvd/robust/rational.hpp"
#include "support/meshes.hpp"

namespace gvd::test {
namespace {

using kernel::Frames;
using kernel::HalfedgeId;
using kernel::Mesh;
using predicates::Complex;
using predicates::Disc;
using predicates::EdgeFrame;
using predicates::Strip;
using robust::DoubleDouble;
using robust::Mpfr;

constexpr int kTruthBits = 512;
constexpr double kU = predicates::kUnit;

Mpfr wide(double x) { return Mpfr(x, kTruthBits); }
Mpfr wide(const DoubleDouble& x) { return Mpfr(x.hi, kTruthBits) + Mpfr(x.lo, kTruthBits); }
double hypot(const Mpfr& x, const Mpfr& y) { return sqrt(x * x + y * y).to_double(); }

/// Relative errors of single operations, in some unit.
struct Operations {
  double side, add, product, quotient, root;
};
/// First-order bounds of what is made of them, in the same unit (docs/error-bounds.md#frames).
struct Derived {
  double apex, length, turn;
};
Derived derive(const Operations& o) {
  const double dot = 2 * o.side + o.product + 2 * o.add;
  const double area = 2 * o.side + std::sqrt(2) * (o.product + o.add) + (o.product + 2 * o.add) / 2 + o.root;
  return {std::hypot(dot, area) + dot + o.quotient, dot / 2 + o.root, std::sqrt(2) * (o.product + o.add)};
}
constexpr double kHigherOrders = 1 + 0x1p-40;

// The derivations of docs/error-bounds.md, against the literals.
TEST(FrameBounds, LiteralsFollowFromTheirDerivations) {
  const Derived d = derive({1 + 0x1p-12, 1, 1, 1, 1});  // sides at inserted vertices
  EXPECT_LE(d.apex * kHigherOrders * kU, predicates::kFrameError);
  const double left = d.apex + d.turn, right = d.apex + d.turn + 2;  // two subtractions from 1
  EXPECT_LE(std::max(left, right) * kHigherOrders * kU, predicates::kStepError);
  // What a step has to spare covers the error of an apex; so does the first one.
  EXPECT_LE(d.apex * kHigherOrders * kU, predicates::kStepError - kU);
  // Twice the constant is added a crossing: it covers the crossing, and the error of an apex is left over.
  EXPECT_LE((d.apex + std::max(left, right)) * kHigherOrders * 1.01 * kU, 2 * predicates::kStepError);
  const double distance = 3 + d.length + 1 + 1;
  EXPECT_LE((distance + d.apex + 6) * kHigherOrders * kU, predicates::kDistanceError);
  EXPECT_LE((4 + 1) * kHigherOrders * kU, predicates::kOrientationError);
  EXPECT_LE((d.apex + d.turn + 1) * kHigherOrders * kU, predicates::kTurnError);
}

TEST(FrameBounds, OneConstantServesAllNumberTypes) {
  const auto needed_with = [](const Operations& o, double turn) {
    const Derived d = derive(o);
    return std::max(d.apex + turn, d.length) * kHigherOrders;
  };
  const auto needed = [&](const Operations& o) { return needed_with(o, derive(o).turn + 2 * o.add); };
  EXPECT_EQ(predicates::unit<double>(0), kU);
  EXPECT_LE(needed({1 + 0x1p-12, 1, 1, 1, 1}), predicates::kUnfoldingStep);
  const double unit = predicates::unit<DoubleDouble>(0);
  EXPECT_LE(needed_with({kU * kU / unit, robust::kDoubleDoubleAddError / unit, robust::kDoubleDoubleProductError / unit,
                         robust::kDoubleDoubleQuotientError / unit, robust::kDoubleDoubleRootError / unit},
                        predicates::kDoubleDoubleTurnError / unit),
            predicates::kUnfoldingStep);
  EXPECT_LE(needed({0x1p-8, 0x1p-8, 0x1p-8, 0x1p-8, 0x1p-8}), predicates::kUnfoldingStep);  // eight bits more than named
}

// The table of docs/error-bounds.md#turns-in-double-double with exact numbers: P = 1, and what is relative to |x'| apart.
TEST(UnfoldingBounds, TurnsInDoubleDoubleFollowFromTheirDerivation) {
  const mpq_class u = kU, grow = 1 + u;
  const mpq_class high = grow * grow, low_argument = u * high + u * grow;  // of x over w, base and z.x.hi being below w (1 + u)
  const mpq_class low_error = u * low_argument, low = low_argument * grow;
  const mpq_class factor = grow;  // the high part of along or across
  const mpq_class product = high * factor, product_low = u * product * grow, left_out = low * u * factor;
  const mpq_class inner = product_low + high * u * factor, inner_error = u * inner;
  const mpq_class outer = inner * grow + low * factor, outer_error = u * outer;
  const mpq_class both = outer * grow, both_error = u * both;
  const mpq_class sum_low = u * product * grow * grow, all = sum_low + both * grow, all_error = u * all;
  const mpq_class sum_error = low_error + left_out + inner_error + outer_error + both_error + all_error;
  const mpq_class to_x = all * grow, beside_x = to_x + sum_error;  // base and the high part are x' but for this
  const mpq_class last = u * beside_x * grow + to_x, error = sum_error + u * last;
  EXPECT_LE(error, mpq_class(predicates::kDoubleDoubleTurnError));
  EXPECT_GT(2 * error, mpq_class(predicates::kDoubleDoubleTurnError)) << "far too wide";
  EXPECT_LE(u * u * grow, mpq_class(predicates::kDoubleDoubleTurnError));  // relative to |x'|
}

/// A double-double of some size with a low part as large as can be, small, or none.
DoubleDouble random_double_double(Random& random) {
  const double hi = random.uniform(-1, 1) * std::ldexp(1.0, -static_cast<int>(random.below(30)));
  const double half_ulp = std::ldexp(1.0, std::ilogb(hi) - 53);
  const double share[] = {0, 1, -1, random.uniform(-1, 1), random.uniform(-1, 1) * 0x1p-30};
  return robust::two_sum(hi, half_ulp * share[random.below(5)]);
}

mpq_class rational(const DoubleDouble& x) { return mpq_class(x.hi) + mpq_class(x.lo); }

// Against exact numbers, where everything cancels too; and the processor's own fused multiply-add gives the same bits.
TEST(UnfoldingBounds, TurnsInDoubleDoubleKeepTheirBound) {
  Random random(12);
  double widest = 0;
  for (int i = 0; i < 40000; ++i) {
    Complex<DoubleDouble> z{random_double_double(random), random_double_double(random)};
    EdgeFrame<DoubleDouble> side{random_double_double(random), random_double_double(random), random_double_double(random), {}};
    if (random.below(3) == 0) z.y = z.x, side.v = -side.y;  // cancels
    if (random.below(3) == 0) z.x = robust::two_sum(1, random.uniform(-1, 1) * 0x1p-53), side.u = side.y;
    const bool left = random.below(2) == 0;
    const DoubleDouble along = left ? side.v : side.u;
    const auto computed = predicates::turned(z, along, side.y, left ? 0 : 1);
    ASSERT_EQ(computed.x.hi, computed.x.hi + computed.x.lo);
    ASSERT_EQ(computed.y.hi, computed.y.hi + computed.y.lo);
    const Complex<mpq_class> exact{rational(z.x), rational(z.y)};
    const EdgeFrame<mpq_class> exact_side{rational(side.u), rational(side.v), rational(side.y), 0};
    const auto truth = left ? predicates::cross_left(exact, exact_side) : predicates::cross_right(exact, exact_side);
    const double off = std::hypot(mpq_class(rational(computed.x) - truth.x).get_d(), mpq_class(rational(computed.y) - truth.y).get_d());
    const double size = (std::fabs(z.x.hi) + std::fabs(z.y.hi) + 1) * std::hypot(along.hi, side.y.hi) + std::hypot(computed.x.hi, computed.y.hi);
    ASSERT_LE(off, predicates::kDoubleDoubleTurnError * size) << i;
    widest = std::max(widest, off / size);
    const auto crossed = predicates::cross(Disc<DoubleDouble>{z, 0}, side, left, predicates::unit<DoubleDouble>(0));
    ASSERT_TRUE(crossed.mid.x == computed.x && crossed.mid.y == computed.y) << i;
  }
  EXPECT_GT(widest, predicates::kDoubleDoubleTurnError / 64);  // the cases are hard enough to mean something
}

TEST(FrameBounds, FloatsAreRoundedUpWithRoomToSpare) {
  Random random(1);
  for (int i = 0; i < 100000; ++i) {
    const double x = std::ldexp(random.uniform(), -static_cast<int>(random.below(400)));
    ASSERT_GE(static_cast<double>(predicates::rounded_up(x)) * (1 - 0x1p-21), x);
  }
  EXPECT_GE(predicates::rounded_up(0), 0);
}

/// A point near p: the same, one ulp off, or a little more.
Point jitter(Point p, Random& random) {
  for (double& x : p) {
    const auto kind = random.below(3);
    if (kind == 1) x = std::nextafter(x, random.below(2) == 0 ? -1e300 : 1e300);
    if (kind == 2) x += std::ldexp(random.uniform(-1, 1), -static_cast<int>(random.below(60)));
  }
  return p;
}

/// Triangles of every shape: round, slivers, needles, near-collinear, far from the origin, one tiny side.
Mesh triangle(Random& random) {
  for (;;) {
    const auto point = [&] { return Point{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
    const double offset = random.below(3) == 0 ? std::ldexp(random.uniform(), static_cast<int>(random.below(30))) : 0;
    Point a = point(), b = point(), c = point();
    const double t = random.uniform(-1, 2);
    switch (random.below(5)) {
      case 0: break;
      case 1:  // nearly collinear
        for (std::size_t k = 0; k < 3; ++k) c[k] = a[k] + t * (b[k] - a[k]);
        c = jitter(c, random);
        break;
      case 2: c = jitter(a, random); break;
      case 3: {  // one side as small as the bounds allow
        const double size = std::ldexp(1.0, -static_cast<int>(random.below(198)));
        a = {0, 0, 0};
        for (double& x : c) x *= size;
        break;
      }
      default:
        for (Point* p : {&a, &b, &c}) (*p)[2] *= 1e-9, (*p)[1] *= 1e-9;
    }
    for (Point* p : {&a, &b, &c})
      for (double& x : *p) x += offset;
    try {
      return Mesh({{a, b, c}, {{0, 1, 2}}});
    } catch (const std::exception&) {  // of zero area
    }
  }
}

template <class T>
void expect_frame_within(const EdgeFrame<T>& computed, const EdgeFrame<Mpfr>& truth, double apex, double length) {
  const Mpfr y = wide(computed.y) - truth.y;
  ASSERT_LE(hypot(wide(computed.u) - truth.u, y), apex * hypot(truth.u, truth.y));
  ASSERT_LE(hypot(wide(computed.v) - truth.v, y), apex * hypot(truth.v, truth.y));
  ASSERT_LE(abs(wide(computed.length) - truth.length).to_double(), length * truth.length.to_double());
}

TEST(FrameBounds, FramesOfAllShapesKeepTheirBounds) {
  Random random(2);
  int with_tiny_side = 0;
  for (int i = 0; i < 6000; ++i) {
    const Mesh mesh = triangle(random);
    const Frames frames(mesh);
    if (frames.has_underflow()) continue;
    const auto truth = frames.in_mpfr(0, kTruthBits);
    for (HalfedgeId h = 0; h < 3; ++h) {
      with_tiny_side += truth[h].length.to_double() < 0x1p-100;
      expect_frame_within(frames(h), truth[h], predicates::kFrameError, 4 * kU);
      const double unit = predicates::unit<DoubleDouble>(0);
      expect_frame_within(frames.in_double_double(h), truth[h], 4 * unit, unit);
      if (HasFatalFailure()) FAIL() << "triangle " << i << " half-edge " << h;
    }
  }
  EXPECT_GT(with_tiny_side, 30);
}

// A needle whose height is lost to cancellation is within the bounds; a side that is too short is not.
// Far from the origin, in the middle of the face and ever closer to a vertex of it, where rounded positions say little.
TEST(FrameBounds, FramesAtInsertedVerticesKeepTheirBounds) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Mesh input = triangle(random);
    mpq_class a(random.uniform()), b(random.uniform());
    a *= robust::power_of_two(-static_cast<int>(random.below(70)));
    b *= (1 - a) * robust::power_of_two(-static_cast<int>(random.below(70)));
    if (a == 0 || b == 0) continue;
    kernel::RefinedSources where;
    const Mesh mesh = kernel::refine(input, {{kernel::point_in_face(input, 0, {1 - a - b, a, b}), 0}}, where);
    const Frames frames(mesh);
    if (frames.has_underflow()) continue;
    for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
      const auto truth = frames.in_mpfr(Mesh::face(h), kTruthBits)[h % 3];
      const double unit = predicates::unit<DoubleDouble>(0);
      expect_frame_within(frames(h), truth, predicates::kFrameError, 4 * kU);
      expect_frame_within(frames.in_double_double(h), truth, 4 * unit, unit);
      if (HasFatalFailure()) FAIL() << "triangle " << i << " half-edge " << h;
    }
  }
}

TEST(FrameBounds, OnlySidesTooShortCountAsUnderflow) {
  const auto has_underflow = [](const Point& b, const Point& c) { return Frames(Mesh({{{0, 0, 0}, b, c}, {{0, 1, 2}}})).has_underflow(); };
  EXPECT_FALSE(has_underflow({1, 0.3, 0.7}, {0.5, 0.15, std::nextafter(0.35, 1)}));
  EXPECT_FALSE(has_underflow({1, 0, 0}, {0.5, 0x1p-400, 0}));
  EXPECT_FALSE(has_underflow({1, 0, 0}, {0, 0x1p-199, 0}));
  EXPECT_TRUE(has_underflow({1, 0, 0}, {0, 0x1p-201, 0}));
}

/// A strip that wanders over the mesh; its cone is reset at random.
Strip random_strip(const Mesh& mesh, std::size_t length, Random& random) {
  Strip strip;
  HalfedgeId at;
  do {
    strip.opposite = random.below(mesh.halfedge_count());
    at = mesh.twin(strip.opposite);
  } while (at == kernel::kNone);
  while (strip.steps.size() < length) {
    const bool left = random.below(2) == 0;
    const HalfedgeId side = left ? Mesh::prev(at) : Mesh::next(at);
    if (mesh.twin(side) == kernel::kNone) break;
    strip.steps.push_back({side, left, random.below(8) == 0});
    at = mesh.twin(side);
  }
  return strip;
}

template <class T>
void expect_inside(const Disc<T>& disc, const Disc<Mpfr>& truth) {
  const double off = hypot(wide(disc.mid.x) - truth.mid.x, wide(disc.mid.y) - truth.mid.y);
  ASSERT_LE(off, disc.radius + truth.radius);
}

void expect_strips_inside(const MeshArrays& arrays, std::uint64_t seed) {
  const Mesh mesh(arrays);
  const Frames frames(mesh);
  Random random(seed);
  for (int i = 0; i < 60; ++i) {
    const Strip strip = random_strip(mesh, 1 + random.below(100), random);
    const auto truth = kernel::unfold_mpfr(frames, strip, 2048);  // wandering strips amplify: the truth needs its bits
    const auto in_double = kernel::unfold_double(frames, strip);
    const auto in_double_double = kernel::unfold_double_double(frames, strip);
    for (const auto point : {0, 1, 2}) {
      const auto pick = [&](const auto& at) { return point == 0 ? at.image : point == 1 ? at.cone0 : at.cone1; };
      expect_inside(pick(in_double), pick(truth));
      expect_inside(pick(in_double_double), pick(truth));
      if (::testing::Test::HasFatalFailure()) FAIL() << "strip " << i << " of " << strip.steps.size() << " faces, point " << point;
    }
  }
}

MeshArrays changed(MeshArrays mesh, const std::function<void(Point&)>& change) {
  for (Point& p : mesh.points) change(p);
  return mesh;
}

TEST(UnfoldingBounds, DiscsContainTheTruth) {
  const MeshArrays terrain = fractal_terrain(4, 3, 0.6, 5);
  Random ulp(6);
  expect_strips_inside(terrain, 1);
  expect_strips_inside(changed(terrain, [](Point& p) { p[1] *= 1e-9, p[2] *= 1e-9; }), 2);                    // slivers
  expect_strips_inside(changed(terrain, [](Point& p) { p[0] += 1e7, p[1] += 1e7; }), 3);                      // far away
  expect_strips_inside(changed(flat_grid(12, 12), [&](Point& p) { p[2] = ulp.uniform(-1, 1) * 0x1p-52; }), 4);  // almost flat
  expect_strips_inside(changed(terrain, [](Point& p) { p[0] = std::exp2(p[0] * 4); }), 5);                     // all sizes
}

mpq_class exact_landing(const mpq_class& ix, const mpq_class& iy, const mpq_class& px, const mpq_class& py) {
  return ix - (px - ix) * iy / (py - iy);
}

// Both points pushed to the rims of their discs, in rational directions on the unit circle.
TEST(UnfoldingBounds, DiscsSeenFromTheFirstSideContainTheTruth) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 20000; ++round) {
    const auto number = [&] { return std::ldexp(unit(random), static_cast<int>(random() % 24) - 12); };
    const auto error = [&] { return round % 2 == 0 ? 0.0 : std::ldexp(std::fabs(unit(random)), -static_cast<int>(random() % 40) - 10); };
    const Disc<double> z{{number(), number()}, error()};
    const double of_apex = error();
    const predicates::PlanePoint<robust::Ball<double>> w{{number(), of_apex}, {number(), of_apex}};
    const double turn = 3.2 * unit(random), x = std::cos(turn), y = std::sin(turn);  // a point near the rim of either
    const Mpfr zx = wide(z.mid.x) + wide(0.999 * z.radius * x), zy = wide(z.mid.y) + wide(0.999 * z.radius * y);
    const Mpfr wx = wide(w.x.mid()) + wide(0.999 * of_apex * y), wy = wide(w.y.mid()) - wide(0.999 * of_apex * x), one = wide(1.0);
    for (const unsigned k : {0u, 1u, 2u}) {
      const auto at = predicates::at_first_side(z, k, w);
      const Mpfr true_x = k == 0 ? zx : k == 1 ? one + zx * (wx - one) - zy * wy : (one - zx) * wx + zy * wy;
      const Mpfr true_y = k == 0 ? zy : k == 1 ? zx * wy + zy * (wx - one) : (one - zx) * wy - zy * wx;
      ASSERT_LE(hypot(true_x - wide(at.x.mid()), true_y - wide(at.y.mid())), at.x.rad()) << "round " << round << ", side " << k;
    }
  }
}

TEST(LandingBounds, MarginCoversEveryPairOfPoints) {
  Random random(7);
  double tightest = 1e300;
  for (int i = 0; i < 20000; ++i) {
    const double y = -std::ldexp(random.uniform(0.5, 1), static_cast<int>(random.below(30)) - 20);
    const Complex<double> image{random.uniform(-2, 2) * (random.below(2) == 0 ? 1 : 1000), y};
    const double fraction = std::ldexp(random.uniform(), -static_cast<int>(random.below(40)));  // of the way to the side
    const double at = random.uniform();
    const Complex<double> p{random.below(4) == 0 ? image.x : image.x + fraction * (at - image.x), y * (1 - fraction)};
    const double disc = (1 + std::fabs(image.x) + std::fabs(image.y)) * std::ldexp(16 * kU, static_cast<int>(random.below(25)));
    const auto landing = predicates::land(image, p, disc);
    if (landing.margin == predicates::kNoLanding.margin) continue;
    for (int k = 0; k < 4; ++k) {
      const auto rim = [&](int quarter) {
        const mpq_class t = random.uniform(-1, 1), square = 1 + t * t;
        const mpq_class c = (1 - t * t) / square * disc, s = 2 * t / square * disc;
        return std::pair(quarter == 0 ? c : mpq_class(-c), quarter == 0 ? s : mpq_class(-s));
      };
      const auto [dx, dy] = rim(k % 2);
      const auto [ex, ey] = rim(k / 2);
      const mpq_class off = abs(exact_landing(image.x + dx, image.y + dy, p.x + ex, p.y + ey) - landing.at);
      ASSERT_LE(off, mpq_class(landing.margin)) << i;
      if (off > 0) tightest = std::min(tightest, mpq_class(landing.margin / off).get_d());
    }
  }
  EXPECT_LT(tightest, 3);  // the margin is not far from what is needed
}

// Rays through points beside p, both points anywhere in their discs.
TEST(LandingBounds, ReachCoversThePointsBesideIt) {
  Random random(8);
  int known = 0;
  for (int i = 0; i < 20000; ++i) {
    const double y = -std::ldexp(random.uniform(0.5, 1), static_cast<int>(random.below(20)) - 10);
    const Complex<double> image{random.uniform(-2, 2) * (random.below(2) == 0 ? 1 : 100), y};
    const double fraction = std::ldexp(random.uniform(), -static_cast<int>(random.below(30)));
    const Complex<double> p{image.x + fraction * (random.uniform() - image.x), y * (1 - fraction)};
    const double disc = (1 + std::fabs(image.x) + std::fabs(image.y)) * std::ldexp(16 * kU, static_cast<int>(random.below(20)));
    const Complex<double> along{random.uniform(-2, 2), random.uniform(-2, 2)};
    const double slack = std::ldexp(random.uniform(), -static_cast<int>(random.below(40)));
    const auto landing = predicates::land(image, p, disc, slack, along, std::hypot(along.x, along.y));
    if (!landing.known) continue;
    ++known;
    for (const double t : {slack, -slack, random.uniform(-slack, slack)}) {
      const mpq_class a = disc * random.uniform(-0.7, 0.7), b = disc * random.uniform(-0.7, 0.7), c = disc * random.uniform(-0.7, 0.7);
      const mpq_class x = p.x + mpq_class(t) * along.x + b, z = p.y + mpq_class(t) * along.y + c;
      ASSERT_LE(abs(exact_landing(image.x + a, image.y + b, x, z) - landing.at), mpq_class(landing.reach)) << i;
    }
  }
  EXPECT_GT(known, 5000);
}

// Both lanes of a pair are what a double gives.
TEST(LandingBounds, PairsAreTwoDoubles) {
  Random random(10);
  for (int i = 0; i < 5000; ++i) {
    const Complex<double> image{random.uniform(-2, 2), -random.uniform()}, along{random.uniform(-2, 2), random.uniform(-2, 2)};
    const double size = std::hypot(along.x, along.y), disc = std::ldexp(16 * kU, static_cast<int>(random.below(45)));
    std::array<Complex<double>, 2> p;
    for (auto& point : p) point = {random.uniform(-1, 1), -random.uniform() * (random.below(2) == 0 ? 1 : 0x1p-20)};
    const std::array<double, 2> slack{random.uniform() * 0x1p-20, 0};
    const auto both = predicates::land(image, Complex<robust::DoublePair>{{p[0].x, p[1].x}, {p[0].y, p[1].y}}, disc,
                                       robust::DoublePair{slack[0], slack[1]}, along, size);
    for (int k = 0; k < 2; ++k) {
      const auto one = predicates::land(image, p[static_cast<std::size_t>(k)], disc, slack[static_cast<std::size_t>(k)], along, size);
      ASSERT_EQ(both.known[k] != 0, one.known);
      ASSERT_EQ(both.at[k], one.at);
      ASSERT_EQ(both.margin[k], one.margin);
      ASSERT_EQ(both.reach[k], one.reach);
    }
  }
}

TEST(DistanceBounds, WhatIsLongerByItsSquareIsLonger) {
  Random random(9);
  int longer = 0, shorter = 0;
  for (int i = 0; i < 20000; ++i) {
    const double weight = random.below(3) == 0 ? 0 : std::ldexp(random.uniform(), -static_cast<int>(random.below(30)));
    const double length = std::ldexp(random.uniform(0.5, 1), -static_cast<int>(random.below(30)));
    const double dx = random.uniform(-100, 100), y = random.uniform(-100, 0);
    const double error = std::ldexp(random.uniform(), -40 - static_cast<int>(random.below(10)));
    // upper + length * share, as of a path from a vertex along a side
    const double target = (weight + length * std::sqrt(dx * dx + y * y)) * (1 + random.uniform(-400, 200) * kU) - error;
    const double share = random.uniform(), along = std::ldexp(random.uniform(0.5, 1), -static_cast<int>(random.below(30)));
    const double upper = target - along * share;
    if (upper < 0) continue;
    const double path = predicates::enlarged(upper) + predicates::enlarged(along) * share;
    const double squared_length = predicates::diminished(length * length), rest_error = predicates::enlarged(error) - weight;
    const bool is_longer = predicates::is_certainly_longer(dx * dx + y * y, squared_length, path, rest_error);
    const auto both = predicates::is_certainly_longer(robust::DoublePair{dx * dx + y * y, 0}, squared_length, robust::DoublePair{path, 1e9}, rest_error);
    ASSERT_EQ(both[0] != 0, is_longer);
    ASSERT_EQ(both[1], 0);
    if (!is_longer) {
      ++shorter;
      continue;
    }
    ++longer;
    // weight + length |(dx, y)| exceeds path + error by 32u of itself
    const mpq_class exact_path = mpq_class(upper) + mpq_class(along) * share;
    const mpq_class rest = (exact_path + error) * (1 + mpq_class(predicates::kDistanceError)) - weight;
    const mpq_class squared = mpq_class(length) * length * (mpq_class(dx) * dx + mpq_class(y) * y);
    ASSERT_TRUE(rest < 0 || squared > rest * rest) << i;
  }
  EXPECT_GT(longer, 5000);
  EXPECT_GT(shorter, 5000);
}

}  // namespace
}  // namespace gvd::test
