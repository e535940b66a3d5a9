#pragma once

#include <optional>
#include <vector>

#include "border_outline.hpp"
#include "vertex_finder.hpp"

namespace gvd::kernel {

/// Follows the borders of label sets through a facet from where they cross its outline, in plain doubles. Every region touches the outline, so no
/// border is closed in itself inside; and an arc is the only one of its two waves if it has only one place to end in.
class BorderTracer {
 public:
  BorderTracer(FacetWaves& waves, const Contenders& contenders, const FacetFilter& filter, FacetLadder& ladder)
      : waves_(waves), contenders_(contenders), ladder_(ladder), outline_(waves, contenders, filter), vertices_(waves, contenders, filter, ladder) {}

  /// Empty if it takes more than doubles.
  std::optional<FacetTessellation> run();

 private:
  using Found = BisectorVertices::Found;
  using Node = FacetTessellation::Node;
  /// A border that leaves a node with these waves on its left and right.
  struct Start {
    std::uint32_t left, right, node;
    bool followed = false;
  };

  void add_outline();
  std::uint32_t add_crossing(const BorderOutline::Crossing& crossing);
  bool follow(std::size_t start);
  bool is_known(std::uint32_t i, std::uint32_t j, std::uint32_t k) const;
  std::size_t add_vertex(Found&& vertex, std::uint32_t left, std::uint32_t right);

  FacetWaves& waves_;
  const Contenders& contenders_;
  FacetLadder& ladder_;
  BorderOutline outline_;
  BisectorVertices vertices_;
  FacetTessellation result_;
  std::vector<Start> starts_;
  std::vector<std::array<std::uint32_t, 3>> known_;  ///< vertices: counter-clockwise
};

}  // namespace gvd::kernel
