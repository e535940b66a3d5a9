#include "facet_waves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gvd/predicates/enclosed_frame.hpp"
#include "gvd/predicates/filter_error.hpp"
#include "gvd/predicates/landing.hpp"
#include "gvd/robust/rational.hpp"
#include "window_images.hpp"

namespace gvd::kernel {

using predicates::Complex;
using predicates::Disc;
using predicates::EdgeFrame;
using predicates::PlanePoint;
using predicates::Strip;
using predicates::to_first_side;
using predicates::Unfolding;
using robust::Ball;
using robust::DoubleDouble;
using robust::Exact;
using robust::Mpfr;

namespace {

/// Names of paths to a vertex: through a window whose apex it is, or along an edge from the root.
std::uint64_t path_through(WindowId window) { return window; }
std::uint64_t path_along_edge(VertexId root) { return (std::uint64_t{1} << 32) | root; }

}  // namespace

FieldWaves::FieldWaves(const Resolution& resolution, const std::vector<VertexKind>& kinds, FaceId f, const UnfoldedWindows* unfolded)
    : resolution_(resolution), field_(resolution.field()), kinds_(kinds), unfolded_(unfolded) {
  const Frames& frames = resolution.frames();
  const Mesh& mesh = frames.mesh();
  face = f;
  frame_ = make_frame<double>(frames(3 * f), predicates::unit<double>(0));
  for (std::uint8_t k = 0; k < 3; ++k) {
    corner[k] = mesh.origin(3 * f + k);
    corner_labels[k] = resolution.labels(corner[k]);
    corner_is_flat[k] = kinds[corner[k]] == VertexKind::flat;
  }
  const std::size_t most = most_sites();
  sites.reserve(most);
  sites_.reserve(most);
  Arrivals arrivals;
  arrivals.all.reserve(most);
  arrivals.kept.reserve(most);
  for (std::uint8_t k = 0; k < 3; ++k) {
    if (field_.corner_sees_face[3 * f + k] != 0) add_corner(k);
    add_side(k, arrivals);
  }
}

/// Hardly any of them turns out to be nowhere nearest, and they are kept until the diagram is made. What is wanted of them next is fetched meanwhile.
std::size_t FieldWaves::most_sites() const {
  std::size_t count = 0;
  for (HalfedgeId h = 3 * face; h < 3 * face + 3; ++h) {
    count += field_.corner_sees_face[h] != 0 ? 1 : 0;
    for (WindowId w = field_.first_window[h]; w != kNone; w = field_.windows[w].next) {
      if (field_.windows[w].dominated()) continue;
      ++count;
      if (const auto* unfolded = unfolded_ == nullptr ? nullptr : unfolded_->find(w)) {
        const auto* const bytes = reinterpret_cast<const std::byte*>(unfolded);
        for (std::size_t line = 0; line < sizeof *unfolded; line += 64) __builtin_prefetch(bytes + line);
      }
    }
  }
  return count;
}

void FieldWaves::add_corner(std::uint8_t k) {
  const Frames& frames = resolution_.frames();
  FacetSite site;
  site.corner = k;
  site.root = corner[k];
  site.labels = resolution_.labels(corner[k]);
  for (std::uint8_t j = 0; j < 3; ++j) {
    site.attains_corner[j] = j == k || resolution_.attains_along_edge(corner[k], corner[j]);
    if (j != k) site.path_to_corner[j] = path_along_edge(corner[k]);
  }
  predicates::Site<F> numbers;
  if (k == 0) numbers.image = {F(0.0), F(0.0)};
  if (k == 1) numbers.image = {F(1.0), F(0.0)};
  if (k == 2) numbers.image = frame_.apex;
  numbers.weight =
      narrowed(resolution_.distance(corner[k])) / predicates::enclosed_length(frames(3 * face), predicates::unit<double>(0));
  sites.push_back(site);
  sites_.push_back(numbers);
}

const Strip& FieldWaves::strip(std::size_t i) const {
  if (strips_.empty()) strips_.resize(sites.size(), {kNone, {}});
  if (strips_[i].opposite == kNone) strips_[i] = strip_of(resolution_.frames().mesh(), field_, sites[i].window);
  return strips_[i];
}

/// Sorts out the windows of one side as the propagation does, with all of them and the final distances at hand.
void FieldWaves::add_side(std::uint8_t side, Arrivals& arrivals) {
  auto &list = arrivals.all, &kept = arrivals.kept;
  list.clear();
  kept.clear();
  const auto upper = [&](std::uint8_t k) { return resolution_.distance(corner[k % 3]).upper() * (1 + 0x1p-48); };
  arrivals.upper = {upper(side), upper(side + 1)};
  for (WindowId w = field_.first_window[3 * face + side]; w != kNone; w = field_.windows[w].next) {
    Arrival arrival;
    if (arrive(w, side, arrivals, arrival)) list.push_back(arrival);
  }
  std::sort(list.begin(), list.end(),
            [](const Arrival& a, const Arrival& b) { return a.begin != b.begin ? a.begin < b.begin : a.window < b.window; });
  const double length = resolution_.frames()(3 * face + side).length;
  for (Arrival& arrival : list) {
    bool keep = true;
    while (!kept.empty() && keep) {
      const Trim t = trim(kept.back(), arrival, length);
      if (t == Trim::drop_second) keep = false;
      if (t != Trim::drop_first) break;
      kept.pop_back();
    }
    if (keep) kept.push_back(arrival);
  }
  for (const Arrival& arrival : kept) add_window(arrival, side);
}

/// False if the window is certainly nowhere shortest in the facet.
bool FieldWaves::arrive(WindowId window, std::uint8_t side, Arrivals& arrivals, Arrival& arrival) const {
  const Frames& frames = resolution_.frames();
  if (field_.windows[window].dominated()) return false;
  const VertexId root = field_.windows[window].root;
  if (root == corner[side] || root == corner[(side + 1) % 3]) return false;  // the edge itself is the shorter way to its points
  arrival.unfolded = unfolded_ == nullptr ? nullptr : unfolded_->find(window);
  if (arrival.unfolded == nullptr) arrival.unfolded = &arrivals.unfolded.emplace_front(UnfoldedWindows::alone(frames, field_, window));
  if (arrival.unfolded->dead) return false;
  const EdgeFrame<double>& frame = frames(3 * face + side);
  const Ball<double> weight = narrowed(resolution_.distance(root));
  arrival.window = window;
  const auto& [image, cone0, cone1] = arrival.unfolded->at;
  const predicates::Landing l0 = predicates::land(image.mid, cone0.mid, std::max(image.radius, cone0.radius));
  const predicates::Landing l1 = predicates::land(image.mid, cone1.mid, std::max(image.radius, cone1.radius));
  arrival.image = image.mid;
  arrival.begin = std::max(0.0, l0.at - l0.margin);
  arrival.end = std::min(1.0, l1.at + l1.margin);
  arrival.slack = {predicates::rounded_up(2 * l0.margin), predicates::rounded_up(2 * l1.margin)};
  arrival.trimmed = arrival.bounded = 0;  // plays no part here
  arrival.weight = weight.mid();
  arrival.weight_error = predicates::rounded_up(weight.rad());
  arrival.image_error = predicates::rounded_up(image.radius * frame.length);
  if (arrival.begin > arrival.end) return false;
  const double y2 = image.mid.y * image.mid.y;
  const auto low = [&](double x) {
    const double dx = x - arrival.image.x;
    const double d = arrival.weight + frame.length * std::sqrt(dx * dx + y2);
    return d * (1 - 0x1p-48) - arrival.weight_error - arrival.image_error;
  };
  return !(arrivals.upper[0] + arrival.end * frame.length * (1 + 0x1p-48) < low(arrival.end) ||
           arrivals.upper[1] + (1 - arrival.begin) * frame.length * (1 + 0x1p-48) < low(arrival.begin));
}

void FieldWaves::add_window(const Arrival& arrival, std::uint8_t side) {
  const Frames& frames = resolution_.frames();
  const WindowId window = arrival.window;
  const VertexId root = field_.windows[window].root;
  FacetSite site;
  site.window = window;
  site.side = side;
  site.root = root;
  site.labels = resolution_.labels(root);
  note_cone(site, *arrival.unfolded);
  const std::uint8_t opposite = static_cast<std::uint8_t>((side + 2) % 3);
  site.attains_corner[opposite] = resolution_.attains(window, corner[opposite]);
  site.path_to_corner[opposite] = path_through(window);
  const double unit = predicates::unit<double>(0);
  sites_.push_back(make_site<double>(site, arrival.unfolded->at, narrowed(resolution_.distance(root)), frames(3 * face), unit));
  sites.push_back(site);
}

/// The names of the cone's vertices. A strip may turn about a vertex more than once in a lifetime: what bounds the cone is a corner of the facet
/// only if no step since has left it.
void FieldWaves::note_cone(FacetSite& site, const UnfoldedWindows::Entry& unfolded) const {
  const Mesh& mesh = resolution_.frames().mesh();
  for (std::size_t c = 0; c < 2; ++c) {
    const WindowId bound = unfolded.bound[c];
    std::uint64_t path;
    if (bound != kNone) {
      site.cone[c] = mesh.apex(field_.windows[bound].halfedge());
      site.attains_cone[c] = resolution_.attains(bound, site.cone[c]);
      path = path_through(bound);
    } else {
      const HalfedgeId h = field_.windows[unfolded.first].halfedge();
      site.cone[c] = c == 0 ? mesh.origin(h) : mesh.target(h);
      site.attains_cone[c] = resolution_.attains_along_edge(site.root, site.cone[c]);
      path = path_along_edge(site.root);
    }
    const std::size_t k = (site.side + c) % 3;
    if (unfolded.bounds_edge[c]) {
      site.path_to_corner[k] = path;
      site.attains_corner[k] = site.attains_cone[c];
    } else if (std::find(corner.begin(), corner.end(), site.cone[c]) != corner.end()) {
      site.cone[c] = kNone;  // an earlier visit of the corner, unfolded to another place
      site.attains_cone[c] = false;
    }
  }
}

LabelSetId FieldWaves::only_label() const noexcept {
  if (sites.empty()) return kNone;
  for (const FacetSite& s : sites)
    if (s.labels != sites.front().labels) return kNone;
  for (const LabelSetId l : corner_labels)
    if (l != sites.front().labels) return kNone;
  return sites.front().labels;
}

template <class T>
predicates::FacetFrame<Ball<T>> FieldWaves::make_frame(const EdgeFrame<T>& first, double unit) const {
  return {predicates::enclosed_apex(first, unit), predicates::enclosed_length(first, unit).scaled(resolution_.frames().scale())};
}

template <class T>
predicates::Site<Ball<T>> FieldWaves::make_site(const FacetSite& site, const Unfolding<T>& at, const Ball<T>& weight,
                                                const EdgeFrame<T>& first, double unit) const {
  const PlanePoint<Ball<T>> apex = predicates::enclosed_apex(first, unit);
  predicates::Site<Ball<T>> result;
  result.weight = weight / predicates::enclosed_length(first, unit);
  if (site.window == kNone) {
    if (site.corner == 0) result.image = {Ball<T>(0.0), Ball<T>(0.0)};
    if (site.corner == 1) result.image = {Ball<T>(1.0), Ball<T>(0.0)};
    if (site.corner == 2) result.image = apex;
    return result;
  }
  result.has_cone = true;
  result.image = predicates::at_first_side(at.image, site.side, apex);
  result.cone = {predicates::at_first_side(at.cone0, site.side, apex), predicates::at_first_side(at.cone1, site.side, apex)};
  return result;
}

FieldWaves::Precise& FieldWaves::precise() {
  if (!precise_) {
    precise_ = std::make_unique<Precise>();
    precise_->dd_sites.resize(sites.size());
  }
  return *precise_;
}

FieldWaves::Precise::AtBits& FieldWaves::at_bits(int bits) {
  auto [it, added] = precise().at_bits.try_emplace(bits);
  Precise::AtBits& at = it->second;
  if (added) {
    at.sites.resize(sites.size());
    const auto first = at.frames(resolution_.frames(), 3 * face, bits);
    at.frame = std::make_unique<predicates::FacetFrame<M>>(make_frame<Mpfr>(first, predicates::unit<Mpfr>(bits)));
  }
  return at;
}

void FieldWaves::forget_frames() {
  if (!precise_) return;
  for (auto& [bits, at] : precise_->at_bits) at.frames = {};
}

const predicates::FacetFrame<FieldWaves::DD>& FieldWaves::frame(DD) {
  Precise& p = precise();
  if (!p.dd_frame) {
    const auto& first = resolution_.frames().in_double_double(3 * face);
    p.dd_frame = std::make_unique<predicates::FacetFrame<DD>>(make_frame<DoubleDouble>(first, predicates::unit<DoubleDouble>(0)));
  }
  return *p.dd_frame;
}

const predicates::Site<FieldWaves::DD>& FieldWaves::site(std::size_t i, DD) {
  Precise& p = precise();
  if (!p.dd_sites[i]) {
    const auto& first = resolution_.frames().in_double_double(3 * face);
    Unfolding<DoubleDouble> at;
    if (sites[i].window != kNone) at = unfold_double_double(resolution_.frames(), strip(i));
    p.dd_sites[i] = std::make_unique<predicates::Site<DD>>(make_site<DoubleDouble>(
        sites[i], at, resolution_.distance(sites[i].root), first, predicates::unit<DoubleDouble>(0)));
  }
  return *p.dd_sites[i];
}

predicates::FacetFrame<FieldWaves::DD> FieldWaves::precise_frame() {
  return make_frame<DoubleDouble>(resolution_.frames().in_double_double(3 * face), predicates::unit<DoubleDouble>(0));
}

predicates::PreciseWave FieldWaves::precise_wave(std::size_t i) {
  const FacetSite& site = sites[i];
  const auto& first = resolution_.frames().in_double_double(3 * face);
  const DD& distance = resolution_.distance(site.root);
  if (site.window == kNone) return predicates::wave_of_corner(site.corner, distance, first);
  const auto* known = resolution_.images() == nullptr ? nullptr : resolution_.images()->find(site.window);
  return predicates::wave_over_side(known != nullptr ? *known : unfold_double_double(resolution_.frames(), strip(i)).image, site.side, distance, first);
}

const predicates::FacetFrame<FieldWaves::M>& FieldWaves::frame(M, int bits) { return *at_bits(bits).frame; }

const predicates::Site<FieldWaves::M>& FieldWaves::site(std::size_t i, M, int bits) {
  Precise::AtBits& cache = at_bits(bits);
  if (!cache.sites[i]) {
    Unfolding<Mpfr> at;
    if (sites[i].window != kNone) at = unfold_mpfr(resolution_.frames(), strip(i), bits, cache.frames);
    const auto& first = cache.frames(resolution_.frames(), 3 * face, bits);
    cache.sites[i] = std::make_unique<predicates::Site<M>>(
        make_site<Mpfr>(sites[i], at, resolution_.distance(sites[i].root, bits), first, predicates::unit<Mpfr>(bits)));
  }
  return *cache.sites[i];
}

const predicates::FacetFrame<Exact>* FieldWaves::exact_frame() {
  Precise& p = precise();
  if (!p.exact_frame) make_exact();
  return p.exact_frame.get();
}

const predicates::Site<Exact>* FieldWaves::exact_site(std::size_t i) {
  exact_frame();
  auto& site = precise_->exact_sites[i];
  if (!site) site = std::make_unique<predicates::Site<Exact>>(make_exact_site(sites[i]));
  return site.get();
}

bool FieldWaves::exact_is_cheap() {
  std::optional<bool>& known = precise().one_class;
  if (!known) {
    const Frames& frames = resolution_.frames();
    const std::uint32_t here = frames.square_class(face);
    const auto is_here = [&](HalfedgeId h) { return frames.square_class(Mesh::face(h)) == here; };
    known = true;
    for (std::size_t i = 0; i < sites.size() && *known; ++i) {
      if (sites[i].window == kNone) continue;
      const Strip& strip = this->strip(i);
      known = is_here(strip.opposite) &&
              std::all_of(strip.steps.begin(), strip.steps.end(), [&](const predicates::StripStep& step) { return is_here(step.side); });
    }
  }
  return *known;
}

void FieldWaves::make_exact() {
  Precise& p = *precise_;
  const Frames& frames = resolution_.frames();
  const predicates::RootPoint apex = exact_apex(frames, 3 * face);
  p.exact_frame = std::make_unique<predicates::FacetFrame<Exact>>();
  p.exact_frame->apex = {Exact(apex.x), Exact(apex.y)};
  p.exact_unit = sqrt(Exact(frames.exact(face)->squared[0]));
  p.exact_frame->length = p.exact_unit.scaled(frames.scale());
  p.exact_sites.resize(sites.size());
}

/// Numbers that are not to be had are undefined: their signs are empty. Most questions are about images alone, and distances are long sums.
Exact FieldWaves::exact_weight(VertexId root, const Exact& unit) const {
  return Exact::deferred([&resolution = resolution_, root, unit] {
    const auto weight = resolution.exact_distance(root);
    return weight ? *weight / unit : Exact::undefined();
  });
}

predicates::Site<Exact> FieldWaves::make_exact_site(const FacetSite& site) const {
  const auto point = [](const predicates::RootPoint& z) { return PlanePoint<Exact>{Exact(z.x), Exact(z.y)}; };
  const Exact undefined(std::numeric_limits<double>::quiet_NaN());
  const PlanePoint<Exact> nowhere{undefined, undefined}, &apex = precise_->exact_frame->apex;
  predicates::Site<Exact> result;
  result.weight = exact_weight(site.root, precise_->exact_unit);
  result.has_cone = site.window != kNone;
  if (!result.has_cone) {
    result.image = site.corner == 0   ? PlanePoint<Exact>{Exact(0.0), Exact(0.0)}
                   : site.corner == 1 ? PlanePoint<Exact>{Exact(1.0), Exact(0.0)}
                                      : apex;
    return result;
  }
  const auto at = resolution_.exact_unfolding(site.window);
  result.image = at ? to_first_side(point(at->image), site.side, apex) : nowhere;
  result.cone = {at ? to_first_side(point(at->cone0), site.side, apex) : nowhere,
                 at ? to_first_side(point(at->cone1), site.side, apex) : nowhere};
  return result;
}

}  // namespace gvd::kernel
