#include "propagation.hpp"

#include <algorithm>
#include <limits>
#include <cmath>
#include <optional>
#include <string>

#include "gvd/kernel/unfolding.hpp"
#include "gvd/predicates/filter_error.hpp"
#include "gvd/predicates/landing.hpp"
#include "gvd/predicates/orientation.hpp"

namespace gvd::kernel {

using predicates::Complex;
using predicates::EdgeFrame;
using predicates::kDistanceError;
using predicates::kFrameError;
using predicates::kOrientationError;
using predicates::kStepError;
using predicates::kUnit;
using predicates::rounded_up;

namespace {

double norm1(double x, double y) { return std::fabs(x) + std::fabs(y); }

bool has_avx() {
#if defined(__x86_64__) && defined(__GNUC__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

}  // namespace

Propagation::Propagation(const Frames& frames, const std::vector<VertexKind>& kinds, DistanceField& field,
                         predicates::Decisions& decisions, Instructions instructions)
    : mesh_(frames.mesh()), all_frames_(frames), frames_(frames.in_double()), kinds_(kinds), field_(field), exact_(frames, field), decisions_(decisions),
      by_avx_(instructions == Instructions::any && has_avx()) {
  const std::size_t n = mesh_.vertex_count(), m = mesh_.halfedge_count();
  const double infinity = std::numeric_limits<double>::infinity();
  field_.first_window.assign(m, kNone);
  field_.first_candidate.assign(n, kNone);
  field_.corner_sees_face.assign(m, 0);
  field_.distance.assign(n, infinity);
  field_.error.assign(n, 0);
  sides_.resize(m);
  upper_.assign(n, infinity);
  settled_.assign(n, 0);
  degree_.assign(n, 0);
  for (HalfedgeId h = 0; h < m; ++h) ++degree_[mesh_.origin(h)];
  emitted_weight_.assign(n, infinity);
  emitted_error_.assign(n, 0);
  emitted_low_.assign(n, infinity);
  emitted_.assign(m, kNone);
  cut_at_shadow_.assign(n, 0);
  sends_again_.assign(n, 0);
  // Some fifteen windows a face with one source, fewer with several: what is not used is never touched.
  field_.windows.reserve(5 * m);
  waves_.reserve(m / 2);
  field_.candidates.reserve(2 * n);
}

bool Propagation::run(std::span<const WaveStart> starts, PropagationPoll poll, void* user) {
  poll_ = poll;
  user_ = user;
  for (const WaveStart& s : starts) relax(s.vertex, {kNone, s.vertex, kNone, s.weight, 0, {0, 0}});
  while (!heap_.empty()) {
    const Entry top = heap_.top();
    heap_.pop();
    if (settled_[top.vertex] != 0 || top.distance != field_.distance[top.vertex]) continue;
    settle(top.vertex);
    ++settled_count_;
    if (!drain()) return false;
  }
  predicates::count(decisions_, predicates::Predicate::window_orientation, robust::Stage::filter);
  decisions_.count(static_cast<std::size_t>(predicates::Predicate::window_orientation), robust::Stage::filter, filtered_orientations_);
  decisions_.count(static_cast<std::size_t>(predicates::Predicate::window_pruning), robust::Stage::filter, filtered_prunings_);
  return true;
}

void Propagation::settle(VertexId v) {
  settled_[v] = 1;
  set_weight(v, 0);
  send_waves(v, field_.candidates[field_.first_candidate[v]].next == kNone);
  relax_neighbours(v);
  push_lists_at(v);
}

/// No path is shorter than the least distance of its root.
double Propagation::least_length(VertexId v, const Candidate& c) const {
  const double low = c.distance - c.error;
  return c.via == v ? low : std::max(low, emitted_low_[c.via]);
}

/// What v's waves carry until it sends them again: its distance is certain to stay in between, by a slack for what may still come, of a share of each
/// candidate's error. The slack goes no lower than the roots' own bounds: so vertices closer than the errors cannot push one another's bounds down for ever.
void Propagation::set_weight(VertexId v, double share) {
  const double d = field_.distance[v];
  double low = emitted_low_[v];
  for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = field_.candidates[c].next) {
    const Candidate& way = field_.candidates[c];
    const double slack = share * way.error + kDistanceError * d;
    low = std::min(low, way.via == v ? way.distance - way.error : std::max(way.distance - way.error - slack, emitted_low_[way.via]));
  }
  emitted_weight_[v] = d;
  emitted_low_[v] = low;
  emitted_error_[v] = std::max(d - low, upper_[v] - d) + kDistanceError * d;
}

/// Of the sources at v, or of the relay for each of its candidates.
void Propagation::send_waves(VertexId v, bool only_path) {
  if (is_source(v)) {
    mesh_.for_each_outgoing(v, [&](HalfedgeId h) { emit(v, h, nullptr); });
  } else if (kinds_[v] == VertexKind::relay) {
    for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = field_.candidates[c].next) emit_shadow(v, field_.candidates[c], only_path);
  }
}

