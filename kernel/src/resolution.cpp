#include "gvd/kernel/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "exact_unfoldings.hpp"
#include "gvd/kernel/error.hpp"
#include "gvd/predicates/compare_legs.hpp"
#include "gvd/predicates/enclosed_frame.hpp"
#include "gvd/robust/rational.hpp"
#include "gvd/robust/rounding.hpp"
#include "window_images.hpp"

namespace gvd::kernel {

using predicates::Predicate;
using robust::Ball;
using robust::DoubleDouble;
using robust::Exact;
using robust::Mpfr;
using robust::RootSum;
using robust::Stage;

namespace {

/// Paths of more legs are not attempted exactly: each leg of one is compared with each of the other.
constexpr std::size_t kMostLegs = 64;
constexpr std::array<int, 4> kMpfrBits = {128, 256, 512, 1024};

template <class T>
bool may_vanish(const Ball<T>& x) {
  return maybe_sign(x).value_or(robust::Sign::zero) == robust::Sign::zero;
}

}  // namespace

LabelSetId LabelSets::intern(std::vector<SourceId> sorted) {
  const auto [it, added] = ids_.try_emplace(std::move(sorted), static_cast<LabelSetId>(sets_.size()));
  if (added) sets_.push_back(it->first);
  return it->second;
}

LabelSetId LabelSets::merge(LabelSetId a, LabelSetId b) {
  if (a == b) return a;
  std::vector<SourceId> both;
  std::set_union(sets_[a].begin(), sets_[a].end(), sets_[b].begin(), sets_[b].end(), std::back_inserter(both));
  return intern(std::move(both));
}

Resolution::Resolution(const Frames& frames, DistanceField& field, const std::vector<SourceVertex>& sources, LabelSets& sets)
    : frames_(frames), field_(field), sources_(sources), sets_(sets), exact_(std::make_unique<ExactUnfoldings>(frames, field)) {
  const std::size_t n = frames.mesh().vertex_count();
  source_of_vertex_.assign(n, kNone);
  for (std::size_t i = 0; i < sources.size(); ++i) source_of_vertex_[sources[i].vertex] = static_cast<std::uint32_t>(i);
  labels_.assign(n, kNone);
  proved_.assign(n, 0);
  straightest_.resize(n);
  distance_.resize(n);
}

Resolution::~Resolution() = default;

std::shared_ptr<const predicates::RootUnfolding> Resolution::exact_unfolding(WindowId window) const { return (*exact_)(window); }

void Resolution::resolve(predicates::Decisions& decisions) {
  std::vector<std::pair<double, VertexId>> order;
  order.reserve(labels_.size());
  for (VertexId v = 0; v < labels_.size(); ++v)
    if (std::isfinite(field_.distance[v])) order.push_back({field_.distance[v], v});
  std::sort(order.begin(), order.end());
  images_ = std::make_unique<WindowImages>(frames_, field_);
  add_images(windows_of_candidates());
  for (const auto& [distance, v] : order)
    while (labels_[v] == kNone) resolve_vertex(waits(v) ? first_of(cluster_of(v), decisions) : v, decisions);
}

void Resolution::add_images(const std::vector<WindowId>& windows) { images_->add(windows); }
void Resolution::forget_images() { images_.reset(); }

/// Of those that doubles cannot tell from the nearest.
std::vector<WindowId> Resolution::windows_of_candidates() const {
  std::vector<WindowId> windows;
  for (const std::uint32_t first : field_.first_candidate) {
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t c = first; c != kNone; c = field_.candidates[c].next) best = std::min(best, field_.candidates[c].distance + field_.candidates[c].error);
    for (std::uint32_t c = first; c != kNone; c = field_.candidates[c].next) {
      const Candidate& candidate = field_.candidates[c];
      if (candidate.window != kNone && candidate.distance - candidate.error <= best) windows.push_back(candidate.window);
    }
  }
  return windows;
}

/// Whether a path of v comes through a vertex that is not resolved yet and may be nearer than v: the two are closer than doubles can tell. (Others that
/// are not resolved are farther by more than all errors.)
bool Resolution::is_awaited(const Candidate& c, VertexId v) const {
  if (c.via == v || labels_[c.via] != kNone || (c.window != kNone && field_.is_stale(c.window))) return false;
  return field_.distance[c.via] - field_.error[c.via] < field_.distance[v] + field_.error[v];
}

