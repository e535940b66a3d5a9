/// What the strips of a facet's waves prove about one another, without numbers or by algebra over the strips.
#include <algorithm>
#include <string>

#include "facet_waves.hpp"
#include "gvd/kernel/error.hpp"

namespace gvd::kernel {

using predicates::Disc;
using predicates::Strip;
using robust::Ball;
using robust::DoubleDouble;
using robust::Exact;
using robust::Mpfr;

/// Two ways from one root to this facet. Wherever they part, until they meet again, the vertices on the right of one must be those
/// on the left of the other: then the ways enclose nothing else. Round flat vertices alone, either way unfolds the root to one
/// image.
bool FieldWaves::enclose_only_flat(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b) const {
  const Mesh& mesh = resolution_.frames().mesh();
  const auto beside = [&](std::span<const HalfedgeId> part, bool right) {
    std::vector<VertexId> chain;
    for (const HalfedgeId side : part) {  // directed against the half-edge that the way comes in over
      const VertexId v = right ? mesh.origin(side) : mesh.target(side);
      if (chain.empty() || chain.back() != v) chain.push_back(v);
    }
    return chain;
  };
  const auto is_flat = [&](VertexId v) { return kinds_[v] == VertexKind::flat; };  // of 2 pi: between them the two ways cross all faces round it
  while (!a.empty() || !b.empty()) {
    if (!a.empty() && !b.empty() && a.front() == b.front()) {
      a = a.subspan(1), b = b.subspan(1);
      continue;
    }
    std::size_t a_end = 0, b_end = b.size();  // where they meet again
    for (; a_end < a.size(); ++a_end) {
      b_end = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[a_end]) - b.begin());
      if (b_end < b.size()) break;
    }
    const auto of_a = a.first(a_end), of_b = b.first(b_end);
    auto chain = beside(of_a, true);
    if (chain != beside(of_b, false)) {
      chain = beside(of_a, false);
      if (chain != beside(of_b, true)) return false;
    }
    // It is not empty: one of the two goes over another side here, and its chain is that of the other one.
    if (!std::all_of(chain.begin(), chain.end(), is_flat)) return false;
    a = a.subspan(a_end), b = b.subspan(b_end);
  }
  return true;
}

bool FieldWaves::have_one_image(std::size_t left, std::size_t right) {
  if (sites[left].root != sites[right].root) return false;
  return enclose_only_flat(sides_of(strip(left)), sides_of(strip(right)));
}

/// The last window of a strip that turns about a vertex; kNone if none does, or if some do, others follow and then some again: then the strip saw the
/// vertex in several places.
WindowId FieldWaves::last_turn(WindowId strip, VertexId v) const {
  const Mesh& mesh = resolution_.frames().mesh();
  const auto turns = [&](WindowId w) {
    const HalfedgeId h = field_.windows[w].halfedge();
    return mesh.origin(h) == v || mesh.target(h) == v;
  };
  WindowId last = strip;
  while (last != kNone && !turns(last)) last = field_.windows[last].parent;
  WindowId w = last;
  while (w != kNone && turns(w)) w = field_.windows[w].parent;
  while (w != kNone && !turns(w)) w = field_.windows[w].parent;
  return w == kNone ? last : kNone;
}

/// The sides that a strip crosses since it turned about a vertex; empty if it never did, or more than once.
std::optional<FieldWaves::Sides> FieldWaves::sides_since(WindowId strip, VertexId v) const {
  const WindowId last = last_turn(strip, v);
  if (last == kNone) return std::nullopt;
  Sides since;
  for (WindowId w = strip; w != last; w = field_.windows[w].parent) since.push_back(resolution_.frames().mesh().twin(field_.windows[w].halfedge()));
  std::reverse(since.begin(), since.end());
  return since;
}

/// Whether what a strip crosses since window `since` is all that the strip of another one crosses; its own name is kNone if it crosses nothing.
bool FieldWaves::goes_on_as(WindowId strip, WindowId since, WindowId other) const {
  for (; strip != since && other != kNone; strip = field_.windows[strip].parent, other = field_.windows[other].parent)
    if (field_.windows[strip].halfedge() != field_.windows[other].halfedge()) return false;
  return strip == since && other == kNone;
}