/// Along the edges at v.
void Propagation::relax_neighbours(VertexId v) {
  mesh_.for_each_outgoing(v, [&](HalfedgeId h) {
    relax_over(v, mesh_.target(h), frames_[h].length);
    const HalfedgeId last = Mesh::prev(h);  // the edge to the last neighbour of a boundary fan
    if (mesh_.twin(last) == kNone) relax_over(v, mesh_.origin(last), frames_[last].length);
  });
}

/// Along the edge from v to `to`, unless v is known by this edge only: a shortest path does not come back.
void Propagation::relax_over(VertexId v, VertexId to, double length) {
  if (is_only_from(to, field_.first_candidate[v])) return;
  const double along = emitted_weight_[v] + length;
  relax(to, {kNone, v, kNone, along, emitted_error_[v] + kDistanceError * along, {0, 0}});
}

/// Whether all candidates of this list, from its link `c` on, are the edge from that neighbour.
bool Propagation::is_only_from(VertexId neighbour, std::uint32_t c) const {
  for (; c != kNone; c = field_.candidates[c].next)
    if (field_.candidates[c].window != kNone || field_.candidates[c].via != neighbour) return false;
  return true;
}

/// Whether a wave of its own sources may be the nearest at v.
bool Propagation::is_source(VertexId v) const {
  for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = field_.candidates[c].next)
    if (field_.candidates[c].window == kNone && field_.candidates[c].via == v) return true;
  return false;
}

void Propagation::relax(VertexId v, const Candidate& candidate) {
  if (candidate.distance - candidate.error > upper_[v]) return;
  auto& list = field_.candidates;
  if (candidate.window == kNone) {  // the same path, its root nearer than it was
    for (std::uint32_t* link = &field_.first_candidate[v]; *link != kNone; link = &list[*link].next) {
      const Candidate& old = list[*link];
      if (old.window != kNone || old.via != candidate.via) continue;
      if (old.distance == candidate.distance && old.error == candidate.error) return;  // nothing new; close vertices would tell one another for ever
      *link = old.next;
      break;
    }
  }
  const double up = (candidate.distance + candidate.error) * (1 + 4 * kUnit);
  if (up < upper_[v]) {
    upper_[v] = up;
    std::uint32_t* link = &field_.first_candidate[v];
    while (*link != kNone) {
      const Candidate& old = list[*link];
      if (old.distance - old.error > up) {
        *link = old.next;
      } else {
        link = &list[*link].next;
      }
    }
  }
  list.push_back(candidate);
  list.back().next = field_.first_candidate[v];
  field_.first_candidate[v] = static_cast<std::uint32_t>(list.size() - 1);
  const bool nearer = candidate.distance < field_.distance[v];
  if (nearer) field_.distance[v] = candidate.distance;
  double low = candidate.distance;
  for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = list[c].next) low = std::min(low, least_length(v, list[c]));
  field_.error[v] = std::max(field_.distance[v] - low, upper_[v] - field_.distance[v]);
  if (settled_[v] == 0) {
    if (nearer) heap_.push({candidate.distance, v});
    return;
  }
  improve_settled(v, low, candidate);
}

/// Rare. Its waves are to be sent again if their weight is no longer within its error, or if they were cut off at the shadow of what was the only path.
void Propagation::improve_settled(VertexId v, double low, const Candidate& candidate) {
  if (low < emitted_low_[v] || cut_at_shadow_[v] != 0) {
    if (sends_again_[v] == 0) to_send_again_.push_back(v);
    sends_again_[v] = 1;
    return;
  }
  if (kinds_[v] == VertexKind::relay && !is_source(v)) emit_shadow(v, candidate, false);
  const std::uint32_t others = field_.candidates[field_.first_candidate[v]].next;
  if (others != kNone && is_only_from(field_.candidates[others].via, others)) relax_neighbours(v);  // one of them was left out
}

void Propagation::send_again(VertexId v) {
  sends_again_[v] = cut_at_shadow_[v] = 0;
  field_.restarted = true;
  set_weight(v, 1);
  mesh_.for_each_outgoing(v, [&](HalfedgeId h) {
    if (emitted_[h] != kNone) field_.windows[emitted_[h]].packed |= WindowRecord::kDead;
    emitted_[h] = kNone;
  });
  send_waves(v, false);
  relax_neighbours(v);
}

