#include <algorithm>
#include <optional>
#include <string>

#include "gvd/kernel/error.hpp"
#include "node_numbers.hpp"
#include "subdivision.hpp"
#include "wave_numbers.hpp"

namespace gvd::kernel::subdivision {

using predicates::Predicate;
using robust::MaybeSign;
using robust::Sign;
using robust::Stage;

/// The two sides of one edge, both in the order of the half-edge of the left facet.
struct EdgeJoiner::View {
  HalfedgeId h, twin;
  const Skeleton &left, &right;
  const SideView &of_left, &of_right;
};

namespace {

/// One node or wave on one side of the edge.
struct Shore {
  const Skeleton& facet;
  std::uint32_t side;
  bool against;  ///< the side runs against the direction in which the edge is read
};

template <class NT>
NT parameter(const Shore& shore, std::uint32_t node, int bits) {
  NT t = side_parameter<NT>(*shore.facet.waves, *shore.facet.tessellation, node, bits);
  return shore.against ? NT(1.0) - t : t;
}

/// A wave in units of the edge: foot and height of its image, weight.
template <class NT>
struct EdgeWave {
  NT along, height, weight;
};

template <class NT>
EdgeWave<NT> edge_wave(const Shore& shore, std::uint32_t site, int bits) {
  const auto& s = site_in<NT>(*shore.facet.waves, site, bits);
  const auto& frame = frame_in<NT>(*shore.facet.waves, bits);
  const auto line = predicates::side_line(frame, shore.side);
  const auto z = seen_from_side(line, s.image);
  return {shore.against ? NT(1.0) - z.x : z.x, abs(z.y), s.weight / sqrt(line.square)};
}

/// Whether the facet and all its waves can be had as exact numbers.
bool has_exact(const Skeleton& facet) {
  if (facet.waves->exact_frame() == nullptr) return false;
  for (std::size_t i = 0; i < facet.waves->sites.size(); ++i)
    if (facet.waves->exact_site(i) == nullptr) return false;
  return true;
}

bool nonzero(const MaybeSign& sign) { return sign.has_value() && *sign != Sign::zero; }

/// Whether two waves certainly do not tie along an interval of the edge: they are neither images of equal weight that are equal or
/// mirrored in the edge, nor both on the line of the edge with a difference of weights that is their distance.
template <class NT>
bool certainly_no_tie(const Shore& a, std::uint32_t site_a, const Shore& b, std::uint32_t site_b, int bits) {
  const EdgeWave<NT> x = edge_wave<NT>(a, site_a, bits), y = edge_wave<NT>(b, site_b, bits);
  const NT weight = x.weight - y.weight, along = x.along - y.along;
  const bool not_mirrored = nonzero(maybe_sign(weight)) || nonzero(maybe_sign(along)) || nonzero(maybe_sign(x.height - y.height));
  const bool not_on_line =
      nonzero(maybe_sign(x.height)) || nonzero(maybe_sign(y.height)) || nonzero(maybe_sign(square(weight) - square(along)));
  return not_mirrored && not_on_line;
}

/// Whether the two sides cannot differ along the stretch, however short: everywhere the label sets do differ, and no two waves tie.
template <class NT>
bool impossible(std::span<const Piece> of_left, std::span<const Piece> of_right, const Shore& left, const Shore& right, int bits) {
  for (const Piece& a : of_left)
    for (const Piece& b : of_right)
      if (a.labels == b.labels || !certainly_no_tie<NT>(left, a.site, right, b.site, bits)) return false;
  return true;
}

/// The pieces after event `from` up to the next essential event or the end of the side.
std::span<const Piece> pieces_after(const SideView& view, std::size_t from) {
  std::size_t last = from + 1;
  while (last < view.events.size() && !view.events[last].essential) ++last;
  return {view.pieces.data() + from + 1, view.pieces.data() + last + 1};
}
std::span<const Piece> pieces_before(const SideView& view, std::size_t to) {
  std::size_t first = to;
  while (first > 0 && !view.events[first - 1].essential) --first;
  return {view.pieces.data() + first, view.pieces.data() + to + 1};
}

/// The pieces before, between and after the events [from, to).
std::span<const Piece> pieces_from(const SideView& view, std::size_t from, std::size_t to) {
  return {view.pieces.data() + from, view.pieces.data() + to + 1};
}

enum class Verdict : std::uint8_t { less, equal, greater };

/// What one stage says about the order of two events.
template <class NT>
std::optional<Verdict> order_in(const Shore& left, std::uint32_t left_node, const Shore& right, std::uint32_t right_node,
                                const std::array<std::span<const Piece>, 2>& if_less,
                                const std::array<std::span<const Piece>, 2>& if_greater, int bits) {
  const MaybeSign sign = maybe_sign(parameter<NT>(left, left_node, bits) - parameter<NT>(right, right_node, bits));
  if (sign == Sign::negative) return Verdict::less;
  if (sign == Sign::positive) return Verdict::greater;
  if (sign == Sign::zero) return Verdict::equal;
  if (impossible<NT>(if_less[0], if_less[1], left, right, bits) && impossible<NT>(if_greater[0], if_greater[1], left, right, bits))
    return Verdict::equal;
  return std::nullopt;
}

}  // namespace

/// A window goes over half-edge h to its child, a corner's wave to the windows that start there.
bool EdgeJoiner::goes_over(const DiagramInput& in, HalfedgeId h, const FacetSite& a, const FacetSite& b) {
  const HalfedgeId twin = in.refined.twin(h);
  const bool a_comes_over = a.window != kNone && a.side == h % 3;
  const bool b_comes_over = b.window != kNone && b.side == twin % 3;
  if (a_comes_over == b_comes_over) return !a_comes_over && a.window == kNone && b.window == kNone && a.root == b.root;
  const FacetSite &child = a_comes_over ? a : b, &other = a_comes_over ? b : a;
  const WindowId parent = in.window(child.window).parent;
  if (other.window != kNone) return parent == other.window;
  return parent == kNone && child.root == other.root;
}

bool EdgeJoiner::same_wave(const DiagramInput& in, HalfedgeId h, const Skeleton& left, std::uint32_t left_site,
                           const Skeleton& right, std::uint32_t right_site) {
  return any_pair(left, left_site, right, right_site,
                  [&](const FacetSite& a, const FacetSite& b) { return goes_over(in, h, a, b); });
}

bool EdgeJoiner::identical(const View& view, const Event& a, const Event& b) const {
  const Piece &left_before = view.of_left.pieces[a.before], &right_before = view.of_right.pieces[b.before];
  const Piece &left_after = view.of_left.pieces[a.after], &right_after = view.of_right.pieces[b.after];
  return left_before.labels == right_before.labels && left_after.labels == right_after.labels &&
         same_wave(in_, view.h, view.left, left_before.last_site, view.right, right_before.last_site) &&
         same_wave(in_, view.h, view.left, left_after.site, view.right, right_after.site);
}

bool EdgeJoiner::are_identical(HalfedgeId h, const Skeleton& left, const Skeleton& right) const {
  const HalfedgeId twin = in_.refined.twin(h);
  if (left.sides[h % 3].pieces.front().labels != right.sides[twin % 3].pieces.back().labels) return false;  // the edge itself is a border there
  if (left.sides[h % 3].events.empty() && right.sides[twin % 3].events.empty()) return true;
  reversed_.assign_reversed(right.sides[twin % 3]);
  const View view{h, twin, left, right, left.sides[h % 3], reversed_};
  const auto is_essential = [](const Event& event) { return event.essential; };
  auto l = view.of_left.events.begin(), r = view.of_right.events.begin();
  for (;; ++l, ++r) {
    l = std::find_if(l, view.of_left.events.end(), is_essential);
    r = std::find_if(r, view.of_right.events.end(), is_essential);
    if (l == view.of_left.events.end() || r == view.of_right.events.end()) return l == view.of_left.events.end() && r == view.of_right.events.end();
    if (!identical(view, *l, *r)) return false;
  }
}

/// Whether either point lies on one boundary ray, which comes over the edge: that of a window and of its child, if the same vertex bounds both cones. (A
/// child that is bounded by the apex of its parent's facet has another name there than the parent, which is never bounded by it.)
bool EdgeJoiner::are_on_one_ray(const View& view, const Event& a, const Event& b) const {
  if (view.left.waves == nullptr || view.right.waves == nullptr) return false;
  const auto &of_left = view.left.tessellation->nodes[a.node], &of_right = view.right.tessellation->nodes[b.node];
  if (of_left.ray == FacetTessellation::kNoSite || of_right.ray == FacetTessellation::kNoSite || of_left.ray_end != of_right.ray_end) return false;
  const FacetSite &left = view.left.waves->sites[of_left.ray], &right = view.right.waves->sites[of_right.ray];
  const VertexId bound = left.cone[of_left.ray_end];
  return bound != kNone && bound == right.cone[of_right.ray_end] && goes_over(in_, view.h, left, right);
}

/// Whether one wave takes over from another on either side, and what takes over is as far all along the edge, and what it takes over from: along a
/// line one wave overtakes another one once. (Facets run along their edge in opposite directions.)
bool EdgeJoiner::cross_alike(const View& view, const Event& a, const Event& b) const {
  if (view.left.waves == nullptr || view.right.waves == nullptr) return false;
  const auto &of_left = view.left.tessellation->nodes[a.node], &of_right = view.right.tessellation->nodes[b.node];
  const auto is_overtaking = [](const FacetTessellation::Node& node) {
    return node.kind == FacetTessellation::Node::Kind::side && node.ray == FacetTessellation::kNoSite && node.defining[0] != FacetTessellation::kNoSite;
  };
  if (!is_overtaking(of_left) || !is_overtaking(of_right)) return false;
  const auto are_as_far = [&](std::uint32_t left_site, std::uint32_t right_site) {
    if (same_wave(in_, view.h, view.left, left_site, view.right, right_site)) return true;
    return in_.as_far_along && in_.as_far_along(view.h, view.left.waves->sites[left_site], view.right.waves->sites[right_site]);
  };
  return are_as_far(of_left.defining[0], of_right.defining[1]) && are_as_far(of_left.defining[1], of_right.defining[0]);
}

EdgeJoiner::Order EdgeJoiner::compare(const View& view, std::size_t left_event, std::size_t right_event) {
  const Event &a = view.of_left.events[left_event], &b = view.of_right.events[right_event];
  if (identical(view, a, b) || are_on_one_ray(view, a, b)) {
    predicates::count(decisions_, Predicate::edge_tie, Stage::identity);
    return Order::equal;
  }
  const Shore left{view.left, view.h % 3, false}, right{view.right, view.twin % 3, true};
  const std::array if_less{pieces_after(view.of_left, left_event), pieces_before(view.of_right, right_event)};
  const std::array if_greater{pieces_before(view.of_left, left_event), pieces_after(view.of_right, right_event)};
  const auto verdict = [&]<class NT>(const NT&, Stage stage, int bits) {
    const auto answer = order_in<NT>(left, a.node, right, b.node, if_less, if_greater, bits);
    if (answer) predicates::count(decisions_, Predicate::edge_tie, stage);
    return answer;
  };
  auto answer = verdict(FacetWaves::F(), Stage::filter, 0);
  if (!answer) answer = verdict(FacetWaves::DD(), Stage::double_double, 0);
  if (!answer && cross_alike(view, a, b)) {
    predicates::count(decisions_, Predicate::edge_tie, Stage::algebra);
    return Order::equal;
  }
  for (const int bits : {128, 256, 512, 1024})
    if (!answer) answer = verdict(FacetWaves::M(), Stage::mpfr, bits);
  if (!answer && has_exact(view.left) && has_exact(view.right)) answer = verdict(robust::Exact(), Stage::algebra, 0);
  if (!answer) return Order::unknown;
  return *answer == Verdict::less ? Order::less : *answer == Verdict::greater ? Order::greater : Order::equal;
}

void EdgeJoiner::join(HalfedgeId h, const Skeleton& left, const Skeleton& right, Joint& joint) {
  const HalfedgeId twin = in_.refined.twin(h);
  reversed_.assign_reversed(right.sides[twin % 3]);
  const View view{h, twin, left, right, left.sides[h % 3], reversed_};
  const auto list_essential = [](const SideView& side, std::vector<std::size_t>& list) {
    list.clear();
    for (std::size_t i = 0; i < side.events.size(); ++i)
      if (side.events[i].essential) list.push_back(i);
  };
  list_essential(view.of_left, left_events_);
  list_essential(view.of_right, right_events_);
  joint.stations.clear();
  joint.decided = merge(view, left_events_, right_events_, joint.stations) && insert_inner_events(view, joint);
  if (!joint.decided)
    predicates::undecided(
        decisions_, Predicate::edge_tie,
        "order of the points where regions meet on side " + std::to_string(h % 3) + " of facet " + std::to_string(left.face));
}

/// Merges two ascending lists of events. False if an order is unknown.
bool EdgeJoiner::merge(const View& view, std::span<const std::size_t> left, std::span<const std::size_t> right,
                       std::vector<Station>& out) {
  std::size_t i = 0, j = 0;
  while (i < left.size() || j < right.size()) {
    Order order = i == left.size() ? Order::greater : Order::less;
    if (i < left.size() && j < right.size()) order = compare(view, left[i], right[j]);
    if (order == Order::unknown) return false;
    Station station;
    if (order != Order::greater) station.node_left = view.of_left.events[left[i++]].node;
    if (order != Order::less) station.node_right = view.of_right.events[right[j++]].node;
    out.push_back(station);
  }
  return true;
}

/// Two facets that show different label sets along their edge have waves that tie along it.
bool EdgeJoiner::contradict(const View& view, std::span<const Piece> of_left, std::span<const Piece> of_right) const {
  const Shore left{view.left, view.h % 3, false}, right{view.right, view.twin % 3, true};
  const bool tessellated = view.left.waves != nullptr && view.right.waves != nullptr;
  if (tessellated && !impossible<FacetWaves::DD>(of_left, of_right, left, right, 0)) return false;
  if (all_decided(decisions_))
    throw InternalError("facets " + std::to_string(view.left.face) + " and " + std::to_string(view.right.face) +
                        ": different label sets along their edge, where no two waves tie");
  return true;
}

/// The inner events [from, to) of one side that lie between two consecutive stations; one that lies in the very place of either
/// becomes a part of it, and the last one passed before the stretch is noted. Stations of the own side bound them by their order; the others are
/// compared. Nothing if that fails.
std::optional<std::vector<std::size_t>> EdgeJoiner::inner_events(const View& view, bool of_left, std::size_t from, std::size_t to,
                                                                 Station* before, Station* behind) {
  const SideView& side = of_left ? view.of_left : view.of_right;
  const auto index_of = [](std::span<const Event> events, std::uint32_t node) {
    return static_cast<std::size_t>(std::find_if(events.begin(), events.end(), [&](const Event& e) { return e.node == node; }) - events.begin());
  };
  const auto order_against = [&](std::size_t event, const Station* station) {
    const std::uint32_t own = of_left ? station->node_left : station->node_right;
    if (own == side.events[event].node) return Order::equal;
    if (own != kNone) return event < index_of(side.events, own) ? Order::less : Order::greater;
    const std::size_t other =
        of_left ? index_of(view.of_right.events, station->node_right) : index_of(view.of_left.events, station->node_left);
    if (of_left) return compare(view, event, other);
    const Order order = compare(view, other, event);
    return order == Order::less ? Order::greater : order == Order::greater ? Order::less : order;
  };
  std::vector<std::size_t> found;
  for (std::size_t event = from; event < to; ++event) {
    const Order low = before == nullptr ? Order::greater : order_against(event, before);
    const Order high = behind == nullptr ? Order::less : order_against(event, behind);
    if (low == Order::unknown || high == Order::unknown) return std::nullopt;
    for (Station* station : {low == Order::equal ? before : nullptr, high == Order::equal ? behind : nullptr})
      if (station != nullptr) (of_left ? station->node_left : station->node_right) = side.events[event].node;
    if (of_left && low == Order::less && before->node_left == kNone) before->passed_left = side.events[event].node;
    if (!of_left && high == Order::greater && behind->node_right == kNone && behind->passed_right == kNone) behind->passed_right = side.events[event].node;
    if (low == Order::greater && high == Order::less) found.push_back(event);
  }
  return found;
}

/// Where the edge itself is a piece of a GVD edge, the waves change along it, too: the events that do not change a label set become
/// stations.
bool EdgeJoiner::insert_inner_events(const View& view, Joint& joint) {
  const auto essential_from = [](const SideView& side, std::size_t k) {
    while (k < side.events.size() && !side.events[k].essential) ++k;
    return k;
  };
  std::vector<Station>& all = all_stations_;
  all.clear();
  std::size_t i = 0, j = 0;  // events of either side from the last essential one on
  for (std::size_t gap = 0; gap <= joint.stations.size(); ++gap) {
    Station* before = gap == 0 ? nullptr : &all.back();  // the one before the gap
    Station* behind = gap == joint.stations.size() ? nullptr : &joint.stations[gap];
    const bool left_goes_on = behind != nullptr && behind->node_left != kNone,
               right_goes_on = behind != nullptr && behind->node_right != kNone;
    const std::size_t i_end = essential_from(view.of_left, i), j_end = essential_from(view.of_right, j);
    if (view.of_left.pieces[i].labels != view.of_right.pieces[j].labels) {
      if (contradict(view, pieces_from(view.of_left, i, i_end), pieces_from(view.of_right, j, j_end))) return false;
      const auto l = inner_events(view, true, i, i_end, before, behind);
      const auto r = inner_events(view, false, j, j_end, before, behind);
      if (!l || !r || !merge(view, *l, *r, all)) return false;
    }
    if (behind == nullptr) break;
    all.push_back(*behind);
    if (left_goes_on) i = i_end + 1;
    if (right_goes_on) j = j_end + 1;
  }
  std::swap(joint.stations, all);
  return true;
}

}  // namespace gvd::kernel::subdivision
