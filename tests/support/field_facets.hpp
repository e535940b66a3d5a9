#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "../../kernel/src/facet_waves.hpp"
#include "gvd/kernel/distance_field.hpp"
#include "gvd/kernel/frames.hpp"
#include "gvd/kernel/resolution.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/kernel/vertex_kind.hpp"

namespace gvd::test {

/// The distance field of a mesh, and the wave sets of its facets as the solver makes them.
class FieldFacets {
 public:
  /// `change`: what is done to the field between propagation and resolution.
  FieldFacets(const kernel::Mesh& mesh, const std::vector<kernel::Source>& sources, const std::function<void(kernel::DistanceField&, const kernel::Frames&)>& change = {})
      : refined_(kernel::refine(mesh, sources, where_)) {
    frames_ = std::make_unique<kernel::Frames>(refined_);
    kinds_ = kernel::classify_vertices(refined_, decisions_);
    std::vector<kernel::WaveStart> starts;
    for (kernel::SourceId i = 0; i < sources.size(); ++i) {
      source_vertices_.push_back({where_.vertex[i], where_.weight[i], sets_.intern({i})});
      starts.push_back({where_.vertex[i], std::ldexp(where_.weight[i], -frames_->scale())});
    }
    kernel::propagate(*frames_, starts, kinds_, field_, decisions_);
    if (change) change(field_, *frames_);
    resolution_ = std::make_unique<kernel::Resolution>(*frames_, field_, source_vertices_, sets_);
    resolution_->resolve(decisions_);
  }

  const kernel::Mesh& mesh() const { return refined_; }
  const kernel::Frames& frames() const { return *frames_; }
  const kernel::DistanceField& field() const { return field_; }
  const kernel::LabelSets& sets() const { return sets_; }
  const kernel::Resolution& resolution() const { return *resolution_; }
  std::unique_ptr<kernel::FieldWaves> waves_of(kernel::FaceId f, const kernel::UnfoldedWindows* unfolded = nullptr) const {
    return std::make_unique<kernel::FieldWaves>(*resolution_, kinds_, f, unfolded);
  }
  kernel::UnfoldedWindows unfolded(const std::vector<kernel::WindowId>& windows) const { return {*frames_, field_, windows}; }
  /// Calls visit(waves) for every facet that waves of several label sets may reach.
  void for_each_boundary_facet(const std::function<void(kernel::FieldWaves&)>& visit) const {
    for (kernel::FaceId f = 0; f < refined_.face_count(); ++f) {
      kernel::FieldWaves waves(*resolution_, kinds_, f);
      if (!waves.sites.empty() && waves.only_label() == kernel::kNone) visit(waves);
    }
  }

 private:
  kernel::RefinedSources where_;
  kernel::Mesh refined_;
  std::unique_ptr<kernel::Frames> frames_;
  std::vector<kernel::VertexKind> kinds_;
  std::vector<kernel::SourceVertex> source_vertices_;
  kernel::LabelSets sets_;
  kernel::DistanceField field_;
  std::unique_ptr<kernel::Resolution> resolution_;
  predicates::Decisions decisions_;
};

}  // namespace gvd::test
