#include "gvd/kernel/extract.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>

#include "cells.hpp"
#include "chains.hpp"
#include "diagram_points.hpp"
#include "gvd/kernel/error.hpp"

namespace gvd::kernel {
namespace {

using namespace subdivision;

class Extraction {
 public:
  Extraction(const DiagramInput& in, predicates::Decisions& decisions) : in_(in), decisions_(decisions) {}

  /// What does not need one another is done side by side.
  Diagram run() {
    tbb::parallel_invoke([&] { if (in_.prepare_points) in_.prepare_points(); },
                         [&] {
                           s_ = subdivide(in_, decisions_);
                           chains_ = trace(in_, s_, all_decided(decisions_));
                         });
    for (const std::string& doubt : chains_.doubts) predicates::undecided(decisions_, predicates::Predicate::location, doubt);
    list_undecided_faces();
    const bool certain = all_decided(decisions_) && d_.undecided_faces.empty();
    d_.label_sets = in_.label_sets;
    keep_one_place_of_closed_chains();
    waves_.emplace(s_);
    tbb::parallel_invoke([&] { make_points(); }, [&] { count_cells(in_, s_, chains_, certain, d_); }, [&] { loops_ = find_loops(in_, s_); });
    for (Chain& chain : chains_.chains)
      if (chain.closed) start_canonically(chain);
    make_edges();
    tbb::parallel_invoke([&] { construct_arcs(in_, s_, *waves_, first_links_, d_.arcs); }, [&] { make_cells(in_, s_, loops_, point_of_, link_arcs_, d_); });
    make_ends();
    make_dual();
    add_neighbours();
    check();
    return std::move(d_);
  }

 private:
  void list_undecided_faces() {
    for (const Skeleton& facet : s_.facets)
      if (facet.undecided) d_.undecided_faces.push_back(in_.refined.input_face(facet.face));
    const auto is_undecided = [&](FaceId f) { return s_.facet_of[f] != kNone && s_.facets[s_.facet_of[f]].undecided; };
    for (const Place& place : s_.places) {
      if (place.kind != Place::Kind::edge || !place.open) continue;
      const FaceId a = Mesh::face(place.halfedge), b = Mesh::face(in_.refined.twin(place.halfedge));
      if (is_undecided(a) || is_undecided(b)) continue;  // open because of that; else the edge itself is undecided
      for (const FaceId f : {a, b}) d_.undecided_faces.push_back(in_.refined.input_face(f));
    }
    auto& faces = d_.undecided_faces;
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  }

  /// A closed edge needs a point to start in.
  void keep_one_place_of_closed_chains() {
    for (const Chain& chain : chains_.chains) {
      if (!chain.closed) continue;
      const bool all_erased = std::all_of(chain.links.begin(), chain.links.end(),
                                          [&](DirectedLink l) { return chains_.role[from_place(s_, l)] == Role::erased; });
      if (all_erased) chains_.role[from_place(s_, chain.links.front())] = Role::crossing;
    }
  }

  void make_points() {
    point_of_.assign(s_.places.size(), kNone);
    std::vector<std::uint32_t> places;
    for (std::uint32_t p = 0; p < s_.places.size(); ++p) {
      if (chains_.role[p] == Role::none || chains_.role[p] == Role::erased) continue;
      point_of_[p] = static_cast<std::uint32_t>(places.size());
      places.push_back(p);
    }
    d_.points = construct_points(in_, s_, *waves_, places, decisions_);
  }

  /// Turns a closed chain so that it starts in its smallest break point, or smallest crossing if it has none.
  void start_canonically(Chain& chain) {
    const auto key = [&](DirectedLink l) {
      const std::uint32_t p = from_place(s_, l);
      const Role role = chains_.role[p];
      const Point position = point_of_[p] == kNone ? Point{} : d_.points[point_of_[p]].position;
      return std::tuple(role == Role::break_point ? 0 : role == Role::crossing ? 1 : 2, position);
    };
    const auto first =
        std::min_element(chain.links.begin(), chain.links.end(), [&](DirectedLink a, DirectedLink b) { return key(a) < key(b); });
    std::rotate(chain.links.begin(), first, chain.links.end());
  }

  void make_edges() {
    link_arcs_.arc.assign(s_.links.size(), kNone);
    link_arcs_.reversed.assign(s_.links.size(), 0);
    d_.arcs.reserve(s_.links.size());
    first_links_.reserve(s_.links.size());
    for (const Chain& chain : chains_.chains) {
      GvdEdge edge;
      edge.closed = chain.closed;
      edge.labels = {label_beside(s_, chain.links.front(), 0), label_beside(s_, chain.links.front(), 1)};
      edge.end = {point_of_[from_place(s_, chain.links.front())], point_of_[to_place(s_, chain.links.back())]};
      for (std::size_t i = 0; i < chain.links.size(); ++i) {
        const DirectedLink link = chain.links[i];
        const std::uint32_t from = from_place(s_, link);
        if (i == 0 || point_of_[from] != kNone) {
          edge.arcs.push_back(static_cast<std::uint32_t>(d_.arcs.size()));
          d_.arcs.emplace_back().node[0] = point_of_[from];
          first_links_.push_back(link);
          if (chains_.role[from] == Role::break_point)
            d_.break_points.push_back({point_of_[from], static_cast<std::uint32_t>(d_.edges.size())});
        }
        d_.arcs.back().node[1] = point_of_[to_place(s_, link)];
        link_arcs_.arc[link.link] = edge.arcs.back();
        link_arcs_.reversed[link.link] = link.reversed ? 1 : 0;
      }
      d_.edges.push_back(std::move(edge));
    }
  }