bool Resolution::waits(VertexId v) const {
  for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = field_.candidates[c].next)
    if (is_awaited(field_.candidates[c], v)) return true;
  return false;
}

/// v, and what it waits for, and what these wait for.
Resolution::Cluster Resolution::cluster_of(VertexId v) const {
  Cluster cluster{v};
  for (std::size_t i = 0; i < cluster.size(); ++i)
    for (std::uint32_t c = field_.first_candidate[cluster[i]]; c != kNone; c = field_.candidates[c].next)
      if (const Candidate& candidate = field_.candidates[c]; is_awaited(candidate, cluster[i]))
        if (std::find(cluster.begin(), cluster.end(), candidate.via) == cluster.end()) cluster.push_back(candidate.via);
  return cluster;
}

/// The one whose nearest path is known to come through resolved vertices alone. The nearest of all is such a one, since legs are not of length zero.
VertexId Resolution::first_of(const Cluster& cluster, predicates::Decisions& decisions) {
  if (const auto first = first_by(cluster, [&](const Candidate& c, VertexId v) { return std::pair(leg(c, v), distance_[c.via]); })) {
    predicates::count(decisions, Predicate::vertex_distance, Stage::double_double);
    return *first;
  }
  for (const int bits : kMpfrBits) {
    const auto in_mpfr = [&](const Candidate& c, VertexId v) {
      const bool known = c.via != v && labels_[c.via] != kNone;
      return std::pair(leg(c, v, bits), known ? distance(c.via, bits) : Ball<Mpfr>(Mpfr(0.0, bits), 0));
    };
    if (const auto first = first_by(cluster, in_mpfr)) {
      predicates::count(decisions, Predicate::vertex_distance, Stage::mpfr);
      return *first;
    }
  }
  predicates::undecided(decisions, Predicate::vertex_distance,
                        "order of vertices " + std::to_string(cluster[0]) + " and " + std::to_string(cluster[1]));
  return *std::min_element(cluster.begin(), cluster.end(), [&](VertexId a, VertexId b) { return field_.distance[a] < field_.distance[b]; });
}

/// `lengths`: of the last leg, and of the way to where it starts (of no meaning if that is not resolved).
template <class Lengths>
std::optional<VertexId> Resolution::first_by(const Cluster& cluster, const Lengths& lengths) const {
  using Length = typename std::invoke_result_t<Lengths, const Candidate&, VertexId>::first_type;
  struct Known {
    std::vector<Length> paths, awaited;  ///< through resolved vertices; and the last legs of those through others
  };
  std::vector<Known> known(cluster.size());
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    for (std::uint32_t c = field_.first_candidate[cluster[i]]; c != kNone; c = field_.candidates[c].next) {
      const Candidate& candidate = field_.candidates[c];
      const bool awaited = is_awaited(candidate, cluster[i]);
      if (!awaited && candidate.via != cluster[i] && labels_[candidate.via] == kNone) continue;  // certainly farther
      if (candidate.window != kNone && field_.is_stale(candidate.window)) continue;
      const auto [leg, before] = lengths(candidate, cluster[i]);
      if (awaited)
        known[i].awaited.push_back(leg);
      else
        known[i].paths.push_back(candidate.via == cluster[i] ? leg : before + leg);
    }
  }
  const auto is_first = [&](const Known& own) {  // whether a path of its own is shorter than any to another one and on
    return std::any_of(own.paths.begin(), own.paths.end(), [&](const Length& path) {
      return std::all_of(known.begin(), known.end(), [&](const Known& other) {
        return std::all_of(other.paths.begin(), other.paths.end(), [&](const Length& way) {
          return std::all_of(own.awaited.begin(), own.awaited.end(),
                             [&](const Length& leg) { return maybe_sign(way + leg - path) == robust::Sign::positive; });
        });
      });
    });
  };
  for (std::size_t i = 0; i < cluster.size(); ++i)
    if (is_first(known[i])) return cluster[i];
  return std::nullopt;
}

