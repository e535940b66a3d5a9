// How the waves that wait on a half-edge cross the face above it.
#include <algorithm>
#include <bit>
#include <cmath>

#include "gvd/predicates/filter_error.hpp"
#include "gvd/predicates/landing.hpp"
#include "propagation.hpp"

namespace gvd::kernel {

using predicates::kDistanceError;
using predicates::kFrameError;
using predicates::kOrientationError;
using predicates::kStepError;
using predicates::Landing;
using predicates::rounded_up;

namespace {

using Image = predicates::Complex<double>;
using Frame = predicates::EdgeFrame<double>;

double norm1(double x, double y) { return std::fabs(x) + std::fabs(y); }

template <bool kLeft>
Image cross(const Image& z, const Frame& side) {
  return kLeft ? predicates::cross_left(z, side) : predicates::cross_right(z, side);
}

/// The begin or the end of a child's interval. `cone`: the vertex that bounds the child's cone there, unless that is the end of the side itself.
template <bool kLeft, bool kBegin>
void project_end(const WindowInterval& wave, const Frame& side, const Image& cone, double disc, WindowInterval& child) {
  const bool at_vertex = kBegin ? child.cone0_at_origin : child.cone1_at_target, was_trimmed = kBegin ? wave.begin_trimmed : wave.end_trimmed;
  // Of the ray through a point of the parent's side; no point of the line beyond it is seen.
  const auto landing_of = [&](double x) {
    return x >= 0 && x <= 1 ? predicates::land(child.image, cross<kLeft>({x, 0}, side), disc) : predicates::kNoLanding;
  };
  double at = kBegin ? 0 : 1;
  float slack = 0;
  bool trimmed = false;
  if (was_trimmed) {
    const double from = kBegin ? wave.begin : wave.end, to_seen = kBegin ? wave.begin_slack : -wave.end_slack;
    const Landing l = landing_of(from);
    const double outer = kBegin ? l.at - l.margin : l.at + l.margin;
    trimmed = kBegin ? outer > 0 : outer < 1;
    if (trimmed) at = outer;
    if (trimmed || !at_vertex) {
      const Landing seen = to_seen == 0 ? l : landing_of(from + to_seen);
      slack = rounded_up(std::max(0.0, kBegin ? seen.at + seen.margin - at : at - seen.at + seen.margin));
    }
  } else if (!at_vertex) {
    const Landing l = predicates::land(child.image, cone, disc);
    at = kBegin ? std::max(0.0, l.at - l.margin) : std::min(1.0, l.at + l.margin);
    slack = rounded_up(2 * l.margin);
  }
  (kBegin ? child.begin : child.end) = at;
  (kBegin ? child.begin_slack : child.end_slack) = slack;
  (kBegin ? child.begin_trimmed : child.end_trimmed) = trimmed;
}

}  // namespace

/// One of the two sides over which waves leave a face, set up once for all of them.
struct Propagation::Exit {
  HalfedgeId target, edge;  // the edge: by the lower one of its half-edges
  Frame side;
  double inverse_length;
  double origin_upper, target_upper, third_upper;  // certain upper bounds of D at the ends of the side and at the third vertex of the face
  std::uint32_t turn_limit;
  WindowId first_window;
  List children;
};

Propagation::Exit Propagation::exit_over(HalfedgeId side, VertexId third, bool left) const {
  Exit exit{mesh_.twin(side), std::min(side, mesh_.twin(side)), frames_[side], 0, 0, 0, 0, 0, kNone, {}};
  if (exit.target == kNone) return exit;
  const VertexId origin = mesh_.target(side), target = mesh_.origin(side);
  exit.inverse_length = 1 / exit.side.length;
  exit.origin_upper = upper_[origin];
  exit.target_upper = upper_[target];
  exit.third_upper = upper_[third];
  exit.turn_limit = degree_[left ? origin : target];
  exit.first_window = field_.first_window[exit.target];
  return exit;
}

void Propagation::cross_face(HalfedgeId h) {
  trim_list(h);
  if (kept_ == 0) return;
  for (std::size_t k = 0; k < kept_; ++k) crossings_[k] = see_apex(list_[k], h);  // may add waves
  make_room(2 * kept_);
  Exit left = exit_over(Mesh::prev(h), mesh_.target(h), true), right = exit_over(Mesh::next(h), mesh_.origin(h), false);
  const ApexSight& best = sights_[h];
  const double length = frames_[h].length;
  for (std::size_t k = 0; k < kept_; ++k) {
    const Wave& wave = waves_[list_[k]];
    const Sight sight = crossings_[k].sight;
    const bool longer = crossings_[k].apex_distance * (1 - kDistanceError) - (wave.image_error + wave.weight_error) > best.upper;
    const double reach = (norm1(wave.image.x, wave.image.y) + 1) * length;
    if (left.target != kNone && sight != Sight::beyond_0 && sight != Sight::on_ray_0) {
      if (longer && wave.begin >= best.high) {
        ++filtered_prunings_;
      } else {
        make_child<true>(wave, sight == Sight::inside || sight == Sight::on_ray_1, reach, left);
      }
    }
    if (right.target != kNone && sight != Sight::beyond_1 && sight != Sight::on_ray_1) {
      if (longer && wave.end <= best.low) {
        ++filtered_prunings_;
      } else {
        make_child<false>(wave, sight == Sight::inside || sight == Sight::on_ray_0, reach, right);
      }
    }
  }
  for (std::size_t k = 0; k < kept_; ++k) recycle(list_[k]);
  splice(left);
  splice(right);
}

/// Hands the children on; they go on at once if their side has a settled end.
void Propagation::splice(const Exit& exit) {
  if (exit.target == kNone) return;
  if (exit.children.first != kNone) {
    field_.first_window[exit.target] = exit.first_window;
    List& list = waiting_[exit.target];
    if (list.first == kNone) {
      list.first = exit.children.first;
    } else {
      waves_[list.last].next = exit.children.first;
    }
    list.last = exit.children.last;
    list.size += exit.children.size;
  }
  if (settled_[mesh_.origin(exit.target)] != 0 || settled_[mesh_.target(exit.target)] != 0) push(exit.target);
}

/// Takes the waiting waves, in the order of their intervals, and trims neighbours; leaves the first kept_ of list_.
void Propagation::trim_list(HalfedgeId h) {
  List& waiting = waiting_[h];
  if (list_.size() < waiting.size) {
    list_.resize(2 * waiting.size);
    crossings_.resize(2 * waiting.size);
  }
  std::size_t size = 0;
  for (std::uint32_t w = waiting.first, next; w != kNone; w = next) {
    const Wave& wave = waves_[w];
    next = wave.next;
    if (field_.restarted && wave.weight != emitted_weight_[wave.root]) {
      recycle(w);
      continue;
    }
    std::size_t k = size++;  // nearly sorted
    for (; k > 0 && waves_[list_[k - 1]].begin > wave.begin; --k) list_[k] = list_[k - 1];
    list_[k] = w;
  }
  waiting.first = waiting.last = kNone;
  waiting.size = 0;
  const double length = frames_[h].length;
  const auto drop = [&](std::uint32_t w) {
    field_.windows[waves_[w].window].packed |= WindowRecord::kDominated;
    recycle(w);
  };
  kept_ = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t w = list_[i];
    Trim result = Trim::none;
    while (kept_ > 0 && waves_[w].begin < waves_[list_[kept_ - 1]].end) {
      result = trim(waves_[list_[kept_ - 1]], waves_[w], length);
      if (result != Trim::drop_first) break;
      drop(list_[--kept_]);
    }
    if (result == Trim::drop_second) {
      drop(w);
    } else {
      list_[kept_++] = w;
    }
  }
  field_.windows_propagated += kept_;
}

