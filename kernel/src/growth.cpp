#include "growth.hpp"

#include <algorithm>

namespace gvd::kernel {

using predicates::Predicate;
using predicates::operator-;
using robust::MaybeSign;
using robust::Sign;
using Node = FacetTessellation::Node;
using Found = BisectorVertices::Found;

void Growth::run(const std::vector<Occurrence>& outline) {
  size_ = outline.size();
  if (size_ < 2) return;
  count_.assign(contenders_.size(), 0);
  for (std::uint32_t i = 0; i < size_; ++i) {
    const auto n = static_cast<std::uint32_t>(size_);
    open_.push_back({outline[i].contender, outline[i].node_after, (i + 1) % n, (i + n - 1) % n});
    if (count_[outline[i].contender]++ == 0) listed_.push_back(outline[i].contender);
  }
  vertices_.set_rivals(listed_);
  vertices_.set_outline(result_);
  while (size_ > 2) {
    if (close_one()) continue;
    if (!ladder_.failed()) ladder_.fail(Predicate::bisector_vertex, "no region can be closed: the waves are inconsistent");
    return;
  }
  if (size_ == 0) return;
  const Open &a = open_[first_], &b = open_[a.next];
  add_arc(a.contender, b.contender, a.node_after, b.node_after);
}

/// Growth closes the regions that meet in one vertex one after the other: between them, arcs have no length.
void Growth::add_arc(std::uint32_t left, std::uint32_t right, std::uint32_t from, std::uint32_t to) {
  if (from == to) return;
  result_.arcs.push_back({contenders_[left].site, contenders_[right].site, from, to, contenders_.tangent(left, right)});
}

std::uint32_t Growth::node_of(Found& vertex) {
  if (vertex.id != FacetTessellation::Piece::kNoNode) return vertex.id;
  vertex.id = static_cast<std::uint32_t>(result_.nodes.size());
  result_.nodes.push_back(vertex.node);
  return vertex.id;
}

/// Takes the occurrence out of the list.
void Growth::remove(std::uint32_t at) {
  const Open& gone = open_[at];
  --count_[gone.contender];
  open_[gone.previous].next = gone.next;
  open_[gone.next].previous = gone.previous;
  if (first_ == at) first_ = gone.previous;
  --size_;
}

/// Closes the first occurrence for which that is proved right.
bool Growth::close_one() {
  std::uint32_t at = first_;
  for (std::size_t tried = 0; tried < size_; ++tried, at = open_[at].next) {
    const std::optional<bool> closed = try_close(at);
    if (!closed) return false;
    if (*closed) return true;
  }
  return false;
}

std::optional<bool> Growth::try_close(std::uint32_t at) {
  const Open& j = open_[at];
  Open &i = open_[j.previous], &k = open_[j.next];
  if (i.contender == k.contender) {
    const auto closes = closes_by_arc(at);
    if (!closes || !*closes) return closes;
    add_arc(i.contender, j.contender, i.node_after, j.node_after);
    const std::uint32_t twin = j.next;
    i.node_after = k.node_after;
    remove(at);
    remove(twin);
    return true;
  }
  Found* vertex = vertices_.find(i.contender, j.contender, k.contender);
  if (vertex == nullptr) return std::nullopt;
  if (!vertex->exists) return false;
  const auto closes = closes_at(at, *vertex);
  if (!closes || !*closes) return closes;
  const std::uint32_t node = node_of(*vertex);
  std::erase(vertex->open, j.contender);
  add_arc(i.contender, j.contender, i.node_after, node);
  add_arc(j.contender, k.contender, j.node_after, node);
  if (size_ == 3) {
    add_arc(k.contender, i.contender, k.node_after, node);
    size_ = 0;
    return true;
  }
  i.node_after = node;
  remove(at);
  return true;
}

/// Whether j, between two occurrences of i, is bounded by one arc from node to node: no third region touches it there.
std::optional<bool> Growth::closes_by_arc(std::uint32_t at) {
  const std::uint32_t i = open_[open_[at].previous].contender, j = open_[at].contender;
  const std::uint32_t from = open_[open_[at].previous].node_after, to = open_[at].node_after;
  if (count_[j] > 1) return reaches(i, j, from, to, result_.nodes[to], i);
  const auto touched = touches_another(i, j, j, nullptr);
  if (!touched) return std::nullopt;
  return !*touched;
}

/// Whether the two arcs of j's open occurrence both end in the vertex (i, j, k). All three regions are single-connected and touch the
/// outline, and what is open is the truth so far; so if each has one occurrence, the boundary of j cannot but change from i to k once.
std::optional<bool> Growth::closes_at(std::uint32_t at, const Found& vertex) {
  const Open& open = open_[at];
  const std::uint32_t i = open_[open.previous].contender, j = open.contender, k = open_[open.next].contender;
  if (!vertex.follows(i, j) || !vertex.follows(j, k)) return false;  // another region has a part there in between
  if (count_[i] == 1 && count_[j] == 1 && count_[k] == 1) return true;
  if (count_[j] == 1) {  // then every open vertex at j belongs to this stretch of its boundary
    const auto before = touches_another(i, j, k, &vertex);
    if (!before || *before) return before ? std::optional(false) : std::nullopt;
    const auto after = touches_another(j, k, i, &vertex);
    if (!after) return std::nullopt;
    return !*after;
  }
  const std::uint32_t none = FacetTessellation::Piece::kNoNode;
  const auto left = reaches(i, j, open_[open.previous].node_after, none, vertex.node, k);
  if (!left || !*left) return left;
  return reaches(j, k, open.node_after, none, vertex.node, i);
}

/// Whether the arc with a on its left and b on its right ends anywhere in an open vertex with a third region, other than `third` and `but`.
std::optional<bool> Growth::touches_another(std::uint32_t a, std::uint32_t b, std::uint32_t third, const Found* but) {
  for (const std::uint32_t other : listed_) {
    if (other == a || other == b || other == third) continue;
    const Found* vertex = vertices_.find(a, b, other);
    if (vertex == nullptr) return std::nullopt;
    if (vertex != but && vertex->follows(a, b)) return true;
  }
  return false;
}

/// Whether the arc (a on its left, b on its right) that starts at node `from` gets to `end` (node `to`, if it is one already) before it
/// ends elsewhere: in a vertex with another region, or where the same bisector leaves the open part.
std::optional<bool> Growth::reaches(std::uint32_t a, std::uint32_t b, std::uint32_t from, std::uint32_t to, const Node& end,
                                    std::uint32_t third) {
  const Node start = result_.nodes[from];
  const MaybeSign ahead = along_arc(a, b, start, end);
  if (!ahead) return std::nullopt;
  if (*ahead == Sign::negative) return false;
  const auto stops_at = [&](const Node& node) -> std::optional<bool> {
    const MaybeSign after_start = along_arc(a, b, start, node);
    if (!after_start || *after_start != Sign::positive) return after_start ? std::optional(false) : std::nullopt;
    const MaybeSign before_end = along_arc(a, b, node, end);
    if (!before_end) return std::nullopt;
    return *before_end == Sign::positive;
  };
  for (const std::uint32_t other : listed_) {
    if (other == a || other == b || other == third) continue;
    const Found* vertex = vertices_.find(a, b, other);
    if (vertex == nullptr) return std::nullopt;
    if (!vertex->follows(a, b)) continue;
    const auto stops = stops_at(vertex->node);
    if (!stops || *stops) return stops ? std::optional(false) : std::nullopt;
  }
  std::uint32_t at = first_;
  for (std::size_t n = 0; n < size_; ++n, at = open_[at].next) {
    const Open& open = open_[at];
    if (open.contender != b || open_[open.next].contender != a || open.node_after == to || open.node_after == from) continue;
    const auto stops = stops_at(result_.nodes[open.node_after]);
    if (!stops || *stops) return stops ? std::optional(false) : std::nullopt;
  }
  return true;
}

/// The order of two points of the bisector of a and b, going with a on the left: positive if `to` comes after `from`. Along a line or a
/// hyperbola the coordinate across the line of the two foci is monotone; along a boundary ray the one along it.
MaybeSign Growth::along_arc(std::uint32_t a, std::uint32_t b, const Node& from, const Node& to) {
  const bool a_is_parent = contenders_.tangent_end(a, b) != Contenders::kNotTangent;
  const std::uint32_t parent = a_is_parent ? a : b;
  const int end = a_is_parent ? contenders_.tangent_end(a, b) : contenders_.tangent_end(b, a);
  const auto test = [&](const auto& numbers) {
    const auto step = node_point(waves_, numbers, to) - node_point(waves_, numbers, from);
    if (end == Contenders::kNotTangent)
      return maybe_sign(cross(numbers.sites[contenders_[b].site]->image - numbers.sites[contenders_[a].site]->image, step));
    const auto& window = *numbers.sites[contenders_[parent].cone_site[static_cast<std::size_t>(end)]];
    const MaybeSign outward = maybe_sign(dot(window.cone[static_cast<std::size_t>(end)] - window.image, step));
    const bool goes_outward = (parent == b) == (end == 0);  // through cone vertex 0 the relay is on the left of its parent's ray
    return outward && !goes_outward ? MaybeSign(-*outward) : outward;
  };
  return ladder_.decide(Predicate::bisector_vertex, test,
                        [&] { return "order along the bisector of " + contenders_.name(a) + " and " + contenders_.name(b); });
}

}  // namespace gvd::kernel
