// Predicates with proofs taken away from them: of every case at exact zero and its neighbour each question to algebra is refused in turn, alone or with all
// that follow. The answer must be the same, or undecided.
#include "gvd/robust/proof_limit.hpp"

#include "support/closing_fans.hpp"
#include "support/equal_paths.hpp"
#include "support/in_line.hpp"
#include "support/midpoint_paths.hpp"
#include "support/tied_sites.hpp"
#include "support/tied_windows.hpp"

namespace gvd::predicates {
namespace {

using robust::ProofLimit;
using namespace gvd::test;

constexpr int kCases = 4;

/// What a predicate says; empty if undecided.
template <class Answer>
using Said = std::optional<Answer>;

/// How often a limit mattered, and how often it left the question undecided.
struct Limited {
  int asked = 0, undecided = 0;

  template <class Ask, class Same>
  void ask(const Ask& ask, const Same& same) {
    const auto said = ask();
    for (const std::uint64_t refused : {std::uint64_t{1}, ProofLimit::kAll}) {
      bool goes_on = true;
      for (std::uint64_t questions = 0; goes_on; ++questions) {
        const ProofLimit limit(questions, refused);
        const auto limited = ask();
        EXPECT_TRUE(!limited || (said && same(*limited, *said))) << "with " << questions << " proofs";
        EXPECT_TRUE(limited || !said || limit.was_reached()) << "with " << questions << " proofs";
        goes_on = limit.was_reached() && !testing::Test::HasFailure();
        asked += limit.was_reached();
        undecided += !limited;
      }
    }
  }
  template <class Ask>
  void ask(const Ask& question) {
    ask(question, std::equal_to<>());
  }
  /// Algebra was wanted, and without it nothing else told that zero was zero.
  void expect_both() const {
    EXPECT_GT(asked, 0);
    EXPECT_GT(undecided, 0);
  }
};

template <class Family>
std::string name_of(const testing::TestParamInfo<Family>& family) {
  return family.param.name;
}

class RaySideLimit : public testing::TestWithParam<BandFamily> {};
TEST_P(RaySideLimit, SameOrUndecided) {
  Random random(1100);
  Limited limited;
  for (int i = 0; i < kCases; ++i) {
    const InLine c = in_line(GetParam(), random);
    for (const InLine& one : {c, neighbour(c, random)}) {
      const FaceStrip strip = one.strip.strip(), longer = one.extended().strip();
      limited.ask([&] { return ray_side(strip, one.through, one.v).sign; });
      limited.ask(
          [&]() -> Said<ConeDecision> {
            const ConeDecision cone = cone_of(longer);
            EXPECT_EQ(cone.sight == ConeDecision::Sight::undecided, cone.stage == robust::Stage::undecided);
            return cone.sight == ConeDecision::Sight::undecided ? std::nullopt : Said<ConeDecision>(cone);
          },
          [](const ConeDecision& a, const ConeDecision& b) { return a.sight == b.sight && a.bound == b.bound; });
    }
  }
  limited.expect_both();
}
INSTANTIATE_TEST_SUITE_P(Families, RaySideLimit, testing::ValuesIn(kBandFamilies), name_of<BandFamily>);

class CompareLengthsLimit : public testing::TestWithParam<EqualPathsFamily> {};
TEST_P(CompareLengthsLimit, SameOrUndecided) {
  Random random(1200);
  Limited limited;
  for (int i = 0; i < kCases; ++i) {
    const EqualPaths c = GetParam().make(random);
    EqualPaths off = c;
    off.a.given += small_step(random);
    for (const EqualPaths& one : {c, off}) {
      const Path a = one.a.described(), b = one.b.described();
      limited.ask([&] { return compare_lengths(a, b).sign; });
    }
  }
  limited.expect_both();
}
INSTANTIATE_TEST_SUITE_P(Families, CompareLengthsLimit, testing::ValuesIn(kEqualPathsFamilies), name_of<EqualPathsFamily>);

class RoundedLengthLimit : public testing::TestWithParam<MidpointFamily> {};
TEST_P(RoundedLengthLimit, SameOrUndecided) {
  Random random(1300);
  Limited limited;
  for (int i = 0; i < kCases; ++i) {
    const Path path = GetParam().make(random).path.described();
    limited.ask([&] { return rounded_length(path).value; });
  }
  limited.expect_both();
}
INSTANTIATE_TEST_SUITE_P(Families, RoundedLengthLimit, testing::ValuesIn(kMidpointFamilies), name_of<MidpointFamily>);

class AngleSumLimit : public testing::TestWithParam<FanFamily> {};
TEST_P(AngleSumLimit, SameOrUndecided) {
  Random random(1400);
  Limited limited;
  bool is_rational = true;  // then long numbers are exact
  for (int i = 0; i < kCases; ++i) {
    const ClosingFan fan = GetParam().make(random);
    std::vector<ExactCorner> corners;
    for (const auto& [d, e] : fan.corners)
      corners.push_back(exact_corner({mpq_class(d[0]), mpq_class(d[1]), mpq_class(d[2])}, {mpq_class(e[0]), mpq_class(e[1]), mpq_class(e[2])}));
    for (const ExactCorner& corner : corners) is_rational = is_rational && robust::rational_square_root(corner.cross_square);
    limited.ask([&] { return compare_angle_sum(corners, fan.quarter_turns).sign; });
    // Too few bits to tell anything, and more and more: the same, or nothing.
    for (int bits = 2; bits <= 64; ++bits) {
      EXPECT_EQ(multiprecision_compare_angle_sum(corners, fan.quarter_turns - 1, bits).value_or(robust::Sign::positive), robust::Sign::positive) << bits;
      EXPECT_EQ(multiprecision_compare_angle_sum(corners, fan.quarter_turns, bits).value_or(robust::Sign::zero), robust::Sign::zero) << bits;
    }
  }
  if (is_rational) {
    EXPECT_GT(limited.asked, 0);
  } else {
    limited.expect_both();
  }
}
INSTANTIATE_TEST_SUITE_P(Families, AngleSumLimit, testing::ValuesIn(kFanFamilies), name_of<FanFamily>);

/// The same places, however well they are known.
bool are_the_same(const EdgeTies& a, const EdgeTies& b) {
  return a.kind == b.kind && (a.kind != EdgeTies::Kind::none || a.a_is_nearer == b.a_is_nearer) &&
         std::equal(a.ties.begin(), a.ties.end(), b.ties.begin(), b.ties.end(), [](const EdgeTie& s, const EdgeTie& t) {
           return s.a_before == t.a_before && s.is_contact == t.is_contact && s.t.lower <= t.t.upper && t.t.lower <= s.t.upper;
         });
}

class TiesOnEdgeLimit : public testing::TestWithParam<TiedWindowsFamily> {};
TEST_P(TiesOnEdgeLimit, SameOrUndecided) {
  Random random(1500);
  Limited limited;
  for (int i = 0; i < kCases; ++i) {
    const TiedWindows c = GetParam().make(random);
    TiedWindows off = c;
    off.a.weight.given += small_step(random) * robust::power_of_two(c.exponent);
    for (const TiedWindows& one : {c, off}) {
      const Window a = one.a.described(), b = one.b.described();
      limited.ask(
          [&]() -> Said<EdgeTies> {
            const EdgeTies ties = ties_on_edge(a, b, one.edge);
            EXPECT_EQ(ties.kind == EdgeTies::Kind::undecided, ties.stage == robust::Stage::undecided);
            return ties.kind == EdgeTies::Kind::undecided ? std::nullopt : Said<EdgeTies>(ties);
          },
          are_the_same);
    }
  }
  limited.expect_both();
}
INSTANTIATE_TEST_SUITE_P(Families, TiesOnEdgeLimit, testing::ValuesIn(kTiedWindowsFamilies), name_of<TiedWindowsFamily>);

class ConflictLimit : public testing::TestWithParam<TiedSitesFamily> {};
TEST_P(ConflictLimit, SameOrUndecided) {
  Random random(1600);
  Limited limited;
  for (int i = 0; i < (GetParam().one_class ? kCases : 1); ++i) {
    const TiedSites c = GetParam().make(random);
    const std::array<const Window*, 3> ijk{&c.windows[0], &c.windows[1], &c.windows[2]};
    for (std::size_t rival = 0; rival < 4; ++rival) limited.ask([&] { return conflict(c.facet, ijk, c.windows[rival]).verdict; });
  }
  limited.expect_both();
}
INSTANTIATE_TEST_SUITE_P(Families, ConflictLimit, testing::ValuesIn(kTiedSitesFamilies), name_of<TiedSitesFamily>);

// A straight way over an edge and one inside a face, of one length; and images in one place, of which one lies in the facet itself.
TEST(ProofLimit, AcrossAnEdgeAndInsideAFace) {
  const FaceCorners below{{{0, 0, 0}, {8, 0, 0}, {3, -4, 0}}}, above{{{0, 0, 0}, {8, 0, 0}, {3, 4, 0}}};
  FaceStrip strip(below, FacePoint::corner(2));
  strip.cross(above);
  const Window across{strip, {}, std::nullopt}, inside{FaceStrip(above, FacePoint::corner(2)), {}, std::nullopt};
  const Leg over_edge(strip, FacePoint::corner(0)), in_face(FaceStrip(above, FacePoint::corner(2)), FacePoint::corner(0));
  Limited limited;
  for (const bool swapped : {false, true}) {
    const Path a{0, {swapped ? in_face : over_edge}}, b{0, {swapped ? over_edge : in_face}};
    EXPECT_EQ(compare_lengths(a, b).sign, robust::Sign::zero);
    limited.ask([&] { return compare_lengths(a, b).sign; });
    const Window &first = swapped ? inside : across, &second = swapped ? across : inside;
    limited.ask([&]() -> Said<EdgeTies::Kind> {
      const EdgeTies::Kind kind = ties_on_edge(first, second, {above[0], above[1]}).kind;
      EXPECT_TRUE(kind == EdgeTies::Kind::everywhere || kind == EdgeTies::Kind::undecided);
      return kind == EdgeTies::Kind::undecided ? std::nullopt : Said<EdgeTies::Kind>(kind);
    });
  }
  limited.expect_both();
}

// A vertex on a boundary ray of one of its waves: which is seen, if anything tells.
TEST(ProofLimit, AVertexOnABoundaryRay) {
  const FaceCorners facet{{{-6, -6, 0}, {6, -6, 0}, {0, 6, 0}}};
  const Window right{FaceStrip(facet, FacePoint::corner(1)), {}, std::nullopt}, left{FaceStrip(facet, FacePoint::corner(0)), {}, std::nullopt},
      top{FaceStrip(facet, FacePoint::corner(2)), {9, {}}, std::nullopt};
  FaceStrip strip({{{-6, -6, 0}, {0, -12, 0}, {6, -6, 0}}}, {{1, 4, 1}});
  strip.cross(facet);
  const Window below{strip, {}, {{3, 2}}};
  Limited limited;
  limited.ask([&] { return conflict(facet, {&below, &right, &left}, top).verdict; });
  limited.expect_both();
}

}  // namespace
}  // namespace gvd::predicates
