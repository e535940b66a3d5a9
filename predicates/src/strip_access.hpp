#pragma once

#include <algorithm>
#include <unordered_map>

#include "face_shape.hpp"
#include "gvd/predicates/strip_numbers.hpp"
#include "gvd/robust/proof_limit.hpp"

/// The points of a FaceStrip in any number type, in the frame of the entry edge of its last face (of the first side of its only face).
namespace gvd::predicates {

class StripAccess {
 public:
  explicit StripAccess(const FaceStrip& strip) : strip_(strip) {}

  const FaceStrip& strip() const noexcept { return strip_; }
  /// Half-edge 3 k + j is side j of face k. Pre: at least one crossing.
  const Strip& steps() const noexcept { return strip_.strip_; }
  const FaceShape& last() const { return *strip_.faces_.back(); }
  const FaceShape& face(std::size_t k) const { return *strip_.faces_[k]; }
  std::size_t face_count() const noexcept { return strip_.faces_.size(); }
  /// The half-edge of the last face's first side.
  std::uint32_t last_halfedge() const { return 3 * static_cast<std::uint32_t>(face_count() - 1); }
  /// Where corner k of the last face, as given, stands in the frame: 0 origin, 1 target, 2 apex.
  std::uint8_t place(std::size_t k) const { return strip_.place_[k]; }
  bool is_in_range() const {
    return std::all_of(strip_.faces_.begin(), strip_.faces_.end(), [](const auto& face) { return face->is_in_range(); });
  }

  /// Where the source is if it is a corner of the first face.
  std::optional<std::size_t> source_corner() const;
  /// Throws std::invalid_argument for a vertex that `ray_side` does not take.
  void require_vertex(std::size_t v) const;
  bool is_source(std::size_t v) const { return v < 3 && source_corner() == v; }

  /// The vertices that bound the first edge crossed, left and right as the source sees them. Pre: there is one.
  std::array<std::size_t, 2> first_bounds() const { return {(strip_.exit_ + 1u) % 3, strip_.exit_}; }
  /// Whether the strip leaves its k-th crossed face (from 1) by the side at the origin of its entry edge.
  bool leaves_left(std::size_t k) const { return strip_.strip_.steps[k - 1].left; }

  template <class Numbers>
  typename Numbers::Point image(Numbers& numbers) const {
    if (strip_.crossings() == 0) return numbers.in_face(0, strip_.source_[1], strip_.source_[2]);
    return carried(numbers, numbers.root(0), 1);
  }
  /// Pre: require_vertex(v) passes.
  template <class Numbers>
  typename Numbers::Point vertex(Numbers& numbers, std::size_t v) const {
    if (is_source(v)) return image(numbers);
    const auto [k, place] = vertex_place(v);
    return carried(numbers, numbers.in_face(3 * k, place == 1 ? 1 : 0, place == 2 ? 1 : 0), k);
  }
  template <class Numbers>
  typename Numbers::Point in_last_face(Numbers& numbers, const FacePoint& p) const {
    const std::array<mpq_class, 3> b = placed(p);
    return numbers.in_face(last_halfedge(), b[1], b[2]);
  }

  /// Barycentric coordinates (sum 1) by place in the frame.
  std::array<mpq_class, 3> placed(const FacePoint& p) const;

 private:
  /// From the frame of face k into that of the last.
  template <class Numbers>
  typename Numbers::Point carried(Numbers& numbers, typename Numbers::Point z, std::size_t k) const {
    for (; k + 1 < strip_.faces_.size(); ++k) {
      const StripStep& step = strip_.strip_.steps[k - 1];
      z = numbers.cross(z, step.side, step.left);
    }
    return z;
  }
  /// The face in whose frame a vertex first stands, and where.
  std::pair<std::uint32_t, std::uint8_t> vertex_place(std::size_t v) const;

  const FaceStrip& strip_;
};

/// Barycentric coordinates with sum 1. Throws std::invalid_argument.
std::array<mpq_class, 3> normalised(const FacePoint& p);

/// Calls visit(numbers, bits) with the DiscNumbers of a strip in T.
template <class T, class Visit>
decltype(auto) with_numbers(const StripAccess& at, int bits, Visit&& visit) {
  if constexpr (std::is_same_v<T, double>) {
    auto numbers = disc_numbers<T>([&](std::uint32_t h) -> decltype(auto) { return at.face(h / 3).in_double()[h % 3]; });
    return visit(numbers);
  } else if constexpr (std::is_same_v<T, robust::DoubleDouble>) {
    auto numbers = disc_numbers<T>([&](std::uint32_t h) -> decltype(auto) { return at.face(h / 3).in_double_double()[h % 3]; });
    return visit(numbers);
  } else {
    std::unordered_map<std::uint32_t, std::array<EdgeFrame<T>, 3>> cache;
    auto numbers = disc_numbers<T>(
        [&](std::uint32_t h) -> const EdgeFrame<T>& {
          const auto [it, added] = cache.try_emplace(h / 3);
          if (added) it->second = at.face(h / 3).in_mpfr(bits);
          return it->second[h % 3];
        },
        bits);
    return visit(numbers);
  }
}

/// What visit(numbers) says of a strip in sums of roots; empty if a coordinate is too long a sum.
template <class Visit>
auto with_roots(const StripAccess& at, const Visit& visit) {
  RootNumbers numbers([&](std::uint32_t h) -> const EdgeFrame<robust::RootSum>& { return at.face(h / 3).in_roots()[h % 3]; });
  std::optional result(visit(numbers));
  if (!numbers.is_known() || !robust::ProofLimit::allows_one()) result.reset();
  return result;
}

/// The image as a program, however many classes the strip crosses. Pre: it crosses an edge.
inline StripProgram program_of(const StripAccess& at, robust::SquareClasses& classes) {
  return strip_program(at.steps(), [&](std::uint32_t h) { return at.face(h / 3).for_program(classes); });
}

/// Runs the numeric stage of a rung: test.template operator()<T>(bits), T = double, DoubleDouble or Mpfr. Empty for the others, and if
/// the strips involved are out of the range of the first two.
template <class Answer, class Test>
std::optional<Answer> numeric_stage(const Rung& rung, bool is_in_range, const Test& test) {
  switch (rung.stage) {
    case robust::Stage::filter: return is_in_range ? test.template operator()<double>(0) : std::nullopt;
    case robust::Stage::double_double: return is_in_range ? test.template operator()<robust::DoubleDouble>(0) : std::nullopt;
    case robust::Stage::mpfr: return test.template operator()<robust::Mpfr>(rung.bits);
    default: return std::nullopt;
  }
}

/// Up the ladder until a rung answers.
template <class AtRung>
Decision decide(const AtRung& at_rung) {
  for (const Rung& rung : kRungs)
    if (const robust::MaybeSign sign = at_rung(rung)) return {sign, rung.stage};
  return {};
}

}  // namespace gvd::predicates
