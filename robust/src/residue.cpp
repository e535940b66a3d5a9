#include "residue.hpp"

namespace gvd::robust {

std::uint64_t ResidueField::power(std::uint64_t x, std::uint64_t exponent) const {
  std::uint64_t result = 1;
  for (; exponent != 0; exponent >>= 1) {
    if ((exponent & 1) != 0) result = product(result, x);
    x = product(x, x);
  }
  return result;
}

// A square root among the residues of the integers.
std::optional<std::uint64_t> ResidueField::rational_root(std::uint64_t x) const {
  const std::uint64_t root = power(x, (p_ + 1) / 4);
  if (product(root, root) != x) return std::nullopt;
  return root;
}

// x^((p^2 - 1) / 2) is the norm a^2 + b^2 of x to the power (p - 1) / 2.
bool ResidueField::is_square(const Element& x) const {
  return is_zero(x) || power(sum(product(x.a, x.a), product(x.b, x.b)), (p_ - 1) / 2) == 1;
}

std::optional<ResidueField::Element> ResidueField::root(const Element& x) const {
  if (x.b == 0) {
    if (const auto root = rational_root(x.a)) return Element{*root, 0};
    return Element{0, *rational_root(difference(0, x.a))};
  }
  const auto norm = rational_root(sum(product(x.a, x.a), product(x.b, x.b)));
  if (!norm) return std::nullopt;
  // (s + t i)^2 = x: s^2 = (a +- n) / 2, one of which is a square because their product is -b^2 / 4; and t = b / (2 s).
  const std::uint64_t half = (p_ + 1) / 2;
  auto s = rational_root(product(half, sum(x.a, *norm)));
  if (!s) s = rational_root(product(half, difference(x.a, *norm)));
  const std::uint64_t inverse = power(*s, p_ - 2);
  return Element{*s, product(product(half, x.b), inverse)};
}

}  // namespace gvd::robust
