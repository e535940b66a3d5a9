#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "fuzz/properties/facets.hpp"
#include "fuzz/properties/property.hpp"
#include "gvd/kernel/facet_numbers.hpp"
#include "gvd/kernel/node_point.hpp"
#include "gvd/predicates/wave.hpp"

namespace gvd::fuzz {
namespace {

using kernel::FacetNumbers;
using kernel::FacetWaves;
using kernel::kNone;
using predicates::Existence;
using robust::MaybeSign;
using robust::Sign;

/// What one stage says of a formula: a sign if it knows one, and an enclosure.
struct Said {
  MaybeSign sign;
  double middle = 0, radius = HUGE_VAL;
};

template <class T>
Said said(const robust::Ball<T>& x) {
  if (!x.is_finite()) return {};
  const double middle = predicates::rough(x.mid());
  return {maybe_sign(x), middle, x.rad() + std::fabs(middle) * 0x1p-52 + 0x1p-1000};
}
Said said(const robust::Exact& x) {
  Said exact = said(x.enclosure(64));
  exact.sign = maybe_sign(x);
  return exact;
}
Said said(Existence existence) {
  if (existence == Existence::open) return {};
  return {existence == Existence::proved ? Sign::positive : Sign::negative, 0, HUGE_VAL};
}

/// The formulas of the predicates, for the sites of one facet.
template <class NT>
class Formulas {
 public:
  Formulas(FacetWaves& waves, int bits) : waves_(waves) { load_numbers(waves, bits, numbers_); }
  bool has(std::size_t site) const { return numbers_.frame != nullptr && numbers_.sites[site] != nullptr; }

  Said cone(std::size_t site, std::size_t end, std::size_t corner) const {
    return said(cone_side(*numbers_.sites[site], end, corner_point(*numbers_.frame, corner)));
  }
  Said nearer(std::size_t a, std::size_t b, std::size_t corner) const {
    const auto p = corner_point(*numbers_.frame, corner);
    return said(distance(*numbers_.sites[a], p) - distance(*numbers_.sites[b], p));
  }
  std::array<Said, 2> tie(std::size_t a, std::size_t b, std::size_t side) const {
    const bool same_weight = waves_.sites[a].root == waves_.sites[b].root;
    const auto t = overtaking(numbers_.side[side], *numbers_.sites[a], *numbers_.sites[b], same_weight);
    return {said(t.existence), t.existence == Existence::proved ? said(t.t) : Said{}};
  }
  Said vertex(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return said(vertex_of(waves_, numbers_, a, b, c).existence);
  }

 private:
  FacetWaves& waves_;
  FacetNumbers<NT> numbers_;
};

/// Stages must not contradict each other: signs that both know are equal, enclosures meet.
class Comparison {
 public:
  Comparison(FacetWaves& waves, Draw& draw)
      : waves_(waves),
        draw_(draw),
        filter_(waves, 0),
        double_double_(waves, 0),
        mpfr_(waves, 256),
        exact_(waves, 0),
        size_(static_cast<std::uint32_t>(waves.sites.size())) {}

  /// Some sites, and two or three of them together; in algebra one cone or one pair only, they cost more than all others.
  std::string fault() {
    constexpr int kDraws = 3;
    const bool cone_by_algebra = draw_.one_in(2);
    for (int i = 0; i < kDraws && fault_.empty(); ++i) {
      const std::uint32_t a = draw_.below(size_), b = (a + 1 + draw_.below(size_ - 1)) % size_;
      look_at(a, i == 0 && cone_by_algebra ? draw_.below(6) : kNone);
      look_at(a, b, draw_.below(3), i == 0 && !cone_by_algebra);
      const std::uint32_t c = draw_.below(size_);
      if (c != a && c != b) look_at_vertex(a, b, c);
    }
    return fault_;
  }

