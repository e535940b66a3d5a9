#include "shadow.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "gvd/kernel/error.hpp"
#include "gvd/predicates/filter_error.hpp"

namespace gvd::kernel {

using Image = predicates::Complex<double>;
using Frame = predicates::EdgeFrame<double>;

namespace {

double norm1(double x, double y) { return std::fabs(x) + std::fabs(y); }
Image normalised(Image z) {
  const double size = norm1(z.x, z.y);
  return {z.x / size, z.y / size};
}

/// Turns by less than half a turn a step; says when half a turn may be full.
class HalfTurn {
 public:
  /// `error`: of the start, relative to its size.
  HalfTurn(Image start, double error) : at_(normalised(start)), error_(predicates::kTurnError + error) {}
  /// Multiplies by the corner's direction; true if the sum of the angles may have reached pi.
  bool reached_by(double x, double y) {
    const Image p{at_.x * x - at_.y * y, at_.x * y + at_.y * x};
    error_ += predicates::kTurnError;
    at_ = normalised(p);
    return !(at_.y > error_);  // also if nothing is known
  }
  const Image& at() const { return at_; }
  double error() const { return error_; }

 private:
  Image at_;
  double error_;
};

}  // namespace

void shadow_of(const Mesh& mesh, const std::vector<Frame>& frames, VertexId v, HalfedgeId over, const Candidate& arrival,
               Shadow& shadow) {
  std::vector<HalfedgeId>& faces = shadow.faces;
  faces.clear();
  shadow.first = shadow.last = {};
  // The fan, counter-clockwise: face i of the fan lies between outgoing[i] and the next one.
  std::vector<HalfedgeId>& fan = shadow.fan;
  fan.clear();
  mesh.for_each_outgoing(v, [&](HalfedgeId h) { fan.push_back(h); });
  const std::size_t n = fan.size();
  const bool closed = !mesh.is_boundary(v);
  std::size_t ccw_face, cw_steps_from;  // first whole face counter-clockwise; number of faces before which we go clockwise
  Image ccw_start, cw_start;            // the angle already turned at the arrival's face
  double start_error = 0;
  if (over != kNone) {
    const std::size_t k = static_cast<std::size_t>(std::find(fan.begin(), fan.end(), Mesh::prev(over)) - fan.begin());
    const Frame& f = frames[over];
    const Image back{arrival.image.x - f.u, arrival.image.y - f.y};
    const Image to_a{-f.u, -f.y}, to_b{f.v, -f.y};
    ccw_start = {to_b.x * back.x + to_b.y * back.y, to_b.y * back.x - to_b.x * back.y};
    cw_start = {back.x * to_a.x + back.y * to_a.y, back.y * to_a.x - back.x * to_a.y};
    start_error = 1.5 * arrival.error / (f.length * norm1(back.x, back.y));
    ccw_face = k + 1;
    cw_steps_from = k;
  } else {
    std::size_t k = 0;
    while (k < n && mesh.target(fan[k]) != arrival.via) ++k;
    ccw_start = cw_start = {1, 0};
    ccw_face = k;  // k == n: along the last edge of a boundary fan
    cw_steps_from = k;
  }
  const auto require_less_than_all = [&](std::size_t steps) {  // a relay: there is more than half a turn on either side
    if (steps > n) throw InternalError("half a turn about vertex " + std::to_string(v) + " goes all the way round it");
  };
  // Counter-clockwise: the first face in which half a turn may be full.
  HalfTurn ccw(ccw_start, start_error), cw(cw_start, start_error);
  std::optional<std::size_t> first, last;
  for (std::size_t step = 0; closed || ccw_face + step < n; ++step) {
    require_less_than_all(step + 1);
    const std::size_t i = ccw_face + step;
    const Frame& f = frames[fan[i % n]];
    const HalfTurn before = ccw;
    if (ccw.reached_by(f.u, f.y)) {
      first = i;
      shadow.first = {fan[i % n], {-before.at().x, before.at().y}, before.error()};
      break;
    }
  }
  for (std::size_t step = 1; closed || step <= cw_steps_from; ++step) {
    require_less_than_all(step);
    const std::size_t i = (cw_steps_from + n - step) % n;
    const Frame& f = frames[fan[i]];
    const Image p = cw.at();
    const double error = cw.error();
    if (cw.reached_by(f.u, f.y)) {
      last = i;  // from the face's other side back by what is left of half a turn
      shadow.last = {fan[i], normalised({p.y * f.y - p.x * f.u, -p.x * f.y - p.y * f.u}), error + predicates::kTurnError};
      break;
    }
  }
  if (closed) {
    for (std::size_t i = *first % n;; i = (i + 1) % n) {
      faces.push_back(fan[i]);
      if (i == *last) break;
    }
  } else {
    for (std::size_t i = first.value_or(n); i < n; ++i) faces.push_back(fan[i]);
    if (last)
      for (std::size_t i = 0; i <= *last; ++i) faces.push_back(fan[i]);
  }
}

}  // namespace gvd::kernel
