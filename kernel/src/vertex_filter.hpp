#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "facet_filter.hpp"

namespace gvd::kernel {

/// Judges vertices of three waves in plain doubles: a point near the vertex from the closed formula, a proof that the vertex is near it (Kantorovich's
/// theorem, docs/error-bounds.md#waves-in-doubles), then the tests by distances and boundary rays.
class VertexFilter {
 public:
  using Point = predicates::DoublePoint;

  VertexFilter(const FacetFilter& filter, const Contenders& contenders) : filter_(filter), contenders_(contenders) {}

  enum class Answer { no, yes, unknown };
  /// Certainly within `radius` of `p`.
  struct Location {
    Point p{0, 0};
    double radius = 0;
  };
  /// A boundary ray on which the vertex lies by identity, with the relay that starts on it.
  struct OnRay {
    std::uint32_t parent, relay, other;
    std::uint8_t end;
  };
  struct Judgement {
    bool certain = false, exists = false;
    Location at{};
    std::uint32_t sides = 0, rays = 0, rivals = 0;  ///< decisions made
  };
  /// The vertex with the regions of the three counter-clockwise round it: whether it exists, lies strictly inside the facet and the three cones, and
  /// no rival is nearer or ties.
  Judgement judge(const std::array<std::uint32_t, 3>& waves, const std::optional<OnRay>& on_ray, std::span<const std::uint32_t> rivals) const;
  /// Whether a rival of three waves that tie at a point sees it and is nearer there.
  Answer nearer(const std::array<std::uint32_t, 3>& waves, std::uint32_t rival, const Location& at) const;

 private:
  struct Found {
    Answer exists = Answer::unknown;
    Location at{};
  };
  struct Guess {
    Point p{0, 0};
    double sign = 1;  ///< of the distances of the three, in the formula
  };
  std::optional<Guess> guess(const std::array<std::uint32_t, 3>& waves) const;
  bool certainly_none(const std::array<std::uint32_t, 3>& waves) const;
  Found locate(const std::array<std::uint32_t, 3>& waves) const;
  Found locate_on_ray(const OnRay& ray) const;
  Answer inside_side(std::size_t k, const Location& at) const;
  Answer inside_ray(std::uint32_t wave, std::size_t end, const Location& at) const;
  Answer sees(std::uint32_t wave, const Location& at) const;

  const FacetFilter& filter_;
  const Contenders& contenders_;
};

}  // namespace gvd::kernel
