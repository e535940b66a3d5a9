#include "gvd/robust/exact.hpp"

#include <CGAL/CORE_Expr.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <thread>
#include <vector>

#include "gvd/robust/rational.hpp"
#include "gvd/robust/root_sum.hpp"
#include "gvd/robust/rounding.hpp"
#include "robust/random_numbers.hpp"

namespace gvd::robust::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Exact root(double x) { return sqrt(Exact(x)); }

TEST(Exact, KnownZeros) {
  EXPECT_EQ(maybe_sign(Exact()), Sign::zero);
  EXPECT_EQ(maybe_sign(root(8) - 2 * root(2)), Sign::zero);
  EXPECT_EQ(maybe_sign(root(2) + root(8) - root(18)), Sign::zero);
  EXPECT_EQ(maybe_sign(root(2) * root(3) - root(6)), Sign::zero);
  EXPECT_EQ(maybe_sign(root(2) + root(3) - sqrt(5 + 2 * root(6))), Sign::zero);
  EXPECT_EQ(maybe_sign(1 / (root(2) - 1) - (root(2) + 1)), Sign::zero);
  EXPECT_EQ(maybe_sign(1 / (root(2) + root(3)) - (root(3) - root(2))), Sign::zero);
  EXPECT_EQ(maybe_sign(sqrt(3 + 2 * root(2)) - 1 - root(2)), Sign::zero) << "denests";
  EXPECT_EQ(maybe_sign(sqrt(2 + root(3)) - (root(6) + root(2)) / 2), Sign::zero) << "denests outside the field";
  EXPECT_EQ(maybe_sign(sqrt(sqrt(Exact(16.0) * root(4)) * root(2)) - 2 * sqrt(root(2) * root(2) / 2) * sqrt(sqrt(Exact(4.0)))),
            Sign::zero);
  const Exact phi = (1 + root(5)) / 2;
  EXPECT_EQ(maybe_sign(square(phi) - phi - 1), Sign::zero);
  EXPECT_EQ(maybe_sign(abs(-phi) - phi), Sign::zero);
}

/// Expressions that are zero by an identity, over several square classes, and their neighbours 2^-600 away.
TEST(Exact, ZerosByConstructionAndTheirNeighbours) {
  RandomNumbers random(53);
  const Exact speck(power_of_two(-600));
  const auto some = [&] {  // c_0 + c_1 sqrt r_1 + c_2 sqrt r_2 > 0
    Exact x(static_cast<double>(1 + random.below(9)));
    for (int i = 0; i < 2; ++i) x += static_cast<double>(random.below(4)) * root(static_cast<double>(1 + random.below(12)));
    return x;
  };
  for (int i = 0; i < 2000; ++i) {
    const Exact a = some(), b = some(), c = some();
    std::vector<Exact> zeros = {sqrt(a) * sqrt(b) - sqrt(a * b), square(sqrt(a) + sqrt(b)) - (a + b + 2 * sqrt(a * b)),
                                sqrt(a * a * b) - a * sqrt(b), sqrt(a + b + 2 * sqrt(a * b)) - sqrt(a) - sqrt(b),
                                (sqrt(a) + sqrt(c)) / (sqrt(b) + sqrt(c)) * (b - c) - (sqrt(a) + sqrt(c)) * (sqrt(b) - sqrt(c))};
    const std::size_t k = random.below(zeros.size());
    ASSERT_EQ(maybe_sign(zeros[k]), Sign::zero) << i << ", identity " << k;
    ASSERT_EQ(maybe_sign(zeros[k] + speck), Sign::positive) << i << ", identity " << k;
    ASSERT_EQ(maybe_sign(zeros[k] - speck), Sign::negative) << i << ", identity " << k;
  }
}

TEST(Exact, NearZerosAreNotZeros) {
  const Exact speck = Exact(power_of_two(-700));
  EXPECT_EQ(maybe_sign(root(2) + root(3) - sqrt(5 + 2 * root(6) + speck)), Sign::negative);
  EXPECT_EQ(maybe_sign(root(2) + root(3) - sqrt(5 + 2 * root(6) - speck)), Sign::positive);
  EXPECT_EQ(maybe_sign(sqrt(sqrt(2 + speck)) - sqrt(root(2))), Sign::positive);
  EXPECT_EQ(maybe_sign(root(2) - Exact(mpq_class(mpz_class("6369051672525773"), mpz_class("4503599627370496")))), Sign::negative);
}

