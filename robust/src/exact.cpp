#include "gvd/robust/exact.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <variant>
#include <vector>

#include "correct_rounding.hpp"
#include "gvd/robust/rational.hpp"
#include "quadratic.hpp"

namespace gvd::robust {

namespace {

enum class Operation : char { negate, add, subtract, multiply, divide, root };

using NodePtr = std::shared_ptr<const Exact::Node>;

struct Expression {
  Operation operation;
  NodePtr left, right;  // right is empty for negate and root
};

// The number is a quotient of two algebraic integers whose conjugates are all at most 2^numerator, 2^denominator in magnitude.
struct ConjugateBits {
  long numerator = 0, denominator = 0;
};

}  // namespace

/// A vertex of an expression graph. Immutable but for the remembered sign, which is the same whoever computes it.
class Exact::Node {
 public:
  explicit Node(Quadratic value);
  explicit Node(Expression expression);

  const Quadratic* quadratic() const { return std::get_if<Quadratic>(&what_); }
  const Expression& expression() const { return std::get<Expression>(what_); }
  const ConjugateBits& conjugate_bits() const { return bits_; }
  MaybeSign sign() const;

 private:
  MaybeSign decide_sign() const;

  static constexpr signed char kUnknown = 2, kOutOfReach = 3;
  std::variant<Quadratic, Expression> what_;
  ConjugateBits bits_;
  mutable std::atomic<signed char> sign_ = kUnknown;
};

namespace {

// Bits are capped far above Exact::kMostBits, so that they cannot overflow.
constexpr long kBitsCap = 1L << 40;

long capped(long bits) { return std::min(bits, kBitsCap); }

// The least k >= 0 with |n| <= 2^k.
long magnitude_bits(const mpz_class& n) {
  const mpz_class less = abs(n) - 1;
  return sgn(less) <= 0 ? 0 : static_cast<long>(mpz_sizeinbase(less.get_mpz_t(), 2));
}

ConjugateBits conjugate_bits_of(const Quadratic& x) {
  const mpz_class denominator = lcm(x.a.get_den(), x.b.get_den());
  const mpq_class a = x.a * denominator, b = x.b * denominator;  // integers
  const long rational = magnitude_bits(a.get_num());
  if (x.is_rational()) return {rational, magnitude_bits(denominator)};
  const long irrational = magnitude_bits(b.get_num()) + (magnitude_bits(x.d) + 1) / 2;
  return {std::max(rational, irrational) + 1, magnitude_bits(denominator)};
}

// The rules of Burnikel et al. 2001, in powers of two.
ConjugateBits conjugate_bits_of(const Expression& e) {
  const auto [u1, l1] = e.left->conjugate_bits();
  const auto [u2, l2] = e.right ? e.right->conjugate_bits() : ConjugateBits{};
  switch (e.operation) {
    case Operation::negate:
      return {u1, l1};
    case Operation::add:
    case Operation::subtract:
      return {capped(std::max(u1 + l2, l1 + u2) + 1), capped(l1 + l2)};
    case Operation::multiply:
      return {capped(u1 + u2), capped(l1 + l2)};
    case Operation::divide:
      return {capped(u1 + l2), capped(l1 + u2)};
    case Operation::root:
      break;
  }
  const long mean = (u1 + l1 + 1) / 2;  // sqrt(p / q) = sqrt(p q) / q = p / sqrt(p q)
  return u1 >= l1 ? ConjugateBits{mean, l1} : ConjugateBits{u1, mean};
}

// Counts the square roots that have to be adjoined to the rationals: those of expressions and those of quadratic fields, each once.
class RootCounter {
 public:
  void visit(const NodePtr& node) {
    if (!seen_.insert(node.get()).second) return;
    if (const Quadratic* leaf = node->quadratic()) {
      if (!leaf->is_rational()) count_field(leaf->d);
      return;
    }
    const Expression& e = node->expression();
    visit(e.left);
    if (e.right) visit(e.right);
    if (e.operation == Operation::root) count_root(*e.left);
  }
  std::size_t count() const { return fields_.size() + radicands_.size() + other_roots_; }

 private:
  void count_field(const mpz_class& d) {
    for (const mpz_class& known : fields_)
      if (mpz_perfect_square_p(mpz_class(known * d).get_mpz_t())) return;
    fields_.push_back(d);
  }
  void count_root(const Exact::Node& radicand) {
    const Quadratic* leaf = radicand.quadratic();
    if (!leaf)
      ++other_roots_;
    else if (std::none_of(radicands_.begin(), radicands_.end(), [&](const Quadratic* known) { return *known == *leaf; }))
      radicands_.push_back(leaf);
  }

