// How the waves that wait on a half-edge cross the face above it. What is used here only is inline: position-independent code would call it else.
#include <algorithm>
#include <bit>
#include <cmath>

#include "gvd/predicates/filter_error.hpp"
#include "gvd/predicates/landing.hpp"
#include "gvd/predicates/longer.hpp"
#include "gvd/robust/double_pair.hpp"
#include "propagation.hpp"

namespace gvd::kernel {

using predicates::kDistanceError;
using predicates::kFrameError;
using predicates::kOrientationError;
using predicates::kStepError;
using robust::choose;
using robust::DoublePair;
using robust::PairMask;

namespace {

using Image = predicates::Complex<double>;
using Frame = predicates::EdgeFrame<double>;

double norm1(double x, double y) { return std::fabs(x) + std::fabs(y); }

template <bool kLeft>
Image cross(const Image& z, const Frame& side) {
  return kLeft ? predicates::cross_left(z, side) : predicates::cross_right(z, side);
}

/// Both at once, for the cone's vertices and for two points of the edge.
template <bool kLeft>
[[gnu::always_inline]] inline predicates::Complex<DoublePair> cross(const DoublePair& x, const DoublePair& y, const Frame& side) {
  if constexpr (kLeft) return {x * side.v + y * side.y, y * side.v - x * side.y};
  const DoublePair back = 1 - x;
  return {1 - (back * side.u + y * side.y), y * side.u - back * side.y};
}
template <bool kLeft>
[[gnu::always_inline]] inline predicates::Complex<DoublePair> cross(const DoublePair& x, const Frame& side) {
  if constexpr (kLeft) return {x * side.v, -x * side.y};
  const DoublePair back = x - 1;
  return {1 + back * side.u, back * side.y};
}

/// A slack that leaves nothing.
constexpr DoublePair kNowhere{8, 8};
/// predicates::rounded_up at the ends that have any, zero at the others.
[[gnu::always_inline]] inline Ends<float> rounded_up(const DoublePair& slack, PairMask has_slack) {
  using Floats = float __attribute__((vector_size(8)));
  const DoublePair rounded = choose(has_slack, slack * (1 + 0x1p-20) + 0x1p-120, DoublePair{0, 0});
  return std::bit_cast<Ends<float>>(__builtin_convertvector(rounded, Floats));
}

}  // namespace

/// One of the two sides over which waves leave a face, set up once for all of them.
struct Propagation::Exit {
  HalfedgeId target, edge;  // the edge: by the lower one of its half-edges
  Frame side;
  double inverse_length, parent_ratio;  // of the parent's length to the side's
  double step_error;                    // of a crossing, a unit of the image's size
  // For is_certainly_longer: lengths, and upper bounds of D at the third vertex of the face and at the ends of the side, that of the target first.
  double squared_length, length, third_upper;
  DoublePair ends_upper;
  std::uint32_t turn_limit;
  WindowId first_window;
  List children;
};

inline Propagation::Exit Propagation::exit_over(HalfedgeId side, VertexId third, double parent_length, bool left) const {
  Exit exit{mesh_.twin(side), std::min(side, mesh_.twin(side)), frames_[side], 0, 0, 0, 0, 0, 0, {0, 0}, 0, kNone, {}};
  if (exit.target == kNone) return exit;
  const VertexId origin = mesh_.target(side), target = mesh_.origin(side);
  exit.inverse_length = 1 / exit.side.length;
  exit.parent_ratio = parent_length * exit.inverse_length;
  exit.step_error = 2 * kStepError * exit.side.length;
  exit.squared_length = predicates::diminished(exit.side.length * exit.side.length);
  exit.length = predicates::enlarged(exit.side.length);
  exit.third_upper = predicates::enlarged(upper_[third]);
  exit.ends_upper = DoublePair{predicates::enlarged(upper_[target]), predicates::enlarged(upper_[origin])};
  exit.turn_limit = degree_[left ? origin : target];
  exit.first_window = field_.first_window[exit.target];
  return exit;
}

/// The apex of the face, for all waves that come to it.
struct Propagation::Apex {
  const Frame& frame;
  double inverse_length, size, disc;  // disc: of the apex
};

#if defined(__x86_64__) && defined(__GNUC__)
/// The same numbers in fewer instructions, for processors that have them: tests/kernel/instructions_test.cpp compares the two bit for bit.
__attribute__((target("avx2"), flatten)) void Propagation::cross_face_by_avx(HalfedgeId h) { cross_face_here(h); }
#else
void Propagation::cross_face_by_avx(HalfedgeId h) { cross_face_here(h); }
#endif

void Propagation::cross_face(HalfedgeId h) { return by_avx_ ? cross_face_by_avx(h) : cross_face_here(h); }

inline void Propagation::cross_face_here(HalfedgeId h) {
  trim_list(h);
  if (kept_ == 0) return;
  const Frame& frame = frames_[h];
  const double size = norm1(frame.u, frame.y);
  const Apex apex{frame, 1 / frame.length, size, kFrameError * size};
  for (std::size_t k = 0; k < kept_; ++k) {
    prefetch_ahead();
    sights_of_list_[k] = see_apex(list_[k].wave, h, apex);  // may add waves
  }
  make_room(2 * kept_);
  Exit left = exit_over(Mesh::prev(h), mesh_.target(h), frame.length, true), right = exit_over(Mesh::next(h), mesh_.origin(h), frame.length, false);
  const ApexSight best = sides_[h].sight;
  for (std::size_t k = 0; k < kept_; ++k) {
    prefetch_ahead();
    const Wave& wave = waves_[list_[k].wave];
    const Sight sight = sights_of_list_[k];
    if (left.target != kNone && sight != Sight::beyond_0 && sight != Sight::on_ray_0) {
      if (wave.begin >= best.high && is_longer_to_apex(wave, frame, best)) {
        ++filtered_prunings_;
      } else {
        make_child<true>(wave, sight == Sight::inside || sight == Sight::on_ray_1, left);
      }
    }
    if (right.target != kNone && sight != Sight::beyond_1 && sight != Sight::on_ray_1) {
      if (wave.end <= best.low && is_longer_to_apex(wave, frame, best)) {
        ++filtered_prunings_;
      } else {
        make_child<false>(wave, sight == Sight::inside || sight == Sight::on_ray_0, right);
      }
    }
  }
  for (std::size_t k = 0; k < kept_; ++k) recycle(list_[k].wave);
  splice(left);
  splice(right);
}

/// The next wave of the list that is crossed next: a wave is where the one before it says, so each has to be fetched before it tells of the next.
inline void Propagation::prefetch_ahead() {
  if (ahead_ == kNone) return;
  ahead_ = waves_[ahead_].next;
  if (ahead_ == kNone) return;
  __builtin_prefetch(&waves_[ahead_]);
  __builtin_prefetch(&waves_[ahead_].next);
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
inline Propagation::Sight Propagation::see_apex(std::uint32_t w, HalfedgeId h, const Apex& at) {
  const Wave& wave = waves_[w];
  const Frame& frame = at.frame;
  const double disc = wave.image_error * at.inverse_length + at.disc;
  const Sight where = locate_apex(wave, h, at, disc);
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

inline Propagation::Sight Propagation::locate_apex(const Wave& wave, HalfedgeId h, const Apex& apex, double disc) {
  const double wx = apex.frame.u - wave.image.x, wy = apex.frame.y - wave.image.y;
  const DoublePair sides = (wave.cone_x - wave.image.x) * wy - (wave.cone_y - wave.image.y) * wx;
  // A cone's vertex is no farther from the image than an end of the edge.
  const double to_cone = norm1(wave.image.x, wave.image.y) + 1 + 8 * disc, to_apex = to_cone + apex.size;
  const double bound = 2.125 * disc * (to_cone + to_apex) + kOrientationError * to_cone * to_apex;
  const DoublePair outwards = sides * DoublePair{1, -1};
  const unsigned beyond = robust::bits(outwards > bound), within = robust::bits(outwards < -bound);
  ++filtered_orientations_;
  if (beyond != 0) return (beyond & kAtBegin) != 0 ? Sight::beyond_0 : Sight::beyond_1;
  if (within == (kAtBegin | kAtEnd)) return Sight::inside;
  --filtered_orientations_;
  return decide_apex(wave, h);
}

/// A child is made unless it is certainly nowhere shortest.
template <bool kLeft>
void Propagation::make_child(const Wave& wave, bool at_apex, Exit& exit) {
  const Frame& side = exit.side;
  // A shortest path crosses no edge twice: a window that has come once round a vertex, or once more over its mark, is done.
  const std::uint32_t turns = (kLeft ? wave.begin_turns : wave.end_turns) + 1, steps = wave.steps + 1;
  if (turns >= exit.turn_limit || exit.edge == wave.mark) return;
  const Image image = cross<kLeft>(wave.image, side);
  const double image_error = wave.image_error + exit.step_error * (norm1(image.x, image.y) + 1);
  const double disc = image_error * exit.inverse_length;
  constexpr unsigned kOld = kLeft ? kAtBegin : kAtEnd, kNew = kLeft ? kAtEnd : kAtBegin;
  const unsigned bounded = (wave.bounded & kOld) | (at_apex ? kNew : 0u);
  const PairMask at_corner = robust::mask_of(bounded), is_trimmed = robust::mask_of(wave.trimmed);
  const auto moved = cross<kLeft>(wave.cone_x, wave.cone_y, side), cut = cross<kLeft>(DoublePair{wave.begin, wave.end}, side);
  const DoublePair cone_x = choose(at_corner, DoublePair{0, 1}, moved.x), cone_y = choose(at_corner, DoublePair{0, 0}, moved.y);
  // The ends: by the rays that cut the wave off, else by those that bound its cone.
  const predicates::Complex<DoublePair> through{choose(is_trimmed, cut.x, cone_x), choose(is_trimmed, cut.y, cone_y)};
  const DoublePair slack = choose(is_trimmed, DoublePair{wave.slack.begin, wave.slack.end}, DoublePair{0, 0});
  const auto landing = predicates::land(image, through, disc, slack, kLeft ? Image{side.v, -side.y} : Image{side.u, side.y}, exit.parent_ratio);
  const DoublePair outer = landing.at + DoublePair{-1, 1} * landing.margin;
  const PairMask is_inner = landing.known & (outer * DoublePair{1, -1} > DoublePair{0, -1}) & (is_trimmed | ~at_corner);
  const DoublePair ends = choose(is_inner, outer, DoublePair{0, 1});
  const double rest = predicates::enlarged(image_error + wave.weight_error) - wave.weight;
  if (ends[0] > ends[1] || is_certainly_longer<kLeft>(image, ends, rest, exit)) {
    ++filtered_prunings_;
    return;
  }
  const std::uint32_t w = free_wave_;
  Wave& child = waves_[w];
  free_wave_ = child.next;
  --free_waves_;
  child.image = image;
  child.begin = ends[0];
  child.end = ends[1];
  child.weight = wave.weight;
  child.image_error = image_error;
  child.weight_error = wave.weight_error;
  const DoublePair reach = choose(landing.known, landing.margin + landing.reach, kNowhere);
  child.slack = rounded_up(reach, (is_inner & is_trimmed) | ~at_corner);
  child.trimmed = static_cast<std::uint8_t>(robust::bits(is_inner & is_trimmed));
  child.bounded = static_cast<std::uint8_t>(bounded);
  child.cone_x = cone_x;
  child.cone_y = cone_y;
  child.begin_turns = kLeft ? turns : 0;
  child.end_turns = kLeft ? 0 : turns;
  child.steps = steps;
  child.mark = (steps & (steps - 1)) == 0 ? exit.edge : wave.mark;
  child.root = wave.root;
  child.window = static_cast<WindowId>(field_.windows.size());
  child.next = kNone;
  field_.windows.push_back({wave.window, exit.target | (at_apex ? WindowRecord::kApexInCone : 0u), wave.root, exit.first_window});
  exit.first_window = child.window;
  if (exit.children.first == kNone) {
    exit.children.first = w;
  } else {
    waves_[exit.children.last].next = w;
  }
  exit.children.last = w;
  ++exit.children.size;
}

/// Xin and Wang's filter: whether every point of a child is certainly nearer to some vertex of the face.
template <bool kLeft>
bool Propagation::is_certainly_longer(const Image& image, const DoublePair& ends, double rest, const Exit& exit) {
  const Frame& side = exit.side;
  const DoublePair to_ends = image.x - ends, squared_reach = to_ends * to_ends + image.y * image.y;
  const DoublePair along = exit.ends_upper + exit.length * (DoublePair{1, 0} + DoublePair{-1, 1} * ends);
  if (robust::any(predicates::is_certainly_longer(squared_reach, exit.squared_length, along, rest))) return true;
  const double nearest = squared_reach[kLeft ? 0 : 1], third_x = side.v - ends[kLeft ? 0 : 1];
  const auto is_longer = [&](double path) { return predicates::is_certainly_longer(nearest, exit.squared_length, path, rest); };
  return is_longer(exit.third_upper + exit.length * std::max(std::fabs(third_x), side.y)) &&
         is_longer((exit.third_upper + exit.length * std::sqrt(third_x * third_x + side.y * side.y)) * (1 + kDistanceError));
}

}  // namespace gvd::kernel
