#include "gvd/robust/square_classes.hpp"

#include "gvd/robust/rational.hpp"

namespace gvd::robust {

std::uint32_t SquareClasses::operator()(const mpq_class& radicand) {
  const std::uint64_t signature = square_class_signature(radicand);
  const auto [first, last] = by_signature_.equal_range(signature);
  for (auto it = first; it != last; ++it)
    if (same_square_class(first_[it->second], radicand)) return it->second;
  const auto id = static_cast<std::uint32_t>(first_.size());
  first_.push_back(radicand);
  root_.emplace_back(1, radicand);
  by_signature_.emplace(signature, id);
  return id;
}

RootSum SquareClasses::root(const mpq_class& radicand) {
  const std::uint32_t id = (*this)(radicand);
  return root_[id] * *rational_square_root(radicand / first_[id]);
}

}  // namespace gvd::robust