/// The window of a strip that has a vertex as its apex; kNone if the strip begins beside the vertex.
WindowId FieldWaves::arrival(WindowId strip, VertexId v) const {
  while (strip != kNone && resolution_.frames().mesh().apex(field_.windows[strip].halfedge()) != v) strip = field_.windows[strip].parent;
  return strip;
}

bool FieldWaves::share_cone_vertex(std::size_t a, std::size_t end_a, std::size_t b, std::size_t end_b) {
  const VertexId v = sites[a].cone[end_a];
  if (v == kNone || sites[b].cone[end_b] != v) return false;
  const auto since = sides_since(sites[a].window, v);
  return since && since == sides_since(sites[b].window, v);
}

bool FieldWaves::are_proved_one_wave(std::size_t a, std::size_t b) {
  if (!resolution_.have_equal_distances(sites[a].root, sites[b].root)) return false;
  return have_one_image_by_algebra(sides_of(strip(a)), sides_of(strip(b)));
}

/// The image of a strip's root, in the frame of the last side as the facet beyond it sees it. `frame_of` gives EdgeFrame<T>.
template <class T, class FrameOf>
Disc<T> FieldWaves::image_of(std::span<const HalfedgeId> sides, const FrameOf& frame_of, double unit) const {
  Disc<T> image = predicates::unfold_first<T>(frame_of(sides[0]), unit).image;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const bool left = sides[i] == Mesh::prev(resolution_.frames().mesh().twin(sides[i - 1]));
    image = predicates::cross(image, frame_of(sides[i]), left, unit);
  }
  return image;
}

/// Whether numbers of type T tell the images apart. As in `show_one_image`.
template <class T, class FrameOf>
bool FieldWaves::have_images_apart(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b, const FrameOf& frame_of, double unit) const {
  const auto may_vanish = [](const Ball<T>& x) { return maybe_sign(x).value_or(robust::Sign::zero) == robust::Sign::zero; };
  const Disc<T> of_a = image_of<T>(a, frame_of, unit);
  Disc<T> of_b = image_of<T>(b, frame_of, unit);
  Ball<T> x = ball_x(of_a), y = ball_y(of_a);
  if (a.back() != b.back()) {
    const std::uint8_t side = side_entered(a);
    const bool left = side == (side_entered(b) + 2) % 3;
    of_b = predicates::cross(of_b, frame_of(3 * face + side), left, unit);
    x = Ball<T>(1.0) - x;
    y = -y;
  }
  x = x - ball_x(of_b);
  y = y - ball_y(of_b);
  return !may_vanish(x) || !may_vanish(y);
}

/// By numbers, of which these many bits cost far less than algebra.
bool FieldWaves::have_images_apart(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b) {
  const Frames& frames = resolution_.frames();
  const auto in_double_double = [&](HalfedgeId h) -> const auto& { return frames.in_double_double(h); };
  if (have_images_apart<DoubleDouble>(a, b, in_double_double, predicates::unit<DoubleDouble>(0))) return true;
  MpfrFrames& known = at_bits(kBitsBeforeAlgebra).frames;
  const auto in_mpfr = [&](HalfedgeId h) -> const auto& { return known(frames, h, kBitsBeforeAlgebra); };
  return have_images_apart<Mpfr>(a, b, in_mpfr, predicates::unit<Mpfr>(kBitsBeforeAlgebra));
}

/// Through two ways that end in this facet, or over one side.
bool FieldWaves::have_one_image_by_algebra(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b) {
  while (a.size() > 1 && b.size() > 1 && a.back() == b.back() && a[a.size() - 2] == b[b.size() - 2])  // from there on they are one way
    a = a.first(a.size() - 1), b = b.first(b.size() - 1);
  return !have_images_apart(a, b) && (show_one_image(a, b) || show_last_common_side_alike(a, b));
}

