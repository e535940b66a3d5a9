#pragma once

#include <array>
#include <vector>

#include "contenders.hpp"
#include "gvd/predicates/bisector_piece.hpp"

namespace gvd::kernel {

/// The contenders of a facet in plain doubles, with what is asked for again and again computed once. Whoever asks gets an answer that is certain,
/// or none; then the ladder is climbed as if nothing had been asked (docs/error-bounds.md#waves-in-doubles).
class FacetFilter {
 public:
  using Bounded = predicates::Bounded;
  using Point = predicates::DoublePoint;

  /// The line of a boundary ray of a cone: the cone is on its left.
  struct Ray : predicates::DoubleLine {
    std::array<Bounded, 3> at_corner;  ///< on which side the corners are
  };
  /// A part of a side.
  struct Stretch {
    double low = 0, high = 1;
    bool contains(double from, double to) const { return low <= from && to <= high; }
  };
  struct Wave {
    predicates::DoubleWave wave;
    std::array<double, 3> at_corner{};        ///< distance
    std::array<double, 3> reach{};            ///< the same without the weight
    bool has_cone = false;
    std::array<Ray, 2> ray{};
    std::array<Stretch, 3> stretch{};  ///< per side: where the wave may be seen, certainly nowhere else
    std::array<Stretch, 3> seen{};     ///< per side: where it is certainly seen
  };
  /// A directed side; `error` bounds that of each of its points.
  struct Side {
    Point origin{0, 0}, direction{0, 0};
    double length = 0, error = 0;
    Point at(double t) const { return {origin.x + t * direction.x, origin.y + t * direction.y}; }
  };

  FacetFilter(const Contenders& contenders, FacetLadder& ladder);

  const Wave& operator[](std::size_t i) const { return waves_[i]; }
  const Side& side(std::size_t k) const { return sides_[k]; }
  std::size_t size() const { return waves_.size(); }

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
  static void cut_stretches(const Ray& ray, const Contender& contender, Wave& wave);
  Ray make_ray(const FacetNumbers<FacetWaves::F>& numbers, const Contender& wave, std::size_t end) const;

  std::pmr::vector<Wave> waves_;
  std::array<Side, 3> sides_;
};

}  // namespace gvd::kernel
