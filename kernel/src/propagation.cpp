#include "propagation.hpp"

#include <algorithm>
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

}  // namespace

Propagation::Propagation(const Frames& frames, const std::vector<VertexKind>& kinds, DistanceField& field,
                         predicates::Decisions& decisions)
    : mesh_(frames.mesh()), all_frames_(frames), frames_(frames.in_double()), kinds_(kinds), field_(field), exact_(frames, field), decisions_(decisions) {
  const std::size_t n = mesh_.vertex_count(), m = mesh_.halfedge_count();
  const double infinity = std::numeric_limits<double>::infinity();
  field_.first_window.assign(m, kNone);
  field_.first_candidate.assign(n, kNone);
  field_.corner_sees_face.assign(m, 0);
  field_.distance.assign(n, infinity);
  field_.error.assign(n, 0);
  waiting_.resize(m);
  queued_.assign(m, 0);
  sights_.resize(m);
  upper_.assign(n, infinity);
  settled_.assign(n, 0);
  degree_.assign(n, 0);
  for (HalfedgeId h = 0; h < m; ++h) degree_[mesh_.origin(h)] = static_cast<std::uint16_t>(std::min(degree_[mesh_.origin(h)] + 1, 0xffff));
  emitted_weight_.assign(n, infinity);
  emitted_error_.assign(n, 0);
  emitted_.assign(m, kNone);
  cut_at_shadow_.assign(n, 0);
}

bool Propagation::run(std::span<const WaveStart> starts, PropagationPoll poll, void* user) {
  for (const WaveStart& s : starts) relax(s.vertex, {kNone, s.vertex, kNone, s.weight, 0, {0, 0}});
  std::uint64_t settled = 0;
  while (!heap_.empty()) {
    const Entry top = heap_.top();
    heap_.pop();
    if (settled_[top.vertex] != 0 || top.distance != field_.distance[top.vertex]) continue;
    settle(top.vertex);
    drain();
    if ((++settled & 1023) == 0 && poll != nullptr &&
        !poll(user, settled, field_.windows.capacity() * sizeof(WindowRecord) + waves_.capacity() * sizeof(Wave)))
      return false;
  }
  predicates::count(decisions_, predicates::Predicate::window_orientation, robust::Stage::filter);
  decisions_.count(static_cast<std::size_t>(predicates::Predicate::window_orientation), robust::Stage::filter, filtered_orientations_);
  decisions_.count(static_cast<std::size_t>(predicates::Predicate::window_pruning), robust::Stage::filter, filtered_prunings_);
  return true;
}

void Propagation::settle(VertexId v) {
  settled_[v] = 1;
  emitted_weight_[v] = field_.distance[v];
  emitted_error_[v] = field_.error[v] + kDistanceError * field_.distance[v];
  send_waves(v, field_.candidates[field_.first_candidate[v]].next == kNone);
  relax_neighbours(v, emitted_error_[v]);
  push_lists_at(v);
}

/// Of the sources at v, or of the relay for each of its candidates.
void Propagation::send_waves(VertexId v, bool only_path) {
  if (is_source(v)) {
    mesh_.for_each_outgoing(v, [&](HalfedgeId h) { emit(v, h, nullptr); });
  } else if (kinds_[v] == VertexKind::relay) {
    for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = field_.candidates[c].next) emit_shadow(v, field_.candidates[c], only_path);
  }
}

