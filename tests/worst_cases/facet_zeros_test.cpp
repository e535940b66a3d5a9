// Worst cases of the decisions inside a facet: waves that tie at a corner, on a side or inside by construction, and their nearest neighbours.
#include "support/tied_facets.hpp"

#include "support/facet_reference.hpp"

namespace gvd::kernel {
namespace {

using predicates::Decisions;
using predicates::Predicate;
using robust::Stage;
using namespace gvd::test;

/// Whether the node may be within 10^-4 of the point.
bool is_near(const TiedFacet& f, const Node& node, const LatticeWaves& waves) {
  const auto at = waves.flat(f.p);
  const auto apart = [&](const FacetWaves::F& x, const Real& truth) {
    return std::fabs(x.mid() - static_cast<double>(truth) / f.length.get_d()) > x.rad() + 1e-4;
  };
  return !apart(node.x, at[0]) && !apart(node.y, at[1]);
}

bool same_cycle(std::vector<std::uint32_t> a, const std::vector<std::uint32_t>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t turn = 0; turn < a.size(); ++turn, std::rotate(a.begin(), a.begin() + 1, a.end()))
    if (a == b) return true;
  return false;
}

class FacetZeros : public testing::Test {
 protected:
  /// Everything is decided; counted with the zeros, or with their neighbours.
  FacetTessellation tessellated(LatticeWaves& waves, bool tie) {
    Decisions decisions;
    const FacetTessellation t = tessellate(waves, decisions);
    for (const auto& what : decisions.undecided_list()) ADD_FAILURE() << what;
    (tie ? zeros : neighbours).merge(decisions);
    return t;
  }
  static std::uint64_t counted(const Decisions& decisions, Predicate p, Stage s) { return decisions(static_cast<std::size_t>(p), s); }
  void expect_zeros(Predicate p, std::uint64_t least) const { EXPECT_GE(counted(zeros, p, Stage::algebra), least); }
  void expect_neighbours(Predicate p) const {
    for (const Stage s : {Stage::filter, Stage::double_double, Stage::mpfr}) EXPECT_GT(counted(neighbours, p, s), 0u) << static_cast<int>(s);
  }
  void run(Node::Kind kind, int rounds);

  Random random{800};
  Decisions zeros, neighbours;
};

/// At p meet the regions of those that tie there; everything else near p has to do with the wave that came late or early.
void check(const TiedFacet& f, const LatticeWaves& waves, const FacetTessellation& t) {
  const auto expected = f.regions();
  // Where a region only touches a side, the other one goes on along it.
  const bool touches = expected.size() == 3 && expected.front() == expected.back();
  const bool is_node = f.kind == Node::Kind::inside ? expected.size() > 2 : expected.size() > 1 && !touches;
  int found = 0, others = 0;
  for (const Node& node : t.nodes) {
    if (!is_near(f, node, waves)) continue;
    const bool is_it = node.kind == f.kind && (f.kind == Node::Kind::inside ? same_cycle(node.sites, expected) : node.sites == expected);
    const bool tie = std::all_of(node.sites.begin(), node.sites.end(), [&](std::uint32_t i) { return f.late[i] == f.late[expected[0]]; });
    found += is_it;
    others += tie && !is_it;
  }
  EXPECT_EQ(found, is_node ? 1 : 0);
  EXPECT_TRUE(others == 0 || f.turned);
}

void FacetZeros::run(Node::Kind kind, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    const TiedFacet f = tied_facet(kind, round % 2 == 0, round % 4 != 0, random), off = neighbour(f, random);
    for (const bool tie : {true, false}) {
      const TiedFacet& c = tie ? f : off;
      LatticeWaves waves = c.waves();
      const FacetTessellation t = tessellated(waves, tie);
      check(c, waves, t);
      if (tie && round % 256 == 0) {
        EXPECT_EQ(FacetReference(waves).check(t), "");
      }
      if (HasFailure()) FAIL() << "round " << round << (tie ? "" : ", neighbour");
    }
  }
}

TEST_F(FacetZeros, AtACorner) {
  run(Node::Kind::corner, 5000);
  expect_zeros(Predicate::corner_order, 10000);
  expect_neighbours(Predicate::corner_order);
}

TEST_F(FacetZeros, OnASide) {
  run(Node::Kind::side, 1200);
  expect_zeros(Predicate::edge_tie, 2500);
  expect_zeros(Predicate::location, 500);
  expect_neighbours(Predicate::edge_tie);
  expect_neighbours(Predicate::location);
}

TEST_F(FacetZeros, Inside) {
  run(Node::Kind::inside, 1000);
  expect_zeros(Predicate::conflict, 2000);
  expect_neighbours(Predicate::conflict);
}

TEST_F(FacetZeros, WhereBoundaryRaysMeet) {
  for (int round = 0; round < 2400; ++round) {
    TwoWalls walls = two_walls(random);
    for (const bool tie : {true, false}) {
      if (!tie) walls.circle.late[1] = random.below(2) == 0 ? small_step(random) : mpq_class(-small_step(random));
      LatticeWaves waves = walls.waves();
      const FacetTessellation t = tessellated(waves, tie);
      const auto expected = walls.nodes();
      std::size_t found = 0;
      for (const Node& node : t.nodes) {
        if (node.kind != Node::Kind::inside || !is_near(walls.circle, node, waves)) continue;
        ++found;
        EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [&](const auto& sites) { return same_cycle(node.sites, sites); }));
      }
      EXPECT_EQ(found, expected.size());
      if (tie && round % 256 == 0) {
        EXPECT_EQ(FacetReference(waves).check(t), "");
      }
      if (HasFailure()) FAIL() << "round " << round << (tie ? "" : ", neighbour");
    }
  }
  expect_zeros(Predicate::cone_membership, 1000);
  expect_neighbours(Predicate::cone_membership);
}

TEST_F(FacetZeros, ImagesInARow) {
  for (int round = 0; round < 3800; ++round) {
    const std::uint64_t seed = random.next();
    const int c = 2 + static_cast<int>(random.below(5));
    const mpq_class step = random.below(2) == 0 ? small_step(random) : mpq_class(-small_step(random));
    for (const bool tie : {true, false}) {
      Random same(seed);
      LatticeWaves waves = images_in_a_row(c, !tie, step, same);
      const FacetTessellation t = tessellated(waves, tie);
      EXPECT_TRUE(std::none_of(t.nodes.begin(), t.nodes.end(), [](const Node& node) { return node.kind == Node::Kind::inside; }));
      if (round % 256 == 0) {
        EXPECT_EQ(FacetReference(waves).check(t), "");
      }
      if (HasFailure()) FAIL() << "round " << round;
    }
  }
  expect_zeros(Predicate::bisector_vertex, 1000);
  expect_neighbours(Predicate::bisector_vertex);
}

}  // namespace
}  // namespace gvd::kernel
