#include "gvd/predicates/angle_sum.hpp"

#include <algorithm>
#include <cmath>

#include "formal_angle_product.hpp"
#include "gvd/predicates/filter_error.hpp"
#include "gvd/predicates/strip.hpp"
#include "gvd/robust/ball.hpp"
#include "gvd/robust/double_double.hpp"
#include "gvd/robust/mpfr_float.hpp"
#include "gvd/robust/proof_limit.hpp"
#include "gvd/robust/rational.hpp"

namespace gvd::predicates {
namespace {

using robust::Ball;
using robust::MaybeSign;
using robust::Sign;
using robust::Stage;

constexpr double kRescale = 0x1p467;
static_assert(kAngleRescale == 467);

/// Turns x + i y back by quarter turns until the real part is positive and at least as large as the imaginary one; returns how
/// many. Without branches, which no processor could foresee.
int turn_by_numbers(double& x, double& y) noexcept {
  const bool right_or_down = x - y >= 0, right_or_up = x + y >= 0;
  const bool odd = right_or_down != right_or_up;
  const double a = odd ? y : x, b = odd ? -x : y;
  const double sign = right_or_up ? 1 : -1;
  x = sign * a;
  y = sign * b;
  return odd ? (right_or_up ? 1 : 3) : (right_or_up ? 0 : 2);
}

template <class NT>
int quarter_of(const NT& x, const NT& y) {
  const auto not_negative = [](MaybeSign s) { return s != Sign::negative; };
  const bool right_or_down = not_negative(maybe_sign(x - y)), right_or_up = not_negative(maybe_sign(x + y));
  if (right_or_down) return right_or_up ? 0 : 3;
  return right_or_up ? 1 : 2;
}

/// Divides x + i y by i^quarters.
template <class NT>
void turn_back(NT& x, NT& y, int quarters) {
  NT x_before = x;
  if (quarters == 1) {
    x = y;
    y = -x_before;
  } else if (quarters == 2) {
    x = -x;
    y = -y;
  } else if (quarters == 3) {
    x = -y;
    y = x_before;
  }
}

/// What the comparison is, once the sum is known to be q pi/2 + arg z with |arg z| < pi/2.
template <class SignOfImaginaryPart>
MaybeSign compare_turns(int quarters, int quarter_turns, SignOfImaginaryPart sign) {
  if (quarters > quarter_turns) return Sign::positive;
  if (quarters < quarter_turns) return Sign::negative;
  return sign();
}

/// The same product in a number type that knows its errors: everything is verified, nothing bounded in advance.
template <class NT>
class TurnedProduct {
 public:
  void add(NT x, NT y) {
    quarters_ += turn_certainly(x, y);
    NT product_x = x_ * x - y_ * y;
    y_ = x_ * y + y_ * x;
    x_ = std::move(product_x);
    // |arg| < pi now, and one of -1, 0, 1 quarter turns brings it below pi/2; half a turn would leave it open which way round.
    const int quarters = turn_certainly(x_, y_);
    certain_ &= quarters != 2;
    quarters_ += quarters == 3 ? -1 : quarters;
    if (!certain_) return;  // x may be nothing now
    // Corners are about 1 in size (product_of), but there may be thousands.
    const int exponent = std::ilogb(rough(x_.mid()));
    x_ = x_.scaled(-exponent);
    y_ = y_.scaled(-exponent);
  }

  MaybeSign compare(int quarter_turns) const {
    return compare(quarter_turns, [&] { return maybe_sign(y_); });
  }
  /// With the sign of the imaginary part from elsewhere.
  template <class SignOfImaginaryPart>
  MaybeSign compare(int quarter_turns, const SignOfImaginaryPart& sign) const {
    if (!certain_) return std::nullopt;
    return compare_turns(quarters_, quarter_turns, sign);
  }

 private:
  int turn_certainly(NT& x, NT& y) {
    const int quarters = quarter_of(x, y);
    turn_back(x, y, quarters);
    certain_ &= maybe_sign(x) == Sign::positive;
    return quarters;
  }

