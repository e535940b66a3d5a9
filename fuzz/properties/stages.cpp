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
  explicit Comparison(FacetWaves& waves)
      : waves_(waves),
        filter_(waves, 0),
        double_double_(waves, 0),
        mpfr_(waves, 256),
        exact_(waves, 0),
        size_(std::min<std::size_t>(waves.sites.size(), 5)) {}

  std::string fault() {
    for (std::size_t a = 0; a < size_ && fault_.empty(); ++a) look_at(a);
    for (std::size_t a = 0; a < size_ && fault_.empty(); ++a)
      for (std::size_t b = 0; b < size_ && fault_.empty(); ++b)
        if (a != b) look_at(a, b);
    return fault_;
  }

 private:
  /// `ask` gets a stage and gives what it says.
  template <class Ask>
  void compare(bool exact, const std::string& what, const Ask& ask) {
    const std::array<Said, 4> told = {ask(filter_), ask(double_double_), ask(mpfr_), exact ? ask(exact_) : Said{}};
    for (std::size_t i = 0; i < told.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const bool signs = told[i].sign && told[j].sign && *told[i].sign != *told[j].sign;
        const bool apart = std::fabs(told[i].middle - told[j].middle) > (told[i].radius + told[j].radius) * (1 + 0x1p-40);
        if (signs || apart) fault_ = fmt::format("{}: stages {} and {} contradict each other", what, j, i);
      }
  }

  void look_at(std::size_t a) {
    if (waves_.sites[a].window == kernel::kNone) return;
    for (std::size_t end = 0; end < 2; ++end)
      for (std::size_t corner = 0; corner < 3; ++corner)
        compare(exact_.has(a), fmt::format("corner {} in the cone of site {}", corner, a),
                [&](const auto& stage) { return stage.cone(a, end, corner); });
  }

  void look_at(std::size_t a, std::size_t b) {
    // Sums of roots of different weights are too slow in algebra for what they would add here.
    const bool exact = exact_.has(a) && exact_.has(b) && waves_.sites[a].root == waves_.sites[b].root;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string what = fmt::format("sites {} and {} on side {}", a, b, k);
      compare(false, what + ", distance", [&](const auto& stage) { return stage.nearer(a, b, k); });
      for (std::size_t i = 0; i < 2; ++i) compare(exact, what + ", tie", [&](const auto& stage) { return stage.tie(a, b, k)[i]; });
      // Law: swapped arguments negate the difference of distances.
      const Said there = filter_.nearer(a, b, k), back = filter_.nearer(b, a, k);
      if (there.sign && (!back.sign || static_cast<int>(*there.sign) != -static_cast<int>(*back.sign)))
        fault_ = what + ": swapping does not negate";
    }
    for (std::size_t c = 0; c < size_; ++c) {
      if (c == a || c == b) continue;
      const auto i = static_cast<std::uint32_t>(a), j = static_cast<std::uint32_t>(b), k = static_cast<std::uint32_t>(c);
      compare(false, fmt::format("vertex of sites {}, {} and {}", a, b, c),
              [&](const auto& stage) { return stage.vertex(i, j, k); });
    }
  }

  FacetWaves& waves_;
  Formulas<FacetWaves::F> filter_;
  Formulas<FacetWaves::DD> double_double_;
  Formulas<FacetWaves::M> mpfr_;
  Formulas<robust::Exact> exact_;
  std::size_t size_;
  std::string fault_;
};

Outcome stages_agree(Trial& t) {
  const Facets facets(t);
  Draw draw = t.draw("stages_agree");
  int looked_at = 0;
  for (int attempt = 0; attempt < 20 && looked_at < 3; ++attempt) {
    const kernel::FaceId f = draw.below(facets.mesh().face_count());
    if (!facets.is_reached(f)) continue;
    const auto waves = facets.waves(f);
    if (waves->sites.size() < 2) continue;
    ++looked_at;
    const std::string fault = Comparison(*waves).fault();
    if (!fault.empty()) return violated(fmt::format("facet {} of the refined mesh: {}", f, fault));
  }
  return looked_at > 0 ? holds() : skipped();
}

constexpr std::array<Property, 1> kProperties = {{
    {"stages_agree", stages_agree, true, "the stages of a predicate never contradict each other on the strips of a facet"},
}};

}  // namespace

std::span<const Property> stage_properties() { return kProperties; }

}  // namespace gvd::fuzz
