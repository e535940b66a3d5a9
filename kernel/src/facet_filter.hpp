#pragma once

#include <array>
#include <vector>

#include "contenders.hpp"
#include "gvd/predicates/cone_row.hpp"

namespace gvd::kernel {

/// The contenders of a facet in plain doubles, with what is asked for again and again computed once. Whoever asks gets an answer that is certain,
/// or none; then the ladder is climbed as if nothing had been asked (docs/error-bounds.md#waves-in-doubles).
class FacetFilter {
 public:
  using Bounded = predicates::Bounded;
  using Point = predicates::DoublePoint;
  using Reading = predicates::WaveRow::Reading;

  /// A directed side; `error` bounds that of each of its points.
  struct Side {
    Point origin{0, 0}, direction{0, 0};
    double length = 0, error = 0;
    Point at(double t) const { return {origin.x + t * direction.x, origin.y + t * direction.y}; }
  };

  FacetFilter(const Contenders& contenders, FacetLadder& ladder);
  FacetFilter(const FacetFilter&) = delete;
  FacetFilter& operator=(const FacetFilter&) = delete;

  const predicates::DoubleWave& wave(std::size_t i) const { return waves_[i]; }
  bool has_cone(std::size_t i) const { return contenders_[i].has_cone; }
  const Side& side(std::size_t k) const { return sides_[k]; }
  std::size_t size() const { return waves_.size(); }
  /// All waves at a point, and at a corner.
  Reading reading(const Point& p) const {
    Reading reading(row_, room_);
    row_.read(p, reading);
    return reading;
  }
  const predicates::WaveRow& row() const { return row_; }
  const predicates::ConeRow& cones() const { return cones_; }
  const Reading& at_corner(std::size_t c) const { return corner_[c]; }

  /// d_b - d_a at the point of side k with parameter t in [0, 1].
  Bounded lead(std::size_t k, std::uint32_t a, std::uint32_t b, double t) const;
  Bounded lead_at_corner(std::size_t c, std::uint32_t a, std::uint32_t b) const;
  /// Its derivative by t at the end `c` of side k: c = k or k + 1.
  Bounded slope_at_corner(std::size_t k, std::size_t c, std::uint32_t a, std::uint32_t b) const;
  /// How far inside boundary ray `end` of wave i the point of side k lies: linear in t.
  Bounded cone_side(std::size_t k, std::uint32_t i, std::size_t end, double t) const;
  /// The same for a point of the facet that is known up to `error`.
  Bounded cone_side(std::uint32_t i, std::size_t end, const Point& p, double error) const;

 private:
  predicates::DoubleLine make_ray(const Contender& wave, std::size_t end) const;

  const Contenders& contenders_;
  const FacetNumbers<FacetWaves::F>& numbers_;
  std::pmr::memory_resource* room_;
  std::pmr::vector<predicates::DoubleWave> waves_;
  predicates::WaveRow row_;
  std::array<Side, 3> sides_;
  std::pmr::vector<Reading> corner_;
  predicates::ConeRow cones_;
};

}  // namespace gvd::kernel
