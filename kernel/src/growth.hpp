#pragma once

#include <optional>
#include <vector>

#include "contenders.hpp"
#include "gvd/kernel/tessellation.hpp"
#include "outline.hpp"
#include "vertex_finder.hpp"

namespace gvd::kernel {

/// Direct window growth: closes the occurrences of the outline one after the other until no bisector is open.
class Growth {
 public:
  Growth(FacetWaves& waves, const Contenders& contenders, const FacetFilter& filter, FacetLadder& ladder, FacetTessellation& result)
      : waves_(waves), contenders_(contenders), ladder_(ladder), result_(result), vertices_(waves, contenders, filter, ladder) {}

  /// Turns the outline's list into arcs and vertices. On failure `ladder.failed()`.
  void run(const std::vector<Occurrence>& outline);

 private:
  /// An occurrence in the cyclic list of what is still open.
  struct Open {
    std::uint32_t contender, node_after, next, previous;
  };
  using Found = BisectorVertices::Found;
  using Node = FacetTessellation::Node;

  bool close_one();
  std::optional<bool> try_close(std::uint32_t at);
  std::optional<bool> closes_by_arc(std::uint32_t at);
  std::optional<bool> closes_at(std::uint32_t at, const Found& vertex);
  std::optional<bool> touches_another(std::uint32_t a, std::uint32_t b, std::uint32_t third, const Found* but);
  std::optional<bool> reaches(std::uint32_t a, std::uint32_t b, std::uint32_t from, std::uint32_t to, const Node& end, std::uint32_t third);
  robust::MaybeSign along_arc(std::uint32_t a, std::uint32_t b, const Node& from, const Node& to);
  void remove(std::uint32_t at);
  void add_arc(std::uint32_t left, std::uint32_t right, std::uint32_t from, std::uint32_t to);
  std::uint32_t node_of(Found& vertex);

  FacetWaves& waves_;
  const Contenders& contenders_;
  FacetLadder& ladder_;
  FacetTessellation& result_;
  BisectorVertices vertices_;
  std::vector<Open> open_;
  std::vector<std::uint32_t> count_;   ///< open occurrences per contender
  std::vector<std::uint32_t> listed_;  ///< contenders on the outline: no other one owns any area
  std::uint32_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace gvd::kernel
