// Which stage decides which predicate: every cell of the table in docs/exactness.md is either reached here, by the counts of decisions, or cannot be.
#include "gvd/kernel/solver.hpp"
#include "support/bump.hpp"
#include "support/folded_grid.hpp"
#include "support/mirrored_terrain.hpp"
#include "support/tied_facets.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using predicates::Decisions;
using predicates::Predicate;
using robust::Stage;
using namespace gvd::test;

/// Waves that tie, and neighbours; then the same ties without exact numbers.
void look_at_facets(Decisions& decisions) {
  Random random(1000);
  const auto look = [&](LatticeWaves waves, bool exact) {
    waves.offers_exact = exact;
    tessellate(waves, decisions);
  };
  for (int round = 0; round < 60; ++round) {
    for (const Node::Kind kind : {Node::Kind::corner, Node::Kind::side, Node::Kind::inside}) {
      const TiedFacet f = tied_facet(kind, 4, round % 2 == 0, round % 4 != 0, random);
      for (const bool exact : {true, false}) look(f.waves(), exact);
      look(neighbour(f, random).waves(), true);
    }
    const Walls two = walls(2, random);
    for (const bool exact : {true, false}) look(two.waves(), exact);
    look(two.two_of_them(small_step(random)).waves(), true);
    const mpq_class step = small_step(random);
    for (const bool bent : {false, true})
      for (const bool exact : {true, false}) look(images_in_a_row(5, 3, bent, step, random), exact);
  }
}

void solve_into(Decisions& decisions, const Mesh& mesh, const std::vector<Source>& sources, bool diagram) {
  SolveOptions options;
  options.diagram = diagram;
  decisions.merge(solve(mesh, sources, options).decisions());
}

/// Vertices in line with a source, and as far from two.
void look_at_folded_grids(Decisions& decisions) {
  Random random(1001);
  for (int round = 0; round < 20; ++round) {
    const FoldedGrid grid = folded_grid(3 + random.below(2), random);
    const Mesh mesh(grid.arrays);
    for (const mpq_class& step : {mpq_class(0), mpq_class(1, 1 << 30), mpq_class(1, mpz_class(1) << 60)})
      solve_into(decisions, mesh, {{point_on_edge(mesh, 0, grid.vertex(0, 1), step), 0}, {point_at_vertex(mesh, grid.vertex(0, 2)), 0}}, round < 4);
  }
}

/// A ray that just passes a bump, or just does not.
void look_at_a_bump(Decisions& decisions, unsigned bits) {
  const Bump bump;
  const Mesh mesh(bump.arrays);
  solve_into(decisions, mesh, {{bump.below(mesh, bits), 0}}, false);
}

/// Nearer to mirror images than double-doubles tell, and than 1024 bits do.
void look_at_mirrored_terrain(Decisions& decisions) {
  const Mesh mesh(mirrored_terrain());
  for (const unsigned bits : {250u, 400u, 2000u}) solve_into(decisions, mesh, mirrored_sources(mesh, mpq_class(1, mpz_class(1) << bits)), false);
}

/// A square cut into flat faces, with sources inside faces, and one whose distance to a vertex lies halfway between two doubles.
void look_at_the_plane(Decisions& decisions) {
  const Mesh mesh(flat_grid(4, 4));
  solve_into(decisions, mesh, {at_vertex(mesh, 6), at_vertex(mesh, 8), at_vertex(mesh, 16), at_vertex(mesh, 18)}, true);
  const mpq_class t = mpq_class(1, 4) + mpq_class(1, mpz_class(1) << 54);
  solve_into(decisions, mesh, {{point_on_edge(mesh, 0, 1, t), 0}}, false);
}

enum : char { kNever = '-', kElsewhere = 'e' };
struct Row {
  Predicate predicate;
  const char* cells;  ///< per stage: its letter if it is reached here, else kNever or kElsewhere
};
/// i identity, f filter, d double-double, m MPFR, a algebra, u undecided. Why the others cannot be: docs/exactness.md.
constexpr std::array<Row, 11> kTable{{{Predicate::window_orientation, "-fdmau"},
                                      {Predicate::window_pruning, "-f----"},
                                      {Predicate::vertex_distance, "-fdmau"},
                                      {Predicate::rounding, "i-deae"},
                                      {Predicate::saddle, "ifdea-"},
                                      {Predicate::edge_tie, "ifdmau"},
                                      {Predicate::corner_order, "efdmau"},
                                      {Predicate::bisector_vertex, "-fdmau"},
                                      {Predicate::cone_membership, "-fdmau"},
                                      {Predicate::conflict, "-fdmau"},
                                      {Predicate::location, "-fdmau"}}};

TEST(StageTable, EveryStageOfEveryPredicateIsReached) {
  Decisions decisions;
  look_at_facets(decisions);
  look_at_folded_grids(decisions);
  look_at_mirrored_terrain(decisions);
  for (const unsigned bits : {150u, 1300u}) look_at_a_bump(decisions, bits);
  look_at_the_plane(decisions);
  for (const auto& [predicate, cells] : kTable) {
    const auto p = static_cast<std::size_t>(predicate);
    for (std::size_t s = 0; s < robust::kStageCount; ++s) {
      const std::uint64_t count = decisions(p, static_cast<Stage>(s));
      const std::string cell = std::string(predicates::kPredicateNames[p]) + ", " + robust::kStageNames[s];
      if (cells[s] == kElsewhere) continue;
      EXPECT_EQ(count > 0, cells[s] != kNever) << cell << ": " << count;
    }
  }
}

}  // namespace
}  // namespace gvd::kernel
