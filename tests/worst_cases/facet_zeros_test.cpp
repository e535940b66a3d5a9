// Worst cases of the decisions inside a facet: waves that tie at a corner, on a side or inside by construction, and their nearest neighbours.
#include "../../kernel/src/facet_filter.hpp"
#include "../../kernel/src/vertex_finder.hpp"
#include "support/facet_reference.hpp"
#include "support/tied_facets.hpp"
#include "support/zero_cases.hpp"

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
  if (a.empty()) return true;
  for (std::size_t turn = 0; turn < a.size(); ++turn, std::rotate(a.begin(), a.begin() + 1, a.end()))
    if (a == b) return true;
  return false;
}

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

struct NamedNode {
  Node::Kind kind;
  std::uint8_t where;
  std::vector<std::uint32_t> sites;  ///< for one inside, the lowest comes first
  auto operator<=>(const NamedNode&) const = default;
};
/// What meets where. `mirrored`: seen again in the mirror of LatticeWaves::mirrored, the last site the first one.
std::vector<NamedNode> named_nodes(const FacetTessellation& t, std::uint32_t sites, bool mirrored) {
  std::vector<NamedNode> list;
  for (const Node& node : t.nodes) {
    NamedNode named{node.kind, node.kind == Node::Kind::inside ? std::uint8_t{0} : node.where, node.sites};
    if (mirrored) {
      std::reverse(named.sites.begin(), named.sites.end());
      for (std::uint32_t& site : named.sites) site = sites - 1 - site;
      if (node.kind == Node::Kind::corner) named.where = LatticeWaves::kMirroredCorner[node.where];
      if (node.kind == Node::Kind::side) named.where = LatticeWaves::kMirroredSide[node.where];
    }
    if (node.kind == Node::Kind::inside) std::rotate(named.sites.begin(), std::min_element(named.sites.begin(), named.sites.end()), named.sites.end());
    list.push_back(named);
  }
  std::sort(list.begin(), list.end());
  return list;
}

/// Vertices of single triples, each asked for by itself among the rivals given.
class TripleVertices {
 public:
  TripleVertices(FacetWaves& waves, Decisions& decisions)
      : waves_(waves), ladder_(waves, decisions), contenders_(waves, ladder_), filter_(contenders_, ladder_) {
    EXPECT_EQ(contenders_.size(), waves.sites.size());
  }
  /// The regions that meet in the vertex, counter-clockwise; empty if there is none.
  std::vector<std::uint32_t> regions(const std::array<std::uint32_t, 3>& ijk, const std::vector<std::uint32_t>& rivals) {
    BisectorVertices vertices(waves_, contenders_, filter_, ladder_);
    vertices.set_rivals(rivals);
    const BisectorVertices::Found* found = vertices.find(ijk[0], ijk[1], ijk[2]);
    EXPECT_FALSE(ladder_.failed());
    return found == nullptr || !found->exists ? std::vector<std::uint32_t>() : found->node.sites;
  }

 private:
  FacetWaves& waves_;
  FacetLadder ladder_;
  Contenders contenders_;
  FacetFilter filter_;
};

/// Calls visit with every triple of a list, in its order.
template <class Visit>
void for_each_triple(const std::vector<std::uint32_t>& list, const Visit& visit) {
  for (std::size_t k = 2; k < list.size(); ++k)
    for (std::size_t j = 1; j < k; ++j)
      for (std::size_t i = 0; i < j; ++i) visit(std::array{list[i], list[j], list[k]});
}

class FacetZeros : public testing::TestWithParam<ZeroShare> {
 protected:
  /// Everything is decided; counted with the zeros, or with their neighbours. One facet in 16 is asked again in a mirror and with its waves in the opposite
  /// order, so that all that is compared is exchanged and all that turns turns the other way; brute force looks at one in 256.
  FacetTessellation tessellated(LatticeWaves& waves, bool tie, int round) {
    Decisions decisions;
    const FacetTessellation t = tessellate(waves, decisions);
    for (const auto& what : decisions.undecided_list()) ADD_FAILURE() << what;
    (tie ? counts.zeros : counts.neighbours).merge(decisions);
    if (asks_all_rungs(round)) {
      LatticeWaves mirrored = waves.mirrored();
      const auto n = static_cast<std::uint32_t>(waves.sites.size());
      EXPECT_EQ(named_nodes(tessellate(mirrored, decisions), n, true), named_nodes(t, n, false));
    }
    if (tie && round % 256 == 0) {
      EXPECT_EQ(FacetReference(waves).check(t), "");
    }
    return t;
  }
  void at_a_point(Node::Kind kind, int round);
  void vertices_on_a_side(int round);
  void where_boundary_rays_meet(int round);
  void vertices_on_boundary_rays();
  void images_in_one_row(int round);
  void images_on_one_line(int round);