/// Where the apex lies for a wave, and how far; tells the apex if it is seen.
Propagation::Crossing Propagation::see_apex(std::uint32_t w, HalfedgeId h) {
  const Wave& wave = waves_[w];
  const Frame& frame = frames_[h];
  const double dx = wave.image.x - frame.u, dy = wave.image.y - frame.y;
  const double distance = wave.weight + frame.length * std::sqrt(dx * dx + dy * dy);
  const double disc = wave.image_error / frame.length + kFrameError * norm1(frame.u, frame.y);
  const Sight where = locate_apex(wave, h, frame, disc);
  if (where == Sight::beyond_0 || where == Sight::beyond_1) return {where, distance};
  const double error = (wave.image_error + wave.weight_error) + kDistanceError * distance;
  ApexSight& best = sights_[h];
  if (distance + error < best.upper && dy < 0) {
    const double t = wave.image.y / dy;  // image -> apex crosses the side at this fraction: dy < 0
    const double x = wave.image.x - dx * t;
    const double slack = 4 * disc * (1 + norm1(dx, dy) / -dy);
    best = {distance + error, x - slack, x + slack};
  }
  const VertexId apex = mesh_.apex(h);
  // No shortest path comes back to where it began. May add waves: last use of `wave`.
  if (apex != wave.root) relax(apex, {wave.window, wave.root, kNone, distance, error, wave.image});
  return {where, distance};
}