/// Whether two ways part over a side and then show it in one place, both ends of it: so whatever is behind.
bool FieldWaves::show_last_common_side_alike(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b) const {
  const auto common = static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
  if (common == 0) return false;
  const Mesh& mesh = resolution_.frames().mesh();
  const HalfedgeId side = a[common - 1];
  const auto shows_alike = [&](VertexId v) {
    const auto since = [&](std::span<const HalfedgeId> way) {  // the sides crossed after v was left; none if it was met again
      way = way.subspan(common);
      const auto is_end = [&](HalfedgeId h) { return mesh.origin(h) == v || mesh.target(h) == v; };
      while (!way.empty() && is_end(way.front())) way = way.subspan(1);
      return std::none_of(way.begin(), way.end(), is_end) ? way : std::span<const HalfedgeId>();
    };
    const auto since_a = since(a), since_b = since(b);
    return !since_a.empty() && !since_b.empty() && show_one_image(since_a, since_b);
  };
  return shows_alike(mesh.origin(side)) && shows_alike(mesh.target(side));
}

/// Over different sides, one image is seen from behind the other's side: 1 - z.
bool FieldWaves::show_one_image(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b) const {
  const predicates::StripProgram of_a = way_program(resolution_.frames(), a);
  const bool one_side = a.back() == b.back();
  const predicates::StripProgram of_b = one_side ? way_program(resolution_.frames(), b) : program_beyond(side_entered(a), b);
  const std::array<long, 4> x = one_side ? std::array<long, 4>{0, 1, 0, 0} : std::array<long, 4>{0, -1, 0, 1};
  if (!are_proved_equal(of_a.value(x), of_b.value({0, 1, 0, 0}))) return false;
  return are_proved_equal(of_a.value({0, 0, one_side ? 1 : -1, 0}), of_b.value({0, 0, 1, 0}));
}

bool FieldWaves::are_mirror_images(std::size_t entering, std::size_t other) {
  const FacetSite &a = sites[entering], &b = sites[other];
  if (b.window == kNone ? b.corner != (a.side + 2) % 3 : b.side == a.side) return false;
  if (!resolution_.have_equal_distances(a.root, b.root)) return false;
  return show_mirror_images(a.side, sides_of(strip(entering)), b.window == kNone ? Sides() : sides_of(strip(other)));
}

bool FieldWaves::is_mirrored_at_cone_vertex(std::size_t parent, std::size_t end, std::size_t other, std::uint8_t side) {
  const FacetSite &a = sites[parent], &b = sites[other];
  const VertexId v = a.cone[end];
  if (b.window == kNone || !a.attains_cone[end] || (a.side == side) == (b.side == side)) return false;
  const auto since = sides_since(a.window, v);
  if (!since || since->empty() || !resolution_.have_equal_distances(v, b.root)) return false;
  const Sides own = sides_of(strip(other));
  return a.side == side ? show_mirror_images(side, *since, own) : show_mirror_images(side, own, *since);
}

bool FieldWaves::is_mirrored_on_strip(std::size_t parent, std::size_t other, std::uint8_t side) {
  const FacetSite &a = sites[parent], &b = sites[other];
  const bool at_corner = b.window == kNone, entering = a.window != kNone && a.side == side;
  if (a.window == kNone || (at_corner ? !entering || b.corner != (side + 2) % 3 : entering == (b.side == side))) return false;
  const Mesh& mesh = resolution_.frames().mesh();
  std::vector<VertexId> seen;
  for (WindowId w = a.window; w != kNone; w = field_.windows[w].parent) {
    const HalfedgeId h = field_.windows[w].halfedge();
    for (const VertexId v : {mesh.origin(h), mesh.target(h)}) {
      if (std::find(seen.begin(), seen.end(), v) != seen.end()) continue;
      seen.push_back(v);
      if (!resolution_.have_equal_distances(v, b.root) || !comes_nearest_to(a.window, v)) continue;
      const auto since = sides_since(a.window, v);
      if (!since || since->empty()) continue;
      const Sides own = at_corner ? Sides() : sides_of(strip(other));
      if (entering ? show_mirror_images(side, *since, own) : show_mirror_images(side, own, *since)) return true;
    }
  }
  return false;
}

bool FieldWaves::are_as_far_from_corner(std::size_t a, std::size_t b, std::uint8_t k) {
  if (sites[a].window == kNone || sites[b].window == kNone || !resolution_.have_equal_distances(sites[a].root, sites[b].root)) return false;
  const auto squared = [&](std::size_t i) {
    const std::uint8_t side = sites[i].side;
    const bool at_target = k == (side + 1) % 3, at_apex = k == (side + 2) % 3;
    return way_program(resolution_.frames(), sides_of(strip(i))).squared_distance(*resolution_.frames().for_program(face), side, at_target ? 1 : 0, at_apex ? 1 : 0);
  };
  return are_proved_equal(squared(a), squared(b));
}

