#include "span_test.hpp"

#include <algorithm>
#include <map>
#include <span>

#include "root_basis.hpp"

namespace gvd::robust {

namespace {

using Ids = std::span<const std::uint32_t>;

// The longest common subsequence; of lists for which that takes too much memory, none. Steps count from `start`.
void align(Ids x, Ids y, std::size_t start, Alignment& result) {
  constexpr std::size_t kMostEntries = std::size_t{1} << 26;  // a quarter of a gigabyte
  const std::size_t m = x.size(), n = y.size();
  const bool none = (m + 1) * (n + 1) > kMostEntries;
  std::vector<std::uint32_t> length(none ? 0 : (m + 1) * (n + 1), 0);  // of the common subsequence of what follows i and j
  const auto at = [&](std::size_t i, std::size_t j) -> std::uint32_t& { return length[i * (n + 1) + j]; };
  for (std::size_t i = none ? 0 : m; i-- > 0;)
    for (std::size_t j = n; j-- > 0;) at(i, j) = x[i] == y[j] ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
  result.common += none ? 0 : at(0, 0);
  for (std::size_t i = 0, j = 0; i < m || j < n;) {
    const auto side_by_side = [&] { return i * n <= j * m; };
    const auto in_a_first = [&] { return none || at(i + 1, j) == at(i, j + 1) ? side_by_side() : at(i + 1, j) > at(i, j + 1); };
    if (!none && i < m && j < n && x[i] == y[j])
      result.steps.push_back({static_cast<int>(start + i++), static_cast<int>(start + j++)});
    else if (j == n || (i < m && in_a_first()))
      result.steps.push_back({static_cast<int>(start + i++), AlignedStep::kNone});
    else
      result.steps.push_back({AlignedStep::kNone, static_cast<int>(start + j++)});
  }
}

}  // namespace

// What the radicands have in common at both ends, and between.
Alignment aligned(const RootProgram& a, const RootProgram& b) {
  std::map<mpz_class, std::uint32_t> ids;
  const auto ids_of = [&](const RootProgram& program) {
    std::vector<std::uint32_t> list;
    for (const auto& layer : program.layers()) list.push_back(ids.try_emplace(layer.radicand, ids.size()).first->second);
    return list;
  };
  const std::vector<std::uint32_t> x = ids_of(a), y = ids_of(b);
  const std::size_t shorter = std::min(x.size(), y.size());
  std::size_t first = 0, last = 0;
  while (first < shorter && x[first] == y[first]) ++first;
  while (last < shorter - first && x[x.size() - 1 - last] == y[y.size() - 1 - last]) ++last;
  Alignment result;
  result.common = first + last;
  for (std::size_t i = 0; i < first; ++i) result.steps.push_back({static_cast<int>(i), static_cast<int>(i)});
  align(Ids(x).subspan(first, x.size() - first - last), Ids(y).subspan(first, y.size() - first - last), first, result);
  for (std::size_t i = last; i-- > 0;) result.steps.push_back({static_cast<int>(x.size() - 1 - i), static_cast<int>(y.size() - 1 - i)});
  return result;
}

SpanTest::SpanTest(const RootProgram& a, const RootProgram& b, const Alignment& alignment, Unknowns unknowns) : a_(a), b_(b) {
  RootBasis basis(alignment.steps.size());
  for (const AlignedStep& aligned : alignment.steps) {
    Step step = step_of(aligned);
    const mpz_class& radicand = radicand_of(aligned);
    if (unknowns == Unknowns::of_steps) {
      step.unknowns = {steps_.size()};
      squares_.push_back(radicand);
    } else {
      auto [multiple, members] = basis.root(radicand);
      step.multiple = std::move(multiple);
      step.unknowns = std::move(members);
      if (basis.size() > squares_.size()) squares_.push_back(radicand);
    }
    if (step.in_a) a_scale_ *= step.multiple.get_den();
    if (step.in_b) b_scale_ *= step.multiple.get_den();
    steps_.push_back(std::move(step));
  }
  find_uses();
  a_denominator_ = a.denominator() * a_scale_;
  b_denominator_ = b.denominator() * b_scale_;
  const mpz_class common = gcd(a_denominator_, b_denominator_);
  a_denominator_ /= common;
  b_denominator_ /= common;
}

const mpz_class& SpanTest::radicand_of(const AlignedStep& aligned) const {
  return aligned.a != AlignedStep::kNone ? a_.layers()[static_cast<std::size_t>(aligned.a)].radicand
                                         : b_.layers()[static_cast<std::size_t>(aligned.b)].radicand;
}

SpanTest::Step SpanTest::step_of(const AlignedStep& aligned) const {
  Step step{1, {}, {}, {}, aligned.a != AlignedStep::kNone, aligned.b != AlignedStep::kNone, {}};
  if (step.in_a) add_entries(step, a_.layers()[static_cast<std::size_t>(aligned.a)], 0);
  if (step.in_b) add_entries(step, b_.layers()[static_cast<std::size_t>(aligned.b)], RootProgram::kSize);
  return step;
}

void SpanTest::find_uses() {
  constexpr std::size_t kUnused = ~std::size_t{0};
  std::vector<std::size_t> first(squares_.size(), kUnused), last(squares_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i)
    for (const std::size_t u : steps_[i].unknowns) {
      if (first[u] == kUnused) first[u] = i;
      last[u] = i;
    }
  std::size_t open = 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    for (const std::size_t u : steps_[i].unknowns) {
      if (first[u] == i) steps_[i].opens.push_back(u);
      if (last[u] == i) steps_[i].closes.push_back(u);
    }
    open += steps_[i].opens.size();  // one at most: a radicand that joins the basis
    open -= steps_[i].closes.size();
    feasible_ = feasible_ && open <= kMostOpen;
  }
}

