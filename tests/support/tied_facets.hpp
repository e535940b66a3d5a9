#pragma once

#include <algorithm>
#include <map>

#include "gvd/kernel/tessellation.hpp"
#include "lattice_waves.hpp"
#include "worst_case_tally.hpp"

/// Facets with a point at which waves tie by construction: their images lie on circles about it, of radii that their weights make up for. What the point is
/// and which regions meet there follows from the directions to the images, in rational numbers.
namespace gvd::test {

using Node = kernel::FacetTessellation::Node;

struct TiedFacet {
  int c = 1, square = 1;  ///< of the plane; of the circle, the square of its radius
  mpq_class length;
  LatticePoint apex;
  Node::Kind kind = Node::Kind::inside;  ///< of the point: corner 0, on side 0, or inside
  LatticePoint p;
  std::vector<LatticePoint> to_image;  ///< all of one length, that of the circle
  std::vector<mpq_class> share;        ///< how far the image lies in that direction, of the radius
  std::vector<mpq_class> late;         ///< what is added to the weight; zeros tie
  bool one_source = false;             ///< all waves come from one source: their weights are one by identity
  bool turned = false;                 ///< an image is a hair off its lattice point: then there may be other nodes a hair off p

  LatticePoint corner(std::size_t k) const { return k == 0 ? LatticePoint{0, 0} : k == 1 ? LatticePoint{length, 0} : apex; }
  mpq_class dot(const LatticePoint& a, const LatticePoint& b) const { return a.x * b.x + c * a.y * b.y; }
  static mpq_class cross(const LatticePoint& a, const LatticePoint& b) { return a.x * b.y - a.y * b.x; }
  static LatticePoint minus(const LatticePoint& a, const LatticePoint& b) { return {a.x - b.x, a.y - b.y}; }

  /// The side by which the line from p to the image leaves the facet.
  std::uint8_t side_towards(const LatticePoint& image) const {
    std::optional<mpq_class> first;
    std::uint8_t side = 0;
    for (std::uint8_t k = 0; k < 3; ++k) {
      const LatticePoint a = corner(k), along = minus(corner((k + 1u) % 3), a);
      const mpq_class inside = cross(along, minus(p, a)), outside = cross(along, minus(image, a));
      if (sgn(outside) >= 0) continue;
      const mpq_class t = sgn(inside) <= 0 ? mpq_class(0) : mpq_class(inside / (inside - outside));
      if (first && t >= *first) continue;
      first = t;
      side = k;
    }
    return side;
  }
  LatticeWave wave(std::size_t i) const {
    const LatticePoint image = p + share[i] * to_image[i];
    return {side_towards(image), image, 1 + late[i], 2 - share[i]};
  }
  LatticeWaves waves() const {
    LatticeWaves result(c, square, length, apex);
    for (std::size_t i = 0; i < to_image.size(); ++i) {
      const std::uint32_t site = result.add(wave(i));
      if (one_source) result.sites[site].root = result.sites[0].root;
    }
    result.finish();
    return result;
  }

  /// The waves whose regions meet at p, counter-clockwise, of those that tie there.
  std::vector<std::uint32_t> regions() const {
    std::vector<std::uint32_t> tied;
    const mpq_class least = *std::min_element(late.begin(), late.end());
    for (std::uint32_t i = 0; i < late.size(); ++i)
      if (late[i] == least) tied.push_back(i);
    if (kind != Node::Kind::inside) return regions_between({1, 0}, kind == Node::Kind::corner ? apex : LatticePoint{-1, 0}, tied);
    const auto half = [](const LatticePoint& v) { return v.y < 0 || (v.y == 0 && v.x < 0); };
    std::sort(tied.begin(), tied.end(), [&](std::uint32_t i, std::uint32_t j) {
      const LatticePoint &a = to_image[i], &b = to_image[j];
      return half(a) != half(b) ? half(b) : cross(a, b) > 0;
    });
    return tied;
  }

