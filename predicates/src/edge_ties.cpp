#include <stdexcept>

#include "gvd/predicates/side_tie.hpp"
#include "gvd/predicates/strip_window.hpp"
#include "gvd/predicates/wave.hpp"
#include "placed_window.hpp"

namespace gvd::predicates {

using robust::Ball;
using robust::Exact;
using robust::MaybeSign;
using robust::Sign;
using Kind = EdgeTies::Kind;

std::size_t side_between(std::uint8_t a, std::uint8_t b) {
  if (a == b) throw std::invalid_argument("the ends of an edge are one point");
  return a + b == 1 ? 0 : a + b == 3 ? 1 : 2;
}

namespace {

constexpr int kTieBits = 64;

template <class T>
Enclosure enclosed(const Ball<T>& t) {
  return {t.lower(), t.upper()};
}
Enclosure enclosed(const Exact& t) { return enclosed(t.enclosure(kTieBits)); }

/// The window in the frame of the edge: its first end 0, its second 1. On an edge a point below and its mirror image above are as near, so
/// the image is put below, whichever way round the face was given.
template <class NT>
Site<NT> seen_from_edge(const WindowNumbers<NT>& numbers, const std::array<std::uint8_t, 2>& place) {
  const std::size_t side = side_between(place[0], place[1]);
  const PlanePoint<NT> z = numbers.image(), apex = numbers.apex();
  const auto corner = [&](std::uint8_t p) -> PlanePoint<NT> {
    if (p == 2) return apex;
    return {NT(p == 1 ? 1.0 : 0.0), NT(0.0)};
  };
  Site<NT> site;
  site.weight = numbers.weight(side);
  if (side == 0 && place[0] == 0) {
    site.image = z;
  } else {
    const PlanePoint<NT> origin = corner(place[0]), direction = corner(place[1]) - origin, from_origin = z - origin;
    const NT square = squared_norm(direction);
    site.image = {dot(direction, from_origin) / square, cross(direction, from_origin) / square};
  }
  site.image.y = -abs(site.image.y);
  return site;
}

template <class NT>
class EdgeComparison {
 public:
  EdgeComparison(Site<NT> a, Site<NT> b, bool same_weight) : a_(std::move(a)), b_(std::move(b)), same_weight_(same_weight) {
    line_ = {{NT(0.0), NT(0.0)}, {NT(1.0), NT(0.0)}, NT(1.0)};
    if (same_weight) a_.weight = b_.weight = NT(0.0);
  }

  std::optional<EdgeTies> run() const {
    const PlanePoint<NT> d = b_.image - a_.image;
    if (same_weight_) {
      const MaybeSign along = maybe_sign(d.x);
      if (!along) return std::nullopt;
      if (*along == Sign::zero) return above_each_other();
      return crossings();
    }
    const NT s = b_.weight - a_.weight;
    const MaybeSign gap = maybe_sign(squared_norm(d) - square(s));
    if (!gap) return std::nullopt;
    if (*gap == Sign::positive) return crossings();
    const MaybeSign lead = maybe_sign(s);
    if (!lead) return std::nullopt;
    if (*gap == Sign::negative) return none(*lead == Sign::positive);
    return *lead == Sign::zero ? of_kind(Kind::everywhere) : contact(*lead);  // one image and one weight, under another description
  }

 private:
  static EdgeTies none(bool a_is_nearer) {
    EdgeTies result;
    result.kind = Kind::none;
    result.a_is_nearer = a_is_nearer;
    return result;
  }
  static EdgeTies of_kind(Kind kind) {
    EdgeTies result;
    result.kind = kind;
    return result;
  }

  /// Equal weights and feet: the image nearer to the line wins all along it.
  std::optional<EdgeTies> above_each_other() const {
    const MaybeSign higher = maybe_sign(b_.image.y - a_.image.y);
    if (!higher) return std::nullopt;
    return *higher == Sign::zero ? of_kind(Kind::everywhere) : none(*higher == Sign::negative);
  }

  /// Each overtaking happens once at most on the line.
  std::optional<EdgeTies> crossings() const {
    EdgeTies result = of_kind(Kind::none);
    std::optional<NT> first;
    for (const bool a_before : {true, false}) {
      const SideTie<NT> tie = a_before ? overtaking(line_, a_, b_, same_weight_) : overtaking(line_, b_, a_, same_weight_);
      if (tie.existence == Existence::open) return std::nullopt;
      if (tie.existence == Existence::impossible) continue;
      const MaybeSign after = maybe_sign(tie.t), before = maybe_sign(NT(1.0) - tie.t);
      if (after == Sign::negative || before == Sign::negative) continue;
      if (!after || !before) return std::nullopt;
      result.ties.push_back({clipped(enclosed(tie.t)), a_before, false});
      if (!first) {
        first = tie.t;
        continue;
      }
      const MaybeSign order = maybe_sign(tie.t - *first);
      if (!order) return std::nullopt;
      if (*order == Sign::negative) std::swap(result.ties[0], result.ties[1]);
    }
    if (!result.ties.empty()) {
      result.kind = Kind::points;
      return result;
    }
    // Not zero: both images are on one side of the line, so it touches no branch of their hyperbola, and a tie at its origin would be one of those found.
    const MaybeSign at_start = maybe_sign(distance(b_, line_.origin) - distance(a_, line_.origin));
    if (!at_start) return std::nullopt;
    result.a_is_nearer = *at_start == Sign::positive;
    return result;
  }