 private:
  /// `ask` gets a stage and gives what it says.
  template <class Ask>
  void compare(bool exact, const std::string& what, const Ask& ask) {
    compare_each<1>(exact, what, [&](const auto& stage) { return std::array{ask(stage)}; });
  }
  template <std::size_t kCount, class Ask>
  void compare_each(bool exact, const std::string& what, const Ask& ask) {
    using All = std::array<Said, kCount>;
    const std::array<All, 4> all = {ask(filter_), ask(double_double_), ask(mpfr_), exact ? ask(exact_) : All{}};
    for (std::size_t n = 0; n < kCount; ++n) agree({all[0][n], all[1][n], all[2][n], all[3][n]}, what);
  }
  void agree(const std::array<Said, 4>& told, const std::string& what) {
    for (std::size_t i = 0; i < told.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const bool signs = told[i].sign && told[j].sign && *told[i].sign != *told[j].sign;
        const bool apart = std::fabs(told[i].middle - told[j].middle) > (told[i].radius + told[j].radius) * (1 + 0x1p-40);
        if (signs || apart) fault_ = fmt::format("{}: stages {} and {} contradict each other", what, j, i);
      }
  }

  /// Both ends of a cone and the three corners; `by_algebra`: the one of these six that is.
  void look_at(std::size_t a, std::uint32_t by_algebra) {
    if (waves_.sites[a].window == kNone) return;
    for (std::uint32_t question = 0; question < 6; ++question)
      compare(question == by_algebra && exact_.has(a), fmt::format("corner {} in the cone of site {}", question / 2, a),
              [&](const auto& stage) { return stage.cone(a, question % 2, question / 2); });
  }

  void look_at(std::size_t a, std::size_t b, std::size_t side, bool by_algebra) {
    // Sums of roots of different weights are too slow in algebra for what they would add here.
    const bool exact = by_algebra && exact_.has(a) && exact_.has(b) && waves_.sites[a].root == waves_.sites[b].root;
    const std::string what = fmt::format("sites {} and {} on side {}", a, b, side);
    compare(false, what + ", distance", [&](const auto& stage) { return stage.nearer(a, b, side); });
    compare_each<2>(exact, what + ", tie", [&](const auto& stage) { return stage.tie(a, b, side); });
    // Law: swapped arguments negate the difference of distances.
    const Said there = filter_.nearer(a, b, side), back = filter_.nearer(b, a, side);
    if (there.sign && (!back.sign || static_cast<int>(*there.sign) != -static_cast<int>(*back.sign)))
      fault_ = what + ": swapping does not negate";
  }

  void look_at_vertex(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    compare(false, fmt::format("vertex of sites {}, {} and {}", a, b, c), [&](const auto& stage) { return stage.vertex(a, b, c); });
  }

  FacetWaves& waves_;
  Draw& draw_;
  Formulas<FacetWaves::F> filter_;
  Formulas<FacetWaves::DD> double_double_;
  Formulas<FacetWaves::M> mpfr_;
  Formulas<robust::Exact> exact_;
  std::uint32_t size_;
  std::string fault_;
};

Outcome stages_agree(Trial& t) {
  const Facets facets(t);
  Draw draw = t.draw("stages_agree");
  constexpr int kFacets = 1;
  int looked_at = 0;
  for (int attempt = 0; attempt < 20 && looked_at < kFacets; ++attempt) {
    const kernel::FaceId f = draw.below(facets.mesh().face_count());
    if (!facets.is_reached(f)) continue;
    const auto waves = facets.waves(f);
    if (waves->sites.size() < 2) continue;
    ++looked_at;
    const std::string fault = Comparison(*waves, draw).fault();
    if (!fault.empty()) return violated(fmt::format("facet {} of the refined mesh: {}", f, fault));
  }
  return looked_at > 0 ? holds() : skipped();
}

constexpr std::array<Property, 1> kProperties = {{
    {"stages_agree", stages_agree, 20, "the stages of a predicate never contradict each other on the strips of a facet"},
}};

}  // namespace

std::span<const Property> stage_properties() { return kProperties; }

}  // namespace gvd::fuzz
