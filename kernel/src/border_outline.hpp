#pragma once

#include <algorithm>
#include <array>
#include <forward_list>
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
  /// A point of the present side, with what all waves are there.
  struct Spot {
    double t = 0;
    const FacetFilter::Reading* waves = nullptr;
  };
  /// A part of the present side at whose ends the nearest waves are all of one known label set. The spots are its ends, or a little beyond.
  struct Part {
    double begin, end;
    LabelSetId at_begin, at_end;
    Spot first, last;
    /// A pair that has its zero at an end of the part: so `nearer` is that all along it.
    std::uint32_t nearer = kNoWave, farther = kNoWave;
  };
  /// A wave of the label set and the stretch of the side where all are compared with it.
  struct Guard {
    std::uint32_t wave;
    Spot first, last;
  };

  bool find_at_corner(std::size_t c);
  Spot spot(double t) { return {t, &readings_.emplace_front(filter_.reading(filter_.side(side_).at(t)))}; }
  bool solve(const Part& part, int halvings);
  bool halve(const Part& part, int halvings);
  bool is_uniform(const Part& part);
  std::uint32_t choose_guard(const Part& part, const Spot& first) const;
  bool guards(const Guard& guard, const Part& part);
  bool cross(const Part& part, int halvings);
  bool is_clear(std::uint32_t from, std::uint32_t to, const Place& at, const Spot& middle);
  bool is_farther(std::uint32_t guard, std::uint32_t other, double begin, double end);
  bool keep_off(const Part& part, std::uint32_t other, double begin, double end, int halvings);
  bool sees(std::uint32_t wave, double begin, double end) const { return filter_.cones().seen(wave, side_).contains(begin, end); }
  bool misses(std::uint32_t wave, double begin, double end) const { return filter_.cones().stretch(wave, side_).misses(begin, end); }
  /// What the error of a point of the side, or of one of its ends, adds to a difference of distances.
  double point_error() const { return 2 * std::max(filter_.side(side_).error, filter_.side((side_ + 1) % 3).error); }
  std::uint32_t nearest(LabelSetId labels, const Spot& spot) const;
  LabelSetId only_label_at(const Spot& spot);

  const FacetWaves& waves_;
  const Contenders& contenders_;
  const FacetFilter& filter_;
  OvertakingFilter signs_;
  std::pmr::vector<LabelSetId> labels_;  ///< per contender
  std::array<std::uint32_t, 3> at_corner_{kNoWave, kNoWave, kNoWave};
  std::pmr::vector<Crossing> crossings_;
  std::pmr::forward_list<FacetFilter::Reading> readings_;  ///< of spots
  predicates::WaveRow::Marks marks_;
  std::size_t side_ = 0;
  std::uint32_t decisions_ = 0, parts_ = 0;
};

}  // namespace gvd::kernel