  std::unordered_set<const Exact::Node*> seen_;
  std::vector<mpz_class> fields_;
  std::vector<const Quadratic*> radicands_;
  std::size_t other_roots_ = 0;
};

// The number is zero or at least 2^-result in magnitude: the norm of its numerator, an algebraic integer of degree at most D, is
// at least 1.
long separation_bits(const Exact::Node& node) {
  RootCounter roots;
  roots.visit(NodePtr(NodePtr(), &node));  // does not own
  const auto [numerator, denominator] = node.conjugate_bits();
  const std::size_t count = roots.count();
  if (count > 20) return kBitsCap;
  return capped(((1L << count) - 1) * numerator + denominator);
}

class Evaluation {
 public:
  explicit Evaluation(int bits) : bits_(bits) {}

  const MpfrInterval& of(const Exact::Node& node) {
    const auto known = values_.find(&node);
    if (known != values_.end()) return known->second;
    return values_.emplace(&node, compute(node)).first->second;
  }

 private:
  MpfrInterval compute(const Exact::Node& node) {
    if (const Quadratic* leaf = node.quadratic()) return leaf->enclosure(bits_);
    const Expression& e = node.expression();
    switch (e.operation) {
      case Operation::negate:
        return -of(*e.left);
      case Operation::root:
        return sqrt(of(*e.left));
      case Operation::add:
        return of(*e.left) + of(*e.right);
      case Operation::subtract:
        return of(*e.left) - of(*e.right);
      case Operation::multiply:
        return of(*e.left) * of(*e.right);
      case Operation::divide:
        break;
    }
    return of(*e.left) / of(*e.right);
  }

