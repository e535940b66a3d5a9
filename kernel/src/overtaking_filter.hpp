#pragma once

#include <optional>
#include <vector>

#include "facet_filter.hpp"

namespace gvd::kernel {

/// Where the boundary ray of a parent's cone crosses a side, if its relay takes over there, or it from the relay: what has to happen is known by
/// identity, only the place is not.
struct RayEvent {
  std::uint32_t parent = 0;
  std::uint8_t end = 0;
};
/// The event of a tangent pair, if identity does not exclude it. Pre: contenders.tangent(from, to).
std::optional<RayEvent> tangent_event(const Contenders& contenders, std::size_t side, std::uint32_t from, std::uint32_t to);

/// Finds the wave that takes over next along a side of the facet in plain doubles, by signs of d_to - d_from: along a line this difference has at
/// most two zeros, one where it falls and one where it rises (predicates::overtaking), so two certain signs tell most.
class OvertakingFilter {
 public:
  OvertakingFilter(const FacetFilter& filter, const Contenders& contenders) : filter_(filter), contenders_(contenders) {}

  /// A place on the side: certainly in (low, high).
  struct Place {
    double low = 0, high = 0;
    FacetWaves::F parameter() const { return {0.5 * (low + high), (high - low) * (0.5 + 0x1p-40) + 0x1p-54}; }
  };
  /// The last event passed: `from` was overtaken at `at`.
  struct Passed {
    std::uint32_t from;
    Place at;
  };
  struct Next {
    std::uint32_t decisions = 0;  ///< how many waves were judged
    bool exists = false;          ///< false: no wave takes over before the end of the side
    std::uint32_t to = 0;
    Place at;
    std::optional<RayEvent> ray;
  };
  /// The first wave that takes over from `from` after `passed`, or after the beginning of the side; empty if doubles cannot tell.
  std::optional<Next> next(std::size_t side, std::uint32_t from, const std::optional<Passed>& passed);

  /// Chooses what the following two ask about: the side, and the wave that may be overtaken.
  void look_from(std::size_t side, std::uint32_t from) { side_ = side, from_ = from; }
  /// The sign of d_to - d_from if it certainly has no zero in [begin, end].
  robust::MaybeSign constant_sign(std::uint32_t to, double begin, double end, int halvings) const;
  /// Encloses the zero where d_to - d_from falls. Pre: it is positive at `begin` and negative at `end`.
  std::optional<Place> locate(std::uint32_t to, double begin, double end) const;

 private:
  enum class Finding { none, one, unknown };
  enum class Seen { no, yes, unknown };

  Finding falling_zero(std::uint32_t to) const;
  Finding ahead(std::uint32_t to) const;
  bool settle(std::uint32_t to);
  bool judge(std::uint32_t to);
  bool judge_ray(std::uint32_t to, const RayEvent& event);
  bool offer(std::uint32_t to, const Place& at, const std::optional<RayEvent>& ray);
  std::optional<Place> locate_ray(const RayEvent& event, bool inward) const;
  Seen sees(std::uint32_t to, const Place& at, const std::optional<RayEvent>& ray) const;

  const FacetFilter& filter_;
  const Contenders& contenders_;
  std::size_t side_ = 0;
  std::uint32_t from_ = 0;
  std::optional<Passed> passed_;
  Next next_;
  std::vector<std::uint32_t> deferred_;  ///< waves of which the ends of the side do not tell enough
};

}  // namespace gvd::kernel