/// Pre: what v waits for is resolved, or certainly farther.
void Resolution::resolve_vertex(VertexId v, predicates::Decisions& decisions) {
  const auto open_decisions = [&] { return decisions(static_cast<std::size_t>(Predicate::vertex_distance), Stage::undecided); };
  const std::uint64_t open_before = open_decisions();
  std::vector<std::uint32_t> list;
  for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = field_.candidates[c].next) {
    const Candidate& candidate = field_.candidates[c];
    if (candidate.window != kNone && field_.is_stale(candidate.window)) continue;  // its path is here again
    if (candidate.via == v || labels_[candidate.via] != kNone) list.push_back(c);
  }
  if (list.empty()) throw InternalError("vertex " + std::to_string(v) + " is reached by no candidate");
  const bool stands_on_proof = std::all_of(list.begin(), list.end(), [&](std::uint32_t c) {
    const VertexId via = field_.candidates[c].via;
    return via == v || proved_[via] != 0;
  });
  if (list.size() == 1) {
    predicates::count(decisions, Predicate::vertex_distance, Stage::filter);
  } else {
    list = nearest_of(list, v, decisions);
  }
  std::sort(list.begin(), list.end());
  LabelSetId labels = kNone;
  for (const std::uint32_t c : list) {
    const Candidate& candidate = field_.candidates[c];
    const LabelSetId own = candidate.via == v ? sources_[source_of_vertex_[v]].labels : labels_[candidate.via];
    labels = labels == kNone ? own : sets_.merge(labels, own);
  }
  labels_[v] = labels;
  proved_[v] = stands_on_proof && open_decisions() == open_before;
  distance_[v] = length(field_.candidates[list.front()], v);
  field_.first_candidate[v] = list.front();
  for (std::size_t i = 0; i < list.size(); ++i) field_.candidates[list[i]].next = i + 1 < list.size() ? list[i + 1] : kNone;
  for (const std::uint32_t c : list) {
    const VertexId via = field_.candidates[c].via;
    const std::uint32_t legs = via == v ? 0 : straightest_[via].legs + 1;
    if (c == list.front() || legs < straightest_[v].legs) straightest_[v] = {c, legs};
  }
}

namespace {

/// Drops what is certainly longer than the least upper bound.
template <class T>
void keep_nearest(std::vector<std::uint32_t>& list, const std::vector<Ball<T>>& lengths) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < list.size(); ++i)
    if (maybe_sign(lengths[i] - lengths[best]) == robust::Sign::negative ||
        (!maybe_sign(lengths[i] - lengths[best]) && lengths[i].rad() < lengths[best].rad()))
      best = i;
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (i == best || maybe_sign(lengths[i] - lengths[best]) != robust::Sign::positive) kept.push_back(list[i]);
  list = std::move(kept);
}

}  // namespace

std::vector<std::uint32_t> Resolution::nearest_of(const std::vector<std::uint32_t>& candidates, VertexId v,
                                                  predicates::Decisions& decisions) {
  std::vector<std::uint32_t> list = candidates;
  const std::size_t before = list.size();
  double best = std::numeric_limits<double>::infinity();
  for (const std::uint32_t c : list) best = std::min(best, field_.candidates[c].distance + field_.candidates[c].error);
  std::erase_if(list, [&](std::uint32_t c) { return field_.candidates[c].distance - field_.candidates[c].error > best; });
  if (list.size() == 1) {
    predicates::count(decisions, Predicate::vertex_distance, Stage::filter);
    return list;
  }
  {
    std::vector<Ball<DoubleDouble>> lengths;
    for (const std::uint32_t c : list) lengths.push_back(length(field_.candidates[c], v));
    keep_nearest(list, lengths);
  }
  if (list.size() == 1) {
    predicates::count(decisions, Predicate::vertex_distance, Stage::double_double);
    return list;
  }
  if (auto nearest = nearest_exactly(list, v)) {
    predicates::count(decisions, Predicate::vertex_distance, Stage::algebra);
    return std::move(*nearest);
  }
  for (const int bits : kMpfrBits) {
    std::vector<Ball<Mpfr>> lengths;
    for (const std::uint32_t c : list) lengths.push_back(length(field_.candidates[c], v, bits));
    keep_nearest(list, lengths);
    if (list.size() == 1) {
      predicates::count(decisions, Predicate::vertex_distance, Stage::mpfr);
      return list;
    }
  }
  predicates::undecided(decisions, Predicate::vertex_distance,
                        "vertex " + std::to_string(v) + ": " + std::to_string(list.size()) + " of " + std::to_string(before) +
                            " paths agree to 1024 bits");
  return list;
}

