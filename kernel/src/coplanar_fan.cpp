#include "coplanar_fan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "gvd/robust/double_double.hpp"

namespace gvd::kernel {
namespace {

using Integer = std::int64_t;
using Wide = __int128;
using Vector = std::array<Integer, 3>;

constexpr int kBits = 40;

/// The neighbours of v round it, as exact differences from v.
std::optional<std::vector<Point>> exact_spokes(const Mesh& mesh, VertexId v) {
  std::vector<Point> spokes;
  const Point& at = mesh.point(v);
  bool exact = true;
  const auto add = [&](VertexId p) {
    exact = exact && mesh.is_representable(p);
    Point d{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto sum = robust::two_sum(mesh.point(p)[k], -at[k]);
      d[k] = sum.hi;
      exact = exact && sum.lo == 0;
    }
    spokes.push_back(d);
  };
  HalfedgeId last = kNone;
  mesh.for_each_outgoing(v, [&](HalfedgeId h) {
    add(mesh.target(h));
    last = h;
  });
  if (mesh.is_boundary(v)) add(mesh.apex(last));
  return exact ? std::optional(spokes) : std::nullopt;
}

/// The sign of a b - c d if it is certain. Pre: nothing overflows.
std::optional<int> sign_of_determinant(double a, double b, double c, double d) {
  const auto p = robust::two_prod(a, b), q = robust::two_prod(c, d);
  const auto is_exact = [](double x, double y, double product) { return x == 0 || y == 0 || std::abs(product) > 0x1p-960; };
  if (!is_exact(a, b, p.hi) || !is_exact(c, d, q.hi)) return std::nullopt;
  if (p.hi != q.hi) return p.hi > q.hi ? 1 : -1;  // hi is the nearest double: monotone
  return p.lo > q.lo ? 1 : p.lo < q.lo ? -1 : 0;
}

/// All spokes in the plane across axis k. No two neighbours are in line, as every face has an area.
bool is_straight_across(const std::vector<Point>& spokes, std::size_t k, bool boundary) {
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const auto turn = [&](const Point& d, const Point& e) { return sign_of_determinant(d[i], e[j], d[j], e[i]); };
  const auto first = turn(spokes[0], spokes[1]);
  if (!first) return false;
  const std::size_t corners = boundary ? spokes.size() - 1 : spokes.size();
  for (std::size_t c = 1; c < corners; ++c) {
    if (turn(spokes[c], spokes[(c + 1) % spokes.size()]) != first) return false;
  }
  return !boundary || turn(spokes.front(), spokes.back()) == 0;
}

/// The spokes in units of one power of two, if they are integers of at most kBits bits.
std::optional<std::vector<Vector>> as_integers(const std::vector<Point>& spokes) {
  double largest = 0;
  for (const Point& d : spokes) {
    for (const double x : d) largest = std::max(largest, std::abs(x));
  }
  const int shift = kBits - 1 - std::ilogb(largest);
  std::vector<Vector> integers(spokes.size());
  for (std::size_t s = 0; s < spokes.size(); ++s) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = std::ldexp(spokes[s][k], shift);  // |x| < 2^40: may lose bits only if it is not an integer
      integers[s][k] = static_cast<Integer>(x);
      if (std::ldexp(static_cast<double>(integers[s][k]), -shift) != spokes[s][k]) return std::nullopt;
    }
  }
  return integers;
}

std::array<Wide, 3> cross(const Vector& d, const Vector& e) {
  const auto entry = [&](std::size_t i, std::size_t j) { return Wide{d[i]} * e[j] - Wide{d[j]} * e[i]; };
  return {entry(1, 2), entry(2, 0), entry(0, 1)};
}

bool is_straight(const std::vector<Vector>& spokes, bool boundary) {
  const std::array<Wide, 3> normal = cross(spokes[0], spokes[1]);
  // In the plane: normal . d, below 3 * 2^81 * 2^40.
  for (const Vector& d : spokes) {
    if (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2] != 0) return false;
  }
  // Normals of the corners are multiples of one another: one entry that is not zero compares their directions.
  const auto k = static_cast<std::size_t>(std::find_if(normal.begin(), normal.end(), [](Wide x) { return x != 0; }) - normal.begin());
  const std::size_t corners = boundary ? spokes.size() - 1 : spokes.size();
  for (std::size_t c = 1; c < corners; ++c) {
    const Wide other = cross(spokes[c], spokes[(c + 1) % spokes.size()])[k];
    if ((other > 0) != (normal[k] > 0)) return false;
  }
  return !boundary || cross(spokes.front(), spokes.back()) == std::array<Wide, 3>{};
}

}  // namespace

bool is_certainly_straight_coplanar_fan(const Mesh& mesh, VertexId v) {
  const auto spokes = exact_spokes(mesh, v);
  if (!spokes) return false;
  const bool boundary = mesh.is_boundary(v);
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::all_of(spokes->begin(), spokes->end(), [&](const Point& d) { return d[k] == 0; })) {
      return is_straight_across(*spokes, k, boundary);
    }
  }
  const auto integers = as_integers(*spokes);
  return integers && is_straight(*integers, boundary);
}

}  // namespace gvd::kernel
