#pragma once

#include <array>
#include <optional>
#include <string>
#include <type_traits>

#include "gvd/kernel/facet_numbers.hpp"
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
  }

  const FacetNumbers<F>& filter() const { return filter_; }
  void count(predicates::Predicate p, robust::Stage stage) { predicates::count(decisions_, p, stage); }

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
    auto answer = for_each_stage([&](const auto& numbers, robust::Stage stage) {
      auto result = test(numbers);
      if (result) count(p, stage);
      return result;
    });
    if (!answer) fail(p, describe());
    return answer;
  }

  /// Calls visit(numbers, stage) for the stages beyond the filter, until it gives an answer.
  template <class Visit>
  auto for_each_stage(const Visit& visit) -> decltype(visit(std::declval<FacetNumbers<F>&>(), robust::Stage::filter)) {
    if (double_double_.frame == nullptr) load_numbers(waves_, 0, double_double_);
    if (auto answer = visit(double_double_, robust::Stage::double_double)) return answer;
    for (const int bits : {128, 256, 512, 1024}) {
      if (bits != loaded_bits_) load_numbers(waves_, bits, mpfr_);
      loaded_bits_ = bits;
      if (auto answer = visit(mpfr_, robust::Stage::mpfr)) return answer;
      if (bits == 256) {  // a tie more often than not: where the proof is cheap, ask for it before the longest numbers
        if (auto exact = visit_exact(visit)) return exact;
      }
    }
    return {};
  }

  bool failed() const { return failed_; }
  void fail(predicates::Predicate p, std::string what) {
    failed_ = true;
    predicates::undecided(decisions_, p, "facet " + std::to_string(waves_.face) + ": " + std::move(what));
  }

 private:
  template <class Visit>
  auto visit_exact(const Visit& visit) -> decltype(visit(std::declval<FacetNumbers<F>&>(), robust::Stage::filter)) {
    if (!exact_loaded_) load_numbers(waves_, 0, exact_);
    exact_loaded_ = true;
    if (exact_.frame == nullptr) return {};
    for (const auto* site : exact_.sites)
      if (site == nullptr) return {};
    return visit(exact_, robust::Stage::algebra);
  }

  FacetWaves& waves_;
  predicates::Decisions& decisions_;
  FacetNumbers<F> filter_;
  FacetNumbers<DD> double_double_;
  FacetNumbers<M> mpfr_;
  int loaded_bits_ = 0;
  FacetNumbers<Exact> exact_;
  bool exact_loaded_ = false;
  bool failed_ = false;
};

}  // namespace gvd::kernel