std::optional<std::vector<std::uint32_t>> Resolution::nearest_exactly(const std::vector<std::uint32_t>& list, VertexId v) const {
  std::vector<std::uint32_t> nearest;
  std::optional<Path> shortest;
  for (const std::uint32_t c : list) {
    auto path = exact_path(field_.candidates[c], v);
    const robust::MaybeSign sign = !path ? std::nullopt : !shortest ? robust::Sign::negative : compare(*path, *shortest);
    if (!sign) return std::nullopt;
    if (*sign == robust::Sign::negative) {
      nearest.clear();
      shortest = std::move(path);
    }
    if (*sign != robust::Sign::positive) nearest.push_back(c);
  }
  return nearest;
}

/// Round both at once: the fan of one of them may be long. Pre: there is one.
HalfedgeId Resolution::edge_between(VertexId a, VertexId b) const {
  const Mesh& mesh = frames_.mesh();
  const auto beside = [&](HalfedgeId h, VertexId v) { return mesh.target(h) == v ? h : mesh.origin(Mesh::prev(h)) == v ? Mesh::prev(h) : kNone; };
  HalfedgeId of_a = mesh.outgoing(a), of_b = mesh.outgoing(b);
  for (;;) {
    for (const auto& [h, v] : {std::pair(of_a, b), std::pair(of_b, a)})
      if (const HalfedgeId found = beside(h, v); found != kNone) return found;
    of_a = mesh.twin(Mesh::prev(of_a));
    of_b = mesh.twin(Mesh::prev(of_b));
    if (of_a == kNone || of_b == kNone || of_a == mesh.outgoing(a) || of_b == mesh.outgoing(b))
      throw InternalError("no edge joins vertices " + std::to_string(a) + " and " + std::to_string(b));
  }
}

Ball<DoubleDouble> Resolution::length(const Candidate& c, VertexId v) {
  const Ball<DoubleDouble> last = leg(c, v);
  return c.via == v ? last : distance_[c.via] + last;
}

/// Along an edge, or through a window: `image_of` gives its image, `frame_of` the frames.
template <class FrameOf, class ImageOf>
auto Resolution::straight_leg(const Candidate& c, VertexId v, double unit, const FrameOf& frame_of, const ImageOf& image_of) const {
  if (c.window == kNone) return predicates::enclosed_length(frame_of(edge_between(c.via, v)), unit);
  return predicates::last_leg(image_of(c.window), frame_of(field_.windows[c.window].halfedge()), unit);
}

Ball<DoubleDouble> Resolution::leg(const Candidate& c, VertexId v) {
  if (c.via == v) return Ball<DoubleDouble>(std::ldexp(sources_[source_of_vertex_[v]].weight, -frames_.scale()));
  const auto frame_of = [&](HalfedgeId h) -> const auto& { return frames_.in_double_double(h); };
  return straight_leg(c, v, predicates::unit<DoubleDouble>(0), frame_of, [&](WindowId window) { return (*images_)(window); });
}

Ball<Mpfr> Resolution::length(const Candidate& c, VertexId v, int bits) const {
  const Ball<Mpfr> last = leg(c, v, bits);
  return c.via == v ? last : distance(c.via, bits) + last;
}

Ball<Mpfr> Resolution::leg(const Candidate& c, VertexId v, int bits) const {
  if (c.via == v) return Ball<Mpfr>(Mpfr(std::ldexp(sources_[source_of_vertex_[v]].weight, -frames_.scale()), bits), 0);
  const auto frame_of = [&](HalfedgeId h) { return frames_.in_mpfr(Mesh::face(h), bits)[h % 3]; };
  const auto image_of = [&](WindowId window) { return unfold_mpfr(frames_, strip_of(frames_.mesh(), field_, window), bits).image; };
  return straight_leg(c, v, predicates::unit<Mpfr>(bits), frame_of, image_of);
}

Ball<Mpfr> Resolution::distance(VertexId v, int bits) const { return length(field_.candidates[field_.first_candidate[v]], v, bits); }

std::optional<Exact> Resolution::exact_distance(VertexId v) const {
  const auto path = exact_path(field_.candidates[field_.first_candidate[v]], v);
  if (!path) return std::nullopt;
  Exact sum(path->weight);
  for (const Leg& leg : path->legs) {
    if (!leg.squared) return std::nullopt;
    sum += sqrt(Exact(*leg.squared));
  }
  return sum;
}

