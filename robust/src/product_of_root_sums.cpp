#include "product_of_root_sums.hpp"

#include <algorithm>

#include "perfect_square.hpp"

namespace gvd::robust {

namespace {

mpz_class exact_quotient(const mpz_class& n, const mpz_class& divisor) {
  mpz_class quotient;
  mpz_divexact(quotient.get_mpz_t(), n.get_mpz_t(), divisor.get_mpz_t());
  return quotient;
}

bool is_zero(std::span<const mpz_class> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](const mpz_class& n) { return sgn(n) == 0; });
}

std::vector<mpz_class> sum(std::span<const mpz_class> x, std::span<const mpz_class> y) {
  std::vector<mpz_class> result(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) result[i] = x[i] + y[i];
  return result;
}

}  // namespace

ProductOfRootSums::ProductOfRootSums(const RootSum& a, const RootSum& b) : a_(a), b_(b) {}

/// Empty if the signature is none of the classes' products.
std::optional<ProductOfRootSums::Place> ProductOfRootSums::place_of(std::uint64_t signature) const {
  Place place = 0;
  for (const Class& c : classes_)
    if (const std::uint64_t less = signature ^ c.reduced; less < signature) signature = less, place ^= c.reduced_place;
  return signature == 0 ? std::optional(place) : std::nullopt;
}

/// Short radicands come first: those of single faces before products of them.
bool ProductOfRootSums::find_classes(const RootSum& a, const RootSum& b) {
  std::vector<const RootSum::Term*> terms;
  for (const RootSum* x : {&a, &b})
    for (const auto& term : x->terms()) terms.push_back(&term);
  std::stable_sort(terms.begin(), terms.end(), [](const auto* x, const auto* y) { return x->radicand < y->radicand; });
  for (const RootSum::Term* term : terms) {
    std::uint64_t reduced = term->signature;
    Place place = Place{1} << classes_.size();
    for (const Class& c : classes_)
      if (const std::uint64_t less = reduced ^ c.reduced; less < reduced) reduced = less, place ^= c.reduced_place;
    if (reduced == 0) continue;
    if (classes_.size() == kMostClasses) return false;
    classes_.push_back({term->radicand, term->signature, reduced, place});
  }
  return true;
}

void ProductOfRootSums::make_roots() {
  roots_.resize(std::size_t{1} << classes_.size());
  for (std::size_t i = 0, first = 1; i < classes_.size(); ++i, first *= 2)
    for (std::size_t below = 0; below < first; ++below) {
      const mpz_class common = gcd(roots_[below].radicand, classes_[i].radicand);
      roots_[first + below] = {exact_quotient(roots_[below].radicand, common) * exact_quotient(classes_[i].radicand, common),
                               roots_[below].multiple * common};
    }
}

std::optional<ProductOfRootSums::Factor> ProductOfRootSums::factor(const RootSum& x) const {
  struct Entry {
    Place place;
    mpq_class multiple;  // the root is so many roots of the place's product
  };
  std::vector<Entry> entries;
  Factor f{std::vector<mpz_class>(roots_.size()), 1};
  for (const auto& term : x.terms()) {
    const auto place = place_of(term.signature);
    if (!place) return std::nullopt;
    const Root& root = roots_[*place];
    mpq_class multiple(1, root.multiple);
    if (term.radicand != root.radicand) {
      const mpz_class product = term.radicand * root.radicand;
      if (!is_perfect_square(product)) return std::nullopt;
      multiple = mpq_class(sqrt(product), root.radicand * root.multiple);
      multiple.canonicalize();
    }
    f.denominator = lcm(f.denominator, multiple.get_den());
    entries.push_back({*place, std::move(multiple)});
  }
  f.coefficients[0] = x.whole_constant() * f.denominator;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const mpq_class& multiple = entries[i].multiple;
    f.coefficients[entries[i].place] = x.terms()[i].coefficient * multiple.get_num() * exact_quotient(f.denominator, multiple.get_den());
  }
  f.denominator *= x.denominator();
  return f;
}

/// (x0 + x1 sqrt b) (y0 + y1 sqrt b), b the last class of the level: by Karatsuba's scheme where no part is zero. Pre: the product is zero still.
void ProductOfRootSums::multiply(Numbers x, Numbers y, std::span<mpz_class> product, std::size_t level) const {
  if (level == 0) {
    product[0] = x[0] * y[0];
    return;
  }
  const std::size_t half = x.size() / 2;
  const Numbers x0 = x.first(half), x1 = x.last(half), y0 = y.first(half), y1 = y.last(half);
  const std::span<mpz_class> low = product.first(half), high = product.last(half);
  const bool no_x0 = is_zero(x0), no_x1 = is_zero(x1), no_y0 = is_zero(y0), no_y1 = is_zero(y1);
  if (!no_x0 && !no_y0) multiply(x0, y0, low, level - 1);
  std::vector<mpz_class> squares;
  if (!no_x1 && !no_y1) {
    squares.resize(half);
    multiply(x1, y1, squares, level - 1);
  }
  if (!no_x0 && !no_x1 && !no_y0 && !no_y1) {
    multiply(sum(x0, x1), sum(y0, y1), high, level - 1);
    for (std::size_t i = 0; i < half; ++i) high[i] -= low[i] + squares[i];
  } else if (!no_x0 && !no_y1) {
    multiply(x0, y1, high, level - 1);
  } else if (!no_x1 && !no_y0) {
    multiply(x1, y0, high, level - 1);
  }
  for (std::size_t i = 0; i < squares.size(); ++i)
    if (sgn(squares[i]) != 0) low[i] += squares[i] * classes_[level - 1].radicand;
}

std::optional<RootSum> ProductOfRootSums::result() {
  if (!find_classes(a_, b_)) return std::nullopt;
  make_roots();
  const auto x = factor(a_);
  const auto y = x ? factor(b_) : std::nullopt;
  if (!y) return std::nullopt;
  std::vector<mpz_class> product(roots_.size());
  multiply(x->coefficients, y->coefficients, product, classes_.size());
  RootSum result;
  result.constant_ = std::move(product[0]);
  result.denominator_ = x->denominator * y->denominator;
  for (Place place = 1; place < product.size(); ++place) {
    if (sgn(product[place]) == 0) continue;
    std::uint64_t signature = 0;
    for (std::size_t i = 0; i < classes_.size(); ++i)
      if ((place >> i & 1) != 0) signature ^= classes_[i].signature;
    result.terms_.push_back({product[place] * roots_[place].multiple, roots_[place].radicand, signature});
  }
  result.reduce();
  return result;
}

}  // namespace gvd::robust
