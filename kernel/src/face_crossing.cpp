// How the waves that wait on a half-edge cross the face above it. What is used here only is inline: position-independent code would call it else.
#include <algorithm>
#include <cmath>

#include "gvd/predicates/filter_error.hpp"
#include "gvd/predicates/landing.hpp"
#include "gvd/predicates/longer.hpp"
#include "propagation.hpp"

namespace gvd::kernel {

using predicates::kDistanceError;
using predicates::kFrameError;
using predicates::kOrientationError;
using predicates::kStepError;
using predicates::rounded_up;
using predicates::StretchedLanding;

namespace {

using Image = predicates::Complex<double>;
using Frame = predicates::EdgeFrame<double>;

double norm1(double x, double y) { return std::fabs(x) + std::fabs(y); }

template <bool kLeft>
Image cross(const Image& z, const Frame& side) {
  return kLeft ? predicates::cross_left(z, side) : predicates::cross_right(z, side);
}

/// The landing of the ray through a point of the parent's frame; `slack`: how far off along the parent's edge a second point may lie.
template <bool kLeft>
[[gnu::always_inline]] inline StretchedLanding land_end(const Image& from, double slack, const Image& image, const Frame& side, double disc, double parent_ratio) {
  const Image along = kLeft ? Image{side.v, -side.y} : Image{side.u, side.y};
  return predicates::land(image, cross<kLeft>(from, side), disc, slack, along, parent_ratio);
}

}  // namespace

/// One of the two sides over which waves leave a face, set up once for all of them.
struct Propagation::Exit {
  HalfedgeId target, edge;  // the edge: by the lower one of its half-edges
  Frame side;
  double squared_length, inverse_length, parent_ratio;  // of the parent's length to the side's
  double origin_upper, target_upper, third_upper;  // certain upper bounds of D at the ends of the side and at the third vertex of the face
  std::uint32_t turn_limit;
  WindowId first_window;
  List children;
};

inline Propagation::Exit Propagation::exit_over(HalfedgeId side, VertexId third, double parent_length, bool left) const {
  Exit exit{mesh_.twin(side), std::min(side, mesh_.twin(side)), frames_[side], 0, 0, 0, 0, 0, 0, 0, kNone, {}};
  if (exit.target == kNone) return exit;
  const VertexId origin = mesh_.target(side), target = mesh_.origin(side);
  exit.squared_length = exit.side.length * exit.side.length;
  exit.inverse_length = 1 / exit.side.length;
  exit.parent_ratio = parent_length * exit.inverse_length;
  exit.origin_upper = upper_[origin];
  exit.target_upper = upper_[target];
  exit.third_upper = upper_[third];
  exit.turn_limit = degree_[left ? origin : target];
  exit.first_window = field_.first_window[exit.target];
  return exit;
}

#if defined(__x86_64__) && !defined(__AVX2__) && defined(__GNUC__)
/// The same numbers in fewer instructions, for processors that have them.
__attribute__((target("avx2"), flatten)) void Propagation::cross_face_by_avx(HalfedgeId h) { cross_face_here(h); }

void Propagation::cross_face(HalfedgeId h) {
  static const bool has_avx = __builtin_cpu_supports("avx2") != 0;
  return has_avx ? cross_face_by_avx(h) : cross_face_here(h);
}
#else
void Propagation::cross_face(HalfedgeId h) { cross_face_here(h); }
#endif

inline void Propagation::cross_face_here(HalfedgeId h) {
  trim_list(h);
  if (kept_ == 0) return;
  const Frame& frame = frames_[h];
  const double inverse_length = 1 / frame.length;
  for (std::size_t k = 0; k < kept_; ++k) sights_of_list_[k] = see_apex(list_[k].wave, h, frame, inverse_length);  // may add waves
  make_room(2 * kept_);
  Exit left = exit_over(Mesh::prev(h), mesh_.target(h), frame.length, true), right = exit_over(Mesh::next(h), mesh_.origin(h), frame.length, false);
  const ApexSight best = sides_[h].sight;
  for (std::size_t k = 0; k < kept_; ++k) {
    const Wave& wave = waves_[list_[k].wave];
    const Sight sight = sights_of_list_[k];
    const double reach = (norm1(wave.image.x, wave.image.y) + 1) * frame.length;
    if (left.target != kNone && sight != Sight::beyond_0 && sight != Sight::on_ray_0) {
      if (wave.begin >= best.high && is_longer_to_apex(wave, frame, best)) {
        ++filtered_prunings_;
      } else {
        make_child<true>(wave, sight == Sight::inside || sight == Sight::on_ray_1, reach, left);
      }
    }
    if (right.target != kNone && sight != Sight::beyond_1 && sight != Sight::on_ray_1) {
      if (wave.end <= best.low && is_longer_to_apex(wave, frame, best)) {
        ++filtered_prunings_;
      } else {
        make_child<false>(wave, sight == Sight::inside || sight == Sight::on_ray_0, reach, right);
      }
    }
  }
  for (std::size_t k = 0; k < kept_; ++k) recycle(list_[k].wave);
  splice(left);
  splice(right);
}

inline double Propagation::apex_distance(const Wave& wave, const Frame& frame) {
  const double dx = wave.image.x - frame.u, dy = wave.image.y - frame.y;
  return wave.weight + frame.length * std::sqrt(dx * dx + dy * dy);
}

/// Whether the apex is certainly farther for the wave than by the best sight of it.
inline bool Propagation::is_longer_to_apex(const Wave& wave, const Frame& frame, const ApexSight& best) {
  return apex_distance(wave, frame) * (1 - kDistanceError) - (wave.image_error + wave.weight_error) > best.upper;
}

/// Hands the children on; they go on at once if their side has a settled end.
inline void Propagation::splice(const Exit& exit) {
  if (exit.target == kNone) return;
  if (exit.children.first != kNone) {
    field_.first_window[exit.target] = exit.first_window;
    List& list = sides_[exit.target].waiting;
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
inline void Propagation::trim_list(HalfedgeId h) {
  const std::size_t size = sort_waiting(h);
  const double length = frames_[h].length;
  Wave* const waves = waves_.data();
  Listed* const list = list_.data();
  const auto drop = [&](std::uint32_t w) {
    field_.windows[waves[w].window].packed |= WindowRecord::kDominated;
    recycle(w);
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t w = list[i].wave;
    Trim result = Trim::none;
    while (kept > 0 && waves[w].begin < waves[list[kept - 1].wave].end) {
      Wave& before = waves[list[kept - 1].wave];
      result = is_only_touched(before, waves[w]) ? Trim::none : trim(before, waves[w], length);
      if (result != Trim::drop_first) break;
      drop(list[--kept].wave);
    }
    if (result == Trim::drop_second) {
      drop(w);
    } else {
      list[kept++].wave = w;
    }
  }
  kept_ = kept;
  field_.windows_propagated += kept;
}

/// Empties the waiting list into list_; returns how many there are.
inline std::size_t Propagation::sort_waiting(HalfedgeId h) {
  List& waiting = sides_[h].waiting;
  if (list_.size() < waiting.size) {
    list_.resize(2 * waiting.size);
    sights_of_list_.resize(2 * waiting.size);
  }
  Wave* const waves = waves_.data();
  Listed* const list = list_.data();
  const bool may_be_stale = field_.restarted;
  std::size_t size = 0;
  for (std::uint32_t w = waiting.first, next; w != kNone; w = next) {
    const Wave& wave = waves[w];
    next = wave.next;
    if (may_be_stale && wave.weight != emitted_weight_[wave.root]) {
      recycle(w);
      continue;
    }
    const double begin = wave.begin;
    std::size_t k = size++;  // nearly sorted
    for (; k > 0 && list[k - 1].begin > begin; --k) list[k] = list[k - 1];
    list[k] = {begin, w};
  }
  waiting.first = waiting.last = kNone;
  waiting.size = 0;
  return size;
}

/// Where the apex lies for a wave; tells the apex if it is seen.
inline Propagation::Sight Propagation::see_apex(std::uint32_t w, HalfedgeId h, const Frame& frame, double inverse_length) {
  const Wave& wave = waves_[w];
  const double disc = wave.image_error * inverse_length + kFrameError * norm1(frame.u, frame.y);
  const Sight where = locate_apex(wave, h, frame, disc);
  if (where == Sight::beyond_0 || where == Sight::beyond_1) return where;
  const double distance = apex_distance(wave, frame);
  const double error = (wave.image_error + wave.weight_error) + kDistanceError * distance;
  const double dx = wave.image.x - frame.u, dy = wave.image.y - frame.y;
  ApexSight& best = sides_[h].sight;
  if (distance + error < best.upper && dy < 0) {
    const double t = wave.image.y / dy;  // image -> apex crosses the side at this fraction: dy < 0
    const double x = wave.image.x - dx * t;
    const double slack = 4 * disc * (1 + norm1(dx, dy) / -dy);
    best = {distance + error, x - slack, x + slack};
  }
  const VertexId apex = mesh_.apex(h);
  // No shortest path comes back to where it began. May add waves: last use of `wave`.
  if (apex != wave.root) relax(apex, {wave.window, wave.root, kNone, distance, error, wave.image});
  return where;
}

inline Propagation::Sight Propagation::locate_apex(const Wave& wave, HalfedgeId h, const Frame& frame, double disc) {
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
  const Image image = cross<kLeft>(wave.image, side);
  const double image_error = wave.image_error + kStepError * (parent_reach + (norm1(image.x, image.y) + 1) * side.length);
  const double disc = image_error * exit.inverse_length;
  Wave& child = waves_[free_wave_];
  child.image = image;
  const bool at_origin = kLeft ? wave.cone0_at_origin : at_apex, at_target = kLeft ? at_apex : wave.cone1_at_target;
  child.cone0_at_origin = at_origin;
  child.cone1_at_target = at_target;
  child.cone0 = at_origin ? Image{0, 0} : cross<kLeft>(wave.cone0, side);
  child.cone1 = at_target ? Image{1, 0} : cross<kLeft>(wave.cone1, side);
  // The ends: by the rays that cut the wave off, else by those that bound its cone.
  child.begin = 0;
  child.begin_slack = 0;
  child.begin_trimmed = false;
  if (wave.begin_trimmed | !at_origin) {
    const Image cut{std::min(wave.begin, 1.0), 0};
    const StretchedLanding l = land_end<kLeft>(*(wave.begin_trimmed ? &cut : &wave.cone0), wave.begin_trimmed ? wave.begin_slack : 0.0F, image, side, disc, exit.parent_ratio);
    const double at = l.at - l.margin;
    child.begin_trimmed = wave.begin_trimmed & (at > 0);
    child.begin = std::max(at, 0.0);
    if (child.begin_trimmed | !at_origin) child.begin_slack = rounded_up(l.margin + l.reach);
  }
  child.end = 1;
  child.end_slack = 0;
  child.end_trimmed = false;
  if (wave.end_trimmed | !at_target) {
    const Image cut{std::max(wave.end, 0.0), 0};
    const StretchedLanding l = land_end<kLeft>(*(wave.end_trimmed ? &cut : &wave.cone1), wave.end_trimmed ? wave.end_slack : 0.0F, image, side, disc, exit.parent_ratio);
    const double at = l.at + l.margin;
    child.end_trimmed = wave.end_trimmed & (at < 1);
    child.end = std::min(at, 1.0);
    if (child.end_trimmed | !at_target) child.end_slack = rounded_up(l.margin + l.reach);
  }
  if (child.begin > child.end || is_certainly_longer<kLeft>(child, wave.weight, image_error + wave.weight_error, exit)) {
    ++filtered_prunings_;
    return;
  }
  child.begin_turns = kLeft ? static_cast<std::uint16_t>(turns) : std::uint16_t{0};
  child.end_turns = kLeft ? std::uint16_t{0} : static_cast<std::uint16_t>(turns);
  child.steps = steps;
  child.mark = (steps & (steps - 1)) == 0 ? exit.edge : wave.mark;
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
  const auto is_longer = [&](double squared_reach, double path) {
    return predicates::is_certainly_longer(weight, exit.squared_length, squared_reach, error, path);
  };
  const double y2 = child.image.y * child.image.y;
  const double to_begin = child.image.x - child.begin, to_end = child.image.x - child.end;
  const double reach_begin = to_begin * to_begin + y2, reach_end = to_end * to_end + y2;
  if (is_longer(reach_end, exit.origin_upper + child.end * side.length) ||
      is_longer(reach_begin, exit.target_upper + (1 - child.begin) * side.length))
    return true;
  const double nearest = kLeft ? reach_begin : reach_end;
  const double third_x = side.v - (kLeft ? child.begin : child.end);
  if (!is_longer(nearest, exit.third_upper + side.length * std::max(std::fabs(third_x), side.y))) return false;
  const double from_third = exit.third_upper + side.length * std::sqrt(third_x * third_x + side.y * side.y);
  return is_longer(nearest, from_third * (1 + kDistanceError));
}

}  // namespace gvd::kernel
