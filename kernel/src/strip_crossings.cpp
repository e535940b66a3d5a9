#include "strip_crossings.hpp"

#include <algorithm>
#include <cmath>

#include "face_map.hpp"
#include "gvd/predicates/strip_numbers.hpp"
#include "gvd/robust/exact.hpp"
#include "gvd/robust/rounding.hpp"

namespace gvd::kernel {
namespace {

using predicates::Strip;
using robust::Ball;
using robust::DoubleDouble;
using robust::Exact;
using robust::Mpfr;
using robust::Sign;

/// A half-edge of the refined mesh that is a piece of an edge of the input.
struct EdgePiece {
  std::array<VertexId, 2> edge;  ///< low id first
  mpq_class begin, end;          ///< parameters of the origin and the target of the half-edge
};

EdgePiece piece_of_edge(const Mesh& input, const Mesh& refined, HalfedgeId h) {
  const FaceId face = refined.input_face(Mesh::face(h));
  const auto begin = barycentric_in_face(input, face, refined, refined.origin(h));
  const auto end = barycentric_in_face(input, face, refined, refined.target(h));
  std::uint32_t zero = 0;
  while (sgn(begin[zero]) != 0 || sgn(end[zero]) != 0) ++zero;
  const std::uint32_t a = (zero + 1) % 3, b = (zero + 2) % 3;
  const VertexId va = input.origin(3 * face + a), vb = input.origin(3 * face + b);
  if (va < vb) return {{va, vb}, begin[b], end[b]};
  return {{vb, va}, begin[a], end[a]};
}

/// An enclosure, and whether its value is certainly within an ulp of the truth.
struct Reported {
  Enclosed enclosed;
  bool sharp;
};
template <class T>
Reported report(const Ball<T>& x) {
  const double value = robust::Midpoint<T>::nearest(x.mid());
  return {{value, x.lower(), x.upper()}, x.rad() <= std::fabs(value) * 0x1p-55};
}
Reported report(const Exact& x) {
  constexpr int kBits = 128;
  const auto value = rounded(x);
  const auto ball = x.enclosure(kBits);
  return {{value.value_or(0), ball.lower(), ball.upper()}, value.has_value()};
}

class StripWalk {
 public:
  StripWalk(const Mesh& input, const Resolution& resolution, WindowId window, const std::array<mpq_class, 3>& bary)
      : input_(input), frames_(resolution.frames()), mesh_(frames_.mesh()), strip_(strip_of(mesh_, resolution.field(), window)) {
    entry_.push_back(mesh_.twin(strip_.opposite));
    for (const auto& step : strip_.steps) entry_.push_back(mesh_.twin(step.side));
    b1_ = bary[Mesh::next(entry_.back()) % 3];
    b2_ = bary[Mesh::prev(entry_.back()) % 3];
  }

  StripCrossings run() {
    const auto double_double = [&](HalfedgeId h) -> decltype(auto) { return frames_.in_double_double(h); };
    if (attempt(predicates::disc_numbers<DoubleDouble>(double_double))) return std::move(result_);
    if (attempt_mpfr(128) || attempt_mpfr(256)) return std::move(result_);
    // What 256 bits cannot tell is a path through a vertex more often than not.
    if (attempt(predicates::RootNumbers([&](HalfedgeId h) { return (*frames_.in_roots(Mesh::face(h)))[h % 3]; }))) return std::move(result_);
    result_.undecided = !attempt_mpfr(512) && !attempt_mpfr(1024);
    return std::move(result_);
  }

 private:
  bool attempt_mpfr(int bits) {
    MpfrFrames cache;
    const auto frame = [&](HalfedgeId h) -> decltype(auto) { return cache(frames_, h, bits); };
    return attempt(predicates::disc_numbers<Mpfr>(frame, bits));
  }

  /// All crossings in one number type; false if one of them is open or not sharp. Then the list is the best known.
  template <class Numbers>
  bool attempt(Numbers numbers) {
    std::vector<typename Numbers::Point> image{numbers.root(strip_.opposite)};
    for (const auto& step : strip_.steps) image.push_back(numbers.cross(image.back(), step.side, step.left));
    result_.list.clear();
    bool good = true;
    auto target = numbers.in_face(entry_.back(), b1_, b2_);
    for (std::size_t i = entry_.size(); i-- > 0;) {
      if (i + 1 < entry_.size()) target = numbers.cross_back(target, entry_[i], strip_.steps[i].left);
      if (i + 1 == entry_.size() && sgn(b2_) == 0) continue;
      good = add(numbers, entry_[i], numbers.meet(image[i], target)) && good;
    }
    return good;
  }

  template <class Numbers>
  bool add(const Numbers& numbers, HalfedgeId h, const typename Numbers::Number& t) {
    using Number = typename Numbers::Number;
    Crossing& crossing = result_.list.emplace_back();
    crossing.halfedge = h;
    const robust::MaybeSign from_origin = maybe_sign(t), from_target = maybe_sign(Number(numbers.number(1) - t));
    if (from_origin != Sign::positive || from_target != Sign::positive) {
      const bool at_origin = from_origin != Sign::positive;
      crossing.vertex = at_origin ? mesh_.origin(h) : mesh_.target(h);
      return (at_origin ? from_origin : from_target) == Sign::zero;
    }
    if (mesh_.is_artificial(h)) return true;
    const EdgePiece piece = piece_of_edge(input_, mesh_, h);
    const Number begin = numbers.number(piece.begin), on_edge = begin + t * (numbers.number(piece.end) - begin);
    crossing.edge = piece.edge;
    const Reported parameter = report(on_edge);
    crossing.t = parameter.enclosed;
    bool sharp = parameter.sharp;
    const ExactPoint a = input_.exact_point(piece.edge[0]), b = input_.exact_point(piece.edge[1]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Reported coordinate = report(Number(numbers.number(a[i]) + on_edge * numbers.number(b[i] - a[i])));
      crossing.position[i] = coordinate.enclosed.value;
      sharp = sharp && coordinate.sharp;
    }
    return sharp;
  }

  const Mesh& input_;
  const Frames& frames_;
  const Mesh& mesh_;
  Strip strip_;
  std::vector<HalfedgeId> entry_;  ///< half-edges crossed, from the root on
  mpq_class b1_, b2_;              ///< of the end of the path, in the frame of the last of them
  StripCrossings result_;
};

}  // namespace

StripCrossings cross_strip(const Mesh& input, const Resolution& resolution, WindowId window, const std::array<mpq_class, 3>& bary) {
  return StripWalk(input, resolution, window, bary).run();
}

}  // namespace gvd::kernel
