#pragma once

#include <optional>
#include <vector>

#include "border_outline.hpp"
#include "vertex_finder.hpp"

namespace gvd::kernel {

/// Follows the borders of label sets through a facet from where they cross its outline, in plain doubles. Every region touches the outline, so no
/// border is closed in itself inside; and an arc ends in the only place it has to end in.
class BorderTracer {
 public:
  BorderTracer(FacetWaves& waves, const Contenders& contenders, const FacetFilter& filter, FacetLadder& ladder)
      : contenders_(contenders), filter_(filter), ladder_(ladder), outline_(waves, contenders, filter), vertices_(waves, contenders, filter, ladder) {}

  /// Empty if it takes more than doubles.
  std::optional<FacetTessellation> run();

 private:
  using Found = BisectorVertices::Found;
  using Node = FacetTessellation::Node;
  using Point = predicates::DoublePoint;
  /// A border that leaves a node with these waves on its left and right.
  struct Start {
    std::uint32_t left, right, node;
    bool followed = false;
  };

  void add_outline();
  std::uint32_t add_crossing(const BorderOutline::Crossing& crossing);
  bool follow(std::size_t start);
  std::optional<Found> first_vertex(const Start& start);
  void choose_order(const Start& start);
  double tie_ahead(const Start& start, std::uint32_t other, const Point& p, const Point& along) const;
  double ray_ahead(std::uint32_t wave, int end, const Point& p, const Point& along) const;
  bool are_excluded(const Start& start, const Node& end);
  bool is_off(const predicates::BisectorPiece& piece, std::uint32_t wave) const;
  bool is_known(std::uint32_t i, std::uint32_t j, std::uint32_t k) const;
  std::size_t add_vertex(Found&& vertex, std::uint32_t left, std::uint32_t right);

  /// A wave that may end an arc, and how far ahead it seems to.
  struct Third {
    double ahead;
    std::uint32_t wave;
  };

  const Contenders& contenders_;
  const FacetFilter& filter_;
  FacetLadder& ladder_;
  BorderOutline outline_;
  BisectorVertices vertices_;
  FacetTessellation result_;
  std::vector<Start> starts_;
  std::vector<Third> thirds_;  ///< those that are to be excluded yet as the end of the present arc
  std::vector<std::array<std::uint32_t, 3>> known_;  ///< vertices: counter-clockwise
};

}  // namespace gvd::kernel
