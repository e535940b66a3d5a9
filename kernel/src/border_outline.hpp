#pragma once

#include <array>
#include <vector>

#include "contenders.hpp"
#include "overtaking_filter.hpp"

namespace gvd::kernel {

/// Where the label set of the nearest wave changes along the outline of a facet, by signs in plain doubles: which wave of the set is nearest in
/// between is not asked (docs/error-bounds.md#borders).
class BorderOutline {
 public:
  using Place = OvertakingFilter::Place;
  /// The nearest wave changes from `from` to `to`, of another label set, and no third one ties with them there.
  struct Crossing {
    std::uint8_t side = 0;
    std::uint32_t from = 0, to = 0;
    Place at;
  };

  BorderOutline(const FacetWaves& waves, const Contenders& contenders, const FacetFilter& filter, FacetLadder& ladder);

  /// False if it takes more than doubles.
  bool walk();
  /// Counter-clockwise from corner 0.
  const std::pmr::vector<Crossing>& crossings() const { return crossings_; }
  /// A wave that attains corner c.
  std::uint32_t at_corner(std::size_t c) const { return at_corner_[c]; }
  LabelSetId labels(std::uint32_t wave) const { return labels_[wave]; }
  std::uint32_t decisions() const { return decisions_; }

 private:
  static constexpr std::uint32_t kNoWave = 0xffffffffu;
  static constexpr std::uint32_t kMostParts = 64;
  /// A part of the present side at whose ends the nearest waves are all of one known label set.
  struct Part {
    double begin, end;
    LabelSetId at_begin, at_end;
    /// A pair that has its zero at an end of the part: so `nearer` is that all along it.
    std::uint32_t nearer = kNoWave, farther = kNoWave;
  };

  bool find_at_corner(std::size_t c);
  bool solve(const Part& part, int halvings);
  bool halve(const Part& part, int halvings);
  bool is_uniform(const Part& part);
  bool cross(const Part& part, int halvings);
  bool is_clear(std::uint32_t from, std::uint32_t to, const Place& at);
  bool is_farther(std::uint32_t guard, std::uint32_t other, double begin, double end);
  bool keep_off(const Part& part, std::uint32_t other, double begin, double end, int halvings);
  bool sees(std::uint32_t wave, double begin, double end) const { return filter_[wave].seen[side_].contains(begin, end); }
  bool misses(std::uint32_t wave, double begin, double end) const {
    return end < filter_[wave].stretch[side_].low || filter_[wave].stretch[side_].high < begin;
  }
  std::uint32_t nearest(LabelSetId labels, double t) const;
  LabelSetId only_label_at(double t);

  const FacetWaves& waves_;
  const Contenders& contenders_;
  const FacetFilter& filter_;
  OvertakingFilter signs_;
  std::pmr::vector<LabelSetId> labels_;  ///< per contender
  std::array<std::uint32_t, 3> at_corner_{kNoWave, kNoWave, kNoWave};
  std::pmr::vector<Crossing> crossings_;
  std::size_t side_ = 0;
  std::uint32_t decisions_ = 0, parts_ = 0;
};

}  // namespace gvd::kernel
