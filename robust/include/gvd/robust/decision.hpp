#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gvd::robust {

/// The stages of the decision ladder, cheapest first. `undecided` is what remains when none of them could prove a sign.
enum class Stage : std::uint8_t { identity, filter, double_double, mpfr, algebra, undecided };
inline constexpr std::size_t kStageCount = 6;
inline constexpr std::array<const char*, kStageCount> kStageNames = {"identity", "filter",  "double_double",
                                                                     "mpfr",     "algebra", "undecided"};

/// Counts of decisions per predicate and stage, and the list of the undecided ones. Owned by the caller; merged, never shared
/// between threads.
template <std::size_t kPredicateCount>
class DecisionTable {
 public:
  void count(std::size_t predicate, Stage stage, std::uint64_t times = 1) noexcept {
    counts_[predicate][static_cast<std::size_t>(stage)] += times;
  }
  void undecided(std::size_t predicate, std::string what) {
    count(predicate, Stage::undecided);
    if (undecided_.size() < kMostListed) undecided_.push_back(std::move(what));
  }
  void merge(const DecisionTable& other) {
    for (std::size_t p = 0; p < kPredicateCount; ++p)
      for (std::size_t s = 0; s < kStageCount; ++s) counts_[p][s] += other.counts_[p][s];
    for (const auto& what : other.undecided_)
      if (undecided_.size() < kMostListed) undecided_.push_back(what);
  }
  std::uint64_t operator()(std::size_t predicate, Stage stage) const noexcept {
    return counts_[predicate][static_cast<std::size_t>(stage)];
  }
  std::uint64_t total(Stage stage) const noexcept {
    std::uint64_t sum = 0;
    for (const auto& row : counts_) sum += row[static_cast<std::size_t>(stage)];
    return sum;
  }
  const std::vector<std::string>& undecided_list() const noexcept { return undecided_; }

  /// The list is a help for the reader, the count is complete; so the list is bounded.
  static constexpr std::size_t kMostListed = 1000;

 private:
  std::array<std::array<std::uint64_t, kStageCount>, kPredicateCount> counts_{};
  std::vector<std::string> undecided_;
};

}  // namespace gvd::robust