  Random random{GetParam().seed()};
  ZeroCounts counts;
};

void FacetZeros::at_a_point(Node::Kind kind, int round) {
  const std::size_t n = kind == Node::Kind::inside ? 4 + random.below(5) : 3 + random.below(5);
  TiedFacet f = tied_facet(kind, n, round % 2 == 0, round % 4 != 0, random);
  if (round % 8 == 5) add_close_direction(f, random);
  const TiedFacet off = neighbour(f, random);
  for (const bool tie : {true, false}) {
    const TiedFacet& c = tie ? f : off;
    LatticeWaves waves = c.waves();
    check(c, waves, tessellated(waves, tie, round));
    if (HasFailure()) FAIL() << (tie ? "" : "neighbour");
  }
}

/// The outline has what is on a side; a vertex is strictly inside. Neighbours: the centre of the circle just inside, or outside.
void FacetZeros::vertices_on_a_side(int round) {
  const TiedFacet f = tied_facet(Node::Kind::side, 6, round % 2 == 0, round % 4 != 0, random);
  TiedFacet round_about = f;
  round_about.kind = Node::Kind::inside;  // only for the order of the directions
  const auto order = round_about.regions();
  for (const int above : {0, 1, -1}) {
    TiedFacet c = f;
    c.p.y += above * small_step(random);
    LatticeWaves waves = c.waves();
    TripleVertices vertices(waves, above == 0 ? counts.zeros : counts.neighbours);
    for_each_triple(order, [&](const auto& ijk) {
      const auto expected = above > 0 ? std::vector(ijk.begin(), ijk.end()) : std::vector<std::uint32_t>();
      EXPECT_TRUE(same_cycle(vertices.regions(ijk, {ijk.begin(), ijk.end()}), expected)) << above;
    });
  }
}

/// Three windows that tie on a boundary ray of each, with the relays there; and with one of them late, when they tie off these rays.
void FacetZeros::vertices_on_boundary_rays() {
  const Walls w = walls(5, random);
  LatticeWaves waves = w.waves();
  TripleVertices vertices(waves, counts.zeros);
  const mpq_class step = random.below(2) == 0 ? small_step(random) : mpq_class(-small_step(random));
  for_each_triple(w.circle.regions(), [&](const auto& ijk) {
    std::vector<std::uint32_t> expected;
    for (const std::uint32_t wall : ijk) expected.insert(expected.end(), {w.before(wall), w.after(wall)});
    const std::array windows{2 * ijk[0], 2 * ijk[1], 2 * ijk[2]};
    EXPECT_TRUE(same_cycle(vertices.regions(windows, expected), expected));

    // The tie moves at right angles to the difference of the first two directions.
    const auto &ui = w.circle.to_image[ijk[0]], &uj = w.circle.to_image[ijk[1]], &uk = w.circle.to_image[ijk[2]];
    const LatticePoint d = TiedFacet::minus(ui, uj);
    LatticePoint moved{w.circle.c * d.y, -d.x};
    if (sgn(w.circle.dot(moved, TiedFacet::minus(uk, ui))) * sgn(step) < 0) moved = mpq_class(-1) * moved;
    const auto on_ray = [&](std::uint32_t wall) { return TiedFacet::cross(w.circle.to_image[wall], moved) == 0; };
    if (std::any_of(ijk.begin(), ijk.end(), on_ray)) return;
    const bool exists = std::all_of(ijk.begin(), ijk.end(), [&](std::uint32_t wall) { return w.seeing(wall, moved) == 2 * wall; });
    Walls off = w;
    off.circle.late[ijk[2]] = step;
    LatticeWaves late = off.waves();
    const auto regions = TripleVertices(late, counts.neighbours).regions(windows, {windows.begin(), windows.end()});
    EXPECT_TRUE(same_cycle(regions, exists ? std::vector(windows.begin(), windows.end()) : std::vector<std::uint32_t>())) << exists;
  });
}

