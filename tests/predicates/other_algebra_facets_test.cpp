// What algebra says about waves in a facet and about angles, beside Calcium and CORE.
#include <CGAL/CORE_Expr.h>

#include "support/calcium.hpp"
#include "support/other_number.hpp"

#include "gvd/kernel/node_point.hpp"
#include "gvd/predicates/wave.hpp"
#include "support/closing_fans.hpp"
#include "support/tied_facets.hpp"

namespace gvd::kernel {
namespace {

using predicates::Existence;
using predicates::PlanePoint;
using predicates::operator+;
using predicates::operator-;
using robust::Exact;
using robust::MaybeSign;
using robust::Sign;
using namespace gvd::test;

/// The decisions of a facet in one number type, each as the sign of one expression. What does not exist has no sign.
template <class NT>
class FacetSigns {
 public:
  FacetSigns(const LatticeWaves& waves, const auto& from) : waves_(waves), known_(waves.template numbers_from<NT>(from)) {
    numbers_.frame = &known_.frame;
    numbers_.sites = SiteNumbers<NT>(known_.sites.size());
    for (std::size_t i = 0; i < known_.sites.size(); ++i) numbers_.sites.set(i, known_.sites[i]);
    for (std::size_t k = 0; k < 3; ++k) numbers_.side[k] = predicates::side_line(known_.frame, k);
  }

  /// Which of two waves is nearer beside corner 0, along side 0.
  MaybeSign corner_order(std::uint32_t a, std::uint32_t b) const {
    const auto &along = numbers_.side[0].direction, &to_a = known_.sites[a].image, &to_b = known_.sites[b].image;
    return maybe_sign(dot(to_a, along) * sqrt(squared_norm(to_b)) - dot(to_b, along) * sqrt(squared_norm(to_a)));
  }
  /// Whether a point of side 0 where two waves tie comes before another one.
  MaybeSign edge_tie(const std::array<std::uint32_t, 4>& w) const {
    const auto tie = [&](std::uint32_t a, std::uint32_t b) {
      const auto there = predicates::overtaking(numbers_.side[0], known_.sites[a], known_.sites[b], have_one_weight(a, b));
      return there.existence == Existence::proved
                 ? there
                 : predicates::overtaking(numbers_.side[0], known_.sites[b], known_.sites[a], have_one_weight(a, b));
    };
    const auto first = tie(w[0], w[1]), second = tie(w[2], w[3]);
    if (first.existence != Existence::proved || second.existence != Existence::proved) return std::nullopt;
    return maybe_sign(first.t - second.t);
  }
  Existence bisector_vertex(const std::array<std::uint32_t, 3>& ijk) const { return vertex(ijk).existence; }
  /// Of the vertex of three waves: against side 0, the boundary rays of the first one, and a fourth wave.
  MaybeSign location(const std::array<std::uint32_t, 3>& ijk) const {
    return at_vertex(ijk, [&](const auto& v) { return maybe_sign(cross(numbers_.side[0].direction, v.p + image(ijk[1]) - numbers_.side[0].origin)); });
  }
  MaybeSign cone_membership(const std::array<std::uint32_t, 3>& ijk, std::size_t end) const {
    return at_vertex(ijk, [&](const auto& v) { return maybe_sign(predicates::cone_side(known_.sites[ijk[0]], end, v.p + image(ijk[1]))); });
  }
  MaybeSign conflict(const std::array<std::uint32_t, 3>& ijk, std::uint32_t rival) const {
    return at_vertex(ijk, [&](const auto& v) { return predicates::conflict(relative_wave(waves_, numbers_, ijk[1], rival), v); });
  }
  /// Of two waves at a point.
  MaybeSign distance(const PlanePoint<NT>& p, std::uint32_t a, std::uint32_t b) const {
    return maybe_sign(predicates::distance(known_.sites[a], p) - predicates::distance(known_.sites[b], p));
  }
  PlanePoint<NT> corner() const { return numbers_.side[0].origin; }

 private:
  bool have_one_weight(std::uint32_t a, std::uint32_t b) const { return waves_.sites[a].root == waves_.sites[b].root; }
  const PlanePoint<NT>& image(std::uint32_t i) const { return known_.sites[i].image; }
  auto vertex(const std::array<std::uint32_t, 3>& ijk) const { return vertex_of(waves_, numbers_, ijk[0], ijk[1], ijk[2]); }
  MaybeSign at_vertex(const std::array<std::uint32_t, 3>& ijk, const auto& sign) const {
    const auto v = vertex(ijk);
    return v.existence == Existence::proved ? sign(v) : std::nullopt;
  }