void Propagation::emit(VertexId v, HalfedgeId outgoing, const Shadow* shadow) {
  field_.corner_sees_face[outgoing] = 1;
  if (emitted_[outgoing] != kNone) return;
  const HalfedgeId opposite = Mesh::next(outgoing);
  const HalfedgeId target = mesh_.twin(opposite);
  if (target == kNone) return;
  const Frame& frame = frames_[opposite];
  make_room(1);
  const std::uint32_t w = free_wave_;
  Wave& wave = waves_[w];
  free_wave_ = wave.next;
  --free_waves_;
  wave = Wave{};
  wave.image = predicates::apex_from_behind(frame);
  wave.cone_x = robust::DoublePair{0, 1};
  wave.end = 1;
  wave.weight = emitted_weight_[v];
  wave.weight_error = rounded_up(emitted_error_[v]);
  wave.image_error = 2 * kStepError * (norm1(wave.image.x, wave.image.y) + 1) * frame.length;
  wave.bounded = kAtBegin | kAtEnd;
  if (shadow != nullptr && cut_at_shadow(*shadow, outgoing, wave)) cut_at_shadow_[v] = 1;
  wave.root = v;
  wave.mark = kNone;
  wave.next = kNone;
  wave.window = emitted_[outgoing] = static_cast<WindowId>(field_.windows.size());
  field_.windows.push_back({kNone, target, v, field_.first_window[target]});
  field_.first_window[target] = wave.window;
  List& list = sides_[target].waiting;
  if (list.first == kNone) {
    list.first = w;
  } else {
    waves_[list.last].next = w;
  }
  list.last = w;
  ++list.size;
  push(target);
}

void Propagation::emit_shadow(VertexId v, const Candidate& arrival, bool only_path) {
  const HalfedgeId over = arrival.window == kNone ? kNone : field_.windows[arrival.window].halfedge();
  shadow_of(mesh_, frames_, v, over, arrival, shadow_);
  for (const HalfedgeId outgoing : shadow_.faces) emit(v, outgoing, only_path ? &shadow_ : nullptr);
}

/// Cuts off what certainly lies outside the shadow. Pre: no other path to the relay may be the shortest.
bool Propagation::cut_at_shadow(const Shadow& shadow, HalfedgeId outgoing, Wave& wave) {
  const Frame& side = frames_[Mesh::next(outgoing)];
  const auto landing = [&](const ShadowRay& ray) {
    const double disc = wave.image_error / side.length + (ray.error + 3 * kStepError) * norm1(side.u, side.y);
    return predicates::land(wave.image, predicates::cross_right(ray.direction, side), disc);
  };
  if (shadow.first.face == outgoing) {
    const predicates::Landing l = landing(shadow.first);
    if (l.at + l.margin < 1) {
      wave.end = std::max(l.at + l.margin, 0.0);
      wave.trimmed |= kAtEnd;
    }
  }
  if (shadow.last.face == outgoing) {
    const predicates::Landing l = landing(shadow.last);
    if (l.at - l.margin > 0) {
      wave.begin = std::min(l.at - l.margin, 1.0);
      wave.trimmed |= kAtBegin;
    }
  }
  return wave.trimmed != 0;
}

void Propagation::push_lists_at(VertexId v) {
  mesh_.for_each_outgoing(v, [&](HalfedgeId h) {
    // The face between h and prev(h): its two sides at v, and the side opposite v, inwards and outwards.
    const HalfedgeId opposite = Mesh::next(h);
    push(h);
    push(Mesh::prev(h));
    push(opposite);
    const HalfedgeId outwards = mesh_.twin(opposite);
    if (outwards != kNone && field_.distance[mesh_.apex(outwards)] < std::numeric_limits<double>::infinity()) push(outwards);
  });
}

void Propagation::push(HalfedgeId h) {
  List& list = sides_[h].waiting;
  if (list.queued || list.first == kNone) return;
  list.queued = true;
  fifo_.push_back(h);
}

/// What crossing the face above h will need first; `prefetch_ahead` fetches the waves that follow.
void Propagation::prefetch(HalfedgeId h) {
  ahead_ = sides_[h].waiting.first;
  __builtin_prefetch(&waves_[ahead_]);
  __builtin_prefetch(&waves_[ahead_].next);
  const Frame* const frame = &frames_[3 * Mesh::face(h)];
  __builtin_prefetch(frame);
  __builtin_prefetch(frame + 2);
}

