#include "span_test.hpp"

#include <algorithm>
#include <map>

namespace gvd::robust {

// The longest common subsequence of the radicands.
Alignment aligned(const RootProgram& a, const RootProgram& b) {
  const std::size_t m = a.layers().size(), n = b.layers().size();
  std::map<mpz_class, std::uint32_t> ids;
  const auto ids_of = [&](const RootProgram& program) {
    std::vector<std::uint32_t> list;
    for (const auto& layer : program.layers()) list.push_back(ids.try_emplace(layer.radicand, ids.size()).first->second);
    return list;
  };
  const std::vector<std::uint32_t> x = ids_of(a), y = ids_of(b);
  std::vector<std::uint32_t> length((m + 1) * (n + 1), 0);  // of the common subsequence of what follows i and j
  const auto at = [&](std::size_t i, std::size_t j) -> std::uint32_t& { return length[i * (n + 1) + j]; };
  for (std::size_t i = m; i-- > 0;)
    for (std::size_t j = n; j-- > 0;) at(i, j) = x[i] == y[j] ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
  Alignment result;
  result.common = at(0, 0);
  for (std::size_t i = 0, j = 0; i < m || j < n;) {
    if (i < m && j < n && x[i] == y[j])
      result.steps.push_back({static_cast<int>(i++), static_cast<int>(j++)});
    else if (j == n || (i < m && at(i + 1, j) >= at(i, j + 1)))
      result.steps.push_back({static_cast<int>(i++), AlignedStep::kNone});
    else
      result.steps.push_back({AlignedStep::kNone, static_cast<int>(j++)});
  }
  return result;
}

SpanTest::SpanTest(const RootProgram& a, const RootProgram& b, const Alignment& alignment, Unknowns unknowns) : a_(a), b_(b) {
  std::map<mpz_class, std::size_t> of_radicand;
  std::vector<std::size_t> last_use;
  for (const AlignedStep& aligned : alignment.steps) {
    Step step{};
    const auto& layer = aligned.a != AlignedStep::kNone ? a.layers()[static_cast<std::size_t>(aligned.a)] : b.layers()[static_cast<std::size_t>(aligned.b)];
    step.radicand = &layer.radicand;
    step.in_a = aligned.a != AlignedStep::kNone;
    step.in_b = aligned.b != AlignedStep::kNone;
    if (step.in_a) add_entries(step, a.layers()[static_cast<std::size_t>(aligned.a)], 0);
    if (step.in_b) add_entries(step, b.layers()[static_cast<std::size_t>(aligned.b)], RootProgram::kSize);
    step.unknown = last_use.size();
    if (unknowns == Unknowns::of_radicands) step.unknown = of_radicand.try_emplace(layer.radicand, last_use.size()).first->second;
    step.opens = step.unknown == last_use.size();
    if (step.opens) last_use.push_back(0);
    last_use[step.unknown] = steps_.size();
    steps_.push_back(std::move(step));
  }
  std::size_t open = 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    Step& step = steps_[i];
    step.closes = last_use[step.unknown] == i;
    open += step.opens && !step.closes;
    open -= !step.opens && step.closes;
    feasible_ = feasible_ && open <= kMostOpen;
  }
  const mpz_class common = gcd(a.denominator(), b.denominator());
  a_denominator_ = a.denominator() / common;
  b_denominator_ = b.denominator() / common;
}

void SpanTest::add_entries(Step& step, const RootProgram::Layer& layer, std::size_t offset) const {
  for (std::size_t i = 0; i < RootProgram::kSize; ++i)
    for (std::size_t j = 0; j < RootProgram::kSize; ++j) {
      const auto row = static_cast<std::uint8_t>(i + offset), column = static_cast<std::uint8_t>(j + offset);
      if (sgn(layer.constant[i][j]) != 0) step.entries.push_back({row, column, false, &layer.constant[i][j]});
      if (sgn(layer.factor[i][j]) != 0) step.entries.push_back({row, column, true, &layer.factor[i][j]});
    }
}

namespace {

// n <= 2^result
long bits_above(const mpz_class& n) { return sgn(n) == 0 ? 0 : static_cast<long>(mpz_sizeinbase(n.get_mpz_t(), 2)); }

// Of the sum of the magnitudes c sqrt(r) of all coefficients of the number, times its denominator: docs/exactness.md#span-test.
long magnitude_bits(const RootProgram& program) {
  mpz_class first = 0, last = 0;
  for (const mpz_class& x : program.first()) first = std::max(first, mpz_class(abs(x)));
  for (const mpz_class& x : program.last()) last += abs(x);
  long bits = bits_above(first) + bits_above(last);
  for (const auto& layer : program.layers()) {
    const mpz_class root = sqrt(layer.radicand) + 1;
    mpz_class most = 0;
    for (std::size_t i = 0; i < RootProgram::kSize; ++i) {
      mpz_class row = 0;
      for (std::size_t j = 0; j < RootProgram::kSize; ++j) row += abs(layer.constant[i][j]) + root * abs(layer.factor[i][j]);
      most = std::max(most, row);
    }
    bits += bits_above(most);
  }
  return bits;
}

}  // namespace

long SpanTest::coefficient_bits() const {
  return std::max(magnitude_bits(a_) + bits_above(b_denominator_), magnitude_bits(b_) + bits_above(a_denominator_)) + 1;
}

/// The test modulo one prime.
class SpanTest::Run {
 public:
  Run(const SpanTest& test, std::uint64_t prime) : test_(test), field_(prime) {}