/// Along the edges at v, whose distance may still improve within the error.
void Propagation::relax_neighbours(VertexId v, double e) {
  const double d = emitted_weight_[v];
  mesh_.for_each_outgoing(v, [&](HalfedgeId h) {
    const double along = d + frames_[h].length;
    relax(mesh_.target(h), {kNone, v, kNone, along, e + kDistanceError * along, {0, 0}});
    const HalfedgeId last = Mesh::prev(h);  // the edge to the last neighbour of a boundary fan
    if (mesh_.twin(last) == kNone) {
      const double back = d + frames_[last].length;
      relax(mesh_.origin(last), {kNone, v, kNone, back, e + kDistanceError * back, {0, 0}});
    }
  });
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
  if (field_.restarted && candidate.window == kNone) {  // the same path, its root nearer than it was
    for (std::uint32_t* link = &field_.first_candidate[v]; *link != kNone; link = &list[*link].next) {
      if (list[*link].window != kNone || list[*link].via != candidate.via) continue;
      *link = list[*link].next;
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
  for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = list[c].next) low = std::min(low, list[c].distance - list[c].error);
  field_.error[v] = std::max(field_.distance[v] - low, upper_[v] - field_.distance[v]);
  if (settled_[v] == 0) {
    if (nearer) heap_.push({candidate.distance, v});
    return;
  }
  improve_settled(v, low, candidate);
}

/// Rare. Its own waves start anew if their weight is no longer within its error, or if they were cut off at the shadow of what was the only path.
void Propagation::improve_settled(VertexId v, double low, const Candidate& candidate) {
  if (low < emitted_weight_[v] - emitted_error_[v] || cut_at_shadow_[v] != 0) {
    field_.restarted = true;
    cut_at_shadow_[v] = 0;
    emitted_weight_[v] = field_.distance[v];
    const double slack = field_.error[v] + kDistanceError * field_.distance[v];
    emitted_error_[v] = 2 * slack;  // the range doubles: vertices that lie close together cannot start one another anew without end
    mesh_.for_each_outgoing(v, [&](HalfedgeId h) {
      if (emitted_[h] != kNone) field_.windows[emitted_[h]].packed |= WindowRecord::kDead;
      emitted_[h] = kNone;
    });
    send_waves(v, false);
    relax_neighbours(v, slack);
  } else if (kinds_[v] == VertexKind::relay && !is_source(v)) {
    emit_shadow(v, candidate, false);
  }
}

void Propagation::emit(VertexId v, HalfedgeId outgoing, const Shadow* shadow) {
  field_.corner_sees_face[outgoing] = 1;
  if (emitted_[outgoing] != kNone) return;
  const HalfedgeId opposite = Mesh::next(outgoing);
  const HalfedgeId target = mesh_.twin(opposite);
  if (target == kNone) return;
  const Frame& frame = frames_[opposite];
  const std::uint32_t w = new_wave();
  Wave& wave = waves_[w];
  wave.image = predicates::apex_from_behind(frame);
  wave.cone0 = {0, 0};
  wave.cone1 = {1, 0};
  wave.begin = 0;
  wave.end = 1;
  wave.weight = emitted_weight_[v];
  wave.weight_error = rounded_up(emitted_error_[v]);
  wave.image_error = rounded_up(2 * kStepError * (norm1(wave.image.x, wave.image.y) + 1) * frame.length);
  wave.begin_slack = wave.end_slack = 0;
  wave.begin_trimmed = wave.end_trimmed = false;
  wave.begin_turns = wave.end_turns = 0;
  wave.cone0_at_origin = wave.cone1_at_target = true;
  if (shadow != nullptr && cut_at_shadow(*shadow, outgoing, wave)) cut_at_shadow_[v] = 1;
  wave.window = new_window(kNone, target, v, false);
  emitted_[outgoing] = wave.window;
  append(target, w);
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
      wave.end = l.at + l.margin;
      wave.end_trimmed = true;
    }
  }
  if (shadow.last.face == outgoing) {
    const predicates::Landing l = landing(shadow.last);
    if (l.at - l.margin > 0) {
      wave.begin = l.at - l.margin;
      wave.begin_trimmed = true;
    }
  }
  return wave.begin_trimmed || wave.end_trimmed;
}

void Propagation::push_lists_at(VertexId v) {
  mesh_.for_each_outgoing(v, [&](HalfedgeId h) {
    // The face between h and prev(h): its two sides at v in both directions, and the side opposite v, inwards and outwards.
    const HalfedgeId opposite = Mesh::next(h), back = Mesh::prev(h);
    push(h);
    push(back);
    push(opposite);
    if (mesh_.twin(h) != kNone) push(mesh_.twin(h));
    const HalfedgeId outwards = mesh_.twin(opposite);
    if (outwards != kNone && field_.distance[mesh_.apex(outwards)] < std::numeric_limits<double>::infinity()) push(outwards);
  });
}

void Propagation::push(HalfedgeId h) {
  if (queued_[h] != 0 || waiting_[h].first == kNone) return;
  queued_[h] = 1;
  fifo_.push_back(h);
}

