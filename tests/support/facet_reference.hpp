#pragma once

#include <mpfr.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/mpfr.hpp>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "gvd/kernel/facet_numbers.hpp"
#include "gvd/kernel/node_point.hpp"
#include "gvd/kernel/tessellation.hpp"

namespace gvd::test {

/// Brute force: the tessellation's nodes from every pair and every triple, in 75 decimal digits, and a check of a tessellation against them.
/// Independent of the product: classical Apollonius (eliminate, one quadratic equation), no identities, no growth. Ties are told by
/// magnitude (a test may), so inputs should be either clearly or exactly degenerate.
class FacetReference {
 public:
  using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<75>, boost::multiprecision::et_off>;
  struct Point {
    Real x, y;
  };

  explicit FacetReference(kernel::FacetWaves& waves) : waves_(waves) {
    kernel::FacetNumbers<kernel::FacetWaves::M> numbers;
    kernel::load_numbers(waves, 256, numbers);
    corner_ = {Point{0, 0}, Point{1, 0}, point(numbers.frame->apex)};
    for (std::size_t i = 0; i < numbers.sites.size(); ++i) {
      const auto* s = numbers.sites[i];
      Wave w;
      w.image = point(s->image);
      w.weight = real(s->weight);
      w.has_cone = s->has_cone;
      if (s->has_cone) w.cone = {point(s->cone[0]), point(s->cone[1])};
      wave_.push_back(w);
    }
    for (std::size_t i = 0; i < wave_.size(); ++i) {
      wave_[i].group = i;
      for (std::size_t j = 0; j < i; ++j) {
        const bool same = waves.sites[i].root == waves.sites[j].root && near(wave_[i].image, wave_[j].image, 50);
        if (same && wave_[i].group == i) wave_[i].group = wave_[j].group;
      }
    }
    find_inside();
    find_on_sides();
  }

  std::size_t inside_count() const { return inside_.size(); }
  std::size_t side_count() const { return on_side_.size(); }

  /// Empty if the tessellation has exactly the true nodes, each with the right number of arcs, and each arc separates the two regions it names.
  /// Together with "each region touches the outline" that makes it the true tessellation.
  std::string check(const kernel::FacetTessellation& t) const {
    if (t.undecided) return "undecided";
    std::vector<bool> inside_met(inside_.size()), side_met(on_side_.size());
    std::vector<std::size_t> degree(t.nodes.size());
    for (const auto& arc : t.arcs) {
      if (arc.from == arc.to) return "an arc of length zero";
      ++degree[arc.from];
      ++degree[arc.to];
    }
    for (std::size_t n = 0; n < t.nodes.size(); ++n) {
      const auto& node = t.nodes[n];
      const bool inside = node.kind == kernel::FacetTessellation::Node::Kind::inside;
      if (degree[n] != node.sites.size() - (inside ? 0 : 1)) return "node " + std::to_string(n) + " has the wrong number of arcs";
      if (node.kind == kernel::FacetTessellation::Node::Kind::corner) {
        const auto truth = round_corner(node.where);
        std::vector<std::size_t> have;
        for (const auto s : node.sites) have.push_back(wave_[s].group);
        if (have != truth && have.size() <= truth.size())  // sampling may miss a thin one
          return "corner " + std::to_string(node.where) + " has other regions";
        continue;
      }
      const Point at = node_point_of(node);
      auto& met = inside ? inside_met : side_met;
      const auto& truth = inside ? inside_ : on_side_;
      std::size_t i = 0;
      while (i < truth.size() && !near(truth[i].at, at, 25)) ++i;
      if (i == truth.size()) return "node " + std::to_string(n) + " does not exist: " + distances(at);
      if (met[i]) return "node " + std::to_string(n) + " is there twice";
      met[i] = true;
      for (const auto s : node.sites)
        if (truth[i].groups.count(wave_[s].group) == 0) return "node " + std::to_string(n) + " names a site that does not tie there";
    }
    for (std::size_t i = 0; i < inside_.size(); ++i)
      if (!inside_met[i]) return "missing vertex at " + text(inside_[i].at);
    for (std::size_t i = 0; i < on_side_.size(); ++i)
      if (!side_met[i]) return "missing singularity at " + text(on_side_[i].at);
    for (std::size_t c = 0; c < 3; ++c) {
      const bool there = std::any_of(t.nodes.begin(), t.nodes.end(), [&](const auto& node) {
        return node.kind == kernel::FacetTessellation::Node::Kind::corner && node.where == c;
      });
      if (!there && round_corner(c).size() > 1) return "missing singularity at corner " + std::to_string(c);
    }
    for (std::size_t a = 0; a < t.arcs.size(); ++a) {
      const std::string wrong = check_arc(t, t.arcs[a]);
      if (!wrong.empty()) return "arc " + std::to_string(a) + ": " + wrong;
    }
    return check_outline(t);
  }