  bool is_zero() {
    for (const RootProgram* program : {&test_.a_, &test_.b_})
      for (const mpz_class& x : program->first()) states_.push_back(field_.of(x));
    for (const Step& step : test_.steps_) take(step);
    std::array<Word, kBlock> functional;
    const Word of_a = field_.of(test_.b_denominator_), of_b = field_.of(test_.a_denominator_);
    for (std::size_t i = 0; i < RootProgram::kSize; ++i) {
      functional[i] = field_.multiply(of_a, field_.of(test_.a_.last()[i]));
      functional[RootProgram::kSize + i] = field_.subtract(0, field_.multiply(of_b, field_.of(test_.b_.last()[i])));
    }
    for (std::size_t state = 0; state < states_.size(); state += kBlock) {
      Word sum = 0;
      for (std::size_t i = 0; i < kBlock; ++i) sum = field_.add(sum, field_.multiply(functional[i], states_[state + i]));
      if (sum != 0) return false;
    }
    return true;
  }

 private:
  /// From each state to one with the root, or to two, the coefficients of 1 and of the root.
  void take(const Step& step) {
    residues_.clear();
    for (const Entry& entry : step.entries) residues_.push_back(field_.of(*entry.value));
    radicand_ = field_.of(*step.radicand);
    const std::size_t old_width = width_;
    if (step.opens && !step.closes) {
      open_.push_back(step.unknown);
      width_ *= 2;
    }
    const auto place = std::find(open_.begin(), open_.end(), step.unknown);
    const std::size_t bit = std::size_t{1} << (place - open_.begin());
    const std::size_t count = states_.size() / old_width, new_width = step.closes && !step.opens ? width_ / 2 : width_;
    next_.assign(count * (step.closes ? 2 : 1) * new_width, 0);
    Word* to = next_.data();
    for (std::size_t i = 0; i < count; ++i, to += (step.closes ? 2 : 1) * new_width) {
      const Word* state = &states_[i * old_width];
      if (step.opens && step.closes) {
        for (std::size_t block = 0; block < width_; block += kBlock) apply(step, state + block, to + block, to + width_ + block);
      } else {
        extended_.assign(state, state + old_width);
        extended_.resize(width_, 0);
        move_with_root(step, bit);
        for (std::size_t block = 0; block * kBlock < width_; ++block) {
          const std::size_t target = step.closes ? without_bit(block, bit) * kBlock + ((block & bit) != 0 ? new_width : 0) : block * kBlock;
          std::copy_n(&moved_[block * kBlock], kBlock, to + target);
        }
      }
    }
    if (step.closes && !step.opens) open_.erase(place);
    width_ = new_width;
    states_.swap(next_);
    if (step.closes) reduce_to_basis();
  }

  /// The number of a block when the root of `bit` is no longer in use.
  static std::size_t without_bit(std::size_t block, std::size_t bit) { return (block & (bit - 1)) | (block >> 1 & ~(bit - 1)); }

  /// Adds both parts of the layer times one block. A program that is not in the step stays as it is.
  void apply(const Step& step, const Word* state, Word* constant, Word* factor) const {
    for (std::size_t i = 0; i < kBlock; ++i)
      if (!(i < RootProgram::kSize ? step.in_a : step.in_b)) constant[i] = field_.add(constant[i], state[i]);
    for (std::size_t e = 0; e < step.entries.size(); ++e) {
      const Entry& entry = step.entries[e];
      Word& to = (entry.factor ? factor : constant)[entry.row];
      to = field_.add(to, field_.multiply(residues_[e], state[entry.column]));
    }
  }

  /// From extended_ to moved_. The root multiplies into the products of roots: its square is the radicand.
  void move_with_root(const Step& step, std::size_t bit) {
    moved_.assign(width_, 0);
    for (std::size_t block = 0; block * kBlock < width_; ++block) {
      std::array<Word, kBlock> factor{};
      apply(step, &extended_[block * kBlock], &moved_[block * kBlock], factor.data());
      Word* to = &moved_[(block ^ bit) * kBlock];
      for (std::size_t i = 0; i < kBlock; ++i)
        to[i] = field_.add(to[i], (block & bit) != 0 ? field_.multiply(radicand_, factor[i]) : factor[i]);
    }
  }

  /// Of the span of the states, by elimination without division.
  void reduce_to_basis() {
    pivots_.clear();
    Word* const begin = states_.data();
    for (std::size_t from = 0; from < states_.size(); from += width_) {
      Word* const v = begin + from;
      for (std::size_t k = 0; k < pivots_.size(); ++k) {
        const Word factor = v[pivots_[k]];
        const Word* const row = begin + k * width_;
        if (factor == 0) continue;
        const Word leading = row[pivots_[k]];
        for (std::size_t i = 0; i < width_; ++i) v[i] = field_.subtract(field_.multiply(leading, v[i]), field_.multiply(factor, row[i]));
      }
      const std::size_t pivot = static_cast<std::size_t>(std::find_if(v, v + width_, [](Word x) { return x != 0; }) - v);
      if (pivot == width_) continue;
      std::copy_n(v, width_, begin + pivots_.size() * width_);
      pivots_.push_back(pivot);
    }
    states_.resize(pivots_.size() * width_);
  }

  const SpanTest& test_;
  PrimeField field_;
  std::size_t width_ = kBlock;  // of a state
  std::vector<Word> states_, next_, extended_, moved_;
  std::vector<std::size_t> open_;  // unknowns in use; that of bit k of the number of a block is the k-th
  std::vector<Word> residues_;     // of the entries of a step
  Word radicand_ = 0;
  std::vector<std::size_t> pivots_;
};

bool SpanTest::proves_equal() const {
  if (!feasible_) return false;
  constexpr long kBitsOfPrime = 61;
  const long bits = coefficient_bits();
  for (std::size_t i = 0; static_cast<long>(i) * kBitsOfPrime <= bits; ++i)
    if (!Run(*this, large_prime(i)).is_zero()) return false;
  return true;
}

}  // namespace gvd::robust