 private:
  /// In a direction e the wave grows by -e.u, u the unit vector to its image; along a side, waves that grow alike differ by their curvature.
  std::vector<std::uint32_t> regions_between(const LatticePoint& from, const LatticePoint& to, const std::vector<std::uint32_t>& tied) const {
    std::vector<LatticePoint> change;
    for (const std::uint32_t i : tied)
      for (const std::uint32_t j : tied) {
        const LatticePoint d = minus(to_image[j], to_image[i]), e{c * d.y, -d.x};
        if (cross(from, e) > 0 && (cross(e, to) > 0)) change.push_back(e);
      }
    std::sort(change.begin(), change.end(), [](const LatticePoint& a, const LatticePoint& b) { return cross(a, b) > 0; });
    change.insert(change.begin(), from);
    change.push_back(to);
    std::vector<std::uint32_t> result{beside(from, tied)};
    for (std::size_t k = 0; k + 1 < change.size(); ++k) {
      const LatticePoint &a = change[k], &b = change[k + 1];
      if (cross(a, b) == 0 && dot(a, b) > 0) continue;
      const LatticePoint middle = cross(a, b) == 0 ? LatticePoint{0, 1} : a + b;
      std::uint32_t best = tied[0];
      for (const std::uint32_t i : tied)
        if (dot(middle, to_image[i]) > dot(middle, to_image[best])) best = i;
      if (k == 0 && share[best] == share[result[0]] && dot(from, to_image[best]) == dot(from, to_image[result[0]])) result[0] = best;
      if (result.back() != best) result.push_back(best);
    }
    const std::uint32_t last = beside(to, tied), before = result.back();
    const bool mirrored = share[last] == share[before] && dot(to, to_image[last]) == dot(to, to_image[before]);
    if (last != before && !mirrored) result.push_back(last);
    return result;
  }
  /// The one that is nearest along a side.
  std::uint32_t beside(const LatticePoint& e, const std::vector<std::uint32_t>& tied) const {
    std::uint32_t best = tied[0];
    for (const std::uint32_t i : tied) {
      const mpq_class ahead = dot(e, to_image[i]) - dot(e, to_image[best]);
      if (ahead > 0 || (ahead == 0 && share[i] > share[best])) best = i;
    }
    return best;
  }
};

/// Circles about the origin with many lattice points, in planes of some square classes.
struct LatticeCircle {
  int c, square;
  std::vector<std::array<int, 2>> points;
};
inline const std::vector<LatticeCircle>& lattice_circles() {
  static const std::vector<LatticeCircle> circles = [] {
    std::vector<LatticeCircle> list;
    for (const int c : {1, 2, 3, 5, 7, 11}) {
      std::map<int, std::vector<std::array<int, 2>>> by_square;
      for (int x = -40; x <= 40; ++x)
        for (int y = -40; y <= 40; ++y) by_square[x * x + c * y * y].push_back({x, y});
      for (auto& [square, points] : by_square)
        if (square >= 900 && square <= 1600 && points.size() >= 12) list.push_back({c, square, std::move(points)});
    }
    return list;
  }();
  return circles;
}

/// `n` waves that tie at a corner, on a side or inside. `mirrored`: two of them in side 0. `one_source`: all come from it, which is cheap to decide.
inline TiedFacet tied_facet(Node::Kind kind, std::size_t n, bool mirrored, bool one_source, Random& random) {
  TiedFacet f;
  f.kind = kind;
  f.one_source = one_source;
  const auto& circles = lattice_circles();
  const LatticeCircle& circle = circles[random.below(static_cast<std::uint32_t>(circles.size()))];
  f.c = circle.c;
  f.square = circle.square;
  f.length = 4 + random.below(4);
  f.apex = {static_cast<int>(random.below(5)), 2 + random.below(3)};
  f.p = kind == Node::Kind::corner ? LatticePoint{0, 0} : kind == Node::Kind::side ? LatticePoint{1 + random.below(3), 0} : LatticePoint{2, 1};
  if (kind == Node::Kind::inside) f.apex = {1 + random.below(3), 3 + random.below(2)};
  const bool weighted = !one_source && random.below(2) == 0;
  while (f.to_image.size() < n) {
    const auto& [x, y] = circle.points[random.below(static_cast<std::uint32_t>(circle.points.size()))];
    LatticePoint v{x, y};
    if (mirrored && f.to_image.size() == 1) v = {f.to_image[0].x, -f.to_image[0].y};
    const bool is_new = std::none_of(f.to_image.begin(), f.to_image.end(), [&](const auto& other) { return other.x == v.x && other.y == v.y; });
    if (mirrored && f.to_image.size() == 1 && !is_new) {
      f.to_image.clear();
      f.share.clear();
      continue;
    }
    if (!is_new) continue;
    f.to_image.push_back(v);
    f.share.push_back(weighted ? mpq_class(3 + random.below(3), 4) : mpq_class(1));
  }
  for (mpq_class& share : f.share) share.canonicalize();
  f.late.assign(n, 0);
  return f;
}

/// The wave turned about p by the angle of tangent 2 t sqrt(c) / (1 - c t^2): it still ties there.
inline LatticePoint turned(const TiedFacet& f, const LatticePoint& v, const mpq_class& t) {
  const mpq_class square = f.c * t * t, cosine = (1 - square) / (1 + square), sine = 2 * t / (1 + square);
  return {cosine * v.x - f.c * sine * v.y, sine * v.x + cosine * v.y};
}

/// One more wave, which comes nearly along the line of the first one.
inline void add_close_direction(TiedFacet& f, Random& random) {
  f.turned = true;
  f.to_image.push_back(turned(f, f.to_image[0], random.below(2) == 0 ? small_step(random) : mpq_class(-small_step(random))));
  f.share.push_back(f.share[0]);
  f.late.push_back(0);
}

/// One wave later or earlier by a step, or seen from p in a direction turned by one: then it still ties there.
inline TiedFacet neighbour(TiedFacet f, Random& random) {
  const std::uint32_t i = random.below(static_cast<std::uint32_t>(f.late.size()));
  const mpq_class step = random.below(2) == 0 ? small_step(random) : mpq_class(-small_step(random));
  if (!f.one_source && random.below(2) == 0) {
    f.late[i] = step;
  } else {
    const LatticePoint v = turned(f, f.to_image[i], step);
    if (std::any_of(f.to_image.begin(), f.to_image.end(), [&](const auto& other) { return other.x == v.x && other.y == v.y; })) return neighbour(f, random);
    f.turned = true;
    f.to_image[i] = v;
  }
  return f;
}

/// Walls: the boundary rays of their windows meet in a point inside, where these and the relays at the ends of the walls tie.
struct Walls {
  TiedFacet circle;      ///< an image a wall; the second one may be late, if there are only two
  std::vector<int> end;  ///< which ray of each window ends at its relay

