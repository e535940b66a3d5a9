#include "gvd/robust/exact.hpp"

#include <atomic>
#include <cmath>
#include <mutex>
#include <unordered_map>
#include <variant>
#include <vector>

#include "correct_rounding.hpp"
#include "gvd/robust/proof_limit.hpp"
#include "gvd/robust/rational.hpp"
#include "root_sum_interval.hpp"
#include "root_tower.hpp"

namespace gvd::robust {

namespace {

enum class Operation : char { negate, add, subtract, multiply, divide, root };

using NodePtr = std::shared_ptr<const Exact::Node>;

struct Expression {
  Operation operation;
  NodePtr left, right;  // right is empty for negate and root
};

struct Deferred {
  std::function<Exact()> make;
};

}  // namespace

/// A vertex of an expression graph. Immutable but for what is remembered, which is the same whoever computes it. Only an Exact that was not used yet
/// refers to a deferred one, never another node.
class Exact::Node {
 public:
  explicit Node(RootSum value);
  explicit Node(Expression expression);
  explicit Node(Deferred deferred) : what_(std::move(deferred)) {}

  bool is_deferred() const { return std::holds_alternative<Deferred>(what_); }
  const Exact& made() const {
    std::call_once(make_, [&] { made_ = std::get<Deferred>(what_).make(); });
    return made_;
  }
  const RootSum* sum() const { return std::get_if<RootSum>(&what_); }
  const Expression& expression() const { return std::get<Expression>(what_); }
  MaybeSign sign() const;

 private:
  MaybeSign decide_sign() const;

  static constexpr signed char kUnknown = 2, kOutOfReach = 3;
  std::variant<RootSum, Expression, Deferred> what_;
  mutable std::atomic<signed char> sign_ = kUnknown;
  mutable std::once_flag make_;
  mutable Exact made_ = Exact(NodePtr());
};

namespace {

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
    if (const RootSum* leaf = node.sum()) return evaluated(*leaf, bits_);
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

// Brings an expression into the normal form of a tower of quadratic extensions.
class TowerEvaluation {
 public:
  // Whether the number is zero; empty if that costs too much.
  std::optional<bool> is_zero(const Exact::Node& node) {
    const bool zero = of(node).numerator.is_zero();
    if (tower_.is_exhausted()) return std::nullopt;
    return zero;
  }

 private:
  const TowerFraction& of(const Exact::Node& node) {
    const auto known = values_.find(&node);
    if (known != values_.end()) return known->second;
    return values_.emplace(&node, compute(node)).first->second;
  }
  TowerFraction compute(const Exact::Node& node) {
    if (tower_.is_exhausted()) return {};
    if (const RootSum* leaf = node.sum()) return tower_.fraction(*leaf);
    const Expression& e = node.expression();
    const TowerFraction& left = of(*e.left);
    if (e.operation == Operation::negate) return tower_.negate(left);
    if (e.operation == Operation::root) return tower_.root(left);
    const TowerFraction& right = of(*e.right);
    switch (e.operation) {
      case Operation::add:
        return tower_.add(left, right);
      case Operation::subtract:
        return tower_.add(left, tower_.negate(right));
      case Operation::multiply:
        return tower_.multiply(left, right);
      default:
        return tower_.multiply(left, {right.denominator, right.numerator});
    }
  }