void SpanTest::add_entries(Step& step, const RootProgram::Layer& layer, std::size_t offset) {
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
  return std::max(magnitude_bits(a_) + bits_above(a_scale_) + bits_above(b_denominator_),
                  magnitude_bits(b_) + bits_above(b_scale_) + bits_above(a_denominator_)) + 1;
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
  void take(const Step& step) {
    const Word numerator = field_.of(step.multiple.get_num()), denominator = field_.of(step.multiple.get_den());
    residues_.clear();
    for (const Entry& entry : step.entries) residues_.push_back(field_.multiply(field_.of(*entry.value), entry.factor ? numerator : denominator));
    const std::size_t old_width = width_;
    for (const std::size_t u : step.opens) {
      open_.push_back({u, field_.of(test_.squares_[u])});
      width_ *= 2;
    }
    std::size_t product = 0;  // the number of the block of the step's unknowns
    for (const std::size_t u : step.unknowns) product |= bit_of(u);
    next_.assign(states_.size() / old_width * width_, 0);
    for (std::size_t from = 0, to = 0; from < states_.size(); from += old_width, to += width_)
      for (std::size_t block = 0; block * kBlock < old_width; ++block) apply(step, product, &states_[from + block * kBlock], block, &next_[to]);
    states_.swap(next_);
    for (const std::size_t u : step.closes) close(u);
    if (!step.closes.empty()) reduce_to_basis();
  }

  std::size_t bit_of(std::size_t unknown) const {
    const auto place = std::find_if(open_.begin(), open_.end(), [&](const auto& used) { return used.first == unknown; });
    return std::size_t{1} << (place - open_.begin());
  }

  /// Adds the layer times one block. A program that is not in the step stays as it is. Unknowns multiply into those of the block; what occurs
  /// twice is a whole number.
  void apply(const Step& step, std::size_t product, const Word* state, std::size_t block, Word* result) const {
    Word* const constant = result + block * kBlock;
    std::array<Word, kBlock> factor{};
    for (std::size_t i = 0; i < kBlock; ++i)
      if (!(i < RootProgram::kSize ? step.in_a : step.in_b)) constant[i] = field_.add(constant[i], state[i]);
    for (std::size_t e = 0; e < step.entries.size(); ++e) {
      const Entry& entry = step.entries[e];
      Word& to = entry.factor ? factor[entry.row] : constant[entry.row];
      to = field_.add(to, field_.multiply(residues_[e], state[entry.column]));
    }
    Word* const to = result + (block ^ product) * kBlock;
    for (std::size_t k = 0; k < open_.size(); ++k)
      if ((block & product & std::size_t{1} << k) != 0)
        for (Word& x : factor) x = field_.multiply(x, open_[k].second);
    for (std::size_t i = 0; i < kBlock; ++i) to[i] = field_.add(to[i], factor[i]);
  }

  /// An unknown that is not used again: what is with it and what is without vanish each by itself, as two states.
  void close(std::size_t unknown) {
    const std::size_t bit = bit_of(unknown), half = width_ / 2;
    next_.resize(states_.size());
    for (std::size_t from = 0; from < states_.size(); from += width_)
      for (std::size_t block = 0; block * kBlock < width_; ++block) {
        const std::size_t rest = (block & (bit - 1)) | (block >> 1 & ~(bit - 1));
        std::copy_n(&states_[from + block * kBlock], kBlock, &next_[from + ((block & bit) != 0 ? half : 0) + rest * kBlock]);
      }
    states_.swap(next_);
    std::erase_if(open_, [&](const auto& used) { return used.first == unknown; });
    width_ = half;
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
  std::vector<Word> states_, next_;
  std::vector<std::pair<std::size_t, Word>> open_;  // unknowns in use, with their squares; bit k of the number of a block stands for the k-th
  std::vector<Word> residues_;                      // of the entries of a step
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
