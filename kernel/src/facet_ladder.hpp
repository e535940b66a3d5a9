#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <type_traits>

#include "gvd/kernel/facet_numbers.hpp"
#include "gvd/predicates/double_wave.hpp"
#include "gvd/predicates/predicate.hpp"

namespace gvd::kernel {

/// Runs decisions about the waves of one facet up the ladder, and counts them. Numbers beyond the filter are asked for only when needed.
class FacetLadder {
 public:
  using F = FacetWaves::F;
  using DD = FacetWaves::DD;
  using M = FacetWaves::M;
  using Exact = robust::Exact;

  FacetLadder(FacetWaves& waves, predicates::Decisions& decisions) : waves_(waves), decisions_(decisions) {
    load_numbers(waves_, 0, filter_);
    doubles_.reserve(filter_.sites.size());
    for (std::size_t i = 0; i < filter_.sites.size(); ++i) doubles_.push_back(predicates::double_wave(*filter_.sites[i]));
  }

  FacetLadder(const FacetLadder&) = delete;
  FacetLadder& operator=(const FacetLadder&) = delete;

  /// Room for what is needed as long as the ladder: the lists of most facets fit, so they cost no allocation.
  std::pmr::memory_resource* room() { return &room_; }
  const FacetNumbers<F>& filter() const { return filter_; }
  /// The sites in plain doubles.
  const std::pmr::vector<predicates::DoubleWave>& doubles() const { return doubles_; }
  void count(predicates::Predicate p, robust::Stage stage, std::uint32_t times = 1) {
    decisions_.count(static_cast<std::size_t>(p), stage, times);
  }

  /// `test(numbers)` gives an optional answer from FacetNumbers of any number type; the first answer counts.
  /// Without any, the decision is listed (`describe()` names it), failed() holds from now on, and the result is empty.
  template <class Test, class Describe>
  auto decide(predicates::Predicate p, const Test& test, const Describe& describe) -> decltype(test(std::declval<FacetNumbers<F>&>())) {
    if (auto answer = test(filter_)) {
      count(p, robust::Stage::filter);
      return answer;
    }
    return decide_beyond_filter(p, test, describe);
  }

  /// The same, when the filter has been tried already.
  template <class Test, class Describe>
  auto decide_beyond_filter(predicates::Predicate p, const Test& test, const Describe& describe)
      -> decltype(test(std::declval<FacetNumbers<F>&>())) {
    robust::Stage last = robust::Stage::undecided;
    auto answer = for_each_stage([&](const auto& numbers, robust::Stage stage) {
      last = stage;
      return test(numbers);
    });
    if (answer) {
      count(p, last);
    } else {
      fail(p, describe());
    }
    return answer;
  }

  /// Calls visit(numbers, stage) for the stages beyond the filter, until it gives an answer.
  template <class Visit>
  auto for_each_stage(const Visit& visit) -> decltype(visit(std::declval<FacetNumbers<F>&>(), robust::Stage::filter)) {
    if (auto answer = visit(in_double_double(), robust::Stage::double_double)) return answer;
    // A tie more often than not: where the proof is cheap it is asked for before MPFR, else before the longest numbers.
    const bool exact_first = waves_.exact_is_cheap();
    if (exact_first) {
      if (auto exact = visit_exact(visit)) return exact;
    }
    for (const int bits : {128, 256, 512, 1024}) {
      if (auto answer = visit(in_mpfr(bits), robust::Stage::mpfr)) return answer;
      if (bits == 256 && !exact_first) {
        if (auto exact = visit_exact(visit)) return exact;
      }
    }
    return {};
  }

  /// The numbers of one stage, for questions that are put before the ladder's own.
  const FacetNumbers<DD>& in_double_double() {
    FacetNumbers<DD>& numbers = beyond().double_double;
    if (numbers.frame == nullptr) load_numbers(waves_, 0, numbers);
    return numbers;
  }
  /// Valid until other bits are asked for.
  const FacetNumbers<M>& in_mpfr(int bits) {
    BeyondFilter& numbers = beyond();
    if (bits != numbers.bits) load_numbers(waves_, bits, numbers.mpfr);
    numbers.bits = bits;
    return numbers.mpfr;
  }

  bool failed() const { return failed_; }
  void fail(predicates::Predicate p, std::string what) {
    failed_ = true;
    predicates::undecided(decisions_, p, "facet " + std::to_string(waves_.face) + ": " + std::move(what));
  }

 private:
  template <class Visit>
  auto visit_exact(const Visit& visit) -> decltype(visit(std::declval<FacetNumbers<F>&>(), robust::Stage::filter)) {
    BeyondFilter& numbers = beyond();
    if (!numbers.exact_loaded) load_numbers(waves_, 0, numbers.exact);
    numbers.exact_loaded = true;
    if (numbers.exact.frame == nullptr) return {};
    return visit(numbers.exact, robust::Stage::algebra);
  }

  std::array<std::byte, 1 << 15> first_room_;
  std::pmr::monotonic_buffer_resource room_{first_room_.data(), first_room_.size()};
  FacetWaves& waves_;
  predicates::Decisions& decisions_;
  FacetNumbers<F> filter_;
  std::pmr::vector<predicates::DoubleWave> doubles_{&room_};
  /// Hardly any facet needs them, and even empty ones cost allocations.
  struct BeyondFilter {
    FacetNumbers<DD> double_double;
    FacetNumbers<M> mpfr;
    int bits = 0;
    FacetNumbers<Exact> exact;
    bool exact_loaded = false;
  };
  BeyondFilter& beyond() {
    if (!beyond_) beyond_ = std::make_unique<BeyondFilter>();
    return *beyond_;
  }
  std::unique_ptr<BeyondFilter> beyond_;
  bool failed_ = false;
};

}  // namespace gvd::kernel