TEST(Exact, UndefinedStaysUndefined) {
  const Exact zero = root(8) - 2 * root(2), hidden_zero = root(2) + root(3) - sqrt(5 + 2 * root(6));
  for (const Exact& x : {1 / zero, 1 / hidden_zero, zero / zero, sqrt(Exact(-1.0)), sqrt(root(2) - root(3)), Exact(kInfinity),
                         Exact(std::numeric_limits<double>::quiet_NaN())}) {
    for (const Exact& y : {x, -x, x + 1, 1 - x, x * 0.0, 0.0 * x, 1 / x, x / 2, sqrt(x), abs(x), square(x), x - x, 1 + x, root(2) - x, x.scaled(3)}) {
      EXPECT_FALSE(y.is_defined());
      EXPECT_FALSE(maybe_sign(y));
      EXPECT_FALSE(rounded(y));
      EXPECT_FALSE(y.bounds(64));
      EXPECT_FALSE(maybe_sign(y.enclosure(64)));
    }
  }
  EXPECT_EQ(maybe_sign(sqrt(hidden_zero)), Sign::zero);
  EXPECT_EQ(maybe_sign(hidden_zero / root(2)), Sign::zero);
}

/// The same random expression in two number types. Small integers, so that zeros and squares are common.
template <class NT>
std::vector<NT> random_expressions(std::uint64_t seed, int count, const std::function<int(const NT&)>& sign_of) {
  RandomNumbers random(seed);
  std::vector<NT> pool;
  for (int i = 1; i <= 6; ++i) pool.push_back(NT(static_cast<double>(i)));
  for (int i = 0; i < count; ++i) {
    const NT a = pool[random.below(pool.size())], b = pool[random.below(pool.size())];
    const std::uint64_t kind = random.below(6);
    if (kind == 0)
      pool.push_back(a + b);
    else if (kind == 1)
      pool.push_back(a - b);
    else if (kind == 2)
      pool.push_back(a * b);
    else if (kind == 3 && sign_of(b) != 0)
      pool.push_back(a / b);
    else if (sign_of(a) >= 0)
      pool.push_back(sqrt(a));
    else
      pool.push_back(-a);
  }
  return pool;
}

TEST(Exact, SignsAgreeWithCore) {
  int zeros = 0, irrational = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto ours = random_expressions<Exact>(seed, 8, [](const Exact& x) { return static_cast<int>(*maybe_sign(x)); });
    const auto theirs = random_expressions<CORE::Expr>(seed, 8, [](const CORE::Expr& x) { return static_cast<int>(x.sign()); });
    ASSERT_EQ(ours.size(), theirs.size());
    for (std::size_t i = 0; i < ours.size(); ++i) {
      ASSERT_EQ(static_cast<int>(*maybe_sign(ours[i])), static_cast<int>(theirs[i].sign())) << seed << ", " << i;
      for (std::size_t j = 6; j < i; ++j) {
        const int sign = static_cast<int>(*maybe_sign(ours[i] - ours[j]));
        ASSERT_EQ(sign, static_cast<int>((theirs[i] - theirs[j]).sign())) << seed << ", " << i << ", " << j;
        zeros += sign == 0;
      }
      irrational += !ours[i].rational();
    }
  }
  EXPECT_GT(zeros, 100);
  EXPECT_GT(irrational, 500);
}

TEST(Exact, AgreesWithRootSums) {
  RandomNumbers random(51);
  for (int i = 0; i < 100; ++i) {
    RootSum sum;
    Exact exact;
    for (int t = 0; t < 3; ++t) {
      const double c = random.between(-20, 20), r = std::fabs(random.between(-20, 20));
      sum.add(mpq_class(c), mpq_class(r));
      exact += c * root(r);
    }
    ASSERT_EQ(maybe_sign(exact), sum.sign()) << i;
    ASSERT_EQ(rounded(exact), sum.rounded()) << i;
    const auto [low, high] = *exact.bounds(100);
    ASSERT_TRUE(compare(RootSum(low), sum) != Sign::positive && compare(sum, RootSum(high)) != Sign::positive);
    ASSERT_LE(high - low, abs(high) * power_of_two(-99));
    const Ball<Mpfr> ball = exact.enclosure(100);
    ASSERT_TRUE(contains(ball, low) || contains(ball, high));
  }
}