  NT x_ = NT(1.0), y_ = NT(0.0);
  int quarters_ = 0;
  bool certain_ = true;
};

long binary_exponent(const mpq_class& q) {
  return static_cast<long>(mpz_sizeinbase(q.get_num_mpz_t(), 2)) - static_cast<long>(mpz_sizeinbase(q.get_den_mpz_t(), 2));
}

/// Each corner is made shorter or longer by a power of two, to about 1, so that no product leaves the range of doubles.
template <class NT>
TurnedProduct<NT> product_of(std::span<const ExactCorner> fan, int bits) {
  TurnedProduct<NT> product;
  for (const ExactCorner& corner : fan) {
    const long root = binary_exponent(corner.cross_square) / 2, shift = corner.dot == 0 ? root : std::max(root, binary_exponent(corner.dot));
    product.add(robust::from<NT>(robust::shifted(corner.dot, -shift), bits), sqrt(robust::from<NT>(robust::shifted(corner.cross_square, -2 * shift), bits)));
  }
  return product;
}

/// Equality is possible with at most four independent roots only (see kMostAngleRoots), so with more of them doubling must end;
/// the last entries are for angles that differ by less than any input of doubles is known to reach.
constexpr int kBits[] = {128, 256, 512, 1024, 4096, 16384};

using InDoubleDouble = TurnedProduct<Ball<robust::DoubleDouble>>;

MaybeSign exact_comparison(std::span<const ExactCorner> fan, int quarter_turns, const InDoubleDouble& product) {
  if (!robust::ProofLimit::allows_one()) return std::nullopt;
  const auto formal = FormalAngleProduct::of(fan, kMostAngleRoots);
  if (!formal) return std::nullopt;
  // Its whole number of quarter turns is certainly less than one off: a double-double loses some 2^-98 a corner.
  return product.compare(quarter_turns, [&] { return formal->imaginary_sign(quarter_turns); });
}

}  // namespace

void AngleSumFilter::add(const Vector& d, const Vector& e, double input_error) noexcept {
  double x = d[0] * e[0] + d[1] * e[1] + d[2] * e[2];
  const double c0 = d[1] * e[2] - d[2] * e[1], c1 = d[2] * e[0] - d[0] * e[2], c2 = d[0] * e[1] - d[1] * e[0];
  double y = std::sqrt(c0 * c0 + c1 * c1 + c2 * c2);
  const double size = std::abs(x) + y;
  if (!(size > kLeastAngleFactor && size < kMostAngleFactor)) in_range_ = false;
  factors_ += 1;
  input_error_ += input_error;
  const int quarters = turn_by_numbers(x, y);
  const double product_x = x_ * x - y_ * y;
  y_ = x_ * y + y_ * x;
  x_ = product_x;
  const int more = turn_by_numbers(x_, y_);
  quarters_ += quarters + (more == 3 ? -1 : more);
  if (x_ > kMostAngleFactor) {
    x_ /= kRescale;
    y_ /= kRescale;
  } else if (x_ < kLeastAngleFactor) {
    x_ *= kRescale;
    y_ *= kRescale;
  }
}

// docs/error-bounds.md#angle-sums. By less than kMostAngleError off, numbers that were brought to |arg| <= pi/4 truly have |arg| < pi/2, so
// quarters are counted right.
double AngleSumFilter::error_bound() const noexcept { return kAngleFactorError * factors_ + kAngleInputError * input_error_; }

std::optional<int> AngleSumFilter::nearest_quarter_turns() const noexcept {
  if (!in_range_ || !(error_bound() < kMostAngleError)) return std::nullopt;
  return quarters_;
}

MaybeSign AngleSumFilter::compare(int quarter_turns) const noexcept {
  const auto quarters = nearest_quarter_turns();
  if (!quarters) return std::nullopt;
  return compare_turns(*quarters, quarter_turns, [&]() -> MaybeSign {
    if (!(std::abs(y_) > error_bound() * (std::abs(x_) + std::abs(y_)))) return std::nullopt;
    return y_ > 0 ? Sign::positive : Sign::negative;
  });
}

ExactCorner exact_corner(const std::array<mpq_class, 3>& d, const std::array<mpq_class, 3>& e) {
  ExactCorner corner;
  corner.dot = d[0] * e[0] + d[1] * e[1] + d[2] * e[2];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const mpq_class c = d[i] * e[j] - d[j] * e[i];
    corner.cross_square += c * c;
  }
  return corner;
}

MaybeSign double_double_compare_angle_sum(std::span<const ExactCorner> fan, int quarter_turns) {
  return product_of<Ball<robust::DoubleDouble>>(fan, 0).compare(quarter_turns);
}

MaybeSign multiprecision_compare_angle_sum(std::span<const ExactCorner> fan, int quarter_turns, int bits) {
  return product_of<Ball<robust::Mpfr>>(fan, bits).compare(quarter_turns);
}

MaybeSign exact_compare_angle_sum(std::span<const ExactCorner> fan, int quarter_turns) {
  return exact_comparison(fan, quarter_turns, product_of<Ball<robust::DoubleDouble>>(fan, 0));
}

Decision compare_angle_sum(std::span<const ExactCorner> fan, int quarter_turns) {
  const InDoubleDouble product = product_of<Ball<robust::DoubleDouble>>(fan, 0);
  if (const auto sign = product.compare(quarter_turns)) return {sign, Stage::double_double};
  if (const auto sign = exact_comparison(fan, quarter_turns, product)) return {sign, Stage::algebra};
  for (const int bits : kBits) {
    if (const auto sign = multiprecision_compare_angle_sum(fan, quarter_turns, bits)) return {sign, Stage::mpfr};
  }
  return {std::nullopt, Stage::undecided};
}

}  // namespace gvd::predicates