void FacetZeros::where_boundary_rays_meet(int round) {
  const Walls all = walls(2 + random.below(4), random);
  const Walls off = all.two_of_them(random.below(2) == 0 ? small_step(random) : mpq_class(-small_step(random)));
  for (const bool tie : {true, false}) {
    const Walls& w = tie ? all : off;
    LatticeWaves waves = w.waves();
    const FacetTessellation t = tessellated(waves, tie, round);
    const auto expected = w.nodes();
    std::size_t found = 0;
    for (const Node& node : t.nodes) {
      if (node.kind != Node::Kind::inside || !is_near(w.circle, node, waves)) continue;
      ++found;
      EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [&](const auto& sites) { return same_cycle(node.sites, sites); }));
    }
    EXPECT_EQ(found, expected.size());
    if (HasFailure()) FAIL() << (tie ? "" : "neighbour");
  }
}

void FacetZeros::images_in_one_row(int round) {
  const std::uint64_t seed = random.next();
  const int c = 2 + static_cast<int>(random.below(5)), n = 3 + static_cast<int>(random.below(4));
  const mpq_class step = random.below(2) == 0 ? small_step(random) : mpq_class(-small_step(random));
  for (const bool tie : {true, false}) {
    Random same(seed);
    LatticeWaves waves = images_in_a_row(c, n, !tie, step, same);
    const FacetTessellation t = tessellated(waves, tie, round);
    EXPECT_TRUE(std::none_of(t.nodes.begin(), t.nodes.end(), [](const Node& node) { return node.kind == Node::Kind::inside; }));
  }
}

/// A wave that starts on another one's line gets nothing if it is on time or late. If it is early it has a sliver about that line, up to where the third one is
/// nearer: a triple with two vertices, close to each other.
void FacetZeros::images_on_one_line(int round) {
  const mpq_class step = small_step(random);
  const std::uint64_t seed = random.next();
  for (const int late : {0, 1, -1}) {
    Random same(seed);
    LatticeWaves waves = on_one_line(late * step, same).waves();
    const FacetTessellation t = tessellated(waves, late == 0, round);
    std::vector<std::vector<std::uint32_t>> inside;
    for (const Node& node : t.nodes)
      if (node.kind == Node::Kind::inside) inside.push_back(node.sites);
    ASSERT_EQ(inside.size(), late < 0 ? 2u : 0u) << late;
    TripleVertices vertices(waves, late == 0 ? counts.zeros : counts.neighbours);
    for (const std::array<std::uint32_t, 3>& ijk : {std::array{0u, 1u, 2u}, std::array{1u, 0u, 2u}}) {
      const auto expected = late < 0 ? std::vector(ijk.begin(), ijk.end()) : std::vector<std::uint32_t>();
      EXPECT_TRUE(same_cycle(vertices.regions(ijk, {0, 1, 2}), expected)) << late;
      EXPECT_TRUE(late >= 0 || same_cycle(inside[0], expected) || same_cycle(inside[1], expected));
    }
  }
}

TEST_P(FacetZeros, AndTheirNeighbours) {
  const auto [predicate, number] = GetParam();
  const int most_rounds = static_cast<int>(4 * GetParam().cases());
  for (int round = 0; counts.at_zero(predicate) < GetParam().cases(); ++round) {
    ASSERT_LT(round, most_rounds);
    switch (predicate) {
      case Predicate::corner_order: at_a_point(Node::Kind::corner, round); break;
      case Predicate::edge_tie: at_a_point(Node::Kind::side, round); break;
      case Predicate::location: vertices_on_a_side(round); break;
      case Predicate::conflict: at_a_point(Node::Kind::inside, round); break;
      case Predicate::cone_membership: round % 8 == 0 ? where_boundary_rays_meet(round) : vertices_on_boundary_rays(); break;
      case Predicate::bisector_vertex: round % 2 == 0 ? images_in_one_row(round) : images_on_one_line(round); break;
      default: FAIL() << "no cases of this predicate are made here";
    }
    if (HasFailure()) FAIL() << "round " << round;
  }
  counts.expect_neighbours(predicate, {Stage::filter, Stage::double_double, Stage::mpfr});
}

INSTANTIATE_TEST_SUITE_P(Shares, FacetZeros, testing::ValuesIn(shares_of(ZeroTest::facet)), [](const auto& share) { return share.param.name(); });

}  // namespace
}  // namespace gvd::kernel