  const LatticeWaves& waves_;
  LatticeWaves::Numbers<NT> known_;
  FacetNumbers<NT> numbers_;
};

/// How often the other numbers agreed with ours, at zero and elsewhere.
struct Agreement {
  int zeros = 0, others = 0;
};

template <class X>
class OtherAlgebraOfFacets : public testing::Test {
 protected:
  /// `ask(signs)` gives the same answer in our numbers and in the others.
  void compare(const LatticeWaves& waves, const auto& ask) {
    const FacetSigns<Exact> ours(waves, [](const mpq_class& q) { return Exact(q); });
    const FacetSigns<OtherNumber<X>> theirs(waves, [](const mpq_class& q) { return OtherNumber<X>(q); });
    const auto sign = ask(ours);
    ASSERT_EQ(sign, ask(theirs));
    if constexpr (std::is_same_v<decltype(sign), const Existence>)
      ++(sign == Existence::proved ? count.others : count.zeros);
    else if (sign)
      ++(*sign == Sign::zero ? count.zeros : count.others);
  }
  /// Four waves that tie, and then not quite: one of them late, or, on a side, the point beside it.
  void compare_tied(Node::Kind kind, const auto& ask) {
    for (int round = 0; round < 8; ++round) {
      const TiedFacet f = tied_facet(kind, 4, false, round % 2 == 0, random);
      compare(f.waves(), ask);
      TiedFacet late = f, beside = f;
      late.one_source = false;
      late.late[round / 2 % 4] = small_step(random);
      compare(late.waves(), ask);
      if (kind != Node::Kind::side) continue;
      beside.p.y += small_step(random);
      compare(beside.waves(), ask);
    }
  }
  void expect_both() const {
    EXPECT_GE(count.zeros, 4);
    EXPECT_GE(count.others, 4);
  }
  Random random{1100};
  Agreement count;
};

using Others = testing::Types<Calcium, CORE::Expr>;
TYPED_TEST_SUITE(OtherAlgebraOfFacets, Others);

TYPED_TEST(OtherAlgebraOfFacets, CornerOrder) {
  // Mirror images in side 0 grow alike along it.
  for (int round = 0; round < 8; ++round) {
    const TiedFacet f = tied_facet(Node::Kind::corner, 3, true, round % 2 == 0, this->random);
    for (const TiedFacet& c : {f, neighbour(f, this->random)}) this->compare(c.waves(), [](const auto& s) { return s.corner_order(0, 1); });
    this->compare(f.waves(), [](const auto& s) { return s.corner_order(0, 2); });
  }
  this->expect_both();
}
TYPED_TEST(OtherAlgebraOfFacets, EdgeTie) {
  this->compare_tied(Node::Kind::side, [](const auto& s) { return s.edge_tie({0, 1, 2, 3}); });
  this->expect_both();
}
TYPED_TEST(OtherAlgebraOfFacets, Location) {
  this->compare_tied(Node::Kind::side, [](const auto& s) { return s.location({0, 1, 2}); });
  this->compare_tied(Node::Kind::side, [](const auto& s) { return s.location({2, 1, 0}); });
  this->expect_both();
}
TYPED_TEST(OtherAlgebraOfFacets, Conflict) {
  this->compare_tied(Node::Kind::inside, [](const auto& s) { return s.conflict({0, 1, 2}, 3); });
  this->compare_tied(Node::Kind::inside, [](const auto& s) { return s.conflict({2, 1, 0}, 3); });
  this->expect_both();
}
TYPED_TEST(OtherAlgebraOfFacets, Distance) {
  this->compare_tied(Node::Kind::corner, [](const auto& s) { return s.distance(s.corner(), 0, 1); });
  this->expect_both();
}
TYPED_TEST(OtherAlgebraOfFacets, ConeMembership) {
  for (int round = 0; round < 8; ++round) {
    const Walls w = walls(3, this->random);
    Walls off = w;
    off.circle.late[2] = small_step(this->random);
    const auto order = w.circle.regions();
    for (const Walls& c : {w, off})
      for (const std::size_t end : {0u, 1u})
        this->compare(c.waves(), [&](const auto& s) { return s.cone_membership({2 * order[0], 2 * order[1], 2 * order[2]}, end); });
  }
  this->expect_both();
}
TYPED_TEST(OtherAlgebraOfFacets, BisectorVertex) {
  for (int round = 0; round < 8; ++round)
    for (const bool bent : {false, true})
      for (const auto& ijk : {std::array{0u, 1u, 2u}, std::array{2u, 1u, 0u}})
        this->compare(images_in_a_row(5, 3, bent, small_step(this->random), this->random), [&](const auto& s) { return s.bisector_vertex(ijk); });
  this->expect_both();
}

/// Fans whose angles add up to 2 pi or pi, and neighbours: the product of all dot + i sqrt(cross square) is real there, and the sign of its imaginary part
/// tells on which side of it the sum is nearby.
TYPED_TEST(OtherAlgebraOfFacets, AngleSum) {
  for (int round = 0; round < 8; ++round) {
    const ClosingFan fan = round % 2 == 0 ? supplementary_fan(this->random) : folded_fan<true>(this->random);
    for (const bool is_zero : {true, false}) {
      std::vector<predicates::ExactCorner> corners;
      for (const auto& [d, e] : fan.corners)
        corners.push_back(predicates::exact_corner({mpq_class(d[0]), mpq_class(d[1]), mpq_class(d[2])}, {mpq_class(e[0]), mpq_class(e[1]), mpq_class(e[2])}));
      if (!is_zero) corners[0].dot += small_step(this->random);
      using NT = OtherNumber<TypeParam>;
      NT x(1.0), y(0.0);
      for (const auto& corner : corners) {
        const NT dot(mpq_class(corner.dot)), root = sqrt(NT(mpq_class(corner.cross_square)));
        const NT next = x * dot - y * root;
        y = x * root + y * dot;
        x = next;
      }
      const MaybeSign above = maybe_sign(y);
      ASSERT_TRUE(above);
      const Sign expected = fan.quarter_turns == 4 ? *above : -*above;
      ASSERT_EQ(predicates::compare_angle_sum(corners, fan.quarter_turns).sign, expected);
      ASSERT_EQ(predicates::exact_compare_angle_sum(corners, fan.quarter_turns).value_or(expected), expected);
      ++(expected == Sign::zero ? this->count.zeros : this->count.others);
    }
  }
  this->expect_both();
}

}  // namespace
}  // namespace gvd::kernel
