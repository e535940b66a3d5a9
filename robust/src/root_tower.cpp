#include "root_tower.hpp"

#include <algorithm>
#include <utility>

#include "gvd/robust/rational.hpp"
#include "perfect_square.hpp"

namespace gvd::robust {

struct TowerElement::Parts {
  TowerElement a, b;
};

TowerElement::TowerElement(int level, TowerElement a, TowerElement b) {
  if (b.is_zero()) {
    *this = std::move(a);
  } else {
    level_ = level;
    parts_ = std::make_shared<const Parts>(Parts{std::move(a), std::move(b)});
  }
}

const TowerElement& TowerElement::a() const noexcept { return parts_->a; }
const TowerElement& TowerElement::b() const noexcept { return parts_->b; }

namespace {

// The greatest common divisor of `divisor` and all coefficients.
mpz_class content(const TowerElement& x, const mpz_class& divisor) {
  if (divisor == 1) return divisor;
  if (x.level() == 0) return gcd(divisor, x.integer());
  return content(x.b(), content(x.a(), divisor));
}

TowerElement divided(const TowerElement& x, const mpz_class& divisor) {
  if (x.level() > 0) return {x.level(), divided(x.a(), divisor), divided(x.b(), divisor)};
  mpz_class quotient;
  mpz_divexact(quotient.get_mpz_t(), x.integer().get_mpz_t(), divisor.get_mpz_t());
  return quotient;
}

const mpz_class& first_coefficient(const TowerElement& x) { return x.level() == 0 ? x.integer() : first_coefficient(x.b()); }

bool is_one(const TowerElement& x) { return x.level() == 0 && x.integer() == 1; }

}  // namespace

TowerElement RootTower::add(const TowerElement& x, const TowerElement& y) {
  if (x.level() < y.level()) return add(y, x);
  if (x.level() == 0) return mpz_class(x.integer() + y.integer());
  if (y.level() < x.level()) return {x.level(), add(x.a(), y), x.b()};
  return {x.level(), add(x.a(), y.a()), add(x.b(), y.b())};
}

TowerElement RootTower::negate(const TowerElement& x) {
  if (x.level() == 0) return mpz_class(-x.integer());
  return {x.level(), negate(x.a()), negate(x.b())};
}

TowerElement RootTower::multiply(const TowerElement& x, const TowerElement& y) {
  if (x.level() < y.level()) return multiply(y, x);
  if (y.is_zero() || is_exhausted()) return {};
  if (is_one(y)) return x;
  if (x.level() == 0) {
    work_ += 20 + static_cast<double>(mpz_size(x.integer().get_mpz_t())) * static_cast<double>(mpz_size(y.integer().get_mpz_t()));
    return mpz_class(x.integer() * y.integer());
  }
  if (y.level() < x.level()) return {x.level(), multiply(x.a(), y), multiply(x.b(), y)};
  // Karatsuba: three products.
  const TowerElement aa = multiply(x.a(), y.a()), bb = multiply(x.b(), y.b());
  const TowerElement all = multiply(add(x.a(), x.b()), add(y.a(), y.b()));
  return {x.level(), add(aa, multiply(bb, square_of(x.level()))), add(all, negate(add(aa, bb)))};
}

TowerFraction RootTower::reduced(TowerFraction x) {
  if (x.numerator.is_zero()) return {};
  if (is_exhausted() || is_one(x.denominator)) return x;
  const mpz_class common = content(x.numerator, content(x.denominator, 0));
  if (common == 1) return x;
  return {divided(x.numerator, common), divided(x.denominator, common)};
}

TowerFraction RootTower::add(const TowerFraction& x, const TowerFraction& y) {
  if (x.numerator.is_zero()) return y;
  if (y.numerator.is_zero()) return x;
  if (add(x.denominator, negate(y.denominator)).is_zero()) return reduced({add(x.numerator, y.numerator), x.denominator});
  return reduced({add(multiply(x.numerator, y.denominator), multiply(y.numerator, x.denominator)), multiply(x.denominator, y.denominator)});
}

TowerFraction RootTower::multiply(const TowerFraction& x, const TowerFraction& y) {
  return reduced({multiply(x.numerator, y.numerator), multiply(x.denominator, y.denominator)});
}

ResidueField::Element RootTower::image(const TowerElement& x, const Place& place) const {
  if (x.level() == 0) return place.field.of(x.integer());
  const ResidueField::Element b = place.field.multiply(image(x.b(), place), place.roots[static_cast<std::size_t>(x.level()) - 1]);
  return place.field.add(image(x.a(), place), b);
}

// Up to the height of the tower; false if one of the roots does not exist.
bool RootTower::extend(Place& place) const {
  while (place.roots.size() < squares_.size()) {
    const ResidueField::Element square = image(squares_[place.roots.size()], place);
    const auto root = place.field.root(square);
    if (!root || ResidueField::is_zero(square)) return false;
    place.roots.push_back(*root);
  }
  return true;
}

// A square of the tower is a square in each of its images; others are in half of them.
bool RootTower::is_certainly_no_square(const TowerElement& x) {
  constexpr std::size_t kPlaces = 6;
  std::erase_if(places_, [&](Place& place) { return !extend(place); });
  for (const auto& primes = signature_primes(); places_.size() < kPlaces && primes_tried_ < primes.size(); ++primes_tried_) {
    if (primes[primes_tried_] % 4 != 3) continue;
    Place place{ResidueField(primes[primes_tried_]), {}};
    if (extend(place)) places_.push_back(std::move(place));
  }
  return std::any_of(places_.begin(), places_.end(), [&](const Place& place) { return !place.field.is_square(image(x, place)); });
}

// A square root of x in F_level, of either sign.
std::optional<TowerFraction> RootTower::root_in_field(const TowerElement& x, int level) {
  if (is_exhausted()) return std::nullopt;
  if (level == 0) {
    work_ += 20 + static_cast<double>(mpz_size(x.integer().get_mpz_t()));
    if (!is_perfect_square(x.integer())) return std::nullopt;
    return TowerFraction{mpz_class(sqrt(x.integer()))};
  }
  if (x.level() > 0 && is_certainly_no_square(x)) return std::nullopt;
  const TowerElement g = square_of(level);
  if (x.level() < level) {  // (s + t sqrt g)^2 is free of sqrt g only if s or t is zero
    if (x.level() > 0 && x.level() == g.level()) {  // x = m / n g, as when one length occurs twice
      const mpz_class &m = first_coefficient(x), &n = first_coefficient(g);
      if (add(multiply(x, n), negate(multiply(g, m))).is_zero())
        if (const auto root = root_in_field(mpz_class(m * n), level - 1))
          return reduced({TowerElement(level, TowerElement(), root->numerator), multiply(root->denominator, n)});
    }
    if (auto s = root_in_field(x, level - 1)) return s;
    const auto tg = root_in_field(multiply(x, g), level - 1);
    if (!tg) return std::nullopt;
    return reduced({TowerElement(level, TowerElement(), tg->numerator), multiply(tg->denominator, g)});
  }
  // (s + t sqrt g)^2 = x = a + b sqrt g has the norm n^2 = a^2 - b^2 g, so s^2 = (a +- n) / 2 and t = b / (2 s); s is not zero because b is not.
  const auto n = root_in_field(multiply(x, TowerElement(level, x.a(), negate(x.b()))), level - 1);
  if (!n) return std::nullopt;
  const TowerElement a = multiply(x.a(), n->denominator), half = multiply(mpz_class(2), n->denominator);
  for (const TowerElement& norm : {n->numerator, negate(n->numerator)}) {
    const TowerElement sum = add(a, norm);                                   // 2 s^2, times the denominator of n
    const auto root = root_in_field(multiply(sum, half), level - 1);  // s times `half`
    if (!root) continue;  // whatever was found with the last work allowed: who asked for it sees that there is none left
    // s + b / (2 s) sqrt g = (2 s^2 + b sqrt g) / (2 s)
    const TowerElement numerator = multiply(TowerElement(level, sum, multiply(x.b(), n->denominator)), root->denominator);
    return reduced({numerator, root->numerator});
  }
  return std::nullopt;
}

TowerFraction RootTower::root(const TowerFraction& x) {
  if (is_exhausted()) return {};
  const TowerElement square = multiply(x.numerator, x.denominator);  // over that of the denominator
  const int height = static_cast<int>(squares_.size());
  TowerFraction root;
  if (auto known = root_in_field(square, height)) {
    root = std::move(*known);
  } else {
    if (is_exhausted()) return {};
    squares_.push_back(square);
    root.numerator = TowerElement(height + 1, TowerElement(), mpz_class(1));
  }
  root.denominator = multiply(root.denominator, x.denominator);
  if (is_exhausted()) return {};
  return reduced(is_negative(root.numerator) == is_negative(root.denominator) ? root : negate(root));
}

/// The root as a multiple of those of these levels, if it is one.
std::optional<TowerFraction> RootTower::root_by_classes(const RootSum::Term& term, std::uint64_t levels) const {
  mpz_class product = 1;
  for (std::size_t i = 0; i < classes_.size(); ++i)
    if ((levels >> i & 1) != 0) product *= squares_[i].integer();
  const mpz_class square = term.radicand * product;
  if (!is_perfect_square(square)) return std::nullopt;
  TowerFraction root{mpz_class(sqrt(square)), product};
  for (std::size_t i = 0; i < classes_.size(); ++i)
    if ((levels >> i & 1) != 0) root.numerator = TowerElement(static_cast<int>(i) + 1, TowerElement(), root.numerator);
  return root;
}

/// Symbols tell at once whether the root of an integer is a new one, as long as there are only such, or of which it is a multiple; else it is looked for.
TowerFraction RootTower::root_of(const RootSum::Term& term) {
  std::uint64_t symbols = term.signature, levels = 0;
  for (const SquareClass& c : classes_)
    if (const std::uint64_t less = symbols ^ c.reduced; less < symbols) symbols = less, levels ^= c.levels;
  if (symbols == 0)
    if (const auto known = root_by_classes(term, levels)) return reduced(*known);
  if (symbols == 0 || classes_.size() < squares_.size()) return root({term.radicand});
  classes_.push_back({symbols, levels ^ std::uint64_t{1} << classes_.size()});
  squares_.emplace_back(term.radicand);
  return {TowerElement(static_cast<int>(squares_.size()), TowerElement(), mpz_class(1))};
}

TowerFraction RootTower::fraction(const RootSum& sum) {
  TowerFraction result{sum.whole_constant(), sum.denominator()};
  for (const auto& term : sum.terms()) {
    if (is_exhausted()) return {};
    auto known = known_roots_.find(term.radicand);
    if (known == known_roots_.end()) known = known_roots_.emplace(term.radicand, root_of(term)).first;
    result = add(result, multiply(known->second, {term.coefficient, sum.denominator()}));
  }
  return result;
}

MpfrInterval RootTower::enclosure(const TowerElement& x, const std::vector<MpfrInterval>& roots, int bits) const {
  if (x.level() == 0) return {x.integer(), bits};
  return enclosure(x.a(), roots, bits) + enclosure(x.b(), roots, bits) * roots[static_cast<std::size_t>(x.level()) - 1];
}

// It ends, because an element that is not of the form zero is not zero.
bool RootTower::is_negative(const TowerElement& x) const {
  if (x.level() == 0) return sgn(x.integer()) < 0;
  for (int bits = 64;; bits *= 2) {
    std::vector<MpfrInterval> roots;
    for (const TowerElement& square : squares_) roots.push_back(sqrt(enclosure(square, roots, bits)));
    if (const MaybeSign sign = enclosure(x, roots, bits).sign()) return *sign == Sign::negative;
  }
}

}  // namespace gvd::robust