/// Of two ways, of which the first comes over a side and the other does not, or is none: the corner opposite. The mirror image of z is conj(1 - z) as seen
/// from behind the side.
bool FieldWaves::show_mirror_images(std::uint8_t side, std::span<const HalfedgeId> entering, std::span<const HalfedgeId> other) const {
  const predicates::StripProgram of_a = way_program(resolution_.frames(), entering);
  const predicates::StripProgram of_b =
      other.empty() ? predicates::StripProgram(*resolution_.frames().for_program(face), side) : program_beyond(side, other);
  if (!are_proved_equal(of_a.value({0, -1, 0, 1}), of_b.value({0, 1, 0, 0}))) return false;
  return are_proved_equal(of_a.value({0, 0, 1, 0}), of_b.value({0, 0, 1, 0}));
}

/// The side of this facet over which a strip comes in.
std::uint8_t FieldWaves::side_entered(std::span<const HalfedgeId> sides) const {
  return static_cast<std::uint8_t>(resolution_.frames().mesh().twin(sides.back()) % 3);
}

/// The image of a strip that comes over another side, in the frame of `side` as the neighbour there sees it: in which an image z in the facet's own
/// frame of that side is 1 - z.
predicates::StripProgram FieldWaves::program_beyond(std::uint8_t side, std::span<const HalfedgeId> sides) const {
  predicates::StripProgram program = way_program(resolution_.frames(), sides);
  program.cross(*resolution_.frames().for_program(face), side, side == (side_entered(sides) + 2) % 3);
  return program;
}

/// The nearest way to the root of `relay` must be the parent's own, as far as that goes, and then turn about it into the strip of
/// `relay`.
bool FieldWaves::is_own_relay(std::size_t parent, std::size_t relay) {
  return has_relay_on_strip(parent, relay) || has_relay_on_other_way(parent, relay);
}

/// Whether the parent's strip turns about the relay, which it arrives at by the nearest way, and then sees it where the relay's own strip does.
bool FieldWaves::has_relay_on_strip(std::size_t parent, std::size_t relay) {
  const VertexId v = sites[relay].root;
  const WindowId turn = last_turn(sites[parent].window, v);
  if (turn == kNone) return false;
  if (!goes_on_as(sites[parent].window, turn, sites[relay].window) && !is_image_of_root(*sides_since(sites[parent].window, v), relay)) return false;
  return comes_nearest_to(turn, v);  // from there on it may see the vertex in other places
}

/// Whether a strip shows a vertex, about which it turned, as far as that is.
bool FieldWaves::comes_nearest_to(WindowId strip, VertexId v) const {
  if (v == field_.windows[strip].root) return false;  // where it began
  const WindowId w = arrival(strip, v);
  if (w == strip) return false;  // it comes to the vertex once more, as a corner of the facet
  if (w == kNone) return resolution_.attains_along_edge(field_.windows[strip].root, v);
  return resolution_.attains(w, v) || resolution_.is_as_far(w, v);
}

/// Whether the relay's image is that of its root by another way, which ends in this facet: with only flat vertices between, or by algebra.
bool FieldWaves::is_image_of_root(const Sides& way, std::size_t relay) {
  if (way.empty() || sites[relay].window == kNone) return false;
  const Sides own = sides_of(strip(relay));
  return enclose_only_flat(way, own) || have_one_image_by_algebra(way, own);
}

/// Whether a strip's cone ends at a vertex, which may be a corner of the facet in another place.
bool FieldWaves::bounds_cone(WindowId strip, std::size_t end, VertexId v) const {
  const Mesh& mesh = resolution_.frames().mesh();
  const UnfoldedWindows::Entry unfolded = UnfoldedWindows::alone(resolution_.frames(), field_, strip);
  const HalfedgeId first = field_.windows[unfolded.first].halfedge();
  if (unfolded.bound[end] == kNone) return v == (end == 0 ? mesh.origin(first) : mesh.target(first));
  return v == mesh.apex(field_.windows[unfolded.bound[end]].halfedge());
}