  /// Per wall the window and its relay: sites 0 and 1, 2 and 3, ...
  LatticeWaves waves() const {
    LatticeWaves result(circle.c, circle.square, circle.length, circle.apex);
    for (std::uint32_t i = 0; i < end.size(); ++i) {
      LatticeWave parent = circle.wave(i), relay = parent;
      const LatticePoint back = mpq_class(-circle.share[i]) * circle.to_image[i];  // from the image to p
      relay.image = parent.image + mpq_class(1, 4) * back;
      relay.times += circle.share[i] / 4;
      // At right angles to the ray, on the side that the window sees.
      const LatticePoint aside{-circle.c * back.y, back.x};
      const LatticePoint open = parent.image + (end[i] == 0 ? mpq_class(-1) : mpq_class(1)) * aside;
      parent.cone = end[i] == 0 ? std::array{relay.image, open} : std::array{open, relay.image};
      const std::uint32_t site = result.add(parent);
      if (circle.late[i] == circle.late[0]) result.sites[site].root = result.sites[0].root;
      result.add_relay(site, static_cast<std::size_t>(end[i]), relay);
    }
    result.finish();
    return result;
  }
  /// The window or its relay: which of the two has the ways that lie counter-clockwise from the one to its image, at p.
  std::uint32_t after(std::uint32_t wall) const { return 2 * wall + (end[wall] == 0 ? 0 : 1); }
  std::uint32_t before(std::uint32_t wall) const { return 2 * wall + (end[wall] == 0 ? 1 : 0); }
  /// Which of the two sees p + step, a step off the ray.
  std::uint32_t seeing(std::uint32_t wall, const LatticePoint& step) const {
    return TiedFacet::cross(circle.to_image[wall], step) > 0 ? after(wall) : before(wall);
  }
  /// The regions that meet in points at p, or a hair off it: in all if none is late, else on each of the two rays by itself.
  std::vector<std::vector<std::uint32_t>> nodes() const {
    const mpq_class late = circle.late[1] - circle.late[0];
    std::vector<std::vector<std::uint32_t>> result;
    if (late == 0) {
      result.emplace_back();
      for (const std::uint32_t wall : circle.regions()) result[0].insert(result[0].end(), {before(wall), after(wall)});
      return result;
    }
    for (std::uint32_t wall = 0; wall < 2; ++wall) {  // towards the image of the later one, off that of the other
      const bool towards = (wall == 1) == (late > 0);
      const LatticePoint step = mpq_class(towards ? 1 : -1) * circle.to_image[wall];
      result.push_back({before(wall), after(wall), seeing(1 - wall, step)});
    }
    return result;
  }
  /// The first two alone, the second one late.
  Walls two_of_them(const mpq_class& late) const {
    Walls two = *this;
    two.end.resize(2);
    two.circle.to_image.resize(2);
    two.circle.share.resize(2);
    two.circle.late = {0, late};
    return two;
  }
};

/// No two of them face to face.
inline Walls walls(std::size_t n, Random& random) {
  Walls w;
  const auto facing = [&](const LatticePoint& a) {
    return std::any_of(w.circle.to_image.begin(), w.circle.to_image.end(), [&](const auto& b) { return TiedFacet::cross(a, b) == 0 && w.circle.dot(a, b) < 0; });
  };
  do w.circle = tied_facet(Node::Kind::inside, n, false, true, random);
  while (std::any_of(w.circle.to_image.begin(), w.circle.to_image.end(), facing));
  for (std::size_t i = 0; i < n; ++i) w.end.push_back(static_cast<int>(random.below(2)));
  return w;
}

/// The second wave starts on the line of the first one, and ties with it all along from there on, or is a little late, or early; a third one comes from elsewhere.
inline TiedFacet on_one_line(const mpq_class& late, Random& random) {
  TiedFacet f = tied_facet(Node::Kind::inside, 2, false, false, random);
  f.to_image = {f.to_image[0], f.to_image[0], f.to_image[1]};
  f.share = {1, mpq_class(3, 4), 1};
  f.late = {0, late, 0};
  return f;
}

/// `n` images in a row, beyond one side, of one distance: nowhere do three of them tie. `bent`: the second one a hair off the row, so that it does, far away.
inline LatticeWaves images_in_a_row(int c, int n, bool bent, const mpq_class& step, Random& random) {
  LatticeWaves waves(c, 1, 6, {2 + random.below(3), 5});
  const LatticePoint first{static_cast<int>(random.below(4)) - 1, -3 - static_cast<int>(random.below(3))};
  const LatticePoint along{1 + random.below(2), mpq_class(static_cast<int>(random.below(3)) - 1, 2)};
  for (int i = 0; i < n; ++i) {
    LatticePoint image = first + mpq_class(i) * along;
    if (bent && i == 1) image.y += step;
    const std::uint32_t site = waves.add({0, image, 0, 0});
    waves.sites[site].root = waves.sites[0].root;
  }
  waves.finish();
  return waves;
}

}  // namespace gvd::test
