// What plain doubles say of ties on the sides of a facet and of vertices inside, asked by itself of waves that are placed as awkwardly as can be: near one another, in a row, about to
// be overtaken everywhere or nowhere, near the facet or very far from it. Whatever they are certain of must be what long numbers say.
#include <gtest/gtest.h>

#include "../../kernel/src/overtaking_filter.hpp"
#include "../../kernel/src/vertex_filter.hpp"
#include "gvd/kernel/node_point.hpp"
#include "support/given_waves.hpp"
#include "support/meshes.hpp"

namespace gvd::kernel {
namespace {

using predicates::Existence;
using robust::Sign;
using test::Random;
using M = FacetWaves::M;
using Point2 = std::array<double, 2>;

/// Waves that see the whole facet and have nothing to do with one another, in numbers that count as exact.
class FreeWaves final : public test::GivenWaves {
 public:
  explicit FreeWaves(Point2 apex) : GivenWaves(apex, 1, true) {
    face = 0;
    corner = {0, 1, 2};
  }
  void add(Point2 image, double weight, VertexId root, const std::optional<std::array<Point2, 2>>& cone = {}) {
    FacetSite site;
    site.window = static_cast<WindowId>(sites.size());
    site.root = root;
    site.labels = site.window;
    add_site(site, image, weight, cone);
  }
  bool is_own_relay(std::size_t, std::size_t) override { return false; }
};

double scale(Random& random, int lowest) { return std::ldexp(1 + random.uniform(), -static_cast<int>(random.below(static_cast<std::uint32_t>(-lowest)))); }

/// Outside the facet or in it, as it comes.
FreeWaves awkward_waves(Random& random) {
  const Point2 apex{random.uniform(-1, 2), random.below(4) == 0 ? scale(random, -30) : random.uniform(0.2, 1.5)};
  FreeWaves waves(apex);
  const double far = random.below(4) == 0 ? std::ldexp(1.0, static_cast<int>(random.below(30))) : 2;
  const auto kind = random.below(6);
  const Point2 centre{random.uniform(-far, far), random.uniform(-far, far)}, along{random.uniform(-1, 1), random.uniform(-1, 1)};
  const double near = scale(random, -40), off = scale(random, -50);
  const std::size_t count = 3 + random.below(3);
  Point2 first{};
  double first_weight = 0;
  for (std::size_t n = 0; n < count; ++n) {
    Point2 image{random.uniform(-far, far), random.uniform(-far, far)};
    double weight = random.below(3) == 0 ? 0 : random.uniform(0, far);
    if (kind == 1) image = {centre[0] + near * random.uniform(-1, 1), centre[1] + near * random.uniform(-1, 1)};                    // near one another
    if (kind == 2) image = {centre[0] + far * along[0] * double(n), centre[1] + far * along[1] * double(n) + off * random.uniform()};  // in a row
    if (kind == 3 && n > 0) weight = first_weight + std::hypot(image[0] - first[0], image[1] - first[1]) * (1 - off * random.uniform(-0.1, 1));  // hardly overtaken
    if (kind == 4) {  // near a corner, or mirrored in a side
      const Point2 corners[] = {{0, 0}, {1, 0}, apex};
      const Point2& c = corners[random.below(3)];
      image = {c[0] + near * random.uniform(-1, 1), c[1] + near * random.uniform(-1, 1)};
      weight = near * random.uniform();
    }
    if (kind == 5 && n > 0) image = {first[0] + off * random.uniform(-1, 1), -first[1]}, weight = first_weight + off * random.uniform(-1, 1) * near;
    if (weight < 0) weight = 0;
    if (n == 0) first = image, first_weight = weight;
    waves.add(image, weight, kind != 3 && random.below(4) == 0 ? 0 : static_cast<VertexId>(10 + n));
  }
  // One root, one weight.
  const VertexId shared = 0;
  double of_shared = -1;
  FreeWaves result(apex);
  for (std::size_t i = 0; i < waves.sites.size(); ++i) {
    const auto& site = waves.site(i, FacetWaves::F());
    double weight = site.weight.mid();
    if (waves.sites[i].root == shared) weight = of_shared = of_shared < 0 ? weight : of_shared;
    result.add({site.image.x.mid(), site.image.y.mid()}, weight, waves.sites[i].root);
  }
  return result;
}

struct Filters {
  predicates::Decisions decisions;
  FacetLadder ladder;
  Contenders contenders;
  FacetFilter filter;
  explicit Filters(FacetWaves& waves) : ladder(waves, decisions), contenders(waves, ladder), filter(contenders, ladder) {}
};

FacetNumbers<M> long_numbers(FacetWaves& waves) {
  FacetNumbers<M> numbers;
  load_numbers(waves, 256, numbers);
  return numbers;
}
double to_double(const M& x) { return x.mid().to_double(); }

/// What a filter said about vertices.
struct Tally {
  int found = 0, none = 0, unknown = 0;
  void expect_all_kinds() const {
    EXPECT_GT(found, 0);
    EXPECT_GT(none, 0);
    EXPECT_GT(unknown, 0);
  }
};

/// The vertex in long numbers, relative to wave j, is to be in the facet, and where `is_seen` holds, just if the filter says so.
template <class Said, class Truth, class IsSeen>
void expect_alike(const Said& said, const Truth& truth, const FacetNumbers<M>& numbers, std::uint32_t j, Tally& tally, const IsSeen& is_seen) {
  using predicates::operator+;
  using predicates::operator-;
  (!said.certain ? tally.unknown : said.exists ? tally.found : tally.none) += 1;
  if (!said.certain || truth.existence == Existence::open) return;
  bool exists = truth.existence == Existence::proved;
  if (exists) {
    const auto p = truth.p + numbers.sites[j]->image;
    if (said.exists) {
      EXPECT_LE(std::hypot(to_double(p.x - M(said.at.p.x)), to_double(p.y - M(said.at.p.y))), said.at.radius);
    }
    for (const auto& side : numbers.side) exists = exists && maybe_sign(cross(side.direction, p - side.origin)) == Sign::positive;
    exists = exists && is_seen(p);
  }
  EXPECT_EQ(said.exists, exists);
}

TEST(FacetFilters, VerticesAreThoseOfLongNumbers) {
  Random random(4100);
  Tally tally;
  for (int round = 0; round < 30000 && !HasFailure(); ++round) {
    SCOPED_TRACE(round);
    FreeWaves waves = awkward_waves(random);
    Filters at(waves);
    if (at.ladder.failed() || at.contenders.size() != waves.sites.size()) continue;
    const VertexFilter filter(at.filter, at.contenders);
    const FacetNumbers<M> numbers = long_numbers(waves);
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::array<std::uint32_t, 3> ijk = round % 2 == 0 ? std::array{i, (i + 1) % 3, (i + 2) % 3} : std::array{i, (i + 2) % 3, (i + 1) % 3};
      expect_alike(filter.judge(ijk, {}, {}), vertex_of(waves, numbers, ijk[0], ijk[1], ijk[2]), numbers, ijk[1], tally, [](const auto&) { return true; });
    }
  }
  tally.expect_all_kinds();
}

// A relay on a boundary ray of its parent, and a third wave that comes along nearly the same line, or as it likes.
TEST(FacetFilters, VerticesOnARayAreThoseOfLongNumbers) {
  Random random(4300);
  Tally tally;
  for (int round = 0; round < 30000 && !HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const Point2 apex{random.uniform(0, 1), random.uniform(0.3, 1.2)};
    FreeWaves waves(apex);
    const double away = scale(random, -20);
    const Point2 relay{random.uniform(0, 1), -away * random.uniform()}, parent{relay[0] + random.uniform(-2, 2), relay[1] - random.uniform(0.1, 2)};
    const double length = std::hypot(relay[0] - parent[0], relay[1] - parent[1]), aside = round % 2 == 0 ? scale(random, -50) : random.uniform(-1, 1);
    const Point2 along{(relay[0] - parent[0]) / length, (relay[1] - parent[1]) / length};
    // Behind the relay, or in front of it; a little later than the relay is there, or by no more than the way from one to the other.
    const double behind = random.uniform(-2, 2), late = random.below(3) == 0 ? (random.below(2) == 0 ? 1 : -1) * scale(random, -50) : random.uniform(-2, 2);
    const Point2 other{relay[0] - behind * along[0] + aside * along[1], relay[1] - behind * along[1] - aside * along[0]};
    const double weight = 3, of_other = weight + length - behind + late;
    const Point2 far_side{parent[0] + 4, parent[1]};  // the cone: between the relay and what lies to its right
    waves.add(parent, weight, 1, std::array{relay, far_side});
    waves.add(relay, weight + length, 2);
    waves.add(other, std::max(0.0, of_other), 3);
    Filters at(waves);
    if (at.ladder.failed() || at.contenders.size() != 3) continue;
    const FacetNumbers<M> numbers = long_numbers(waves);
    expect_alike(VertexFilter(at.filter, at.contenders).judge({0, 1, 2}, VertexFilter::OnRay{0, 1, 2, 0}, {}), vertex_on_ray(waves, numbers, 0, 1, 2), numbers, 1, tally,
                 [&](const auto& p) { return maybe_sign(cone_side(*numbers.sites[0], 1, p)) == Sign::positive; });
  }
  tally.expect_all_kinds();
}

/// The wave that is the nearest at corner k; empty if two are as near.
std::optional<std::uint32_t> nearest_at(const FacetNumbers<M>& numbers, std::size_t k) {
  std::uint32_t nearest = 0;
  bool is_sure = true;
  for (std::uint32_t i = 1; i < numbers.sites.size(); ++i) {
    const auto sign = maybe_sign(distance(*numbers.sites[i], numbers.side[k].origin) - distance(*numbers.sites[nearest], numbers.side[k].origin));
    if (!sign || *sign == Sign::zero) is_sure = false;
    if (sign == Sign::negative) nearest = i, is_sure = true;
  }
  return is_sure ? std::optional(nearest) : std::nullopt;
}

// Along each side, from the wave that is nearest where it begins, from one to the next.
TEST(FacetFilters, WavesOvertakeOneAnotherAsInLongNumbers) {
  Random random(4200);
  int overtaken = 0, never = 0, unknown = 0;
  for (int round = 0; round < 20000 && !HasFailure(); ++round) {
    FreeWaves waves = awkward_waves(random);
    Filters at(waves);
    if (at.ladder.failed() || at.contenders.size() != waves.sites.size()) continue;
    OvertakingFilter filter(at.filter, at.contenders);
    const FacetNumbers<M> numbers = long_numbers(waves);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto start = nearest_at(numbers, k);
      if (!start) continue;
      std::uint32_t from = *start;
      std::optional<OvertakingFilter::Passed> passed;
      for (std::size_t steps = 0; steps <= waves.sites.size(); ++steps) {
        const auto said = filter.next(k, from, passed);
        unknown += !said;
        if (!said) break;
        // The first one in long numbers.
        std::optional<M> first;
        std::uint32_t to = from;
        bool is_open = false;
        for (std::uint32_t i = 0; i < waves.sites.size(); ++i) {
          if (i == from) continue;
          const auto tie = predicates::overtaking(numbers.side[k], *numbers.sites[from], *numbers.sites[i], waves.sites[i].root == waves.sites[from].root);
          is_open = is_open || tie.existence == Existence::open;
          if (tie.existence != Existence::proved) continue;
          const bool is_ahead = maybe_sign(tie.t - M(passed ? passed->at.high : 0.0)) == Sign::positive && maybe_sign(M(1.0) - tie.t) == Sign::positive;
          if (is_ahead && (!first || maybe_sign(*first - tie.t) == Sign::positive)) first = tie.t, to = i;
        }
        if (is_open) break;
        EXPECT_EQ(said->exists, first.has_value()) << round << " side " << k;
        (said->exists ? overtaken : never) += 1;
        if (!said->exists || !first) break;
        EXPECT_EQ(said->to, to) << round;
        EXPECT_LE(said->at.low, to_double(*first)) << round;
        EXPECT_GE(said->at.high, to_double(*first)) << round;
        passed = OvertakingFilter::Passed{from, said->at};
        from = said->to;
      }
    }
  }
  EXPECT_GT(overtaken, 0);
  EXPECT_GT(never, 0);
  EXPECT_GT(unknown, 0);
}

}  // namespace
}  // namespace gvd::kernel