  RootTower tower_;
  std::unordered_map<const Exact::Node*, TowerFraction> values_;  // references stay valid
};

constexpr int kFirstBits = 128;
// How long to look for a sign other than zero if zero could be neither proved nor excluded.
constexpr int kBitsWithoutProof = 1 << 14;

NodePtr make(RootSum value) { return std::make_shared<const Exact::Node>(std::move(value)); }
NodePtr make(Operation operation, NodePtr left, NodePtr right = nullptr) {
  return std::make_shared<const Exact::Node>(Expression{operation, std::move(left), std::move(right)});
}

// Larger products are left as expressions: those of coordinates over more than six classes (predicates::kMostTerms terms each, and a constant).
constexpr std::size_t kMostProducts = 33 * 33;
bool is_short_product(const RootSum& x, const RootSum& y) { return (x.terms().size() + 1) * (y.terms().size() + 1) <= kMostProducts; }

// 1 / x, if x is a rational, a multiple of one root, or of a real quadratic field. Pre: x is not zero.
std::optional<RootSum> inverse(const RootSum& x) {
  if (x.terms().size() > 1) return std::nullopt;
  if (x.terms().empty()) return RootSum(mpq_class(1 / x.constant()));
  const mpz_class& radicand = x.terms().front().radicand;
  const mpq_class coefficient = x.coefficient(x.terms().front()), constant = x.constant();
  RootSum conjugate(constant);
  conjugate.add(-coefficient, radicand);
  return conjugate * mpq_class(1 / (constant * constant - coefficient * coefficient * radicand));
}

// The non-negative root of a rational, or of an element of a real quadratic field that is a square there. Pre: x >= 0.
std::optional<RootSum> square_root(const RootSum& x) {
  if (x.terms().empty()) return RootSum(1, x.constant());
  if (x.terms().size() > 1) return std::nullopt;
  // (s + t sqrt d)^2 = a + b sqrt d has the norm n^2 = a^2 - b^2 d, so s^2 = (a +- n) / 2 and t = b / (2 s); s is not zero because b is not.
  const mpz_class& d = x.terms().front().radicand;
  const mpq_class b = x.coefficient(x.terms().front()), a = x.constant();
  const auto n = rational_square_root(a * a - b * b * d);
  if (!n) return std::nullopt;
  for (const mpq_class& s_squared : {mpq_class((a + *n) / 2), mpq_class((a - *n) / 2)}) {
    const auto s = rational_square_root(s_squared);
    if (!s) continue;
    RootSum root(*s);
    root.add(b / (2 * *s), d);
    return root.sign() == Sign::negative ? -root : root;
  }
  return std::nullopt;
}

bool is_plain_zero(const NodePtr& node) { return node->sum() && node->sum()->is_zero(); }

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

Exact::Node::Node(RootSum value) : what_(std::move(value)) {}
Exact::Node::Node(Expression e) : what_(std::move(e)) {}

MaybeSign Exact::Node::sign() const {
  signed char known = sign_.load(std::memory_order_relaxed);
  if (known == kUnknown) {
    if (!ProofLimit::allows_one()) return std::nullopt;
    const MaybeSign decided = decide_sign();
    known = decided ? static_cast<signed char>(*decided) : kOutOfReach;
    sign_.store(known, std::memory_order_relaxed);
  }
  if (known == kOutOfReach) return std::nullopt;
  return static_cast<Sign>(known);
}

MaybeSign Exact::Node::decide_sign() const {
  if (const RootSum* leaf = sum()) return leaf->sign();
  bool is_not_zero = false;
  for (int bits = kFirstBits; is_not_zero || bits <= kBitsWithoutProof; bits *= 2) {
    Evaluation evaluation(bits);
    if (const MaybeSign sign = evaluation.of(*this).sign()) return sign;
    if (bits != 4 * kFirstBits) continue;
    const auto zero = TowerEvaluation().is_zero(*this);
    if (zero == true) return Sign::zero;
    is_not_zero = zero == false;
  }
  return std::nullopt;
}

Exact::Exact(double x) : node_(std::isfinite(x) ? make(RootSum(mpq_class(x))) : nullptr) {}
Exact::Exact(const mpq_class& q) : node_(make(RootSum(q))) {}
Exact::Exact(RootSum sum) : node_(make(std::move(sum))) {}

Exact Exact::deferred(std::function<Exact()> make) { return Exact(std::make_shared<const Node>(Deferred{std::move(make)})); }

const NodePtr& Exact::node() const { return node_ && node_->is_deferred() ? node_->made().node() : node_; }

Exact operator-(const Exact& a) {
  if (!a.node()) return a;
  if (const RootSum* leaf = a.node()->sum()) return Exact(make(-*leaf));
  return Exact(make(Operation::negate, a.node()));
}

Exact operator+(const Exact& a, const Exact& b) {
  if (!a.node() || !b.node()) return Exact(NodePtr());
  if (is_plain_zero(a.node())) return b;
  if (is_plain_zero(b.node())) return a;
  if (a.node()->sum() && b.node()->sum()) return Exact(make(*a.node()->sum() + *b.node()->sum()));
  return Exact(make(Operation::add, a.node(), b.node()));
}

Exact operator-(const Exact& a, const Exact& b) {
  if (!a.node() || !b.node()) return Exact(NodePtr());
  if (a.node() == b.node()) return Exact();
  if (is_plain_zero(b.node())) return a;
  if (a.node()->sum() && b.node()->sum()) return Exact(make(*a.node()->sum() - *b.node()->sum()));
  return Exact(make(Operation::subtract, a.node(), b.node()));
}

Exact operator*(const Exact& a, const Exact& b) {
  if (!a.node() || !b.node()) return Exact(NodePtr());
  if (is_plain_zero(a.node())) return a;
  if (is_plain_zero(b.node())) return b;
  if (const RootSum *x = a.node()->sum(), *y = b.node()->sum(); x && y && is_short_product(*x, *y)) return Exact(make(*x * *y));
  return Exact(make(Operation::multiply, a.node(), b.node()));
}

Exact operator/(const Exact& a, const Exact& b) {
  if (!a.node() || !b.node()) return Exact(NodePtr());
  const MaybeSign sign = b.node()->sign();
  if (!sign || *sign == Sign::zero) return Exact(NodePtr());
  if (is_plain_zero(a.node())) return a;
  if (const RootSum *x = a.node()->sum(), *y = b.node()->sum(); x && y)
    if (const auto divisor = inverse(*y)) return Exact(make(*x * *divisor));  // of two terms at most
  return Exact(make(Operation::divide, a.node(), b.node()));
}

Exact sqrt(const Exact& a) {
  const MaybeSign sign = maybe_sign(a);
  if (!sign || *sign == Sign::negative) return Exact(NodePtr());
  if (*sign == Sign::zero) return Exact();
  if (const RootSum* leaf = a.node()->sum())
    if (auto root = square_root(*leaf)) return Exact(make(std::move(*root)));
  return Exact(make(Operation::root, a.node()));
}

Exact abs(const Exact& a) {
  const MaybeSign sign = maybe_sign(a);
  if (!sign) return Exact(NodePtr());
  return *sign == Sign::negative ? -a : a;
}

Exact Exact::scaled(int k) const { return *this * Exact(power_of_two(k)); }

MaybeSign maybe_sign(const Exact& a) { return a.node() ? a.node()->sign() : std::nullopt; }

std::optional<double> rounded(const Exact& a) {
  if (!maybe_sign(a)) return std::nullopt;
  return correctly_rounded([&](int bits) { return *narrow_interval(*a.node(), bits); },
                           [&](const mpq_class& q) { return maybe_sign(a - Exact(q)); });
}

Ball<Mpfr> Exact::enclosure(int bits) const {
  if (node())
    if (const auto interval = narrow_interval(*node(), bits)) return interval->to_ball();
  return {Mpfr(0.0, bits), std::numeric_limits<double>::infinity()};
}

std::optional<std::pair<mpq_class, mpq_class>> Exact::bounds(int bits) const {
  if (const auto value = rational()) return std::pair{*value, *value};
  if (!node()) return std::nullopt;
  const auto interval = narrow_interval(*node(), bits);
  if (!interval) return std::nullopt;
  return std::pair{interval->low().to_mpq(), interval->high().to_mpq()};
}

std::optional<mpq_class> Exact::rational() const {
  if (!node() || !node()->sum() || !node()->sum()->terms().empty()) return std::nullopt;
  return node()->sum()->constant();
}

template <>
Exact from<Exact>(const mpq_class& q, int) {
  return Exact(q);
}

}  // namespace gvd::robust
