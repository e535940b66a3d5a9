#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "contenders.hpp"
#include "ring.hpp"
#include "gvd/kernel/node_point.hpp"
#include "vertex_filter.hpp"

namespace gvd::kernel {

/// Finds the true vertices of a facet: points strictly inside where three waves tie, each sees them, and no other is nearer.
class BisectorVertices {
 public:
  struct Found {
    bool exists = false;
    FacetTessellation::Node node;     ///< sites: all whose regions meet there, counter-clockwise
    std::vector<std::uint32_t> open;  ///< the same as contenders, as far as growth has not closed them there
    std::uint32_t id = FacetTessellation::Piece::kNoNode;  ///< in the result, once it is used there
    bool has(std::uint32_t contender) const { return std::find(open.begin(), open.end(), contender) != open.end(); }
    /// Whether the region of b follows that of a, as yet.
    bool follows(std::uint32_t a, std::uint32_t b) const {
      for (std::size_t m = 0; exists && open.size() > 2 && m < open.size(); ++m)
        if (open[m] == a) return open[(m + 1) % open.size()] == b;
      return false;
    }
  };

  BisectorVertices(FacetWaves& waves, const Contenders& contenders, const FacetFilter& filter, FacetLadder& ladder)
      : waves_(waves), contenders_(contenders), filter_(filter, contenders), ladder_(ladder), rivals_(ladder.room()) {}

  /// Only these contenders can conflict: the others own no area of the facet. To be called first.
  void set_rivals(std::span<const std::uint32_t> rivals);
  /// The nodes that `walked` has by now are all that the walk round the facet has found: only where it has none may a vertex lie on a side.
  void set_outline(const FacetTessellation& walked);

  /// The vertex with the regions of i, j, k counter-clockwise round it, perhaps with others in between. Remembered, and one for all triples that
  /// meet in one point. Null on failure. Pre: i, j, k are different rivals.
  Found* find(std::uint32_t i, std::uint32_t j, std::uint32_t k);
  /// How to construct the vertex: the three waves in counter-clockwise order, the pivot in the middle; or, if two of them are tangent,
  /// the relay, the third wave, and the parent's boundary ray.
  struct Triple {
    std::array<std::uint32_t, 3> waves{};
    bool on_ray = false;
    std::uint32_t pivot = 0, other = 0, parent = 0;
    std::uint8_t ray_end = 0;
  };
  /// The same without memory and with other rivals, by doubles alone; empty if they cannot tell.
  struct InDoubles {
    bool exists = false;
    Triple triple;
    VertexFilter::Location at;
    const std::array<std::uint32_t, 3>& waves() const { return triple.waves; }  ///< counter-clockwise
  };
  std::optional<InDoubles> find_in_doubles(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::span<const std::uint32_t> rivals);
  /// Whether a rival sees that point and is nearer.
  std::optional<bool> is_beaten(const InDoubles& vertex, std::uint32_t rival);
  FacetTessellation::Node node(const InDoubles& vertex) const;

 private:
  enum class Verdict { pass, reject, open, tie, on_ray };
  /// What has to hold: existence, then within the three sides, in the cones of the three (two rays each), then not in conflict with a rival.
  static constexpr std::uint32_t kExistence = 0, kSides = 1, kCones = 4, kRivals = 10;

  std::optional<Triple> triple(std::uint32_t i, std::uint32_t j, std::uint32_t k) const;
  void examine(const Triple& triple, Found& found);
  bool examine_in_doubles(const Triple& triple, std::span<const std::uint32_t> rivals, InDoubles& found);
  template <class NT>
  predicates::BisectorVertex<NT> construct(const FacetNumbers<NT>& numbers, const Triple& triple) const;
  template <class NT>
  bool run_tests(const FacetNumbers<NT>& numbers, robust::Stage stage, const Triple& triple);
  template <class NT>
  Verdict test(const FacetNumbers<NT>& numbers, const Triple& triple, const predicates::BisectorVertex<NT>& vertex,
               const predicates::PlanePoint<NT>& p, std::uint32_t what) const;
  template <class NT>
  Verdict conflict(const FacetNumbers<NT>& numbers, const Triple& triple, const predicates::BisectorVertex<NT>& vertex,
                   const predicates::PlanePoint<NT>& p, std::uint32_t rival) const;
  template <class NT>
  Verdict against_side(const FacetNumbers<NT>& numbers, std::uint8_t side, const predicates::PlanePoint<NT>& p) const;
  bool settle_where_they_part(const Triple& triple);
  bool add_eclipsed_ties(const Triple& triple, const FacetTessellation::Node& node);
  FacetTessellation::Node node_of(const Triple& triple) const;
  void forget();
  std::int32_t& remembered(std::uint32_t i, std::uint32_t j, std::uint32_t k);
  static predicates::Predicate predicate_of(std::uint32_t what);
  std::string describe(const Triple& triple, std::uint32_t what) const;

  FacetWaves& waves_;
  const Contenders& contenders_;
  VertexFilter filter_;
  FacetLadder& ladder_;
  std::pmr::vector<std::uint32_t> rivals_;
  const FacetTessellation* walked_ = nullptr;
  std::size_t nodes_of_walk_ = 0;
  std::vector<std::uint32_t> rank_;       ///< of a contender among the rivals
  std::vector<std::int32_t> remembered_;  ///< per ordered triple of rivals: 0 unknown, else 1 + index in found_
  std::vector<std::unique_ptr<Found>> found_;  ///< pointers to them are handed out
  std::vector<std::uint32_t> pending_, ties_;
  std::vector<std::pair<std::uint32_t, robust::Sign>> settled_;  ///< conflicts of rivals that are known already
  bool on_boundary_ray_ = false;  ///< the vertex being examined lies on one of the three's, other than by construction
};

}  // namespace gvd::kernel
