#include "gvd/robust/double_double.hpp"

#include <gtest/gtest.h>

#include "gvd/robust/rational.hpp"
#include "robust/random_numbers.hpp"

namespace gvd::robust::test {
namespace {

const mpq_class kU = power_of_two(-53);

bool is_normalised(const DoubleDouble& x) { return x.hi == x.hi + x.lo; }

/// |computed - truth| <= bound * |computed.hi|
void expect_within(const DoubleDouble& computed, const mpq_class& truth, double bound, int i) {
  ASSERT_TRUE(is_normalised(computed)) << i;
  ASSERT_LE(abs(to_mpq(computed) - truth), mpq_class(bound) * abs(mpq_class(computed.hi))) << i;
}

/// Random double-doubles of moderate exponent (no underflow), often with a small, a large or an adversarial low part.
class Moderate {
 public:
  explicit Moderate(std::uint64_t seed) : random_(seed) {}
  DoubleDouble operator()() {
    const double hi = random_.between(-60, 60);
    if (random_.chance(10)) return hi;
    return two_sum(hi, std::ldexp(random_.between(-1, 0),
                                  std::ilogb(hi) - 53 - (random_.chance(60) ? 0 : static_cast<int>(random_.below(60)))));
  }
  RandomNumbers& random() { return random_; }

