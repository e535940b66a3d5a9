#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "gvd/robust/gmp.hpp"
#include "gvd/robust/root_sum.hpp"
#include "mpfr_interval.hpp"
#include "residue.hpp"

namespace gvd::robust {

/// An element of a RootTower with whole coefficients, in normal form: an integer (level 0), or a + b sqrt(g) with b not zero, g that of its
/// level, and a and b of lower levels. Two elements are equal iff their forms are.
class TowerElement {
 public:
  TowerElement(const mpz_class& n = 0) : integer_(n) {}  // NOLINT: an integer is an element
  /// a + b sqrt(g) of that level. Pre: a and b are of lower levels.
  TowerElement(int level, TowerElement a, TowerElement b);

  int level() const noexcept { return level_; }
  bool is_zero() const { return level_ == 0 && sgn(integer_) == 0; }
  const mpz_class& integer() const noexcept { return integer_; }
  const TowerElement& a() const noexcept;
  const TowerElement& b() const noexcept;

 private:
  struct Parts;
  int level_ = 0;
  mpz_class integer_;
  std::shared_ptr<const Parts> parts_;
};

/// numerator / denominator; the denominator is not zero.
struct TowerFraction {
  TowerElement numerator, denominator{mpz_class(1)};
};

/// A tower of real fields Q = F_0 < F_1 < ... < F_n, where F_i = F_{i-1}(sqrt g_i) with g_i > 0 that is no square in F_{i-1}. It grows with the
/// roots asked for, and recognises those that are there already; so all numbers built by + - * / and roots have one normal form, and zero is
/// recognised without any bound. An element has up to 2^n coefficients: for formulas over a few roots. What costs too much is not computed:
/// from then on `is_exhausted()`, and results mean nothing.
class RootTower {
 public:
  TowerFraction add(const TowerFraction& x, const TowerFraction& y);
  TowerFraction negate(const TowerFraction& x) { return {negate(x.numerator), x.denominator}; }
  TowerFraction multiply(const TowerFraction& x, const TowerFraction& y);
  /// The positive root. Pre: x > 0.
  TowerFraction root(const TowerFraction& x);
  TowerFraction fraction(const RootSum& sum);

  bool is_exhausted() const noexcept { return work_ > kMostWork || squares_.size() > kMostLevels; }

 private:
  static constexpr std::size_t kMostLevels = 12;
  /// In products of machine words, roughly: some seconds.
  static constexpr double kMostWork = 1e9;

  TowerElement add(const TowerElement& x, const TowerElement& y);
  TowerElement negate(const TowerElement& x);
  TowerElement multiply(const TowerElement& x, const TowerElement& y);
  /// An image of the tower in the field of p^2 elements, up to the level of the last root.
  struct Place {
    ResidueField field;
    std::vector<ResidueField::Element> roots;
  };
  bool is_certainly_no_square(const TowerElement& x);
  bool extend(Place& place) const;
  ResidueField::Element image(const TowerElement& x, const Place& place) const;
  std::optional<TowerFraction> root_in_field(const TowerElement& x, int level);
  TowerFraction root_of(const RootSum::Term& term);
  std::optional<TowerFraction> root_by_classes(const RootSum::Term& term, std::uint64_t levels) const;
  TowerFraction reduced(TowerFraction x);
  const TowerElement& square_of(int level) const { return squares_[static_cast<std::size_t>(level) - 1]; }
  bool is_negative(const TowerElement& x) const;
  MpfrInterval enclosure(const TowerElement& x, const std::vector<MpfrInterval>& roots, int bits) const;

  /// A whole square of the tower, by its symbols.
  struct SquareClass {
    std::uint64_t reduced;  ///< less those of the classes before, by elimination
    std::uint64_t levels;   ///< of these and of itself, as bits
  };

  std::vector<TowerElement> squares_;
  std::vector<SquareClass> classes_;  ///< of the lowest levels, as long as they are roots of integers that were met in sums of roots
  std::map<mpz_class, TowerFraction> known_roots_;
  std::vector<Place> places_;
  std::size_t primes_tried_ = 0;
  double work_ = 0;
};

}  // namespace gvd::robust
