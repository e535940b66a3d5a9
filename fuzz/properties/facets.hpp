#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "facet_waves.hpp"
#include "fuzz/properties/trial.hpp"
#include "gvd/kernel/vertex_kind.hpp"

namespace gvd::fuzz {

/// The stages of `solve` up to the wave sets of the facets, which a solution does not show.
class Facets {
 public:
  explicit Facets(const Trial& t)
      : refined_(refine(t.mesh(), t.sources(), where_)), frames_(refined_), kinds_(kept_vertex_kinds(t.mesh()).of) {
    kinds_.resize(refined_.vertex_count(), kernel::VertexKind::flat);
    std::map<kernel::VertexId, std::pair<double, std::vector<kernel::SourceId>>> least;
    for (kernel::SourceId s = 0; s < where_.vertex.size(); ++s) {
      const auto [it, fresh] = least.try_emplace(where_.vertex[s], where_.weight[s], std::vector<kernel::SourceId>{});
      auto& [weight, labels] = it->second;
      if (where_.weight[s] < weight) labels.clear(), weight = where_.weight[s];
      if (where_.weight[s] == weight) labels.push_back(s);
    }
    std::vector<kernel::WaveStart> starts;
    for (const auto& [v, entry] : least) {
      sources_.push_back({v, entry.first, sets_.intern(entry.second)});
      starts.push_back({v, std::ldexp(entry.first, -frames_.scale())});
    }
    propagate(frames_, starts, kinds_, field_, decisions_);
    resolution_ = std::make_unique<kernel::Resolution>(frames_, field_, sources_, sets_);
    resolution_->resolve(decisions_);
  }

  const kernel::Mesh& mesh() const { return refined_; }
  bool is_reached(kernel::FaceId f) const { return resolution_->is_reached(refined_.origin(3 * f)); }
  std::unique_ptr<kernel::FieldWaves> waves(kernel::FaceId f) const {
    return std::make_unique<kernel::FieldWaves>(*resolution_, kinds_, f);
  }
  const kernel::Resolution& resolution() const { return *resolution_; }
  /// A drawn face and those around it, so many that looking at their waves with many bits costs about the same on every mesh; only faces that are reached.
  std::vector<kernel::FaceId> patch(Draw& draw) const {
    constexpr std::size_t kMost = 24;
    std::vector<kernel::FaceId> faces;
    const auto add = [&](kernel::FaceId f) {
      if (faces.size() < kMost && is_reached(f) && std::find(faces.begin(), faces.end(), f) == faces.end()) faces.push_back(f);
    };
    add(draw.below(refined_.face_count()));
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (kernel::HalfedgeId h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h)
        if (refined_.twin(h) != kernel::kNone) add(kernel::Mesh::face(refined_.twin(h)));
    return faces;
  }
  const std::vector<kernel::VertexKind>& kinds() const { return kinds_; }

 private:
  kernel::RefinedSources where_;
  kernel::Mesh refined_;
  predicates::Decisions decisions_;
  kernel::Frames frames_;
  std::vector<kernel::VertexKind> kinds_;
  std::vector<kernel::SourceVertex> sources_;
  kernel::LabelSets sets_;
  kernel::DistanceField field_;
  std::unique_ptr<kernel::Resolution> resolution_;
};

}  // namespace gvd::fuzz