 private:
  RandomNumbers random_;
};

TEST(DoubleDouble, ErrorFreeTransformationsAreExact) {
  RandomNumbers random(1);
  for (int i = 0; i < 100000; ++i) {
    const double a = random.mixed(), b = random.mixed();
    const DoubleDouble sum = two_sum(a, b);
    if (std::isfinite(sum.hi) && std::isfinite(sum.lo)) {
      ASSERT_EQ(to_mpq(sum), mpq_class(a) + mpq_class(b)) << i;
      ASSERT_EQ(sum.hi, a + b);
    }
    const double large = std::fabs(a) < std::fabs(b) ? b : a, small = std::fabs(a) < std::fabs(b) ? a : b;
    const DoubleDouble fast = fast_two_sum(large, small);
    if (std::isfinite(fast.hi)) {
      ASSERT_EQ(to_mpq(fast), mpq_class(a) + mpq_class(b)) << i;
    }
    const DoubleDouble product = two_prod(a, b);
    if (!std::isfinite(product.hi)) continue;
    const mpq_class lost = abs(to_mpq(product) - mpq_class(a) * mpq_class(b));
    if (std::fabs(product.hi) >= 0x1p-969) {
      ASSERT_EQ(lost, 0) << i;
    }
    ASSERT_LE(lost, power_of_two(-1075)) << i;
  }
}

TEST(DoubleDouble, SumsKeepTheirBound) {
  Moderate next(2);
  for (int i = 0; i < 200000; ++i) {
    const DoubleDouble x = next();
    DoubleDouble y = next();
    if (next.random().chance(50)) {  // nearly cancelling
      y = -x;
      const int place = static_cast<int>(next.random().below(110));
      y = y + DoubleDouble(std::ldexp(x.hi, -place));
    }
    expect_within(x + y, to_mpq(x) + to_mpq(y), kDoubleDoubleAddError, i);
    expect_within(x - y, to_mpq(x) - to_mpq(y), kDoubleDoubleAddError, i);
  }
}

TEST(DoubleDouble, SumsKeepTheirBoundInTheSubnormalRange) {
  RandomNumbers random(3);
  for (int i = 0; i < 50000; ++i) {
    const DoubleDouble x = two_sum(random.between(-1074, -960), random.between(-1074, -1020));
    const DoubleDouble y = two_sum(random.between(-1074, -960), random.between(-1074, -1020));
    expect_within(x + y, to_mpq(x) + to_mpq(y), kDoubleDoubleAddError, i);
  }
}

TEST(DoubleDouble, ProductsQuotientsAndRootsKeepTheirBounds) {
  Moderate next(4);
  for (int i = 0; i < 200000; ++i) {
    const DoubleDouble x = next(), y = next();
    expect_within(x * y, to_mpq(x) * to_mpq(y), kDoubleDoubleProductError, i);
    expect_within(x / y, to_mpq(x) / to_mpq(y), kDoubleDoubleQuotientError, i);
    const DoubleDouble root = sqrt(abs(x));
    ASSERT_TRUE(is_normalised(root));
    const mpq_class s = to_mpq(root), e = mpq_class(kDoubleDoubleRootError) * s, truth = abs(to_mpq(x));
    ASSERT_TRUE((s - e) * (s - e) <= truth && truth <= (s + e) * (s + e)) << i;
  }
}

TEST(DoubleDouble, RootsKeepTheirBoundDownToTheSmallestNumber) {
  RandomNumbers random(5);
  for (int i = 0; i < 50000; ++i) {
    const DoubleDouble x = abs(two_sum(random.between(-1074, -800), random.between(-1074, -900)));
    const mpq_class s = to_mpq(sqrt(x)), e = mpq_class(kDoubleDoubleRootError) * s, truth = to_mpq(x);
    ASSERT_TRUE((s - e) * (s - e) <= truth && truth <= (s + e) * (s + e)) << i;
  }
}

TEST(DoubleDouble, ComparisonsAreThoseOfTheExactValues) {
  Moderate next(6);
  for (int i = 0; i < 20000; ++i) {
    const DoubleDouble x = next(), y = next.random().chance(30) ? DoubleDouble(x.hi) : next();
    ASSERT_EQ(x < y, to_mpq(x) < to_mpq(y));
    ASSERT_EQ(x <= y, to_mpq(x) <= to_mpq(y));
    ASSERT_EQ(x == y, to_mpq(x) == to_mpq(y));
    ASSERT_EQ(to_mpq(abs(x)), abs(to_mpq(x)));
    ASSERT_EQ(static_cast<double>(x), x.hi);
  }
}

// The derivations of docs/error-bounds.md#double-double, step by step with exact numbers, against the literals of the header.
TEST(DoubleDouble, LiteralsFollowFromTheirDerivations) {
  const mpq_class& u = kU;
  const mpq_class grow = 1 + u, shrink = 1 - u;

  // Sum: the published bound 3u^2 / (1 - 4u) is relative to the truth; ours to the high part of the result.
  const mpq_class published = 3 * u * u / (1 - 4 * u);
  const mpq_class sum = published / (1 - published) * grow;
  EXPECT_LE(sum, mpq_class(kDoubleDoubleAddError));

  // Product, with |x.hi y.hi| = 1.
  const mpq_class low_low = u * u, low_low_error = u * low_low;
  const mpq_class inner = u + low_low * grow, inner_error = u * inner;
  const mpq_class cross = u + inner * grow, cross_error = u * cross;
  const mpq_class tail = u + cross * grow, tail_error = u * tail;
  const mpq_class product_error = low_low_error + inner_error + cross_error + tail_error;
  const mpq_class product = shrink * shrink - product_error;  // least magnitude of the result
  const mpq_class product_bound = product_error / product * grow;
  EXPECT_LE(product_bound, mpq_class(kDoubleDoubleProductError));
  EXPECT_GT(4 * product_bound, mpq_class(kDoubleDoubleProductError)) << "far too wide";

  // Quotient, with |x.hi| = |y.hi| = 1 and so |q| <= 1 + u.
  const mpq_class c_lo = u * grow;  // low part of y.hi q
  const mpq_class f_argument = u * grow + c_lo, f_error = u * f_argument, f = f_argument * grow;
  const mpq_class r_hi = (1 + u + f + c_lo) * grow, r_lo = u * r_hi;
  const mpq_class high = u + c_lo + f + r_lo, high_error = u * high;                    // x.hi - r.hi
  const mpq_class low = u + r_lo, low_error = u * low;                                  // x.lo - r.lo
  const mpq_class rest_argument = u + u + u * grow + f_error + high_error + low_error;  // near x - y q
  const mpq_class rest_error = f_error + high_error + low_error + u * rest_argument;
  const mpq_class rest = rest_argument * grow;
  const mpq_class quotient_error = rest_error / shrink + u * rest + rest * u / shrink;
  const mpq_class quotient = shrink - rest * grow;  // least magnitude of the result
  const mpq_class quotient_bound = quotient_error / quotient * grow;
  EXPECT_LE(quotient_bound, mpq_class(kDoubleDoubleQuotientError));
  EXPECT_GT(4 * quotient_bound, mpq_class(kDoubleDoubleQuotientError));

  // Root, with x.hi = 1 and so s = 1 + d, |d| <= u.
  const mpq_class residual = 2 * u + u * u, residual_error = u * residual;
  const mpq_class with_low = residual * grow + u, with_low_error = u * with_low;
  const mpq_class correction = with_low * grow / (2 * shrink);
  const mpq_class from_start = u + u;  // |sqrt x - s|, sqrt(1 + u) < 1 + u
  const mpq_class root_error =
      (residual_error + with_low_error) / (2 * shrink) + u * correction + from_start * from_start / (2 * shrink);
  const mpq_class root_bound = root_error / (shrink - correction * grow - root_error) * grow;
  EXPECT_LE(root_bound, mpq_class(kDoubleDoubleRootError));
  EXPECT_GT(4 * root_bound, mpq_class(kDoubleDoubleRootError));
}

}  // namespace
}  // namespace gvd::robust::test
