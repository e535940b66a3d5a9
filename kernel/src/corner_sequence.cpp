#include "corner_sequence.hpp"

namespace gvd::kernel {
namespace {

using predicates::Predicate;
using predicates::operator-;
using robust::MaybeSign;
using robust::Sign;

/// From corner c along the side that starts there, or back along the side that ends there.
template <class NT>
predicates::PlanePoint<NT> direction_from(const FacetNumbers<NT>& numbers, std::size_t c, CornerOrder::Direction direction) {
  if (direction == CornerOrder::Direction::outgoing) return numbers.side[c].direction;
  const auto& d = numbers.side[(c + 2) % 3].direction;
  return {-d.x, -d.y};
}

}  // namespace

std::string CornerOrder::describe(std::size_t c, std::uint32_t p, std::uint32_t q, const char* what) const {
  return std::string(what) + " at corner " + std::to_string(c) + " (vertex " + std::to_string(waves_.corner[c]) + "), " +
         contenders_.name(p) + " and " + contenders_.name(q);
}

/// The derivative of a distance in a direction is minus the cosine of its angle with the direction to the image.
MaybeSign CornerOrder::nearer_beside(std::size_t c, Direction direction, std::uint32_t p, std::uint32_t q) {
  const Contender &a = contenders_[p], &b = contenders_[q];
  if (a.corner == c || b.corner == c) {  // its own distance grows as fast as a distance can
    ladder_.count(Predicate::corner_order, robust::Stage::identity);
    return a.corner == c ? Sign::negative : Sign::positive;
  }
  if (contenders_.mirrored(p, q, direction == Direction::outgoing ? c : (c + 2) % 3) != Sign::zero) {
    ladder_.count(Predicate::corner_order, robust::Stage::identity);
    return Sign::zero;
  }
  const auto test = [&](const auto& numbers) {
    const auto& at = numbers.side[c].origin;
    const auto along = direction_from(numbers, c, direction);
    const auto &ia = numbers.sites[a.site]->image, &ib = numbers.sites[b.site]->image;
    if (a.root == b.root) return maybe_sign(dot(ia - ib, along));
    const auto to_a = ia - at, to_b = ib - at;
    return maybe_sign(dot(to_a, along) * sqrt(squared_norm(to_b)) - dot(to_b, along) * sqrt(squared_norm(to_a)));
  };
  return ladder_.decide(Predicate::corner_order, test, [&] { return describe(c, p, q, "order"); });
}

std::vector<std::uint32_t> CornerOrder::sequence(std::size_t c) {
  std::vector<std::uint32_t> tied;
  for (std::uint32_t i = 0; i < contenders_.size(); ++i)
    if (contenders_[i].corner == c || contenders_[i].attains_corner[c]) tied.push_back(i);
  if (tied.empty()) ladder_.fail(Predicate::corner_order, "no wave attains corner " + std::to_string(c));
  if (tied.size() <= 1) return tied;
  FacetTessellation::Node node;
  node.kind = FacetTessellation::Node::Kind::corner;
  node.where = static_cast<std::uint8_t>(c);
  return Ring(waves_, contenders_, ladder_).regions(node, tied);
}

}  // namespace gvd::kernel