TEST(Exact, RationalsInDisguiseAreExact) {
  EXPECT_EQ((root(2) * root(8)).rational(), mpq_class(4));
  EXPECT_EQ(((1 + root(2)) * (1 - root(2))).rational(), mpq_class(-1));
  EXPECT_EQ(sqrt(Exact(mpq_class(9, 4))).rational(), mpq_class(3, 2));
  EXPECT_FALSE(root(2).rational());
  const auto [low, high] = *(root(2) * root(8)).bounds(64);
  EXPECT_EQ(low, 4);
  EXPECT_EQ(high, 4);
  EXPECT_FALSE((Exact(1.0) / sqrt(1 + root(2))).rational());
  EXPECT_EQ(maybe_sign(Exact(1.0) / sqrt(1 + root(2)) - sqrt(root(2) - 1)), Sign::zero) << "a sum divided by another number";
}

TEST(Exact, RoundsMidpointsToEven) {
  const Exact half_ulp = Exact(power_of_two(-53)), hidden_zero = root(2) + root(3) - sqrt(5 + 2 * root(6));
  EXPECT_EQ(rounded(1 + half_ulp), 1.0);
  EXPECT_EQ(rounded(1 + half_ulp + hidden_zero), 1.0);
  EXPECT_EQ(rounded(1 + 3 * half_ulp + hidden_zero), 1 + 0x1p-51);
  EXPECT_EQ(rounded(1 + half_ulp + root(2).scaled(-800)), 1 + 0x1p-52);
  EXPECT_EQ(rounded(hidden_zero), 0.0);
  EXPECT_EQ(rounded(Exact(power_of_two(1024))), kInfinity);
  EXPECT_EQ(rounded(root(2)), std::sqrt(2.0));
}

TEST(Exact, OneTemplateServesAllNumberTypes) {
  const auto formula = [](auto three) {
    using NT = decltype(three);
    const NT third = from<NT>(mpq_class(1, 3), 200);
    return sqrt(square(three) + 2 * third - 1.0) / abs(-three) - third * three + from_double<NT>(0.5, 200);
  };
  const Exact truth = formula(Exact(3.0));
  const double value = *rounded(truth);
  EXPECT_EQ(rounded(formula(from_double<Ball<Mpfr>>(3.0, 200))), value);
  EXPECT_EQ(rounded(formula(Ball<DoubleDouble>(3.0))), value);
  const Ball<double> plain = formula(Ball<double>(3.0));
  EXPECT_LE(plain.lower(), value);
  EXPECT_GE(plain.upper(), value);
  EXPECT_EQ(maybe_compare(truth, truth), Sign::zero);
}

TEST(Exact, SignsOutOfReachAreEmptyNotZero) {
  // 24 independent roots and 24 roots of those: a number of the field has 2^48 coefficients.
  Exact forth = 0.0, back = 0.0;
  int count = 0;
  for (int n = 2; count < 24; ++n) {
    if (mpz_probab_prime_p(mpz_class(n).get_mpz_t(), 20) == 0) continue;
    forth = forth + sqrt(root(n) + 1);
    back = sqrt(root(n) + 1) + back;
    ++count;
  }
  EXPECT_EQ(maybe_sign(forth), Sign::positive) << "no bound is needed to see that a number is not zero";
  EXPECT_EQ(maybe_sign(forth - back - Exact(power_of_two(-500))), Sign::negative);
  EXPECT_FALSE(maybe_sign(forth - back));
  EXPECT_FALSE(rounded(forth - back));
  EXPECT_FALSE((1 / (forth - back)).is_defined());
  EXPECT_FALSE((forth - back).bounds(64));
  EXPECT_FALSE((forth - back).enclosure(64).is_finite());
  EXPECT_FALSE(sqrt(forth - back).is_defined());
  const Exact near_midpoint = forth - back + Exact(1 + power_of_two(-53));
  EXPECT_EQ(maybe_sign(near_midpoint), Sign::positive);
  EXPECT_FALSE(rounded(near_midpoint)) << "on which side of the midpoint it lies is out of reach";
}

