#pragma once

#include <optional>
#include <vector>

#include "contenders.hpp"
#include "corner_sequence.hpp"
#include "facet_filter.hpp"
#include "gvd/kernel/tessellation.hpp"
#include "overtaking_filter.hpp"

namespace gvd::kernel {

/// A contender's stretch of the outline of what is not yet tessellated, and the node where the next stretch begins.
struct Occurrence {
  std::uint32_t contender = 0;
  std::uint32_t node_after = FacetTessellation::Piece::kNoNode;
};

/// Walks round the facet: what lies just inside it along its outline.
class OutlineWalk {
 public:
  OutlineWalk(FacetWaves& waves, const Contenders& contenders, const FacetFilter& filter, FacetLadder& ladder, FacetTessellation& result)
      : waves_(waves),
        contenders_(contenders),
        filter_(filter),
        overtaking_(filter, contenders),
        ladder_(ladder),
        corners_(waves, contenders, ladder),
        result_(result) {}

  /// The cyclic list of occurrences, counter-clockwise; a single one has no node. Fills result.outline and the nodes of corners and sides.
  /// Empty on failure.
  std::vector<Occurrence> walk();

 private:
  /// A place on a side where `to` takes over from `from`; or, if they are one, where the view of `from` ends; or, if `contact`, where a wave that
  /// touches `from` along the side without crossing it comes into view.
  struct Event {
    std::uint32_t from, to;
    std::uint32_t ray = FacetTessellation::kNoSite;  ///< site whose boundary ray crosses the side there, if they are tangent
    std::uint8_t ray_end = 0;
    bool on_ray = false;  ///< the point lies on a boundary ray of `to` or `from`, other than `ray`
    bool contact = false;
    /// Whether `to` and `from` cross or touch there, which along one side happens at one point in this sense.
    bool is_tie() const { return !contact && to != from; }
    std::optional<predicates::SideTie<FacetWaves::F>> filtered;  ///< its parameter in the filter's numbers, once asked for
  };
  enum class Answer { no, yes, on_ray };

  bool pass_corner(std::size_t c, const std::vector<std::uint32_t>& sequence);
  bool walk_side(std::size_t side, std::uint32_t last);
  bool pass_event(std::size_t side, const std::vector<Event>& tied);
  std::optional<std::vector<Event>> next_events(std::size_t side, std::uint32_t from, const std::optional<Event>& previous);
  std::optional<std::vector<Event>> filtered_events(std::size_t side, std::uint32_t from, const std::optional<Event>& previous);
  std::optional<Event> candidate(std::size_t side, std::uint32_t from, std::uint32_t to);
  std::array<std::uint32_t, 2> twins_that_touch(std::size_t side, std::uint32_t from, std::uint32_t to) const;
  bool ray_is_through_corner(std::size_t side, const Event& event) const;
  bool may_touch(std::size_t side, std::uint32_t from, std::uint32_t to) const;
  struct MirroredTouch {
    bool is_known = false;
    std::optional<Event> event{};
  };
  MirroredTouch mirrored_touch(std::size_t side, std::uint32_t from, std::uint32_t to) const;
  std::optional<bool> do_touch(std::size_t side, std::uint32_t from, std::uint32_t to);
  std::optional<Event> contact(std::size_t side, std::uint32_t from, std::uint32_t to) const;
  bool tie_is_at_corner(std::size_t side, const Event& event);
  bool ties_at_corners(const Event& event) const;
  bool at_one_point(std::size_t side, const Event& a, const Event& b);
  std::optional<bool> happens(std::size_t side, Event& event, const std::optional<Event>& previous);
  /// `along`: which boundary rays of `to` are known to run along the side.
  template <class NT>
  std::optional<Answer> happens_in(const FacetNumbers<NT>& numbers, std::size_t side, const Event& event,
                                   const std::optional<Event>& previous, std::array<bool, 2> along) const;
  template <class NT>
  predicates::SideTie<NT> parameter(const FacetNumbers<NT>& numbers, std::size_t side, const Event& event) const;
  robust::MaybeSign compare(std::size_t side, const Event& a, const Event& b);
  bool complete(std::size_t side, std::uint32_t from, std::uint32_t last, const std::optional<Event>& previous, std::vector<Event>& events);

  std::uint32_t add_node(FacetTessellation::Node node);
  void enter(std::uint32_t node, std::uint32_t contender);
  std::string describe(std::size_t side, const Event& event, const char* what) const;

  FacetWaves& waves_;
  const Contenders& contenders_;
  const FacetFilter& filter_;
  OvertakingFilter overtaking_;
  FacetLadder& ladder_;
  CornerOrder corners_;
  FacetTessellation& result_;
  std::vector<Occurrence> list_;
  bool touched_ = false;               ///< whether another wave may touch the one that the next event takes over from
  std::vector<std::uint32_t> passed_;  ///< the waves known to tie, and to be seen, at the side's last event
};

}  // namespace gvd::kernel
