#pragma once

#include <algorithm>

#include "gvd/predicates/strip_window.hpp"
#include "laid_out.hpp"
#include "meshes.hpp"
#include "planar_strips.hpp"
#include "real.hpp"
#include "zigzag.hpp"

/// Three windows of a facet with a vertex at a known point of its plane, and a fourth one that ties there, by construction.
namespace gvd::test {

struct TiedSites {
  predicates::FaceCorners facet;
  std::vector<predicates::Window> windows;  ///< i, j, k and the rival
  Real tie;                                 ///< the distance of the vertex
  LaidOut rival_strip;
  std::array<mpq_class, 3> vertex;  ///< barycentric, in the facet as the last face of the rival's strip has it (edge ends, apex)

  Real rival_distance() const {
    const auto flat = rival_strip.flat<Real>();
    const auto image = rival_strip.image(flat);
    const auto [a, b] = rival_strip.edge.back();
    const std::array<std::size_t, 3> corner{b, a, flat.size() - 1};
    RealPoint<Real> p{Real(0), Real(0)};
    for (std::size_t k = 0; k < 3; ++k) p = {p.x + real(vertex[k]) * flat[corner[k]].x, p.y + real(vertex[k]) * flat[corner[k]].y};
    return real(windows[3].weight.given) + norm(p - image);
  }
};

/// The plane, put into space by (x, y) -> (rx x, y, rz x): distances are those of (sqrt(rx^2 + rz^2) x, y).
struct TiltedPlane {
  int rx, rz;
  predicates::SpacePoint operator()(const PlanarPoint& p) const { return {mpq_class(rx * p.x).get_d(), p.y.get_d(), mpq_class(rz * p.x).get_d()}; }
  /// |p|^2
  mpq_class square(const PlanarPoint& p) const { return (rx * rx + rz * rz) * p.x * p.x + p.y * p.y; }
};

inline PlanarPoint whole(int x, int y) { return {x, y}; }

/// A site of the plane as a window of the facet: over the side beyond which it lies; empty if it lies beyond none by a clear margin.
inline std::optional<LaidOut> strip_from(const TiltedPlane& plane, const std::array<PlanarPoint, 3>& facet, const PlanarPoint& site) {
  for (std::size_t k = 0; k < 3; ++k) {
    const PlanarPoint &a = facet[k], &b = facet[(k + 1) % 3], &apex = facet[(k + 2) % 3];
    if (turn(a, b, site) >= 0) continue;
    // A whole point behind the site, so that the site lies inside the triangle.
    const mpq_class x = 4 * site.x - 3 * (a.x + b.x) / 2, y = 4 * site.y - 3 * (a.y + b.y) / 2;
    const PlanarPoint far{std::floor(x.get_d()), std::floor(y.get_d())};
    const auto area = [&](const PlanarPoint& p, const PlanarPoint& q, const PlanarPoint& r) {
      return mpq_class((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
    };
    const std::array<mpq_class, 3> weight{area(b, a, site), area(a, far, site), area(far, b, site)};  // of far, b, a
    if (sgn(weight[0]) <= 0 || sgn(weight[1]) < 0 || sgn(weight[2]) < 0) continue;
    LaidOut strip;
    strip.corner = {plane(far), plane(b), plane(a), plane(apex)};
    strip.edge = {{1, 2}};
    strip.source.weight = weight;
    return strip;
  }
  return std::nullopt;
}

struct PlanarSite {
  PlanarPoint at;
  mpq_class weight;
};

/// `sites`: i, j, k and the rival. The vertex is p, where all of them are `tie` away.
inline std::optional<TiedSites> planar_sites(const TiltedPlane& plane, const std::array<PlanarPoint, 3>& facet, std::array<PlanarSite, 4> sites,
                                             const PlanarPoint& p, const Real& tie) {
  TiedSites result{{plane(facet[0]), plane(facet[1]), plane(facet[2])}, {}, tie, {}, {}};
  for (const PlanarSite& site : sites) {
    const auto strip = strip_from(plane, facet, site.at);
    if (!strip) return std::nullopt;
    result.windows.push_back({strip->strip(), {site.weight, {}}, std::nullopt});
    result.rival_strip = *strip;
  }
  // Of the corners (edge[1], edge[0], apex) of the facet as the rival's strip has it.
  std::array<PlanarPoint, 3> corner;
  const std::array<std::size_t, 3> order{2, 1, 3};
  for (std::size_t i = 0; i < 3; ++i)
    for (const PlanarPoint& c : facet)
      if (plane(c) == result.rival_strip.corner[order[i]]) corner[i] = c;
  const auto area = [](const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c) {
    return mpq_class((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  };
  const mpq_class all = area(corner[0], corner[1], corner[2]);
  for (std::size_t i = 0; i < 3; ++i) result.vertex[i] = area(p, corner[(i + 1) % 3], corner[(i + 2) % 3]) / all;
  return result;
}

/// Counter-clockwise round p.
inline void sort_round(std::array<PlanarSite, 4>& sites, const PlanarPoint& p) {
  const auto angle = [&](const PlanarSite& s) { return std::atan2(mpq_class(s.at.y - p.y).get_d(), mpq_class(s.at.x - p.x).get_d()); };
  std::sort(sites.begin(), sites.begin() + 3, [&](const PlanarSite& a, const PlanarSite& b) { return angle(a) < angle(b); });
}
template <class T, std::size_t n>
std::array<T, 4> four_of(std::array<T, n> all, Random& random) {
  for (std::size_t k = n; k > 1; --k) std::swap(all[k - 1], all[random.below(static_cast<std::uint32_t>(k))]);
  return {all[0], all[1], all[2], all[3]};
}
/// A facet round the origin, with whole corners.
inline std::array<PlanarPoint, 3> small_facet(Random& random, int size) {
  const auto some = [&] { return size + static_cast<int>(random.below(static_cast<std::uint32_t>(size))); };
  return {whole(-some(), -some()), whole(some(), -some()), whole(static_cast<int>(random.below(3)) - 1, some())};
}

/// Grid points on a circle.
inline TiedSites on_a_circle(Random& random) {
  constexpr std::array<std::array<int, 2>, 12> kCircle{
      {{63, 16}, {33, 56}, {-16, 63}, {-56, 33}, {-63, -16}, {-33, -56}, {16, -63}, {56, -33}, {60, 25}, {-25, 60}, {-60, -25}, {25, -60}}};
  for (;;) {
    const auto picked = four_of(kCircle, random);
    std::array<PlanarSite, 4> sites;
    const PlanarPoint centre = whole(static_cast<int>(random.below(7)) - 3, static_cast<int>(random.below(7)) - 3);
    for (std::size_t i = 0; i < 4; ++i) sites[i] = {{centre.x + picked[i][0], centre.y + picked[i][1]}, 0};
    sort_round(sites, centre);
    if (turn(sites[0].at, sites[1].at, sites[2].at) <= 0) continue;
    if (auto result = planar_sites({1, 0}, small_facet(random, 5), sites, centre, Real(65))) return *result;
  }
}

/// Mirror images in the y axis, in planes of one square class or another: the corners of a rectangle in a circle.
inline TiedSites mirrored_sites(Random& random) {
  constexpr std::array<std::array<int, 2>, 4> kPlanes{{{1, 1}, {1, 2}, {2, 3}, {3, 4}}};
  for (;;) {
    const auto& slope = kPlanes[random.below(4)];
    const TiltedPlane plane{slope[0], slope[1]};
    const int x = 20 + static_cast<int>(random.below(20)), y = 20 + static_cast<int>(random.below(20));
    auto picked = four_of(std::array<std::array<int, 2>, 4>{{{x, y}, {-x, y}, {-x, -y}, {x, -y}}}, random);
    std::array<PlanarSite, 4> sites;
    for (std::size_t i = 0; i < 4; ++i) sites[i] = {whole(picked[i][0], picked[i][1]), 0};
    sort_round(sites, whole(0, 0));
    if (turn(sites[0].at, sites[1].at, sites[2].at) <= 0) continue;
    if (auto result = planar_sites(plane, small_facet(random, 4), sites, whole(0, 0), sqrt(real(plane.square(sites[0].at))))) return *result;
  }
}

/// Images on Pythagorean directions from the origin, with weights that make all tie there.
inline std::array<PlanarSite, 4> weighted_sites(Random& random, int most) {
  constexpr std::array<std::array<int, 2>, 12> kDirections{
      {{3, 4}, {4, 3}, {-3, 4}, {-4, 3}, {3, -4}, {-3, -4}, {4, -3}, {-4, -3}, {5, 0}, {0, 5}, {-5, 0}, {0, -5}}};
  const auto picked = four_of(kDirections, random);
  std::array<PlanarSite, 4> sites;
  for (std::size_t i = 0; i < 4; ++i) {
    const int r = 10 + static_cast<int>(random.below(static_cast<std::uint32_t>(most)));
    sites[i] = {whole(r * picked[i][0], r * picked[i][1]), 400 - 5 * r};
  }
  sort_round(sites, whole(0, 0));
  return sites;
}
inline TiedSites weighted(Random& random) {
  for (;;) {
    const auto sites = weighted_sites(random, 30);
    // Only the order of the directions counts, as all radii are positive.
    const auto unit = [&](std::size_t i) { return PlanarPoint{sites[i].at.x / (400 - sites[i].weight), sites[i].at.y / (400 - sites[i].weight)}; };
    if (turn(unit(0), unit(1), unit(2)) <= 0) continue;
    if (auto result = planar_sites({1, 0}, small_facet(random, 9), sites, whole(0, 0), Real(400))) return *result;
  }
}

/// The other vertex of a triple with two, whose regions lie the other way round; the rival ties there.
inline TiedSites two_vertices(Random& random) {
  for (;;) {
    auto sites = weighted_sites(random, 60);
    // Relative to the middle one: p.a - rho s = c, |p| = rho; one root is known, the product of both is rational.
    const PlanarPoint pivot = sites[1].at;
    const auto relative = [&](std::size_t i) {
      const mpq_class x = sites[i].at.x - pivot.x, y = sites[i].at.y - pivot.y, s = sites[i].weight - sites[1].weight;
      return std::array<mpq_class, 4>{x, y, s, (x * x + y * y - s * s) / 2};
    };
    const auto i = relative(0), k = relative(2);
    const mpq_class det = i[0] * k[1] - i[1] * k[0];
    if (sgn(det) == 0) continue;
    // p = u + rho w
    const auto solve = [&](const mpq_class& ri, const mpq_class& rk) {
      return PlanarPoint{(ri * k[1] - rk * i[1]) / det, (i[0] * rk - k[0] * ri) / det};
    };
    const PlanarPoint u = solve(i[3], k[3]), w = solve(i[2], k[2]);
    const mpq_class a = w.x * w.x + w.y * w.y - 1, c = u.x * u.x + u.y * u.y, known = 400 - sites[1].weight;
    if (sgn(a) == 0) continue;
    const mpq_class rho = c / (a * known);
    if (sgn(rho) <= 0 || rho <= i[2] || rho <= k[2] || rho == known) continue;
    const PlanarPoint p{u.x + rho * w.x + pivot.x, u.y + rho * w.y + pivot.y};
    const mpq_class value = rho + sites[1].weight;
    // The rival: on a Pythagorean direction from p.
    const int r = 4 + static_cast<int>(random.below(30)), sx = random.below(2) == 0 ? 1 : -1, sy = random.below(2) == 0 ? 1 : -1;
    sites[3] = {{p.x + sx * 3 * r, p.y + sy * 4 * r}, value - 5 * r};
    std::swap(sites[0], sites[2]);
    // At this vertex the regions are counter-clockwise in this order, or this is the first vertex again.
    const auto unit = [&](std::size_t n) {
      const mpq_class d = value - sites[n].weight;
      return PlanarPoint{(sites[n].at.x - p.x) / d, (sites[n].at.y - p.y) / d};
    };
    if (turn(unit(0), unit(1), unit(2)) <= 0) continue;
    if (auto result = planar_sites({1, 0}, small_facet(random, 9), sites, p, real(value))) return *result;
  }
}

/// Sources in the corners of the facet, a grid triangle in a circle, and beyond a side.
inline TiedSites sites_along_mesh_edges(Random& random) {
  constexpr std::array<std::array<int, 2>, 12> kCircle{
      {{7, 4}, {4, 7}, {-4, 7}, {-7, 4}, {-7, -4}, {-4, -7}, {4, -7}, {7, -4}, {8, 1}, {-1, 8}, {-8, -1}, {1, -8}}};
  for (;;) {
    const auto picked = four_of(kCircle, random);
    std::array<PlanarSite, 4> sites;
    for (std::size_t i = 0; i < 4; ++i) sites[i] = {whole(picked[i][0], picked[i][1]), 0};
    if (turn(sites[0].at, sites[1].at, sites[2].at) <= 0) continue;
    const std::array<PlanarPoint, 3> facet{sites[0].at, sites[1].at, sites[2].at};
    const TiltedPlane plane{1, 0};
    const auto strip = strip_from(plane, facet, sites[3].at);
    if (!strip) continue;
    std::array<PlanarSite, 4> all{sites[3], sites[3], sites[3], sites[3]};
    auto result = planar_sites(plane, facet, all, whole(0, 0), sqrt(Real(65)));
    if (!result) continue;
    for (std::size_t k = 0; k < 3; ++k) result->windows[k] = {predicates::FaceStrip(result->facet, predicates::FacePoint::corner(k)), {}, std::nullopt};
    return *result;
  }
}

/// A facet that is regular, with corners on the axes: three strips that go over into one another when the axes are exchanged in turn, and their
/// mirror image. Every face is of a square class of its own.
inline TiedSites regular_facet(Random& random) {
  for (;;) {
    LaidOut strip = random_layout(1 + random.below(4), random, [](const predicates::SpacePoint& p) { return p; });
    // The last face becomes the facet: its corners (edge ends, apex) are put on the axes.
    const auto [a, b] = strip.edge.back();
    if (a < 3 && b < 3 && strip.edge.size() > 1) continue;
    const double size = 1 + random.uniform();
    strip.corner[a] = {size, 0, 0};
    strip.corner[b] = {0, size, 0};
    strip.corner.back() = {0, 0, size};
    const auto exchanged = [&](std::array<std::size_t, 3> axes) {
      LaidOut image = strip;
      for (auto& p : image.corner) p = {p[axes[0]], p[axes[1]], p[axes[2]]};
      return image;
    };
    const auto window = [](const LaidOut& s) -> predicates::Window { return {s.strip(), {}, std::nullopt}; };
    TiedSites result;
    result.rival_strip = exchanged({1, 0, 2});
    result.vertex = {mpq_class(1, 3), mpq_class(1, 3), mpq_class(1, 3)};
    const std::array<LaidOut, 3> turned{strip, exchanged({1, 2, 0}), exchanged({2, 0, 1})};
    result.windows = {window(turned[0]), window(turned[1]), window(turned[2]), window(result.rival_strip)};
    // Corner a at the origin of the last face's entry edge or not: the facet counter-clockwise as the first face of the strip is.
    result.facet = {strip.corner[b], strip.corner[a], strip.corner.back()};
    result.tie = result.rival_distance();
    return result;
  }
}

struct TiedSitesFamily {
  const char* name;
  TiedSites (*make)(Random&);
  bool one_class;
};
inline constexpr std::array<TiedSitesFamily, 6> kTiedSitesFamilies = {{{"integer_grid", on_a_circle, true},
                                                                      {"mirror_images", mirrored_sites, true},
                                                                      {"pythagorean_weights", weighted, true},
                                                                      {"triples_with_two_vertices", two_vertices, true},
                                                                      {"sites_along_mesh_edges", sites_along_mesh_edges, true},
                                                                      {"regular_facet", regular_facet, false}}};

}  // namespace gvd::test
