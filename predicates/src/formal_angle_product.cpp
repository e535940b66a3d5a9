#include "formal_angle_product.hpp"

#include <algorithm>

#include "gvd/robust/rational.hpp"

namespace gvd::predicates {

std::optional<FormalAngleProduct> FormalAngleProduct::of(std::span<const ExactCorner> fan, std::size_t most) {
  FormalAngleProduct product;
  std::vector<Root> roots;
  for (const ExactCorner& corner : fan) {
    auto root = product.root_of(corner.cross_square, most);
    if (!root) return std::nullopt;
    roots.push_back(std::move(*root));
  }
  product.x_.resize(std::size_t{1} << product.radicands_.size());
  product.y_ = product.x_;
  product.x_[0] = 1;
  for (std::size_t i = 0; i < fan.size(); ++i) product.multiply(fan[i].dot, roots[i]);
  return product;
}

std::optional<FormalAngleProduct::Root> FormalAngleProduct::root_of(const mpq_class& square, std::size_t most) {
  const std::size_t subsets = std::size_t{1} << radicands_.size();
  for (std::size_t subset = 0; subset < subsets; ++subset) {
    mpq_class quotient = square;
    for (std::size_t k = 0; k < radicands_.size(); ++k) {
      if ((subset >> k & 1) != 0) quotient /= radicands_[k];
    }
    if (auto factor = robust::rational_square_root(quotient)) return Root{std::move(*factor), subset};
  }
  if (radicands_.size() == most) return std::nullopt;
  radicands_.push_back(square);
  return Root{1, subsets};
}

FormalAngleProduct::Number FormalAngleProduct::times(const Number& number, const Root& root) const {
  Number result(number.size());
  for (std::size_t s = 0; s < number.size(); ++s) {
    mpq_class& entry = result[s ^ root.subset];
    entry = number[s] * root.factor;
    for (std::size_t k = 0; k < radicands_.size(); ++k) {
      if ((s & root.subset) >> k & 1) entry *= radicands_[k];
    }
  }
  return result;
}

void FormalAngleProduct::multiply(const mpq_class& dot, const Root& root) {
  const Number x_root = times(x_, root), y_root = times(y_, root);
  for (std::size_t s = 0; s < x_.size(); ++s) {
    x_[s] = x_[s] * dot - y_root[s];
    y_[s] = y_[s] * dot + x_root[s];
  }
}

robust::MaybeSign FormalAngleProduct::imaginary_sign(int quarters) const {
  const Number& part = quarters % 2 == 0 ? y_ : x_;
  if (std::all_of(part.begin(), part.end(), [](const mpq_class& q) { return q == 0; })) return robust::Sign::zero;
  const bool one_term = std::count_if(part.begin(), part.end(), [](const mpq_class& q) { return q != 0; }) == 1;
  if (!one_term) return std::nullopt;
  const auto term = std::find_if(part.begin(), part.end(), [](const mpq_class& q) { return q != 0; });
  const auto sign = sgn(*term) > 0 ? robust::Sign::positive : robust::Sign::negative;
  // Im(z / i^q) is y, -x, -y, x.
  return quarters % 4 == 1 || quarters % 4 == 2 ? -sign : sign;
}

}  // namespace gvd::predicates
