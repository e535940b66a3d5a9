#pragma once

#include <array>
#include <optional>
#include <span>

#include "gvd/predicates/ladder.hpp"
#include "gvd/robust/gmp.hpp"
#include "gvd/robust/sign.hpp"

/// The angle test at a vertex: the sum of the angles of a fan of corners against 2 pi (4 quarter turns) or pi (2).
///
/// A corner at v between the neighbours p and q is the complex number w = d.e + i |d x e|, d = p - v, e = q - v, whose argument is
/// the angle, in (0, pi). The argument of the product is the sum, up to full turns; these are counted with quarter turns: after
/// each factor the product is turned so that its real part is positive and not less than the size of its imaginary part, as far as
/// numbers can tell. So sum = q pi/2 + arg z with |arg z| < pi/2 always, and the sum compares with T pi/2 as q with T, and if they
/// are equal as Im z with 0. All comparisons: negative, zero, positive if the sum is less than, equal to, more than the turns
/// asked for.
namespace gvd::predicates {

/// The stage in plain doubles, with an a-priori error bound, derived in angle_sum.cpp.
class AngleSumFilter {
 public:
  using Vector = std::array<double, 3>;

  /// Adds the corner between d and e, each component a difference of two doubles, rounded once. `input_error` bounds
  /// |error of d| / |d| + |error of e| / |e| beyond that rounding, the errors of the points that the differences were taken of (0
  /// if exact).
  void add(const Vector& d, const Vector& e, double input_error = 0) noexcept;
  robust::MaybeSign compare(int quarter_turns) const noexcept;
  /// The sum in quarter turns to the nearest whole number, certainly less than 1 off; empty if numbers left the safe range.
  std::optional<int> nearest_quarter_turns() const noexcept;

  /// For tests: z, up to a power of two, and the relative error of it that is promised.
  std::array<double, 2> product() const noexcept { return {x_, y_}; }
  double error_bound() const noexcept;

 private:
  double x_ = 1, y_ = 0;
  double factors_ = 0;      ///< how many
  double input_error_ = 0;  ///< sum of those given
  int quarters_ = 0;
  bool in_range_ = true;
};

/// A corner in exact numbers.
struct ExactCorner {
  mpq_class dot;           ///< d.e
  mpq_class cross_square;  ///< |d x e|^2 > 0
};
/// The corner between d and e. Pre: they are not parallel. A common factor of all spokes of a fan changes no angle: with one that makes them whole,
/// no sum or product has to be reduced.
ExactCorner exact_corner(const std::array<mpq_class, 3>& d, const std::array<mpq_class, 3>& e);

robust::MaybeSign double_double_compare_angle_sum(std::span<const ExactCorner> fan, int quarter_turns);
robust::MaybeSign multiprecision_compare_angle_sum(std::span<const ExactCorner> fan, int quarter_turns, int bits);
/// Decides if the roots |d x e| of the fan are all rational multiples of one (coplanar fans); proves equality if at most
/// kMostAngleRoots of them are independent (two on folds). Otherwise empty. Cost: 2^roots rational operations a corner.
robust::MaybeSign exact_compare_angle_sum(std::span<const ExactCorner> fan, int quarter_turns);
/// Enough for every equality. Write A_c for the sum of the angles whose root is rational times sqrt(c), c up to squares. If all
/// angles add up to a multiple of pi/2, the product of the corners is real or imaginary, and so are its images when sqrt signs
/// change; hence each A_c with c not 1 is a multiple of pi / 2^m, m the number of independent roots. Its tangent is rational times
/// sqrt(c) or infinite, and the only such angles are multiples of pi/2 (multiples of pi/4 have c = 1, those of pi/8 and less no
/// rational squared tangent). So at most four classes c other than 1 fit into 2 pi.
inline constexpr std::size_t kMostAngleRoots = 4;

/// The stages above after the filter, in turn. The exact one comes before MPFR, because what double-double cannot tell is usually
/// equal.
Decision compare_angle_sum(std::span<const ExactCorner> fan, int quarter_turns);

}  // namespace gvd::predicates