Propagation::Sight Propagation::locate_apex(const Wave& wave, HalfedgeId h, const Frame& frame, double disc) {
  const double wx = frame.u - wave.image.x, wy = frame.y - wave.image.y;
  const double x0 = wave.cone0.x - wave.image.x, y0 = wave.cone0.y - wave.image.y;
  const double x1 = wave.cone1.x - wave.image.x, y1 = wave.cone1.y - wave.image.y;
  const double side0 = x0 * wy - y0 * wx, side1 = x1 * wy - y1 * wx;
  const double size = norm1(wx, wy) + 2 * disc, size0 = norm1(x0, y0) + 2 * disc, size1 = norm1(x1, y1) + 2 * disc;
  const double part = 2.125 * disc, share = part + kOrientationError * size, whole = part * size;
  const double bound0 = whole + share * size0, bound1 = whole + share * size1;
  ++filtered_orientations_;
  if (side0 > bound0) return Sight::beyond_0;
  if (side1 < -bound1) return Sight::beyond_1;
  if (side0 < -bound0 && side1 > bound1) return Sight::inside;
  --filtered_orientations_;
  return decide_apex(wave, h);
}

/// A child is made in a free wave, and kept there unless it is certainly nowhere shortest.
template <bool kLeft>
void Propagation::make_child(const Wave& wave, bool at_apex, double parent_reach, Exit& exit) {
  const Frame& side = exit.side;
  // A shortest path crosses no edge twice: a window that has come once round a vertex, or once more over its mark, is done.
  const std::uint32_t turns = (kLeft ? wave.begin_turns : wave.end_turns) + 1u, steps = wave.steps + 1;
  if (turns >= exit.turn_limit || exit.edge == wave.mark) return;
  Wave& child = waves_[free_wave_];
  child.image = cross<kLeft>(wave.image, side);
  const double image_error = wave.image_error + kStepError * (parent_reach + (norm1(child.image.x, child.image.y) + 1) * side.length);
  const double disc = image_error * exit.inverse_length;
  child.cone0_at_origin = kLeft ? wave.cone0_at_origin : at_apex;
  child.cone1_at_target = kLeft ? at_apex : wave.cone1_at_target;
  child.cone0 = child.cone0_at_origin ? Image{0, 0} : cross<kLeft>(wave.cone0, side);
  child.cone1 = child.cone1_at_target ? Image{1, 0} : cross<kLeft>(wave.cone1, side);
  project_end<kLeft, true>(wave, side, child.cone0, disc, child);
  project_end<kLeft, false>(wave, side, child.cone1, disc, child);
  const double error = image_error + wave.weight_error;
  if (child.begin > child.end || is_certainly_longer<kLeft>(child, wave.weight, error, exit)) {
    ++filtered_prunings_;
    return;
  }
  child.begin_turns = kLeft ? static_cast<std::uint16_t>(turns) : std::uint16_t{0};
  child.end_turns = kLeft ? std::uint16_t{0} : static_cast<std::uint16_t>(turns);
  child.steps = steps;
  child.mark = std::has_single_bit(steps) ? exit.edge : wave.mark;
  child.weight = wave.weight;
  child.weight_error = wave.weight_error;
  child.image_error = rounded_up(image_error);
  child.root = wave.root;
  child.window = static_cast<WindowId>(field_.windows.size());
  field_.windows.push_back({wave.window, exit.target | (at_apex ? WindowRecord::kApexInCone : 0u), wave.root, exit.first_window});
  exit.first_window = child.window;
  const std::uint32_t w = free_wave_;
  free_wave_ = child.next;
  --free_waves_;
  child.next = kNone;
  if (exit.children.first == kNone) {
    exit.children.first = w;
  } else {
    waves_[exit.children.last].next = w;
  }
  exit.children.last = w;
  ++exit.children.size;
}

/// Xin and Wang's filter: whether every point of the child is certainly nearer to some vertex of the face.
template <bool kLeft>
bool Propagation::is_certainly_longer(const Wave& child, double weight, double error, const Exit& exit) {
  const Frame& side = exit.side;
  const double y2 = child.image.y * child.image.y;
  const double to_begin = child.image.x - child.begin, to_end = child.image.x - child.end;
  const double begin_low = (weight + side.length * std::sqrt(to_begin * to_begin + y2)) * (1 - kDistanceError) - error;
  const double end_low = (weight + side.length * std::sqrt(to_end * to_end + y2)) * (1 - kDistanceError) - error;
  if (exit.origin_upper + child.end * side.length < end_low || exit.target_upper + (1 - child.begin) * side.length < begin_low) return true;
  const double nearest = kLeft ? begin_low : end_low;
  if (!(exit.third_upper < nearest)) return false;
  const double third_x = side.v - (kLeft ? child.begin : child.end);
  const double from_third = exit.third_upper + side.length * std::sqrt(third_x * third_x + side.y * side.y);
  return from_third * (1 + kDistanceError) < nearest;
}

}  // namespace gvd::kernel