  /// The weights differ by the distance of the images: they tie on the ray from the farther image (of the lesser weight) through the other,
  /// beyond that one. `lead` is positive if a's weight is the lesser.
  std::optional<EdgeTies> contact(Sign lead) const {
    const bool a_leads = lead == Sign::positive;
    const Site<NT>&light = a_leads ? a_ : b_, &heavy = a_leads ? b_ : a_;
    const PlanePoint<NT> ray = heavy.image - light.image;
    const MaybeSign rise = maybe_sign(ray.y), height = maybe_sign(heavy.image.y);
    if (!rise || !height) return std::nullopt;
    if (*height == Sign::zero && *rise == Sign::zero) return along_edge(heavy.image.x, ray.x, a_leads);
    if (*height != Sign::zero && *rise != Sign::positive) return none(a_leads);
    const NT t = *height == Sign::zero ? heavy.image.x : heavy.image.x - ray.x * (heavy.image.y / ray.y);
    const MaybeSign after = maybe_sign(t), before = maybe_sign(NT(1.0) - t);
    if (!after || !before) return std::nullopt;
    if (*after == Sign::negative || *before == Sign::negative) return none(a_leads);
    EdgeTies result = of_kind(Kind::points);
    result.ties.push_back({clipped(enclosed(t)), a_leads, true});
    return result;
  }

  /// Both images on the line: they tie from the heavy one's on, in the direction of the ray.
  std::optional<EdgeTies> along_edge(const NT& from, const NT& ray, bool a_leads) const {
    const MaybeSign forward = maybe_sign(ray);
    if (!forward) return std::nullopt;
    const bool up = *forward == Sign::positive;
    const MaybeSign rest = maybe_sign(up ? NT(1.0) - from : from);  // what the ray has of the edge
    if (!rest) return std::nullopt;
    if (*rest == Sign::negative) return none(a_leads);
    EdgeTies result = of_kind(*rest == Sign::zero ? Kind::points : Kind::ray);
    const Enclosure at = clipped(enclosed(from));
    if (*rest == Sign::zero)
      result.ties.push_back({at, a_leads, true});
    else
      result.ties.push_back({up ? Enclosure{at.lower, 1} : Enclosure{0, at.upper}, a_leads, true});
    return result;
  }

  static Enclosure clipped(Enclosure t) { return {std::clamp(t.lower, 0.0, 1.0), std::clamp(t.upper, 0.0, 1.0)}; }

  Site<NT> a_, b_;
  bool same_weight_;
  SideLine<NT> line_;
};

/// Coordinates of an image in the frame of an edge, as seen from beyond it.
struct ProgramOnEdge {
  StripProgram image;
  bool along;  ///< the frame starts at the first end of the edge
  robust::RootProgram x() const { return along ? image.value({0, 1, 0, 0}) : image.value({0, -1, 0, 1}); }
  robust::RootProgram y() const { return image.value({0, 0, 1, 0}); }
};
/// Pre: the strip crosses an edge.
ProgramOnEdge program_on_edge(const StripAccess& at, const std::array<std::uint8_t, 2>& place, robust::SquareClasses& classes) {
  ProgramOnEdge result{program_of(at, classes), true};
  const std::size_t side = side_between(place[0], place[1]);
  if (side != 0) result.image.cross(at.last().for_program(classes), side, side == 2);
  result.along = place[0] == (side == 1 ? 2 : 0);  // over side 1 (from 1 to 2) the frame starts at 2, otherwise at 0
  return result;
}
/// Whether the images are one, or mirror images in the edge, by the span test; false says nothing.
bool are_proved_alike(const FaceStrip& a, const std::array<std::uint8_t, 2>& place_a, const FaceStrip& b, const std::array<std::uint8_t, 2>& place_b) {
  if (a.crossings() == 0 || b.crossings() == 0) return false;
  robust::SquareClasses classes;
  const ProgramOnEdge first = program_on_edge(StripAccess(a), place_a, classes), second = program_on_edge(StripAccess(b), place_b, classes);
  if (!are_proved_equal(first.x(), second.x())) return false;
  return are_proved_equal(first.y(), second.y());
}

}  // namespace

std::optional<EdgeTies> ties_on_edge_at(const Rung& rung, const Window& a, const Window& b, const std::array<SpacePoint, 2>& edge) {
  const auto place_a = places_of(a.strip, edge), place_b = places_of(b.strip, edge);
  side_between(place_a[0], place_a[1]);
  const bool same_weight = have_equal_weights(rung, a, b);
  std::optional<EdgeTies> result;
  if (rung.stage == robust::Stage::identity) {
    if (same_weight && a.strip == b.strip) result.emplace().kind = Kind::everywhere;
  } else {
    const std::array<const Window*, 2> windows{&a, &b};
    result = window_stage<EdgeTies>(rung, windows, [&]<class NT>(int bits) -> std::optional<EdgeTies> {
      const WindowNumbers<NT> na(a, bits), nb(b, bits);
      return EdgeComparison<NT>(seen_from_edge(na, place_a), seen_from_edge(nb, place_b), same_weight).run();
    });
    if (!result && rung.stage == robust::Stage::algebra && same_weight && are_proved_alike(a.strip, place_a, b.strip, place_b))
      result.emplace().kind = Kind::everywhere;
  }
  if (result) result->stage = rung.stage;
  return result;
}

EdgeTies ties_on_edge(const Window& a, const Window& b, const std::array<SpacePoint, 2>& edge) {
  if (auto ties = ties_on_edge_at({robust::Stage::identity}, a, b, edge)) return *ties;
  for (const Rung& rung : kRungs)
    if (auto ties = ties_on_edge_at(rung, a, b, edge)) return *ties;
  return {};
}

}  // namespace gvd::predicates
