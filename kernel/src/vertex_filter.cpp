#include "vertex_filter.hpp"

#include <algorithm>
#include <cmath>

namespace gvd::kernel {
namespace {

using predicates::Bounded;
using predicates::DoublePoint;
using predicates::kDoubleWaveError;
using predicates::kUnit;

DoublePoint minus(const DoublePoint& a, const DoublePoint& b) { return {a.x - b.x, a.y - b.y}; }
double dot(const DoublePoint& a, const DoublePoint& b) { return a.x * b.x + a.y * b.y; }
double cross(const DoublePoint& a, const DoublePoint& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

VertexFilter::Judgement VertexFilter::judge(const std::array<std::uint32_t, 3>& waves, const std::optional<OnRay>& on_ray,
                                            std::span<const std::uint32_t> rivals) const {
  Judgement result;
  const Found found = on_ray ? locate_on_ray(*on_ray) : locate(waves);
  if (found.exists == Answer::unknown) return result;
  const Judgement rejected{true, false, found.at, 0, 0, 0};
  if (found.exists == Answer::no) return rejected;
  result.at = found.at;
  bool certain = true;
  const auto reject = [&] {
    result.certain = true;
    return result;
  };
  for (std::size_t k = 0; k < 3; ++k, ++result.sides) {
    const Answer inside = inside_side(k, found.at);
    if (inside == Answer::no) return reject();
    certain = certain && inside == Answer::yes;
  }
  for (const std::uint32_t wave : waves) {
    for (std::size_t end = 0; contenders_[wave].has_cone && end < 2; ++end, ++result.rays) {
      if (on_ray && wave == on_ray->parent && end == on_ray->end) continue;
      const Answer inside = inside_ray(wave, end, found.at);
      if (inside == Answer::no) return reject();
      certain = certain && inside == Answer::yes;
    }
  }
  for (const std::uint32_t rival : rivals) {
    if (rival == waves[0] || rival == waves[1] || rival == waves[2]) continue;
    ++result.rivals;
    const Answer conflicts = nearer(waves, rival, found.at);
    if (conflicts == Answer::yes) return reject();
    certain = certain && conflicts == Answer::no;
  }
  result.certain = result.exists = certain;
  return result;
}

VertexFilter::Answer VertexFilter::inside_side(std::size_t k, const Location& at) const {
  const auto& side = filter_.side(k);
  const Bounded inside = predicates::bounded_cross(side.direction, side.error, minus(at.p, side.origin), (side.error + at.radius) * (1 + 0x1p-48));
  return inside.positive() ? Answer::yes : inside.negative() ? Answer::no : Answer::unknown;
}

VertexFilter::Answer VertexFilter::inside_ray(std::uint32_t wave, std::size_t end, const Location& at) const {
  const Bounded inside = filter_.cone_side(wave, end, at.p, at.radius);
  return inside.positive() ? Answer::yes : inside.negative() ? Answer::no : Answer::unknown;
}

VertexFilter::Answer VertexFilter::sees(std::uint32_t wave, const Location& at) const {
  Answer answer = Answer::yes;
  for (std::size_t end = 0; contenders_[wave].has_cone && end < 2; ++end) {
    const Answer inside = inside_ray(wave, end, at);
    if (inside == Answer::no) return inside;
    if (inside == Answer::unknown) answer = inside;
  }
  return answer;
}

/// Whether a rival sees the point and is nearer there; what ties by identity (BisectorVertices::conflict) is not compared.
VertexFilter::Answer VertexFilter::nearer(const std::array<std::uint32_t, 3>& waves, std::uint32_t rival, const Location& at) const {
  for (const std::uint32_t own : waves)
    if (contenders_.eclipses(own, rival)) return Answer::no;
  for (const std::uint32_t own : waves)
    if (contenders_.eclipses(rival, own)) return sees(rival, at);
  const auto &own = filter_.wave(waves[1]), &other = filter_.wave(rival);
  Bounded lead = predicates::difference(own, distance(own, at.p), other, distance(other, at.p));
  lead.error += 2 * at.radius;
  if (lead.positive()) return Answer::no;
  const Answer seen = sees(rival, at);
  return seen == Answer::no || lead.negative() ? seen : Answer::unknown;
}

/// predicates::bisector_vertex in doubles; the pivot is in the middle.
std::optional<VertexFilter::Guess> VertexFilter::guess(const std::array<std::uint32_t, 3>& waves) const {
  const auto &wi = filter_.wave(waves[0]), &wj = filter_.wave(waves[1]), &wk = filter_.wave(waves[2]);
  const DoublePoint ai = minus(wi.image, wj.image), ak = minus(wk.image, wj.image);
  const bool same_i = contenders_[waves[0]].root == contenders_[waves[1]].root, same_k = contenders_[waves[2]].root == contenders_[waves[1]].root;
  const double si = same_i ? 0 : wi.weight - wj.weight, sk = same_k ? 0 : wk.weight - wj.weight;
  Guess guess;
  if (same_i && same_k) {
    const double turn = cross(ak, ai), ci = dot(ai, ai) / (2 * turn), ck = dot(ak, ak) / (2 * turn);
    if (!(turn > 0)) return std::nullopt;
    guess.p = {wj.image.x + ck * ai.y - ci * ak.y, wj.image.y + ci * ak.x - ck * ai.x};
    return guess;
  }
  const double gap_i = dot(ai, ai) - si * si, gap_k = dot(ak, ak) - sk * sk;
  const DoublePoint aik = minus(ai, ak);
  const double gap_ik = dot(aik, aik) - (si - sk) * (si - sk);
  if (!(gap_i > 0 && gap_k > 0 && gap_ik > 0)) return std::nullopt;
  // n = (a, -s); the line of the two planes has the direction d = n_i x n_k.
  const double dx = si * ak.y - ai.y * sk, dy = -si * ak.x + ai.x * sk, dr = cross(ai, ak);
  const double norm = dx * dx + dy * dy + dr * dr;
  const double ci = 0.5 * gap_i, ck = 0.5 * gap_k;
  // ci (n_k x d) + ck (d x n_i)
  const double x = ci * (ak.y * dr + sk * dy) + ck * (dy * -si - dr * ai.y);
  const double y = ci * (-sk * dx - ak.x * dr) + ck * (dr * ai.x + dx * si);
  const double r = ci * (ak.x * dy - ak.y * dx) + ck * (dx * ai.y - dy * ai.x);
  const double root = norm * 0.5 * std::sqrt(gap_i * gap_k * gap_ik);
  const double b = x * dx + y * dy - r * dr, a = dx * dx + dy * dy - dr * dr, c = x * x + y * y - r * r;
  const double t = b > 0 ? -c / (b + root) : (root - b) / a;
  const double rho = (r + t * dr) / norm;
  guess.p = {wj.image.x + (x + t * dx) / norm, wj.image.y + (y + t * dy) / norm};
  // As those of rho, so those of rho - si and of rho - sk: were two different, their waves' images would be as near as their weights, by the triangle inequality.
  guess.sign = rho > 0 ? 1 : -1;
  return guess;
}

/// Whether one of the three is nearer than another one everywhere; or all start at one root, and the vertex has the other turn.
bool VertexFilter::certainly_none(const std::array<std::uint32_t, 3>& waves) const {
  bool one_root = true;
  for (std::size_t n = 0; n < 3; ++n) {
    const std::uint32_t a = waves[n], b = waves[(n + 1) % 3];
    if (contenders_[a].root == contenders_[b].root) continue;
    one_root = false;
    if (predicates::certainly_nearer(filter_.wave(a), filter_.wave(b)) || predicates::certainly_nearer(filter_.wave(b), filter_.wave(a))) return true;
  }
  if (!one_root) return false;
  const auto &wi = filter_.wave(waves[0]), &wj = filter_.wave(waves[1]), &wk = filter_.wave(waves[2]);
  return predicates::bounded_cross(minus(wk.image, wj.image), wk.error + wj.error, minus(wi.image, wj.image), wi.error + wj.error).negative();
}

/// One step of Newton's iteration for the two differences of signed distances, with the proof that it converges and how far it may be off.
/// A solution whose sign goes with the turn of the three directions is the vertex asked for; if the sign is negative, there is none.
VertexFilter::Found VertexFilter::locate(const std::array<std::uint32_t, 3>& waves) const {
  const auto start = guess(waves);
  if (!start && certainly_none(waves)) return {Answer::no, {}};
  if (!start) return {};
  std::array<DoublePoint, 3> u;
  std::array<double, 3> value;
  double curvature = 0, turn_error = 32 * kUnit, error = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const auto& wave = filter_.wave(waves[n]);
    const DoublePoint away = minus(start->p, wave.image);
    const double r = std::sqrt(dot(away, away)), share = n == 1 ? 2 : 1;
    u[n] = {start->sign * away.x / r, start->sign * away.y / r};
    value[n] = wave.weight + start->sign * r;
    curvature += 2 * share / r;
    turn_error += 4 * share * wave.error / r;
    error += share * (wave.error + kDoubleWaveError * (std::fabs(wave.weight) + r));
    if (!(4 * wave.error < r)) return {};
  }
  const DoublePoint ji = minus(u[0], u[1]), jk = minus(u[2], u[1]);
  const double fi = value[0] - value[1], fk = value[2] - value[1];
  const double size = std::sqrt(dot(ji, ji) + dot(jk, jk)), det = cross(ji, jk);
  if (!(-det * start->sign > 16 * (2 * size * turn_error + turn_error * turn_error + 8 * kUnit * size * size))) return {};
  const double inverse = 1.25 * (size + turn_error) / std::fabs(det);
  const DoublePoint step{(fk * ji.y - fi * jk.y) / det, (fi * jk.x - fk * ji.x) / det};
  const double moved = std::sqrt(dot(step, step));
  const double eta = 1.25 * (moved + inverse * error), h = inverse * curvature * eta;
  if (!(h < 0.25)) return {};
  Found found;
  found.at.p = {start->p.x + step.x, start->p.y + step.y};
  found.at.radius = 2 * h * eta + 1.25 * inverse * error + 0.125 * moved + 4 * kUnit * (std::fabs(found.at.p.x) + std::fabs(found.at.p.y));
  found.exists = start->sign > 0 ? Answer::yes : Answer::no;
  return found;
}

/// Beyond the relay on its parent's boundary ray, d_other - d_relay can only fall: two signs enclose its zero, one tells that there is none in reach.
VertexFilter::Found VertexFilter::locate_on_ray(const OnRay& on) const {
  const auto ray = filter_.cones().ray(on.parent, on.end);
  const auto &relay = filter_.wave(on.relay), &other = filter_.wave(on.other);
  const DoublePoint along = minus(relay.image, ray.from);
  const double length = std::sqrt(dot(along, along));
  const double turn = 2 * (relay.error + ray.from_error) / length + 8 * kUnit;  // error of the ray's direction
  const auto at = [&](double reach) { return DoublePoint{relay.image.x + reach / length * along.x, relay.image.y + reach / length * along.y}; };
  const auto off = [&](double reach) { return relay.error + reach * turn + 8 * kUnit * (std::fabs(relay.image.x) + std::fabs(relay.image.y)); };
  const auto lead = [&](double reach) {
    Bounded by = predicates::difference(relay, relay.weight + reach, other, distance(other, at(reach)));
    by.error += 2 * off(reach);
    return by;
  };
  Found found;
  const Bounded first = lead(0);
  if (first.negative()) found.exists = Answer::no;
  if (!first.positive()) return found;
  double far = 0;
  for (std::size_t c = 0; c < 3; ++c) far = std::max(far, distance({relay.image, 0, 0}, filter_.side(c).origin));
  if (lead(far * (1 + 0x1p-20) + 2 * (off(far) + filter_.side(2).error)).positive()) {
    found.exists = Answer::no;  // in the facet there is none
    return found;
  }
  const DoublePoint a = minus(other.image, relay.image);
  const double s = other.weight - relay.weight, slope = dot(along, a) - s * length;
  const double reach = 0.5 * (dot(a, a) - s * s) / slope * length;
  const DoublePoint p = at(reach), away = minus(p, other.image);
  const double fall = 1 - dot(along, away) / (length * std::sqrt(dot(away, away)));
  const double margin = 2 * (std::fabs(lead(reach).value) + lead(reach).error) / fall;
  if (!(margin < reach) || !lead(reach - margin).positive() || !lead(reach + margin).negative()) return found;
  found.exists = Answer::yes;
  found.at = {p, (margin + off(reach + margin)) * (1 + 0x1p-40)};
  return found;
}

}  // namespace gvd::kernel
