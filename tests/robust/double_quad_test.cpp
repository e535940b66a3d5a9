// Four at once give the numbers of one after the other.
#include "gvd/robust/ball_quad.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>

#include "robust/random_numbers.hpp"

namespace gvd::robust::test {
namespace {

using B = Ball<DoubleDouble>;

bool are_same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b); }
bool are_same(const DoubleDouble& a, const DoubleDouble& b) { return are_same(a.hi, b.hi) && are_same(a.lo, b.lo); }
bool are_same(const B& a, const B& b) { return are_same(a.mid(), b.mid()) && are_same(a.rad(), b.rad()); }

/// As the library has it compiled for processors with fused multiply-add, where this is one.
#if defined(__x86_64__) && defined(__GNUC__)
bool has_fma() { return __builtin_cpu_supports("fma") != 0; }
template <class Work>
__attribute__((target("fma"), flatten)) auto by_fma(const Work& work) {
  return work();
}
#else
bool has_fma() { return false; }
template <class Work>
auto by_fma(const Work& work) {
  return work();
}
#endif

class Quads : public testing::Test {
 protected:
  static constexpr int kRounds = 50000;
  RandomNumbers random{20261122};

  /// Alike, or each of its own: zeros, subnormals, infinities and what is not a number among them.
  std::array<B, 4> balls() {
    std::array<B, 4> list;
    for (B& ball : list) ball = random.chance(2) ? B(random.any() * 4, random.chance(50) ? INFINITY : 0) : random.ball<DoubleDouble>();
    if (random.chance(60))
      for (B& ball : list) ball = B(abs(ball.mid()), ball.rad());
    return list;
  }
  template <class Quad, class One>
  void expect_alike(const char* what, const Quad& of_quads, const One& of_one) {
    for (int round = 0; round < kRounds; ++round) {
      const auto a = balls(), b = balls();
      const auto work = [&] { return of_quads(BallQuad(a[0], a[1], a[2], a[3]), BallQuad(b[0], b[1], b[2], b[3])); };
      const auto result = has_fma() && round % 2 == 0 ? by_fma(work) : work();
      for (std::size_t k = 0; k < 4; ++k) {
        const B one = of_one(a[k], b[k]);
        ASSERT_TRUE(are_same(result.lane(k), one)) << what << ", lane " << k << " of round " << round << ": " << result.lane(k).mid().hi << " +- "
                                                   << result.lane(k).rad() << ", alone " << one.mid().hi << " +- " << one.rad();
      }
    }
  }
};

TEST_F(Quads, AreBallsInEachLane) {
  expect_alike("-a", [](const auto& a, const auto&) { return -a; }, [](const B& a, const B&) { return -a; });
  expect_alike("a + b", [](const auto& a, const auto& b) { return a + b; }, [](const B& a, const B& b) { return a + b; });
  expect_alike("a - b", [](const auto& a, const auto& b) { return a - b; }, [](const B& a, const B& b) { return a - b; });
  expect_alike("a * b", [](const auto& a, const auto& b) { return a * b; }, [](const B& a, const B& b) { return a * b; });
  expect_alike("a / b", [](const auto& a, const auto& b) { return a / b; }, [](const B& a, const B& b) { return a / b; });
  expect_alike("a^2", [](const auto& a, const auto&) { return square(a); }, [](const B& a, const B&) { return square(a); });
  expect_alike("sqrt a", [](const auto& a, const auto&) { return sqrt(a); }, [](const B& a, const B&) { return sqrt(a); });
  expect_alike("sqrt a^2", [](const auto& a, const auto&) { return sqrt(square(a)); }, [](const B& a, const B&) { return sqrt(square(a)); });
}

TEST_F(Quads, RootsOfDoubleDoublesAreThoseOfEach) {
  for (int round = 0; round < kRounds; ++round) {
    std::array<DoubleDouble, 4> x;
    for (DoubleDouble& one : x) one = abs(random.chance(10) ? DoubleDouble(random.any()) : random.double_double());
    const DoubleDoubleQuad root = sqrt(quad(x[0], x[1], x[2], x[3]));
    for (std::size_t k = 0; k < 4; ++k) ASSERT_TRUE(are_same(root.lane(k), sqrt(x[k]))) << x[k].hi;
  }
}

TEST_F(Quads, LanesAreWhereTheyAreAskedFor) {
  const auto b = balls();
  const BallQuad quad(b[0], b[1], b[2], b[3]), turned = quad.lanes<3, 0, 0, 2>(), same(b[1]);
  const std::size_t from[] = {3, 0, 0, 2};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_TRUE(are_same(quad.lane(k), b[k]));
    EXPECT_TRUE(are_same(turned.lane(k), b[from[k]]));
    EXPECT_TRUE(are_same(same.lane(k), b[1]));
  }
}

}  // namespace
}  // namespace gvd::robust::test
