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
      : contenders_(contenders),
        filter_(filter),
        ladder_(ladder),
        outline_(waves, contenders, filter, ladder),
        vertices_(waves, contenders, filter, ladder),
        starts_(ladder.room()),
        thirds_(ladder.room()),
        reading_(filter.row(), ladder.room()),
        off_(filter.row(), ladder.room()),
        all_(ladder.room()),
        known_(ladder.room()) {}

  /// Empty if it takes more than doubles.
  std::optional<FacetTessellation> run();

 private:
  using Vertex = BisectorVertices::InDoubles;
  using Node = FacetTessellation::Node;
  using Point = predicates::DoublePoint;
  static constexpr std::uint32_t kNoWave = 0xffffffffu;
  /// A border that leaves a node with these waves on its left and right.
  struct Start {
    std::uint32_t left, right, node;
    bool followed = false;
  };

  void add_outline();
  std::uint32_t add_crossing(const BorderOutline::Crossing& crossing);
  bool follow(std::size_t start);
  std::optional<Vertex> first_vertex(const Start& start);
  Point look_ahead(const Start& start, const Point& p);
  std::uint32_t next_ahead(const Point& p, const Point& along);
  bool sees(std::uint32_t wave, const Point& p) const;
  double ray_ahead(const Start& start, std::uint32_t other, const Point& p, const Point& along) const;
  void exclude_beside(const Start& start, const Point& end, double radius);
  bool are_excluded(const Start& start);
  std::optional<bool> is_beaten(const Vertex& vertex, std::uint32_t third);
  void find_thirds(const Start& start);
  std::size_t add_vertex(const Vertex& vertex, std::uint32_t left, std::uint32_t right);

  /// What is known of a wave beside the present arc: how far ahead it seems to end the arc, and whether it can.
  struct Third {
    double ahead = 0;
    bool is_candidate = true;    ///< none of the two, nor known to end the arc elsewhere
    bool is_looked_for = false;  ///< whether it sees that place has been taken into account
    bool is_off = false;         ///< takes no part in the piece up to the end found last
    bool has_no_vertex = false;
  };

  const Contenders& contenders_;
  const FacetFilter& filter_;
  FacetLadder& ladder_;
  BorderOutline outline_;
  BisectorVertices vertices_;
  FacetTessellation result_;
  std::pmr::vector<Start> starts_;
  std::pmr::vector<Third> thirds_;  ///< per wave, for the present arc
  FacetFilter::Reading reading_;
  predicates::WaveRow::Marks off_;
  std::pmr::vector<std::uint32_t> all_;
  std::pmr::vector<std::array<std::uint32_t, 3>> known_;  ///< vertices: counter-clockwise
};

}  // namespace gvd::kernel