/// False if the caller wants to stop.
bool Propagation::drain() {
  while (true) {
    for (std::size_t i = 0; i < to_send_again_.size(); ++i) send_again(to_send_again_[i]);  // may add more
    work_ += to_send_again_.size();
    to_send_again_.clear();
    if (fifo_head_ == fifo_.size()) break;
    const HalfedgeId h = fifo_[fifo_head_++];
    ahead_ = kNone;
    if (fifo_head_ < fifo_.size()) prefetch(fifo_[fifo_head_]);
    sides_[h].waiting.queued = false;
    cross_face(h);
    work_ += 1 + kept_;
    if (work_ >= next_poll_ && !may_go_on()) return false;
  }
  fifo_.clear();
  fifo_head_ = 0;
  return true;
}

bool Propagation::may_go_on() {
  next_poll_ = work_ + kWorkBetweenPolls;
  return poll_ == nullptr || poll_(user_, settled_count_, field_.windows.capacity() * sizeof(WindowRecord) + waves_.capacity() * sizeof(Wave));
}

namespace {

/// From the sides of the apex with respect to the two boundary rays.
template <class Sight>
std::optional<Sight> sight_of(robust::MaybeSign side0, robust::MaybeSign side1) {
  using robust::Sign;
  if (side0 == Sign::positive) return Sight::beyond_0;
  if (side1 == Sign::negative) return Sight::beyond_1;
  if (!side0 || !side1) return std::nullopt;
  if (side0 == Sign::zero) return Sight::on_ray_0;
  if (side1 == Sign::zero) return Sight::on_ray_1;
  return Sight::inside;
}

template <class T>
Complex<robust::Ball<T>> as_balls(const predicates::Disc<T>& z) {
  return {predicates::ball_x(z), predicates::ball_y(z)};
}

template <class Sight, class T>
std::optional<Sight> sight_in(const predicates::Unfolding<T>& at, const EdgeFrame<T>& frame, double unit) {
  const double error = predicates::kUnfoldingStep * unit * predicates::rough_size(Complex<T>{frame.u, frame.y});
  const Complex<robust::Ball<T>> apex{{frame.u, error}, {frame.y, error}};
  const auto image = as_balls(at.image);
  return sight_of<Sight>(maybe_sign(predicates::orientation(image, as_balls(at.cone0), apex)),
                         maybe_sign(predicates::orientation(image, as_balls(at.cone1), apex)));
}

}  // namespace

/// The later stages for an apex that the filter could not place.
Propagation::Sight Propagation::decide_apex(const Wave& wave, HalfedgeId h) {
  work_ += kWorkOfLadder;
  const predicates::Strip strip = strip_of(mesh_, field_, wave.window);
  const auto decided = [&](Sight sight, robust::Stage stage) {
    predicates::count(decisions_, predicates::Predicate::window_orientation, stage);
    return sight;
  };
  if (const auto s = sight_in<Sight>(unfold_double_double(all_frames_, strip), all_frames_.in_double_double(h),
                                     predicates::unit<robust::DoubleDouble>(0)))
    return decided(*s, robust::Stage::double_double);
  if (const auto at = exact_(wave.window)) {
    const predicates::RootPoint apex = exact_apex(all_frames_, h);
    const auto side = [&](const predicates::RootPoint& cone) { return predicates::orientation(at->image, cone, apex).sign(); };
    return decided(*sight_of<Sight>(side(at->cone0), side(at->cone1)), robust::Stage::algebra);
  }
  for (const int bits : {128, 256, 512, 1024}) {
    const auto frame = all_frames_.in_mpfr(Mesh::face(h), bits)[h % 3];
    if (const auto s = sight_in<Sight>(unfold_mpfr(all_frames_, strip, bits), frame, predicates::unit<robust::Mpfr>(bits)))
      return decided(*s, robust::Stage::mpfr);
  }
  predicates::undecided(decisions_, predicates::Predicate::window_orientation,
                        "vertex " + std::to_string(mesh_.apex(h)) + " against the cone of a window of vertex " +
                            std::to_string(field_.windows[wave.window].root) + " over half-edge " + std::to_string(h));
  return Sight::inside;
}

/// Makes sure of so many free waves; moves the others.
void Propagation::make_room(std::size_t waves) {
  if (free_waves_ >= waves) return;
  const std::size_t old = waves_.size(), more = std::max(old, waves + 64);
  waves_.resize(old + more);
  for (std::size_t i = old; i < old + more; ++i) waves_[i].next = static_cast<std::uint32_t>(i + 1);
  waves_.back().next = free_wave_;
  free_wave_ = static_cast<std::uint32_t>(old);
  free_waves_ += more;
}

bool propagate(const Frames& frames, std::span<const WaveStart> starts, const std::vector<VertexKind>& kinds, DistanceField& field,
               predicates::Decisions& decisions, PropagationPoll poll, void* user) {
  return Propagation(frames, kinds, field, decisions).run(starts, poll, user);
}

}  // namespace gvd::kernel