void Propagation::drain() {
  while (fifo_head_ < fifo_.size()) {
    const HalfedgeId h = fifo_[fifo_head_++];
    queued_[h] = 0;
    cross_face(h);
  }
  fifo_.clear();
  fifo_head_ = 0;
}

Propagation::Sight Propagation::locate_apex(const Wave& wave, HalfedgeId h, const Frame& frame) {
  const double wx = frame.u - wave.image.x, wy = frame.y - wave.image.y;
  const double x0 = wave.cone0.x - wave.image.x, y0 = wave.cone0.y - wave.image.y;
  const double x1 = wave.cone1.x - wave.image.x, y1 = wave.cone1.y - wave.image.y;
  const double side0 = x0 * wy - y0 * wx, side1 = x1 * wy - y1 * wx;
  const double disc = wave.image_error / frame.length + kFrameError * norm1(frame.u, frame.y);
  const double size = norm1(wx, wy) + 2 * disc, size0 = norm1(x0, y0) + 2 * disc, size1 = norm1(x1, y1) + 2 * disc;
  const double bound0 = 2.125 * disc * (size + size0) + kOrientationError * size * size0;
  const double bound1 = 2.125 * disc * (size + size1) + kOrientationError * size * size1;
  ++filtered_orientations_;
  if (side0 > bound0) return Sight::beyond_0;
  if (side1 < -bound1) return Sight::beyond_1;
  if (side0 < -bound0 && side1 > bound1) return Sight::inside;
  --filtered_orientations_;
  return decide_apex(wave, h);
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

void Propagation::trim_list(HalfedgeId h) {
  list_.clear();
  kept_.clear();
  const auto recycle = [&](std::uint32_t w) {
    waves_[w].next = free_wave_;
    free_wave_ = w;
  };
  for (std::uint32_t w = waiting_[h].first; w != kNone;) {
    const std::uint32_t next = waves_[w].next;
    if (field_.restarted && waves_[w].weight != emitted_weight_[field_.windows[waves_[w].window].root]) {
      recycle(w);
    } else {
      list_.push_back(w);
    }
    w = next;
  }
  waiting_[h] = {};
  for (std::size_t i = 1; i < list_.size(); ++i) {  // nearly sorted and short
    const std::uint32_t w = list_[i];
    std::size_t k = i;
    for (; k > 0 && waves_[list_[k - 1]].begin > waves_[w].begin; --k) list_[k] = list_[k - 1];
    list_[k] = w;
  }
  const double length = frames_[h].length;
  for (const std::uint32_t w : list_) {
    bool keep = true;
    while (!kept_.empty()) {
      const Trim t = trim(waves_[kept_.back()], waves_[w], length);
      if (t == Trim::drop_second) keep = false;
      if (t != Trim::drop_first) break;
      field_.windows[waves_[kept_.back()].window].packed |= WindowRecord::kDominated;
      recycle(kept_.back());
      kept_.pop_back();
    }
    if (keep) {
      kept_.push_back(w);
    } else {
      field_.windows[waves_[w].window].packed |= WindowRecord::kDominated;
      recycle(w);
    }
  }
}

void Propagation::cross_face(HalfedgeId h) {
  const Frame& frame = frames_[h];
  const HalfedgeId left = mesh_.twin(Mesh::prev(h)), right = mesh_.twin(Mesh::next(h));
  const VertexId apex = mesh_.apex(h);
  ApexSight& sight = sights_[h];
  crossings_.clear();
  trim_list(h);
  for (const std::uint32_t w : kept_) {
    const Wave& wave = waves_[w];
    ++field_.windows_propagated;
    const double dx = wave.image.x - frame.u, dy = wave.image.y - frame.y;
    const double d = wave.weight + frame.length * std::sqrt(dx * dx + dy * dy);
    const Sight where = locate_apex(wave, h, frame);
    crossings_.push_back({w, where, d});
    if (where == Sight::beyond_0 || where == Sight::beyond_1) continue;
    const double error = (wave.image_error + wave.weight_error) + kDistanceError * d;
    if (d + error < sight.upper && dy < 0) {
      const double t = wave.image.y / dy;  // image -> apex crosses the side at this fraction: dy < 0
      const double x = wave.image.x - dx * t;
      const double disc = wave.image_error / frame.length + kFrameError * norm1(frame.u, frame.y);
      const double slack = 4 * disc * (1 + norm1(dx, dy) / -dy);
      sight = {d + error, x - slack, x + slack};
    }
    relax(apex, {wave.window, field_.windows[wave.window].root, kNone, d, error, wave.image});  // may add waves: last use of `wave`
  }
  for (const Crossing& c : crossings_) {
    const Wave& wave = waves_[c.wave];
    const bool longer = c.apex_distance * (1 - kDistanceError) - (wave.image_error + wave.weight_error) > sight.upper;
    const double begin = wave.begin, end = wave.end;
    const Sight where = c.sight;
    if (left != kNone && where != Sight::beyond_0 && where != Sight::on_ray_0) {
      if (longer && begin >= sight.high) {
        ++filtered_prunings_;
      } else {
        make_child<true>(c.wave, where, h, left);
      }
    }
    if (right != kNone && where != Sight::beyond_1 && where != Sight::on_ray_1) {
      if (longer && end <= sight.low) {
        ++filtered_prunings_;
      } else {
        make_child<false>(c.wave, where, h, right);
      }
    }
  }
  for (const std::uint32_t w : kept_) {
    waves_[w].next = free_wave_;
    free_wave_ = w;
  }
  for (const HalfedgeId target : {left, right})
    if (target != kNone && (settled_[mesh_.origin(target)] != 0 || settled_[mesh_.target(target)] != 0)) push(target);
}

template <bool kLeft>
void Propagation::make_child(std::uint32_t parent, Sight sight, HalfedgeId h, HalfedgeId target) {
  const Wave& wave = waves_[parent];
  const Frame& side = frames_[kLeft ? Mesh::prev(h) : Mesh::next(h)];
  const auto cross = [&](const Image& z) { return kLeft ? predicates::cross_left(z, side) : predicates::cross_right(z, side); };
  const bool at_apex = kLeft ? sight == Sight::inside || sight == Sight::on_ray_1 : sight == Sight::inside || sight == Sight::on_ray_0;
  const double length = side.length, parent_length = frames_[h].length;
  Wave child;
  // A shortest path crosses no edge twice: a window that has come once round a vertex is done.
  child.begin_turns = kLeft ? static_cast<std::uint16_t>(wave.begin_turns + 1) : std::uint16_t{0};
  child.end_turns = kLeft ? std::uint16_t{0} : static_cast<std::uint16_t>(wave.end_turns + 1);
  if ((kLeft ? child.begin_turns : child.end_turns) >= degree_[kLeft ? mesh_.origin(target) : mesh_.target(target)]) return;
  child.image = cross(wave.image);
  const double reach = (norm1(wave.image.x, wave.image.y) + 1) * parent_length + (norm1(child.image.x, child.image.y) + 1) * length;
  const double image_error = wave.image_error + kStepError * reach;
  const double disc = image_error / length;
  child.begin = 0;
  child.end = 1;
  child.begin_slack = child.end_slack = 0;
  child.begin_trimmed = child.end_trimmed = false;
  child.cone0_at_origin = kLeft ? wave.cone0_at_origin : at_apex;
  child.cone1_at_target = kLeft ? at_apex : wave.cone1_at_target;
  if (child.cone0_at_origin) {
    child.cone0 = {0, 0};
  } else {
    child.cone0 = cross(wave.cone0);
    if (!wave.begin_trimmed) {
      const predicates::Landing l = predicates::land(child.image, child.cone0, disc);
      child.begin = std::max(0.0, l.at - l.margin);
      child.begin_slack = rounded_up(2 * l.margin);
    }
  }
  if (child.cone1_at_target) {
    child.cone1 = {1, 0};
  } else {
    child.cone1 = cross(wave.cone1);
    if (!wave.end_trimmed) {
      const predicates::Landing l = predicates::land(child.image, child.cone1, disc);
      child.end = std::min(1.0, l.at + l.margin);
      child.end_slack = rounded_up(2 * l.margin);
    }
  }
  // Of the ray through a point of the parent's side; no point of the line beyond it is seen.
  const auto landing_of = [&](double x) {
    return x >= 0 && x <= 1 ? predicates::land(child.image, cross({x, 0}), disc) : predicates::kNoLanding;
  };
  if (wave.begin_trimmed) {
    const predicates::Landing l = landing_of(wave.begin);
    const double begin = l.at - l.margin, seen_from = wave.begin + wave.begin_slack;
    if (begin > child.begin) {
      child.begin = begin;
      child.begin_trimmed = true;
    }
    if (child.begin_trimmed || !child.cone0_at_origin) {
      const predicates::Landing seen = wave.begin_slack == 0 ? l : landing_of(seen_from);
      child.begin_slack = rounded_up(std::max(0.0, seen.at + seen.margin - child.begin));
    }
  }
  if (wave.end_trimmed) {
    const predicates::Landing l = landing_of(wave.end);
    const double end = l.at + l.margin, seen_to = wave.end - wave.end_slack;
    if (end < child.end) {
      child.end = end;
      child.end_trimmed = true;
    }
    if (child.end_trimmed || !child.cone1_at_target) {
      const predicates::Landing seen = wave.end_slack == 0 ? l : landing_of(seen_to);
      child.end_slack = rounded_up(std::max(0.0, child.end - seen.at + seen.margin));
    }
  }
  if (child.begin > child.end) {
    ++filtered_prunings_;
    return;
  }
  // Xin and Wang's filter: a vertex of the face from which every point of the child is certainly nearer.
  const double y2 = child.image.y * child.image.y;
  const double to_begin = child.image.x - child.begin, to_end = child.image.x - child.end;
  const double at_begin = wave.weight + length * std::sqrt(to_begin * to_begin + y2);
  const double at_end = wave.weight + length * std::sqrt(to_end * to_end + y2);
  const double error = image_error + wave.weight_error;
  const double begin_low = at_begin * (1 - kDistanceError) - error, end_low = at_end * (1 - kDistanceError) - error;
  const VertexId origin = mesh_.origin(target), end = mesh_.target(target), third = kLeft ? mesh_.target(h) : mesh_.origin(h);
  const double third_x = side.v - (kLeft ? child.begin : child.end);
  const double from_third = upper_[third] + length * std::sqrt(third_x * third_x + side.y * side.y);
  if (upper_[origin] + child.end * length < end_low || upper_[end] + (1 - child.begin) * length < begin_low ||
      from_third * (1 + kDistanceError) < (kLeft ? begin_low : end_low)) {
    ++filtered_prunings_;
    return;
  }
  child.weight = wave.weight;
  child.weight_error = wave.weight_error;
  child.image_error = rounded_up(image_error);
  child.window = new_window(wave.window, target, field_.windows[wave.window].root, at_apex);
  const std::uint32_t w = new_wave();
  waves_[w] = child;
  append(target, w);
}

std::uint32_t Propagation::new_wave() {
  if (free_wave_ == kNone) {
    waves_.emplace_back();
    return static_cast<std::uint32_t>(waves_.size() - 1);
  }
  const std::uint32_t w = free_wave_;
  free_wave_ = waves_[w].next;
  return w;
}

WindowId Propagation::new_window(WindowId parent, HalfedgeId h, VertexId root, bool apex_in_cone) {
  const auto id = static_cast<WindowId>(field_.windows.size());
  field_.windows.push_back({parent, h | (apex_in_cone ? WindowRecord::kApexInCone : 0u), root, field_.first_window[h]});
  field_.first_window[h] = id;
  return id;
}

void Propagation::append(HalfedgeId h, std::uint32_t wave) {
  waves_[wave].next = kNone;
  List& list = waiting_[h];
  if (list.first == kNone) {
    list.first = list.last = wave;
  } else {
    waves_[list.last].next = wave;
    list.last = wave;
  }
}

bool propagate(const Frames& frames, std::span<const WaveStart> starts, const std::vector<VertexKind>& kinds, DistanceField& field,
               predicates::Decisions& decisions, PropagationPoll poll, void* user) {
  return Propagation(frames, kinds, field, decisions).run(starts, poll, user);
}

}  // namespace gvd::kernel