bool Resolution::have_equal_distances(VertexId a, VertexId b) const {
  if (a == b) return true;
  if (!may_vanish(distance_[a] - distance_[b]) || !may_vanish(distance(a, kBitsBeforeAlgebra) - distance(b, kBitsBeforeAlgebra))) return false;
  const auto path_to = [&](VertexId v) { return exact_path(field_.candidates[field_.first_candidate[v]], v); };
  const auto to_a = path_to(a), to_b = path_to(b);
  return to_a && to_b && compare(*to_a, *to_b) == robust::Sign::zero;
}

/// Of the paths that tie at a vertex the one found first, or, if that has too many legs, the one with the fewest: along edges in one line, each flat vertex
/// ends a leg.
std::optional<Resolution::Path> Resolution::exact_path(const Candidate& candidate, VertexId v) const {
  if (auto path = exact_path(candidate, v, [&](VertexId u) { return field_.first_candidate[u]; })) return path;
  return exact_path(candidate, v, [&](VertexId u) { return straightest_[u].candidate; });
}

template <class Winner>
std::optional<Resolution::Path> Resolution::exact_path(const Candidate& candidate, VertexId v, const Winner& winner) const {
  Path path;
  const Candidate* c = &candidate;
  for (; c->via != v; v = c->via, c = &field_.candidates[winner(v)]) {
    if (path.legs.size() == kMostLegs) return std::nullopt;
    path.legs.push_back({c->window, c->via, v, squared_leg(*c, v)});
  }
  path.weight = robust::exact_rational(sources_[source_of_vertex_[v]].weight) * robust::power_of_two(-frames_.scale());
  return path;
}

std::optional<RootSum> Resolution::squared_leg(const Candidate& c, VertexId v) const {
  if (c.window == kNone) {
    const HalfedgeId h = edge_between(c.via, v);
    return RootSum(frames_.exact(Mesh::face(h))->squared[h % 3]);
  }
  const auto at = exact_unfolding(c.window);
  if (!at) return std::nullopt;
  const HalfedgeId h = field_.windows[c.window].halfedge();
  const predicates::RootPoint apex = exact_apex(frames_, h);
  const RootSum x = at->image.x - apex.x, y = at->image.y - apex.y;
  return (x * x + y * y) * frames_.exact(Mesh::face(h))->squared[h % 3];
}

/// The sum of roots where both have one, which is quick; otherwise the span test on the strips.
bool Resolution::are_equal(const Leg& a, const Leg& b) const {
  if (a.window == b.window && a.from == b.from && a.to == b.to) return true;
  if (a.squared && b.squared) return (*a.squared - *b.squared).is_zero();
  if (a.window == kNone || b.window == kNone) return false;
  const Mesh& mesh = frames_.mesh();
  const auto of_a = sides_of(strip_of(mesh, field_, a.window)), of_b = sides_of(strip_of(mesh, field_, b.window));
  if (a.from == b.from && a.to == b.to && show_end_alike(of_a, of_b)) return true;
  const auto squared = [&](WindowId window, std::span<const HalfedgeId> sides) {
    const HalfedgeId h = field_.windows[window].halfedge();
    return way_program(frames_, sides).squared_distance_to_apex(*frames_.for_program(Mesh::face(h)), h % 3);
  };
  return robust::are_proved_equal(squared(a.window, of_a), squared(b.window, of_b));
}

/// Whether two ways to one apex part over a side from which both see it in one place: going backwards to that side, they show one image of it.
bool Resolution::show_end_alike(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b) const {
  const auto common = static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
  if (common == 0 || common == std::min(a.size(), b.size())) return false;
  const auto backwards = [&](std::span<const HalfedgeId> way) {
    std::vector<HalfedgeId> sides;
    for (std::size_t i = way.size(); i >= common; --i) sides.push_back(frames_.mesh().twin(way[i - 1]));
    return way_program(frames_, sides);
  };
  const predicates::StripProgram of_a = backwards(a), of_b = backwards(b);
  if (!are_proved_equal(of_a.value({0, 1, 0, 0}), of_b.value({0, 1, 0, 0}))) return false;
  return are_proved_equal(of_a.value({0, 0, 1, 0}), of_b.value({0, 0, 1, 0}));
}