  void make_ends() {
    std::vector<std::uint32_t> vertex_of(d_.points.size(), kNone);
    for (std::uint32_t p = 0; p < s_.places.size(); ++p) {
      if (chains_.role[p] != Role::vertex) continue;
      vertex_of[point_of_[p]] = static_cast<std::uint32_t>(d_.vertices.size());
      d_.vertices.push_back({point_of_[p], sources_at(in_, s_, p), {}, s_.places[p].boundary});
    }
    std::vector<Role> role_of_point(d_.points.size());
    for (std::uint32_t p = 0; p < s_.places.size(); ++p)
      if (point_of_[p] != kNone) role_of_point[point_of_[p]] = chains_.role[p];
    for (std::uint32_t e = 0; e < d_.edges.size(); ++e) {
      if (d_.edges[e].closed) continue;
      for (const std::uint32_t point : d_.edges[e].end) {
        if (role_of_point[point] == Role::vertex) d_.vertices[vertex_of[point]].edges.push_back(e);
        if (role_of_point[point] == Role::boundary) d_.boundary_meetings.push_back({point, e});
        if (role_of_point[point] == Role::open) d_.open_ends.push_back({point, e});
      }
    }
  }

  void make_dual() {
    struct Pair {
      std::array<SourceId, 2> sources;
      std::uint32_t edge;
      auto operator<=>(const Pair&) const = default;
    };
    std::vector<Pair> pairs;
    for (std::uint32_t e = 0; e < d_.edges.size(); ++e)
      for (const SourceId a : in_.label_sets[d_.edges[e].labels[0]])
        for (const SourceId b : in_.label_sets[d_.edges[e].labels[1]])
          if (a != b) pairs.push_back({{std::min(a, b), std::max(a, b)}, e});
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const Pair& pair : pairs) {
      if (d_.dual.empty() || d_.dual.back().sources != pair.sources) d_.dual.push_back({pair.sources, {}});
      d_.dual.back().edges.push_back(pair.edge);
    }
  }

  void add_neighbours() {
    for (const DualEdge& dual : d_.dual) {
      d_.cells[dual.sources[0]].neighbours.push_back(dual.sources[1]);
      d_.cells[dual.sources[1]].neighbours.push_back(dual.sources[0]);
    }
    for (Cell& cell : d_.cells) std::sort(cell.neighbours.begin(), cell.neighbours.end());
  }

  static void require(bool holds, const char* what) {
    if (!holds) throw InternalError(std::string("the diagram is inconsistent: ") + what);
  }

  void check() const {
    std::size_t ends = 0, open_edges = 0;
    for (const GvdVertex& vertex : d_.vertices) {
      require(!vertex.edges.empty(), "a GVD vertex without an edge");
      ends += vertex.edges.size();
    }
    ends += d_.boundary_meetings.size() + d_.open_ends.size();
    for (const GvdEdge& edge : d_.edges) {
      open_edges += edge.closed ? 0 : 1;
      require(edge.labels[0] != edge.labels[1], "one label set on both sides of a GVD edge");
      require(!edge.closed || edge.end[0] == edge.end[1], "a closed edge with two ends");
      for (std::size_t i = 0; i < edge.arcs.size(); ++i) {
        const Arc& arc = d_.arcs[edge.arcs[i]];
        require(arc.labels == edge.labels, "an arc with other label sets than its edge");
        require(arc.node[0] == (i == 0 ? edge.end[0] : d_.arcs[edge.arcs[i - 1]].node[1]), "arcs that do not follow one another");
      }
    }
    require(ends == 2 * open_edges, "an edge that ends nowhere");
    for (const DualEdge& dual : d_.dual) require(!dual.edges.empty(), "a dual edge without a GVD edge");
  }

  const DiagramInput& in_;
  predicates::Decisions& decisions_;
  Subdivision s_;
  std::optional<PreciseWaves> waves_;
  Chains chains_;
  std::vector<std::uint32_t> point_of_;  // per place
  Loops loops_;
  LinkArcs link_arcs_;
  std::vector<DirectedLink> first_links_;  // per arc
  Diagram d_;
};

}  // namespace

Diagram extract(const DiagramInput& in, predicates::Decisions& decisions) { return Extraction(in, decisions).run(); }

}  // namespace gvd::kernel