bool FieldWaves::is_relay_on_ray(std::size_t parent, std::size_t end, std::size_t relay) {
  const WindowId strip = sites[parent].window;
  const VertexId bound = sites[parent].cone[end], v = sites[relay].root;
  if (bound == kNone) return bounds_cone(strip, end, v) && has_relay_on_strip(parent, relay);
  if (!sites[parent].attains_cone[end] || !sides_since(strip, bound)) return false;
  if (!has_relay_on_strip(parent, relay)) return false;
  return v == bound || comes_straight_through(v, bound, strip) || comes_straight_through(bound, v, strip);
}

/// Of two vertices about which a strip turns, both as far from its root as is straight: whether a nearest path to the farther one comes from the nearer
/// one through the faces of the strip. Then the lengths add up, so the three are on one line.
bool FieldWaves::comes_straight_through(VertexId nearer, VertexId farther, WindowId strip) const {
  const WindowId end = arrival(strip, farther);
  const auto between = sides_since(end, nearer);
  if (!between) return false;
  for (std::uint32_t c = field_.first_candidate[farther]; c != kNone; c = field_.candidates[c].next) {
    const Candidate& way = field_.candidates[c];
    if (way.via != nearer) continue;
    if (way.window == kNone ? between->empty() : sides_of(strip_of(resolution_.frames().mesh(), field_, way.window)) == *between) return true;
  }
  return false;
}

/// The sides crossed when one turns about a vertex, from the first of them until face `end`, which is at that vertex, too, is reached; empty if that would leave the mesh.
std::optional<FieldWaves::Sides> FieldWaves::turn_about(HalfedgeId first, bool left, FaceId end) const {
  const Mesh& mesh = resolution_.frames().mesh();
  Sides sides;
  HalfedgeId side = first;
  for (;;) {
    sides.push_back(side);
    const HalfedgeId in = mesh.twin(side);
    if (in == kNone) return std::nullopt;
    if (Mesh::face(in) == end) return sides;
    side = left ? Mesh::next(in) : Mesh::prev(in);
    if (side == first) throw InternalError("face " + std::to_string(end) + " is not at the vertex that a way turns about");
  }
}

/// A way to vertex v and on about it to face `end`; empty if it would leave the mesh.
std::optional<FieldWaves::Sides> FieldWaves::way_about(const Candidate& way, VertexId v, bool left, FaceId end) const {
  const Mesh& mesh = resolution_.frames().mesh();
  if (way.window == kNone) {  // along an edge: the face beside it opposite v's next side
    HalfedgeId edge = resolution_.edge_between(way.via, v);
    if ((mesh.origin(edge) == v) == left) edge = mesh.twin(edge);
    if (edge == kNone) return std::nullopt;
    return turn_about(left ? Mesh::next(edge) : Mesh::prev(edge), left, end);
  }
  Sides sides = sides_of(strip_of(mesh, field_, way.window));
  const HalfedgeId last = field_.windows[way.window].halfedge();
  if (Mesh::face(last) == end) return sides;
  const auto turn = turn_about(left ? Mesh::prev(last) : Mesh::next(last), left, end);
  if (!turn) return std::nullopt;
  sides.insert(sides.end(), turn->begin(), turn->end());
  return sides;
}

/// The same where the parent's image is that of the way through the relay: because they have only flat vertices between them, or by algebra.
bool FieldWaves::has_relay_on_other_way(std::size_t parent, std::size_t relay) {
  const VertexId v = sites[relay].root;
  const Sides own = sides_of(strip(parent));
  const Sides rest = sites[relay].window == kNone ? Sides{} : sides_of(strip(relay));
  const FaceId end = rest.empty() ? face : Mesh::face(rest.front());
  for (std::uint32_t c = field_.first_candidate[v]; c != kNone; c = field_.candidates[c].next) {
    if (field_.candidates[c].via != sites[parent].root) continue;
    for (const bool left : {true, false}) {
      auto way = way_about(field_.candidates[c], v, left, end);
      if (!way) continue;
      way->insert(way->end(), rest.begin(), rest.end());
      if (enclose_only_flat(own, *way) || have_one_image_by_algebra(own, *way)) return true;
    }
  }
  return false;
}

}  // namespace gvd::kernel