  int bits_;
  std::unordered_map<const Exact::Node*, MpfrInterval> values_;  // references stay valid
};

constexpr int kFirstBits = 128;
// How long to look for a sign other than zero if zero could not be proved.
constexpr long kBitsWithoutProof = 1L << 14;

NodePtr make(Quadratic value) { return std::make_shared<const Exact::Node>(std::move(value)); }
NodePtr make(Operation operation, NodePtr left, NodePtr right = nullptr) {
  return std::make_shared<const Exact::Node>(Expression{operation, std::move(left), std::move(right)});
}

// The result in normal form if both operands have one and share a field.
template <class Function>
NodePtr in_normal_form(const NodePtr& a, const NodePtr& b, const Function& function) {
  if (!a->quadratic() || !b->quadratic()) return nullptr;
  if (auto value = function(*a->quadratic(), *b->quadratic())) return make(std::move(*value));
  return nullptr;
}

bool is_plain_zero(const NodePtr& node) { return node->quadratic() && node->sign() == Sign::zero; }

// An interval of relative width at most 2^-bits; empty if the sign is out of reach.
std::optional<MpfrInterval> narrow_interval(const Exact::Node& node, int bits) {
  const MaybeSign sign = node.sign();
  if (!sign) return std::nullopt;
  if (*sign == Sign::zero) return MpfrInterval(bits);
  for (int working = bits + 32;; working *= 2) {
    Evaluation evaluation(working);
    const MpfrInterval& value = evaluation.of(node);
    if (value.is_narrow(bits)) return value;
  }
}

}  // namespace

Exact::Node::Node(Quadratic value) : what_(std::move(value)), bits_(conjugate_bits_of(*quadratic())) {}
Exact::Node::Node(Expression e) : what_(std::move(e)), bits_(conjugate_bits_of(expression())) {}

MaybeSign Exact::Node::sign() const {
  signed char known = sign_.load(std::memory_order_relaxed);
  if (known == kUnknown) {
    const MaybeSign decided = decide_sign();
    known = decided ? static_cast<signed char>(*decided) : kOutOfReach;
    sign_.store(known, std::memory_order_relaxed);
  }
  if (known == kOutOfReach) return std::nullopt;
  return static_cast<Sign>(known);
}

MaybeSign Exact::Node::decide_sign() const {
  if (const Quadratic* leaf = quadratic()) return leaf->sign();
  std::optional<long> separation;
  for (long bits = kFirstBits; !separation || bits <= (*separation <= kMostBits ? 4 * kMostBits : kBitsWithoutProof); bits *= 2) {
    Evaluation evaluation(static_cast<int>(bits));
    const MpfrInterval& value = evaluation.of(*this);
    if (const MaybeSign sign = value.sign()) return sign;
    if (!separation) separation = separation_bits(*this);
    if (value.is_below_power_of_two(-*separation)) return Sign::zero;
  }
  return std::nullopt;
}

Exact::Exact(double x) : node_(std::isfinite(x) ? make(Quadratic{mpq_class(x), 0}) : nullptr) {}
Exact::Exact(const mpq_class& q) : node_(make(Quadratic{q, 0})) {}

Exact operator-(const Exact& a) {
  if (!a.node_) return a;
  if (const Quadratic* leaf = a.node_->quadratic()) return Exact(make(negate(*leaf)));
  return Exact(make(Operation::negate, a.node_));
}

Exact operator+(const Exact& a, const Exact& b) {
  if (!a.node_ || !b.node_) return Exact(NodePtr());
  if (is_plain_zero(a.node_)) return b;
  if (is_plain_zero(b.node_)) return a;
  if (auto sum = in_normal_form(a.node_, b.node_, add)) return Exact(std::move(sum));
  return Exact(make(Operation::add, a.node_, b.node_));
}

Exact operator-(const Exact& a, const Exact& b) {
  if (!a.node_ || !b.node_) return Exact(NodePtr());
  if (a.node_ == b.node_) return Exact();
  if (is_plain_zero(b.node_)) return a;
  const auto subtract = [](const Quadratic& x, const Quadratic& y) { return add(x, negate(y)); };
  if (auto difference = in_normal_form(a.node_, b.node_, subtract)) return Exact(std::move(difference));
  return Exact(make(Operation::subtract, a.node_, b.node_));
}

Exact operator*(const Exact& a, const Exact& b) {
  if (!a.node_ || !b.node_) return Exact(NodePtr());
  if (is_plain_zero(a.node_)) return a;
  if (is_plain_zero(b.node_)) return b;
  if (auto product = in_normal_form(a.node_, b.node_, multiply)) return Exact(std::move(product));
  return Exact(make(Operation::multiply, a.node_, b.node_));
}

Exact operator/(const Exact& a, const Exact& b) {
  if (!a.node_ || !b.node_) return Exact(NodePtr());
  const MaybeSign sign = b.node_->sign();
  if (!sign || *sign == Sign::zero) return Exact(NodePtr());
  if (is_plain_zero(a.node_)) return a;
  if (auto quotient = in_normal_form(a.node_, b.node_, divide)) return Exact(std::move(quotient));
  return Exact(make(Operation::divide, a.node_, b.node_));
}

Exact sqrt(const Exact& a) {
  const MaybeSign sign = maybe_sign(a);
  if (!sign || *sign == Sign::negative) return Exact(NodePtr());
  if (*sign == Sign::zero) return Exact();
  if (const Quadratic* leaf = a.node_->quadratic())
    if (auto root = square_root(*leaf)) return Exact(make(std::move(*root)));
  return Exact(make(Operation::root, a.node_));
}

Exact abs(const Exact& a) {
  const MaybeSign sign = maybe_sign(a);
  if (!sign) return Exact(NodePtr());
  return *sign == Sign::negative ? -a : a;
}

Exact Exact::scaled(int k) const { return *this * Exact(power_of_two(k)); }

MaybeSign maybe_sign(const Exact& a) { return a.node_ ? a.node_->sign() : std::nullopt; }

std::optional<double> rounded(const Exact& a) {
  if (!maybe_sign(a)) return std::nullopt;
  return correctly_rounded([&](int bits) { return *narrow_interval(*a.node_, bits); },
                           [&](const mpq_class& q) { return maybe_sign(a - Exact(q)); });
}

Ball<Mpfr> Exact::enclosure(int bits) const {
  if (node_)
    if (const auto interval = narrow_interval(*node_, bits)) return interval->to_ball();
  return {Mpfr(0.0, bits), std::numeric_limits<double>::infinity()};
}

std::optional<std::pair<mpq_class, mpq_class>> Exact::bounds(int bits) const {
  if (const auto value = rational()) return std::pair{*value, *value};
  if (!node_) return std::nullopt;
  const auto interval = narrow_interval(*node_, bits);
  if (!interval) return std::nullopt;
  return std::pair{interval->low().to_mpq(), interval->high().to_mpq()};
}

std::optional<mpq_class> Exact::rational() const {
  if (!node_ || !node_->quadratic() || !node_->quadratic()->is_rational()) return std::nullopt;
  return node_->quadratic()->a;
}

template <>
Exact from<Exact>(const mpq_class& q, int) {
  return Exact(q);
}

}  // namespace gvd::robust
