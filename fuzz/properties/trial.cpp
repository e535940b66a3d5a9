#include "fuzz/properties/trial.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "gvd/kernel/error.hpp"
#include "gvd/kernel/mesh_facts.hpp"
#include "gvd/kernel/surface_point.hpp"

namespace gvd::fuzz {

using kernel::Location;
using kernel::Solution;
using robust::Stage;

const char* tag_name(Tag tag) {
  constexpr std::array<const char*, kTagCount> kNames = {"saddles",
                                                         "ties",
                                                         "shared_region",
                                                         "crowded_facet",
                                                         "gvd_vertex",
                                                         "break_point",
                                                         "weighted",
                                                         "hidden_source",
                                                         "duplicate_source",
                                                         "source_on_edge",
                                                         "source_in_facet",
                                                         "several_in_facet",
                                                         "boundary",
                                                         "closed",
                                                         "unreachable",
                                                         "flat_vertices",
                                                         "stage_identity",
                                                         "stage_filter",
                                                         "stage_double_double",
                                                         "stage_mpfr",
                                                         "stage_algebra",
                                                         "stage_undecided"};
  return kNames[static_cast<std::size_t>(tag)];
}

Trial::Trial(Case c, std::uint64_t seed)
    : case_(std::move(c)), seed_(seed), mesh_(case_.mesh), sources_(sources_of(mesh_, case_.sources)) {
  if (sources_.empty()) throw InputError("there is no source");
}

bool Trial::weighted() const noexcept {
  return std::any_of(sources_.begin(), sources_.end(), [](const auto& s) { return s.weight != 0; });
}

Solution Trial::solve(const kernel::Mesh& mesh, const std::vector<kernel::Source>& sources, bool diagram, unsigned threads) {
  kernel::SolveOptions options;
  options.diagram = diagram;
  options.threads = threads;
  options.time_limit_seconds = kSeconds;
  Solution solution = kernel::solve(mesh, sources, options);
  if (!kernel::is_complete(solution.status())) throw TookTooLong("a run took longer than its limit");
  return solution;
}

const Solution& Trial::solution() {
  if (!solution_) solution_ = solve(mesh_, sources_, true);
  return *solution_;
}

const Solution& Trial::field() {
  if (solution_) return *solution_;
  if (!field_) field_ = solve(mesh_, sources_, false);
  return *field_;
}

const Solution& Trial::alone(kernel::SourceId s) {
  const auto found = alone_.find(s);
  if (found != alone_.end()) return found->second;
  return alone_.emplace(s, solve(mesh_, {sources_[s]}, false)).first->second;
}

Draw Trial::draw(const std::string& property) const {
  std::uint64_t hash = 0;
  for (const char c : property) hash = mixed_seed(hash, static_cast<unsigned char>(c));
  return Draw(mixed_seed(seed_, hash));
}

namespace {

void tag_sources(const kernel::Mesh& mesh, const std::vector<kernel::Source>& sources, Tags& tags) {
  std::set<kernel::FaceId> faces;
  for (const auto& s : sources) {
    const Location at = locate(mesh, s.at);
    if (at.kind == Location::Kind::edge) tags.add(Tag::source_on_edge);
    if (at.kind != Location::Kind::face) continue;
    tags.add(Tag::source_in_facet);
    if (!faces.insert(at.face).second) tags.add(Tag::several_in_facet);
  }
}

/// Waves that have an arc in the face, told by root and image.
bool has_crowded_facet(const kernel::Diagram& diagram) {
  using Wave = std::tuple<kernel::VertexId, double, double>;
  std::map<kernel::FaceId, std::set<Wave>> waves;
  for (const auto& arc : diagram.arcs)
    for (std::size_t side = 0; side < 2; ++side)
      waves[arc.face].insert({arc.root[side], arc.image[side][0].value, arc.image[side][1].value});
  return std::any_of(waves.begin(), waves.end(), [](const auto& entry) { return entry.second.size() >= 4; });
}

void tag_stages(const predicates::Decisions& decisions, Tags& tags) {
  constexpr std::array<Tag, robust::kStageCount> kTags = {Tag::stage_identity, Tag::stage_filter,  Tag::stage_double_double,
                                                          Tag::stage_mpfr,     Tag::stage_algebra, Tag::stage_undecided};
  for (std::size_t s = 0; s < robust::kStageCount; ++s)
    if (decisions.total(static_cast<Stage>(s)) != 0) tags.add(kTags[s]);
}

}  // namespace

Tags Trial::tags() {
  Tags tags;
  const auto tag_if = [&](bool yes, Tag tag) {
    if (yes) tags.add(tag);
  };
  const Solution& s = solution();
  const kernel::Diagram& d = s.diagram();
  predicates::Decisions unused;
  const kernel::MeshFacts facts = kernel::facts(mesh_, unused);
  tag_if(facts.saddles + facts.boundary_relays > 0, Tag::saddles);
  tag_if(facts.flat_vertices > 0, Tag::flat_vertices);
  tags.add(facts.boundary_edges > 0 ? Tag::boundary : Tag::closed);
  tag_if(s.summary().ties > 0, Tag::ties);
  tag_if(!d.shared.empty(), Tag::shared_region);
  tag_if(has_crowded_facet(d), Tag::crowded_facet);
  tag_if(!d.vertices.empty(), Tag::gvd_vertex);
  tag_if(!d.break_points.empty(), Tag::break_point);
  tag_if(weighted(), Tag::weighted);
  tag_if(!s.hidden().empty(), Tag::hidden_source);
  tag_if(!s.duplicates().empty(), Tag::duplicate_source);
  tag_if(s.summary().unreachable_vertices > 0, Tag::unreachable);
  tag_sources(mesh_, sources_, tags);
  tag_stages(s.decisions(), tags);
  return tags;
}

}  // namespace gvd::fuzz