 private:
  struct Wave {
    Point image;
    Real weight;
    bool has_cone = false;
    std::array<Point, 2> cone;
    std::size_t group = 0;
  };
  struct TrueNode {
    Point at;
    std::set<std::size_t> groups;
  };

  static Real real(const kernel::FacetWaves::M& ball) {
    Real x;
    mpfr_set(x.backend().data(), ball.mid().get(), MPFR_RNDN);
    return x;
  }
  static Point point(const predicates::PlanePoint<kernel::FacetWaves::M>& p) { return {real(p.x), real(p.y)}; }
  static Real cross(const Point& o, const Point& a, const Point& b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }
  static Real length(const Point& a, const Point& b) { return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y)); }
  /// 10^-digits.
  static const Real& tiny(int digits) {
    static const std::vector<Real> powers = [] {
      std::vector<Real> list{1};
      while (list.size() < 76) list.push_back(list.back() / 10);
      return list;
    }();
    return powers[static_cast<std::size_t>(digits)];
  }
  static bool near(const Point& a, const Point& b, int digits) { return length(a, b) < tiny(digits); }
  static std::string text(const Point& p) { return "(" + p.x.str(6) + ", " + p.y.str(6) + ")"; }
  std::string distances(const Point& p) const {
    std::string result = text(p) + ", distances";
    for (std::size_t i = 0; i < wave_.size(); ++i) result += " " + distance(i, p).str(30) + (sees(i, p) ? "" : " (not seen)");
    return result;
  }
  static Point along(const Point& a, const Point& b, const Real& t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

  Real distance(std::size_t i, const Point& p) const { return wave_[i].weight + length(p, wave_[i].image); }
  bool sees(std::size_t i, const Point& p) const {
    const Wave& w = wave_[i];
    const Real& slack = tiny(30);
    return !w.has_cone || (cross(w.image, w.cone[0], p) <= slack && cross(w.image, w.cone[1], p) >= -slack);
  }
  Real least(const Point& p) const {
    Real best = 1e30;
    for (std::size_t i = 0; i < wave_.size(); ++i)
      if (sees(i, p)) best = std::min(best, distance(i, p));
    return best;
  }
  std::size_t winner(const Point& p) const {
    std::size_t best = 0;
    Real least = 1e30;
    for (std::size_t i = 0; i < wave_.size(); ++i) {
      if (!sees(i, p)) continue;
      const Real d = distance(i, p);
      if (d < least) {
        least = d;
        best = i;
      }
    }
    return wave_[best].group;
  }
  bool strictly_inside(const Point& p) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (cross(corner_[k], corner_[(k + 1) % 3], p) <= tiny(25)) return false;
    return true;
  }
  /// A true node if the waves given are nearest at p and see it.
  void consider(const Point& p, const Real& value, const std::vector<std::size_t>& waves, std::vector<TrueNode>& nodes) const {
    for (const auto i : waves)
      if (!sees(i, p) || abs(distance(i, p) - value) > tiny(30)) return;
    if (least(p) < value - tiny(30)) return;
    for (auto& node : nodes) {
      if (!near(node.at, p, 25)) continue;
      for (const auto i : waves) node.groups.insert(wave_[i].group);
      return;
    }
    TrueNode node{p, {}};
    for (const auto i : waves) node.groups.insert(wave_[i].group);
    nodes.push_back(node);
  }

  void find_inside() {
    for (std::size_t i = 0; i < wave_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (std::size_t k = 0; k < j; ++k) {
          if (wave_[i].group == wave_[j].group || wave_[j].group == wave_[k].group || wave_[i].group == wave_[k].group) continue;
          for (const auto& [p, value] : apollonius(wave_[i], wave_[j], wave_[k]))
            if (strictly_inside(p)) consider(p, value, {i, j, k}, inside_);
        }
    // A tie of three waves may have only two regions round it, if one of them is a relay behind another that sees the point. (Only then
    // are the regions counted: sampling misses thin ones.)
    std::erase_if(inside_, [&](const TrueNode& node) { return has_relay(node.groups) && regions_round(node.at) < 3; });
  }
  bool has_relay(const std::set<std::size_t>& groups) const {
    for (const auto a : groups)
      for (const auto b : groups)
        if (a != b && abs(length(wave_[a].image, wave_[b].image) - abs(wave_[a].weight - wave_[b].weight)) < tiny(30)) return true;
    return false;
  }
  /// The points with weight + distance equal for the three, and that value. Classical: the differences are linear in (x, y, value).
  static std::vector<std::pair<Point, Real>> apollonius(const Wave& a, const Wave& b, const Wave& c) {
    std::array<std::array<Real, 4>, 2> m;  // 2 x (bx - ax) + 2 y (by - ay) - 2 v (wb - wa) = |b|^2 - |a|^2 - wb^2 + wa^2
    for (int r = 0; r < 2; ++r) {
      const Wave& o = r == 0 ? b : c;
      m[r] = {2 * (o.image.x - a.image.x), 2 * (o.image.y - a.image.y), -2 * (o.weight - a.weight),
              norm(o.image) - norm(a.image) - o.weight * o.weight + a.weight * a.weight};
    }
    int free = 2;
    Real best = 0;
    for (int f = 0; f < 3; ++f) {
      const int p = (f + 1) % 3, q = (f + 2) % 3;
      const Real det = m[0][p] * m[1][q] - m[0][q] * m[1][p];
      if (abs(det) > best) {
        best = abs(det);
        free = f;
      }
    }
    if (best < tiny(40)) return {};
    const int p = (free + 1) % 3, q = (free + 2) % 3;
    const Real det = m[0][p] * m[1][q] - m[0][q] * m[1][p];
    std::array<Real, 3> base, slope;  // variable = base + slope * free variable
    base[p] = (m[0][3] * m[1][q] - m[0][q] * m[1][3]) / det;
    base[q] = (m[0][p] * m[1][3] - m[0][3] * m[1][p]) / det;
    slope[p] = (-m[0][free] * m[1][q] + m[0][q] * m[1][free]) / det;
    slope[q] = (-m[0][p] * m[1][free] + m[0][free] * m[1][p]) / det;
    base[free] = 0;
    slope[free] = 1;
    const Real x = base[0] - a.image.x, y = base[1] - a.image.y, v = base[2] - a.weight;
    const Real qa = slope[0] * slope[0] + slope[1] * slope[1] - slope[2] * slope[2];
    const Real qb = x * slope[0] + y * slope[1] - v * slope[2];
    const Real qc = x * x + y * y - v * v;
    std::vector<std::pair<Point, Real>> result;
    for (const Real& f : roots(qa, qb, qc)) {
      const Real value = base[2] + slope[2] * f;
      if (value < a.weight || value < b.weight || value < c.weight) continue;
      result.push_back({{base[0] + slope[0] * f, base[1] + slope[1] * f}, value});
    }
    return result;
  }
  static Real norm(const Point& p) { return p.x * p.x + p.y * p.y; }
  /// a x^2 + 2 b x + c = 0; a double root within rounding counts.
  static std::vector<Real> roots(const Real& a, const Real& b, const Real& c) {
    const Real disc = b * b - a * c;
    if (disc < -tiny(60) * (b * b + abs(a * c))) return {};
    const Real root = disc > 0 ? sqrt(disc) : Real(0);
    const Real far = b > 0 ? Real(-b - root) : Real(-b + root);
    std::vector<Real> result;
    if (abs(far) > tiny(60)) result.push_back(c / far);
    if (abs(a) > tiny(60)) result.push_back(far / a);
    return result;
  }
  std::size_t regions_round(const Point& p) const {
    std::vector<std::size_t> seen;
    for (int i = 0; i < 720; ++i) {
      const double angle = (i + 0.37) * 3.14159265358979323846 / 360;
      seen.push_back(winner({p.x + tiny(20) * std::cos(angle), p.y + tiny(20) * std::sin(angle)}));
    }
    std::size_t changes = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) changes += seen[i] != seen[(i + 1) % seen.size()];
    return std::max<std::size_t>(changes, 1);
  }
  /// The regions round corner c from the outgoing side counter-clockwise, as far as fine sampling sees them.
  std::vector<std::size_t> round_corner(std::size_t c) const {
    const Point o = corner_[c], a = corner_[(c + 1) % 3], b = corner_[(c + 2) % 3];
    std::vector<std::size_t> result;
    for (int i = 1; i < 400; ++i) {
      const Real s = Real(i) / 400 * tiny(20);
      const Real r = tiny(20) - s;
      const auto w = winner({o.x + r * (a.x - o.x) + s * (b.x - o.x), o.y + r * (a.y - o.y) + s * (b.y - o.y)});
      if (result.empty() || result.back() != w) result.push_back(w);
    }
    return result;
  }

  void find_on_sides() {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point p0 = corner_[k], p1 = corner_[(k + 1) % 3];
      std::vector<TrueNode> nodes;
      for (std::size_t i = 0; i < wave_.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          for (const Real& t : side_ties(wave_[i], wave_[j], p0, p1)) {
            if (t < tiny(25) || t > 1 - tiny(25)) continue;
            const Point p = along(p0, p1, t);
            if (wave_[i].group != wave_[j].group) consider(p, distance(i, p), {i, j}, nodes);
          }
      // Regions change there, just inside the facet.
      const Point inner{(corner_[0].x + corner_[1].x + corner_[2].x) / 3, (corner_[0].y + corner_[1].y + corner_[2].y) / 3};
      for (const auto& node : nodes) {
        std::set<std::size_t> seen;
        for (int i = 1; i < 400; ++i) {
          const Real s = Real(i) / 400 * tiny(20);
          const Real r = tiny(20) - s;
          const Point ahead{node.at.x + r * (p1.x - p0.x), node.at.y + r * (p1.y - p0.y)};
          const Point behind{node.at.x - r * (p1.x - p0.x), node.at.y - r * (p1.y - p0.y)};
          seen.insert(winner(along(ahead, inner, s)));
          seen.insert(winner(along(behind, inner, s)));
        }
        if (seen.size() > 1) on_side_.push_back(node);
      }
    }
  }
  static std::vector<Real> side_ties(const Wave& a, const Wave& b, const Point& p0, const Point& p1) {
    // unknown t and v: |p(t) - A|^2 = (v - wa)^2; the difference is linear.
    const Real ex = p1.x - p0.x, ey = p1.y - p0.y, e = ex * ex + ey * ey;
    const Real ax = p0.x - a.image.x, ay = p0.y - a.image.y, bx = p0.x - b.image.x, by = p0.y - b.image.y;
    const Real at = ex * ax + ey * ay, bt = ex * bx + ey * by;
    // 2 t (at - bt) + |pa|^2 - |pb|^2 = -2 v (wa - wb) + wa^2 - wb^2
    const Real lt = 2 * (at - bt), lv = 2 * (a.weight - b.weight);
    const Real rhs = a.weight * a.weight - b.weight * b.weight - (ax * ax + ay * ay) + (bx * bx + by * by);
    std::vector<Real> result;
    if (abs(lv) > abs(lt)) {  // v = (rhs - lt t) / lv
      const Real v0 = rhs / lv - a.weight, v1 = -lt / lv;
      for (const Real& t : roots(e - v1 * v1, at - v0 * v1, ax * ax + ay * ay - v0 * v0)) result.push_back(t);
    } else if (abs(lt) > tiny(40)) {  // t = (rhs - lv v) / lt
      const Real t0 = rhs / lt, t1 = -lv / lt;
      const Real b0 = e * t0 * t1 + at * t1 + a.weight, c0 = e * t0 * t0 + 2 * at * t0 + ax * ax + ay * ay - a.weight * a.weight;
      for (const Real& v : roots(e * t1 * t1 - 1, b0, c0)) result.push_back(t0 + t1 * v);
    }
    return result;
  }

  Point node_point_of(const kernel::FacetTessellation::Node& node) const {
    kernel::FacetNumbers<kernel::FacetWaves::M> numbers;
    kernel::load_numbers(waves_, 256, numbers);
    return point(kernel::node_point(waves_, numbers, node));
  }

  /// The bisector is met by lines across the chord of the arc; there the two named regions meet, left and right, and no other is nearer.
  std::string check_arc(const kernel::FacetTessellation& t, const kernel::FacetTessellation::Arc& arc) const {
    const Point from = node_point_of(t.nodes[arc.from]), to = node_point_of(t.nodes[arc.to]);
    const std::size_t l = arc.left, r = arc.right;
    const Real chord = length(from, to);
    for (const double share : {0.1, 0.37, 0.5, 0.81}) {
      const Point m = along(from, to, share);
      Point p = m;
      if (!arc.tangent) {
        // g = d_left - d_right grows towards the right image: bisection along the direction from left to right image.
        const Point il = wave_[l].image, ir = wave_[r].image;
        const Real across = length(il, ir);
        const Point u{(ir.x - il.x) / across, (ir.y - il.y) / across};
        const auto at = [&](const Real& s) { return Point{m.x + s * u.x, m.y + s * u.y}; };
        Real low = -4 * chord, high = 4 * chord;
        const auto g = [&](const Real& s) { return distance(l, at(s)) - distance(r, at(s)); };
        if (g(low) > 0 || g(high) < 0) return "no bisector near the chord";
        for (int i = 0; i < 110; ++i) {
          const Real mid = (low + high) / 2;
          (g(mid) < 0 ? low : high) = mid;
        }
        p = at(low);
        if (cross(from, to, at(low + chord)) > cross(from, to, p)) return "left and right are exchanged";
      }
      if (abs(distance(l, p) - distance(r, p)) > tiny(22)) return "the regions do not tie";
      if (!group_sees(l, p) || !group_sees(r, p)) return "a region is not seen";
      if (least(p) < distance(l, p) - tiny(22)) return "another wave is nearer";
      // a step to either side of the arc
      const Real step = chord * tiny(12);
      const Point n{-(to.y - from.y) / chord * step, (to.x - from.x) / chord * step};
      const Point left{p.x + n.x, p.y + n.y}, right{p.x - n.x, p.y - n.y};
      if (winner(left) != wave_[l].group || winner(right) != wave_[r].group) return "other regions beside it";
    }
    return "";
  }
  bool group_sees(std::size_t i, const Point& p) const {
    for (std::size_t j = 0; j < wave_.size(); ++j)
      if (wave_[j].group == wave_[i].group) {
        const Wave& w = wave_[j];
        const Real& slack = tiny(20);
        if (!w.has_cone || (cross(w.image, w.cone[0], p) <= slack && cross(w.image, w.cone[1], p) >= -slack)) return true;
      }
    return false;
  }

  std::string check_outline(const kernel::FacetTessellation& t) const {
    kernel::FacetNumbers<kernel::FacetWaves::M> numbers;
    kernel::load_numbers(waves_, 256, numbers);
    std::array<Real, 3> reached{0, 0, 0};
    for (const auto& piece : t.outline) {
      const auto parameter = [&](std::uint32_t node, int corner) {
        return node == kernel::FacetTessellation::Piece::kNoNode ? Real(corner) : real(node_parameter(waves_, numbers, t.nodes[node]));
      };
      const Real begin = parameter(piece.from, 0), end = parameter(piece.to, 1);
      if (begin != reached[piece.side] || end <= begin) return "the outline has a gap on side " + std::to_string(piece.side);
      reached[piece.side] = end;
      const Point p0 = corner_[piece.side], p1 = corner_[(piece.side + 1) % 3], in = corner_[(piece.side + 2) % 3];
      for (const double share : {0.01, 0.5, 0.99}) {
        const Point p = along(along(p0, p1, begin + share * (end - begin)), in, tiny(24));
        if (winner(p) != wave_[piece.site].group) return "another region along side " + std::to_string(piece.side);
      }
    }
    for (const Real& r : reached)
      if (r != 1) return "the outline is not complete";
    return "";
  }

  kernel::FacetWaves& waves_;
  std::array<Point, 3> corner_;
  std::vector<Wave> wave_;
  std::vector<TrueNode> inside_, on_side_;
};

}  // namespace gvd::test
