#pragma once

#include "gvd/predicates/strip_window.hpp"
#include "path_numbers.hpp"

/// Windows as sites in the frame of an edge or facet that the caller names, in any number type of the ladder.
namespace gvd::predicates {

/// The numbers of one window for one number type: points of its strip in the frame of its last face, the sides of that face, its weight.
template <class NT>
class WindowNumbers;

template <class T>
class WindowNumbers<robust::Ball<T>> {
 public:
  using NT = robust::Ball<T>;
  WindowNumbers(const Window& window, int bits) : at_(window.strip), window_(window), bits_(bits) {}

  PlanePoint<NT> image() const {
    return with_numbers<T>(at_, bits_, [&](auto& numbers) { return numbers.coordinates(at_.image(numbers)); });
  }
  PlanePoint<NT> vertex(std::size_t v) const {
    return with_numbers<T>(at_, bits_, [&](auto& numbers) { return numbers.coordinates(at_.vertex(numbers, v)); });
  }
  PlanePoint<NT> apex() const {
    return with_numbers<T>(at_, bits_, [&](auto& numbers) { return numbers.coordinates(numbers.in_face(at_.last_halfedge(), 0, 1)); });
  }
  NT side(std::size_t k) const { return side_length<T>(at_, k, bits_); }
  /// In units of side k.
  NT weight(std::size_t k) const { return length_in<T>(window_.weight, bits_) / side(k); }

 private:
  StripAccess at_;
  const Window& window_;
  int bits_;
};

/// Undefined where a coordinate or a weight would be too long a sum: then the signs that need it are empty.
template <>
class WindowNumbers<robust::Exact> {
 public:
  using NT = robust::Exact;
  WindowNumbers(const Window& window, int) : at_(window.strip), window_(window) {}

  PlanePoint<NT> image() const {
    return point([&](auto& numbers) { return at_.image(numbers); });
  }
  PlanePoint<NT> vertex(std::size_t v) const {
    return point([&](auto& numbers) { return at_.vertex(numbers, v); });
  }
  PlanePoint<NT> apex() const {
    return point([&](auto& numbers) { return numbers.in_face(at_.last_halfedge(), 0, 1); });
  }
  NT weight(std::size_t k) const {
    const auto length = exact_length(window_.weight);
    if (!length) return NT::undefined();
    return *length / sqrt(NT(mpq_class(at_.last().exact().squared[k] * robust::power_of_two(2 * at_.last().exponent()))));
  }

 private:
  template <class Visit>
  PlanePoint<NT> point(const Visit& visit) const {
    const auto z = with_roots(at_, visit);
    if (!z) return {NT::undefined(), NT::undefined()};
    return {NT(z->x), NT(z->y)};
  }

  StripAccess at_;
  const Window& window_;
};

/// Places (0 origin, 1 target, 2 apex) of the given points in the last face of a strip. Throws std::invalid_argument if one is no corner.
template <std::size_t n>
std::array<std::uint8_t, n> places_of(const FaceStrip& strip, const std::array<SpacePoint, n>& points) {
  const StripAccess at(strip);
  std::array<std::uint8_t, n> places;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& face = strip.last_face();
    const auto corner = std::find(face.begin(), face.end(), points[i]);
    if (corner == face.end()) throw std::invalid_argument("an edge or facet is not that of the last face of a strip");
    places[i] = at.place(static_cast<std::size_t>(corner - face.begin()));
  }
  return places;
}

/// The side between two places: 0 entry, 1 target to apex, 2 apex to origin. Throws std::invalid_argument if they are one.
std::size_t side_between(std::uint8_t a, std::uint8_t b);

/// By identity; at the algebra stage also by proof.
inline bool have_equal_weights(const Rung& rung, const Window& a, const Window& b) {
  if (a.weight == b.weight) return true;
  return rung.stage == robust::Stage::algebra && compare_lengths_at(rung, a.weight, b.weight) == robust::Sign::zero;
}

/// The stage of a rung for windows: test.template operator()<NT>(bits), NT = Ball<T> or Exact.
template <class Answer, class Test>
std::optional<Answer> window_stage(const Rung& rung, std::span<const Window* const> windows, const Test& test) {
  if (rung.stage == robust::Stage::algebra) return test.template operator()<robust::Exact>(0);
  const bool in_range = std::all_of(windows.begin(), windows.end(), [](const Window* w) {
    return StripAccess(w->strip).is_in_range() && is_in_range(w->weight);
  });
  return numeric_stage<Answer>(rung, in_range, [&]<class T>(int bits) { return test.template operator()<robust::Ball<T>>(bits); });
}

}  // namespace gvd::predicates
