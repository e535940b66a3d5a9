#include "vertex_finder.hpp"

#include <algorithm>
#include <utility>

namespace gvd::kernel {

using predicates::BisectorVertex;
using predicates::Existence;
using predicates::PlanePoint;
using predicates::Predicate;
using predicates::operator+;
using predicates::operator-;
using robust::MaybeSign;
using robust::Sign;
using robust::Stage;
using Node = FacetTessellation::Node;

void BisectorVertices::set_rivals(std::span<const std::uint32_t> rivals) {
  rivals_.assign(rivals.begin(), rivals.end());
  remembered_.clear();
}

void BisectorVertices::set_outline(const FacetTessellation& walked) {
  walked_ = &walked;
  nodes_of_walk_ = walked.nodes.size();
}

void BisectorVertices::forget() {
  const std::size_t n = rivals_.size();
  remembered_.assign(n * n * n, 0);
  rank_.assign(contenders_.size(), 0);
  for (std::uint32_t r = 0; r < n; ++r) rank_[rivals_[r]] = r;
}

std::int32_t& BisectorVertices::remembered(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  while (i > j || i > k) {  // the same vertex whatever the turn of the triple: begin with the lowest
    std::swap(i, j);
    std::swap(j, k);
  }
  const std::size_t n = rivals_.size();
  if (remembered_.empty()) forget();
  return remembered_[(rank_[i] * n + rank_[j]) * n + rank_[k]];
}

BisectorVertices::Found* BisectorVertices::find(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  std::int32_t& entry = remembered(i, j, k);
  if (entry == 0) {
    Found& found = *found_.emplace_back(std::make_unique<Found>());
    entry = static_cast<std::int32_t>(found_.size());
    if (const auto spec = triple(i, j, k)) examine(*spec, found);
    const auto ring = found.open;
    for (std::size_t a = 0; ring.size() > 3 && a < ring.size(); ++a)
      for (std::size_t b = a + 1; b < ring.size(); ++b)
        for (std::size_t c = b + 1; c < ring.size(); ++c)
          remembered(ring[a], ring[b], ring[c]) = static_cast<std::int32_t>(found_.size());
  }
  return ladder_.failed() ? nullptr : found_[static_cast<std::size_t>(entry - 1)].get();
}

std::optional<BisectorVertices::InDoubles> BisectorVertices::find_in_doubles(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::span<const std::uint32_t> rivals) {
  InDoubles found;
  const auto spec = triple(i, j, k);
  if (spec && !examine_in_doubles(*spec, rivals, found)) return std::nullopt;
  return found;
}

std::optional<bool> BisectorVertices::is_beaten(const InDoubles& vertex, std::uint32_t rival) {
  const VertexFilter::Answer nearer = filter_.nearer(vertex.waves(), rival, vertex.at);
  if (nearer == VertexFilter::Answer::unknown) return std::nullopt;
  ladder_.count(Predicate::conflict, Stage::filter);
  return nearer == VertexFilter::Answer::yes;
}

/// Empty if identity excludes a vertex. The boundary ray of a parent through its cone vertex 0 has the relay on its left, through 1
/// on its right; both tie along it until a third wave takes over, so the ray ends in a vertex (relay, parent, third) or (parent,
/// relay, third), and never begins in one.
std::optional<BisectorVertices::Triple> BisectorVertices::triple(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
  Triple result{{i, j, k}, false, j, 0, 0, 0};
  int tangent_pairs = 0;
  const std::array<std::uint32_t, 3> w{i, j, k};
  for (std::size_t first = 0; first < 3; ++first) {
    const std::uint32_t a = w[first], b = w[(first + 1) % 3], third = w[(first + 2) % 3];
    if (!contenders_.related(a, b)) continue;
    if (!contenders_.tangent(a, b)) return std::nullopt;  // one eclipses the other: they tie where the first does not see, or at the corner only
    for (const bool relay_first : {true, false}) {
      const std::uint32_t relay = relay_first ? a : b, parent = relay_first ? b : a;
      const int end = contenders_.tangent_end(parent, relay);
      if (end == Contenders::kNotTangent) continue;
      ++tangent_pairs;  // two of them: the rays leave one point in different directions
      if (tangent_pairs > 1 || (end == 0) != relay_first) return std::nullopt;
      if (contenders_.eclipses(third, relay)) return std::nullopt;  // two rays that meet in the relay itself only
      result.on_ray = true;
      result.pivot = contenders_.starts_on_ray(parent, relay);
      result.other = third;
      result.parent = parent;
      result.ray_end = static_cast<std::uint8_t>(end);
    }
  }
  if (!result.on_ray) {  // a pivot with an equal weight makes a simpler formula
    const auto root = [&](std::size_t n) { return contenders_[w[n]].root; };
    const std::size_t pivot = root(1) == root(0) || root(1) == root(2) || root(0) != root(2) ? 1 : 2;
    result.waves = {w[(pivot + 2) % 3], w[pivot], w[(pivot + 1) % 3]};
    result.pivot = w[pivot];
  }
  return result;
}

template <class NT>
BisectorVertex<NT> BisectorVertices::construct(const FacetNumbers<NT>& numbers, const Triple& t) const {
  const auto site = [&](std::uint32_t wave) { return contenders_[wave].site; };
  if (t.on_ray) return vertex_on_ray(waves_, numbers, contenders_[t.parent].cone_site[t.ray_end], site(t.pivot), site(t.other));
  return vertex_of(waves_, numbers, site(t.waves[0]), site(t.waves[1]), site(t.waves[2]));
}

template <class NT>
BisectorVertices::Verdict BisectorVertices::conflict(const FacetNumbers<NT>& numbers, const Triple& t,
                                                     const BisectorVertex<NT>& vertex, const PlanePoint<NT>& p,
                                                     std::uint32_t rival) const {
  const Contender& wave = contenders_[rival];
  std::array<MaybeSign, 2> inside{Sign::positive, Sign::positive};
  const auto look = [&] {  // whether the rival sees p
    for (std::size_t end = 0; wave.has_cone && end < 2; ++end) inside[end] = maybe_sign(cone_side(numbers, wave, end, p));
    return inside[0] != Sign::negative && inside[1] != Sign::negative;
  };
  for (const std::uint32_t own : t.waves)  // behind the boundary ray of one of the three, which strictly sees p: never nearer
    if (contenders_.tangent_end(own, rival) != Contenders::kNotTangent || contenders_.eclipses(own, rival)) return Verdict::pass;
  for (const std::uint32_t own : t.waves) {
    const int end = contenders_.tangent_end(rival, own);
    if (end == Contenders::kNotTangent && !contenders_.eclipses(rival, own)) continue;
    // The parent of one of the three is nearer strictly inside its cone, equal on the ray.
    if (!look()) return Verdict::pass;
    if (!inside[0] || !inside[1]) return Verdict::open;
    return end == Contenders::kNotTangent || inside[static_cast<std::size_t>(end)] == Sign::positive ? Verdict::reject
                                                                                                     : Verdict::tie;
  }
  const auto known = std::find_if(settled_.begin(), settled_.end(), [&](const auto& s) { return s.first == rival; });
  const MaybeSign nearer = known != settled_.end()
                               ? known->second
                               : predicates::conflict(relative_wave(waves_, numbers, contenders_[t.pivot].site, wave.site), vertex);
  if (nearer == Sign::negative || !look()) return Verdict::pass;
  if (!nearer || !inside[0] || !inside[1]) return Verdict::open;
  return nearer == Sign::positive ? Verdict::reject : Verdict::tie;
}

/// On a side, the walk has seen whatever changes along it. Where a region only touches the side nothing does: if two of them do so in one point, because a
/// boundary ray ends there, it is a vertex like those inside.
template <class NT>
BisectorVertices::Verdict BisectorVertices::against_side(const FacetNumbers<NT>& numbers, std::uint8_t side, const PlanePoint<NT>& p) const {
  const auto& line = numbers.side[side];
  const MaybeSign inside = maybe_sign(cross(line.direction, p - line.origin));
  if (!inside) return Verdict::open;
  if (*inside != Sign::zero) return *inside == Sign::positive ? Verdict::pass : Verdict::reject;
  if (walked_ == nullptr) return Verdict::reject;
  const NT t = dot(p - line.origin, line.direction) / line.square;
  for (const MaybeSign& within : {maybe_sign(t), maybe_sign(NT(1.0) - t)})
    if (within != Sign::positive) return within ? Verdict::reject : Verdict::open;
  for (std::size_t n = 0; n < nodes_of_walk_; ++n) {
    const Node& node = walked_->nodes[n];
    if (node.kind != Node::Kind::side || node.where != side) continue;
    const MaybeSign apart = maybe_sign(node_parameter(waves_, numbers, node) - t);
    if (!apart || *apart == Sign::zero) return apart ? Verdict::reject : Verdict::open;
  }
  return Verdict::pass;
}

template <class NT>
BisectorVertices::Verdict BisectorVertices::test(const FacetNumbers<NT>& numbers, const Triple& t, const BisectorVertex<NT>& vertex,
                                                 const PlanePoint<NT>& p, std::uint32_t what) const {
  if (what == kExistence) return Verdict::pass;
  if (what >= kRivals) return conflict(numbers, t, vertex, p, what - kRivals);
  if (what < kCones) return against_side(numbers, static_cast<std::uint8_t>(what - kSides), p);
  const std::uint32_t wave = t.waves[(what - kCones) / 2], end = (what - kCones) % 2;
  if (!contenders_[wave].has_cone) return Verdict::pass;
  if (t.on_ray && wave == t.parent && end == t.ray_end) return Verdict::pass;  // on the ray by identity
  const MaybeSign inside = maybe_sign(cone_side(numbers, contenders_[wave], end, p));
  if (!inside) return Verdict::open;
  if (*inside == Sign::zero) return Verdict::on_ray;
  return *inside == Sign::positive ? Verdict::pass : Verdict::reject;
}

Predicate BisectorVertices::predicate_of(std::uint32_t what) {
  if (what == kExistence) return Predicate::bisector_vertex;
  if (what < kCones) return Predicate::location;
  return what < kRivals ? Predicate::cone_membership : Predicate::conflict;
}

std::string BisectorVertices::describe(const Triple& t, std::uint32_t what) const {
  std::string text =
      "vertex of " + contenders_.name(t.waves[0]) + ", " + contenders_.name(t.waves[1]) + ", " + contenders_.name(t.waves[2]);
  if (what == kExistence) return text + ": whether there is one";
  if (what < kCones) return text + ": against side " + std::to_string(what - kSides);
  if (what < kRivals) return text + ": boundary ray of the cone of " + contenders_.name(t.waves[(what - kCones) / 2]);
  return text + ": conflict with " + contenders_.name(what - kRivals);
}

/// Runs the pending tests in one number type and drops those that pass. False if one of them rejects the vertex.
template <class NT>
bool BisectorVertices::run_tests(const FacetNumbers<NT>& numbers, Stage stage, const Triple& t) {
  const BisectorVertex<NT> vertex = construct(numbers, t);
  if (vertex.existence == Existence::open) return true;
  if (vertex.existence == Existence::impossible) {
    ladder_.count(predicate_of(kExistence), stage);
    return false;
  }
  const PlanePoint<NT> p = vertex.p + numbers.sites[contenders_[t.pivot].site]->image;
  std::size_t kept = 0;
  for (const std::uint32_t what : pending_) {
    const Verdict verdict = test(numbers, t, vertex, p, what);
    if (verdict == Verdict::open) {
      pending_[kept++] = what;
      continue;
    }
    ladder_.count(predicate_of(what), stage);
    if (verdict == Verdict::reject) return false;
    if (verdict == Verdict::tie) ties_.push_back(what - kRivals);
    if (verdict == Verdict::on_ray) on_boundary_ray_ = true;
  }
  pending_.resize(kept);
  return true;
}

/// What the images alone decide, in the frame where their strips part: whether there is a vertex (if not, the result is false), and which
/// rivals conflict.
bool BisectorVertices::settle_where_they_part(const Triple& t) {
  if (t.on_ray) return true;
  for (const std::uint32_t what : pending_) {
    if (what != kExistence && what < kRivals) continue;
    std::vector<std::uint32_t> waves(t.waves.begin(), t.waves.end());
    if (what != kExistence) waves.push_back(what - kRivals);
    for (std::uint32_t& wave : waves) wave = contenders_[wave].site;
    const auto sites = contenders_.where_they_part(waves);
    if (sites.empty()) continue;
    FacetNumbers<robust::Exact> numbers;
    numbers.sites = SiteNumbers<robust::Exact>(waves_.sites.size());
    for (std::size_t n = 0; n < waves.size(); ++n) numbers.sites.set(waves[n], sites[n]);
    const auto vertex = construct(numbers, t);
    if (vertex.existence == Existence::impossible) {
      ladder_.count(predicate_of(what), Stage::algebra);
      return false;
    }
    if (what == kExistence || vertex.existence != Existence::proved) continue;
    const auto relative = relative_wave(waves_, numbers, contenders_[t.pivot].site, contenders_[what - kRivals].site);
    if (const MaybeSign nearer = predicates::conflict(relative, vertex)) settled_.emplace_back(what - kRivals, *nearer);
  }
  return true;
}

/// False if doubles cannot tell.
bool BisectorVertices::examine_in_doubles(const Triple& t, std::span<const std::uint32_t> rivals, InDoubles& found) {
  std::optional<VertexFilter::OnRay> on_ray;
  if (t.on_ray) on_ray = {t.parent, t.pivot, t.other, t.ray_end};
  const VertexFilter::Judgement judged = filter_.judge(t.waves, on_ray, rivals);
  if (!judged.certain) return false;
  ladder_.count(Predicate::bisector_vertex, Stage::filter);
  ladder_.count(Predicate::location, Stage::filter, judged.sides);
  ladder_.count(Predicate::cone_membership, Stage::filter, judged.rays);
  ladder_.count(Predicate::conflict, Stage::filter, judged.rivals);
  if (!judged.exists) return true;
  found = {true, t, judged.at};
  return true;
}

Node BisectorVertices::node(const InDoubles& vertex) const {
  const auto& waves = vertex.waves();
  Node node = node_of(vertex.triple);
  node.sites = {contenders_[waves[0]].site, contenders_[waves[1]].site, contenders_[waves[2]].site};
  node.x = FacetWaves::F(vertex.at.p.x, vertex.at.radius);
  node.y = FacetWaves::F(vertex.at.p.y, vertex.at.radius);
  return node;
}

void BisectorVertices::examine(const Triple& t, Found& found) {
  if (InDoubles known; examine_in_doubles(t, rivals_, known)) {
    found.exists = known.exists;
    if (known.exists) found.node = node(known), found.open.assign(known.waves().begin(), known.waves().end());
    return;
  }
  pending_.clear();
  ties_.clear();
  on_boundary_ray_ = false;
  for (std::uint32_t what = 0; what < kRivals; ++what) {
    const bool cone = what >= kCones;
    if (!cone || contenders_[t.waves[(what - kCones) / 2]].has_cone) pending_.push_back(what);
  }
  for (const std::uint32_t rival : rivals_)
    if (rival != t.waves[0] && rival != t.waves[1] && rival != t.waves[2]) pending_.push_back(kRivals + rival);

  const auto& numbers = ladder_.filter();
  bool holds = run_tests(numbers, Stage::filter, t);
  settled_.clear();
  // Exact images where strips part cost more than a few hundred bits, and more than exact numbers that are cheap here.
  int finer_stages = 0;
  bool parted = false;
  const auto part = [&] { return std::exchange(parted, true) || settle_where_they_part(t); };
  if (holds && !pending_.empty()) {
    const auto finished = ladder_.for_each_stage([&](const auto& finer, Stage stage) -> std::optional<bool> {
      const bool exact = stage == Stage::algebra, cheap = exact && waves_.exact_is_cheap();
      if ((exact || ++finer_stages > 3) && !cheap && !part()) return false;
      if (!run_tests(finer, stage, t)) return false;
      if (cheap && !pending_.empty() && !(part() && run_tests(finer, stage, t))) return false;
      return pending_.empty() ? std::optional(true) : std::nullopt;
    });
    if (!finished) {
      if (!ladder_.failed()) ladder_.fail(predicate_of(pending_[0]), describe(t, pending_[0]));
      return;
    }
    holds = *finished;
  }
  if (!holds) return;

  found.node = node_of(t);
  found.open = {t.waves[0], t.waves[1], t.waves[2]};
  if (!ties_.empty() || on_boundary_ray_) {
    if (on_boundary_ray_ && !add_eclipsed_ties(t, found.node)) return;
    found.open.insert(found.open.end(), ties_.begin(), ties_.end());
    found.open = Ring(waves_, contenders_, ladder_).regions(found.node, found.open);
    for (const std::uint32_t wave : t.waves)  // one of them may own no direction there
      if (!found.has(wave)) found.open.clear();
  }
  found.exists = !found.open.empty();
  for (const std::uint32_t wave : found.open) found.node.sites.push_back(contenders_[wave].site);
  const auto p = node_point(waves_, numbers, found.node);
  found.node.x = p.x;
  found.node.y = p.y;
}

FacetTessellation::Node BisectorVertices::node_of(const Triple& t) const {
  FacetTessellation::Node node;
  node.kind = FacetTessellation::Node::Kind::inside;
  if (t.on_ray) {
    node.defining = {contenders_[t.pivot].site, contenders_[t.other].site, FacetTessellation::kNoSite};
    node.ray = contenders_[t.parent].cone_site[t.ray_end];
    node.ray_end = t.ray_end;
  } else {
    for (std::size_t n = 0; n < 3; ++n) node.defining[n] = contenders_[t.waves[n]].site;
  }
  return node;
}

/// What starts on the way of one of the three is not nearer, so conflict() passes it; on a boundary ray it may tie.
bool BisectorVertices::add_eclipsed_ties(const Triple& t, const FacetTessellation::Node& node) {
  for (const std::uint32_t rival : rivals_) {
    const auto eclipsed = [&](std::uint32_t own) { return own != rival && contenders_.eclipses(own, rival); };
    const bool is_new = std::find(t.waves.begin(), t.waves.end(), rival) == t.waves.end() &&
                        std::find(ties_.begin(), ties_.end(), rival) == ties_.end();
    if (!is_new || std::none_of(t.waves.begin(), t.waves.end(), eclipsed)) continue;
    if (Ring(waves_, contenders_, ladder_).ties(node, t.waves, rival) == true) ties_.push_back(rival);
  }
  return !ladder_.failed();
}

}  // namespace gvd::kernel