TEST(Exact, NumbersTooLargeForTheTowerAreOutOfReach) {
  // Zero by construction, but a product of two such numbers is more work than is allowed.
  mpz_class large;
  mpz_ui_pow_ui(large.get_mpz_t(), 3, 1700000);
  const Exact c{mpq_class(large)}, nested = sqrt(1 + root(2));
  EXPECT_FALSE(maybe_sign((c * nested) * (c * nested) - c * c * (1 + root(2))));
  const Exact three_roots = 1 + root(2) + root(3);  // its square is no number of one root
  EXPECT_FALSE(maybe_sign(sqrt(c * c * three_roots * three_roots) - c * three_roots));
  EXPECT_EQ(maybe_sign(sqrt(three_roots * three_roots) - three_roots), Sign::zero);
}

TEST(Exact, SignsThatNeedMoreBitsThanTheirDivisors) {
  // 128 bits show neither the sign of the divisor nor that of what a root is taken of.
  const Exact tiny = sqrt(5 + 2 * root(6) + Exact(power_of_two(-300))) - root(2) - root(3);
  const Exact large = 1 / tiny;
  EXPECT_EQ(maybe_sign(large - Exact(power_of_two(290))), Sign::positive);
  EXPECT_EQ(maybe_sign(large * large - large), Sign::positive);
  EXPECT_EQ(maybe_sign(sqrt(large) - 1), Sign::positive);
  EXPECT_EQ(maybe_sign(sqrt(tiny) - Exact(power_of_two(-100))), Sign::negative);
  EXPECT_EQ(maybe_sign(large * tiny - 1), Sign::zero);
}

TEST(Exact, RootsThatPrimesOfTheTowerDivide) {
  // Modulo such a prime the root vanishes: that image of the tower shows nothing, and another must.
  for (const std::uint64_t p : signature_primes()) {
    const Exact a = 1 + sqrt(Exact(mpq_class(p))), b = 2 + sqrt(Exact(mpq_class(p)));
    ASSERT_EQ(maybe_sign(sqrt(a) * sqrt(b) - sqrt(a * b)), Sign::zero) << p;
    ASSERT_EQ(maybe_sign(sqrt(a) * sqrt(b) - sqrt(a * b + Exact(power_of_two(-400)))), Sign::negative) << p;
  }
}

TEST(Exact, NumbersMoveBetweenThreads) {
  std::vector<Exact> shared;
  for (int i = 2; i < 12; ++i) shared.push_back(root(i) + root(i + 1) - sqrt(2.0 * i + 1 + 2 * root(i * (i + 1.0))));
  std::vector<std::vector<MaybeSign>> signs(4);
  std::vector<std::thread> threads;
  for (auto& mine : signs)
    threads.emplace_back([&mine, numbers = shared] {
      for (const Exact& x : numbers) mine.push_back(maybe_sign(x * root(7)));
    });
  shared.clear();
  for (auto& thread : threads) thread.join();
  for (const auto& mine : signs)
    for (const MaybeSign& sign : mine) EXPECT_EQ(sign, Sign::zero);
}

}  // namespace
TEST(Exact, DeferredNumbersAreMadeOnceAndOnlyIfNeeded) {
  int made = 0;
  const Exact x = Exact::deferred([&made] {
    ++made;
    return sqrt(Exact(2.0));
  });
  const Exact copy = x;
  EXPECT_EQ(made, 0);
  EXPECT_EQ(maybe_sign(x * copy - Exact(2.0)), Sign::zero);
  EXPECT_EQ(maybe_sign(copy), Sign::positive);
  EXPECT_TRUE(x.is_defined());
  EXPECT_EQ(made, 1);
  const Exact nothing = Exact::deferred([] { return Exact::undefined(); });
  EXPECT_FALSE(nothing.is_defined());
  EXPECT_EQ(maybe_sign(nothing + x), std::nullopt);
}

/// Copies in several threads, of one that is made of another, and still made once; all that asks for a number sees what was made.
TEST(Exact, DeferredNumbersAreMadeOnceByManyThreads) {
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> made = 0;
    const Exact inner = Exact::deferred([&made] {
      ++made;
      return root(3);
    });
    const Exact outer = Exact::deferred([inner] { return inner; });
    std::atomic<int> right = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&, copy = outer] {
        const bool zero = maybe_sign(copy * copy - 3) == Sign::zero && maybe_sign(copy - inner) == Sign::zero;
        right += zero && rounded(copy) == std::sqrt(3.0) && maybe_sign(-copy) == Sign::negative && !copy.rational() && copy.bounds(8)->first < 2 ? 1 : 0;
      });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(right, 4);
    EXPECT_EQ(made, 1);
  }
}

}  // namespace gvd::robust::test