/// The sign of the difference of the lengths. Equal legs cancel, the same ones without any arithmetic.
robust::MaybeSign Resolution::compare(const Path& a, const Path& b) const {
  return predicates::compare_legs(mpq_class(a.weight - b.weight), a.legs, b.legs, [&](const Leg& x, const Leg& y) { return are_equal(x, y); });
}

bool Resolution::attains(WindowId window, VertexId v) const noexcept {
  for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = field_.candidates[c].next)
    if (field_.candidates[c].window == window) return true;
  return false;
}

bool Resolution::attains_along_edge(VertexId via, VertexId v) const noexcept {
  for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = field_.candidates[c].next)
    if (field_.candidates[c].window == kNone && field_.candidates[c].via == via) return true;
  return false;
}

/// Not from the images that `resolve` keeps. Pre: v is not the source itself.
Ball<DoubleDouble> Resolution::enclosed_leg(const Candidate& c, VertexId v) const {
  const auto frame_of = [&](HalfedgeId h) -> const auto& { return frames_.in_double_double(h); };
  const auto image_of = [&](WindowId window) {
    return predicates::unfold<DoubleDouble, false>(strip_of(frames_.mesh(), field_, window), frame_of).image;
  };
  return straight_leg(c, v, predicates::unit<DoubleDouble>(0), frame_of, image_of);
}

bool Resolution::is_as_far(WindowId window, VertexId v) const {
  enum : std::uint8_t { unknown, no, yes };
  std::call_once(allocate_as_far_, [&] { as_far_ = std::vector<std::atomic<std::uint8_t>>(field_.windows.size()); });
  std::atomic<std::uint8_t>& known = as_far_[window];
  if (known.load(std::memory_order_relaxed) == unknown)
    known.store(proves_as_far(window, v) ? yes : no, std::memory_order_relaxed);
  return known.load(std::memory_order_relaxed) == yes;
}

/// Whether the square of an image in these sums of roots takes longer than the span test.
bool Resolution::has_long_image(WindowId window) const {
  constexpr std::size_t kFewTerms = 4;  // chooses which proof is tried first, and no more
  const auto at = exact_unfolding(window);
  return at && std::max(at->image.x.terms().size(), at->image.y.terms().size()) > kFewTerms;
}

bool Resolution::proves_as_far(WindowId window, VertexId v) const {
  const auto leg_of = [&](const Candidate& c) { return Leg{c.window, c.via, v, squared_leg(c, v)}; };
  const auto strip_of_leg = [&](const Candidate& c) { return Leg{c.window, c.via, v, std::nullopt}; };
  Candidate through{};
  through.window = window;
  through.via = field_.windows[window].root;
  const Ball<DoubleDouble> enclosed = enclosed_leg(through, v);
  for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = field_.candidates[c].next) {
    const Candidate& other = field_.candidates[c];
    if (other.via != through.via || !may_vanish(enclosed - enclosed_leg(other, v))) continue;
    if (!may_vanish(leg(through, v, kBitsBeforeAlgebra) - leg(other, v, kBitsBeforeAlgebra))) continue;
    if (has_long_image(window) && are_equal(strip_of_leg(through), strip_of_leg(other))) return true;
    if (are_equal(leg_of(through), leg_of(other))) return true;
  }
  return false;
}

double rounded_distance(const Resolution& resolution, VertexId v, predicates::Decisions& decisions) {
  const int scale = resolution.frames().scale();
  const Ball<DoubleDouble>& d = resolution.distance(v);
  if (const auto value = robust::rounded(d.scaled(scale))) {
    predicates::count(decisions, Predicate::rounding, Stage::double_double);
    return *value;
  }
  if (const auto exact = resolution.exact_distance(v)) {
    if (const auto value = robust::rounded(exact->scaled(scale))) {
      predicates::count(decisions, Predicate::rounding, Stage::algebra);
      return *value;
    }
  }
  for (const int bits : kMpfrBits) {
    if (const auto value = robust::rounded(resolution.distance(v, bits).scaled(scale))) {
      predicates::count(decisions, Predicate::rounding, Stage::mpfr);
      return *value;
    }
  }
  predicates::undecided(decisions, Predicate::rounding, "distance of vertex " + std::to_string(v) + ": within 2^-1024 of a midpoint of two doubles");
  return std::ldexp(d.mid().hi, scale);
}

}  // namespace gvd::kernel
