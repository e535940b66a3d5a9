#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gvd/kernel/distance_field.hpp"
#include "gvd/kernel/frames.hpp"
#include "gvd/kernel/ids.hpp"
#include "gvd/kernel/unfolding.hpp"
#include "gvd/predicates/predicate.hpp"
#include "gvd/robust/ball.hpp"
#include "gvd/robust/exact.hpp"
#include "gvd/robust/root_sum.hpp"

namespace gvd::kernel {

/// Sets of sources, each stored once.
class LabelSets {
 public:
  LabelSetId intern(std::vector<SourceId> sorted);
  LabelSetId merge(LabelSetId a, LabelSetId b);
  const std::vector<SourceId>& operator[](LabelSetId id) const { return sets_[id]; }
  const std::vector<std::vector<SourceId>>& all() const noexcept { return sets_; }

 private:
  std::vector<std::vector<SourceId>> sets_;
  std::map<std::vector<SourceId>, LabelSetId> ids_;
};

/// One vertex at which waves start: the sources there of least weight.
struct SourceVertex {
  VertexId vertex;
  double weight;  ///< mesh units
  LabelSetId labels;
};

class ExactUnfoldings;
class WindowImages;

/// Decides, vertex by vertex in the order of distance, which candidates are nearest, what their labels are, and which double is nearest to the
/// distance. All distances in scaled units except where mesh units are named. After `resolve` the const members may be called by several threads.
class Resolution {
 public:
  Resolution(const Frames& frames, DistanceField& field, const std::vector<SourceVertex>& sources, LabelSets& sets);
  ~Resolution();

  /// Leaves only the winners (exactly tied) in the candidate lists of the field.
  void resolve(predicates::Decisions& decisions);
  /// The images of windows in double-double that `resolve` made are kept for others, who may add to them, and give them back.
  void add_images(const std::vector<WindowId>& windows);
  void forget_images();
  /// Null once they were given back; it may lack any.
  const WindowImages* images() const noexcept { return images_.get(); }

  bool is_reached(VertexId v) const noexcept { return labels_[v] != kNone; }
  LabelSetId labels(VertexId v) const noexcept { return labels_[v]; }
  /// Whether the labels and the distance of v stand on no open decision, its own or that of a vertex its paths come from.
  bool is_proved(VertexId v) const noexcept { return proved_[v] != 0; }
  const std::vector<LabelSetId>& labels() const noexcept { return labels_; }
  /// Whether the window, whose apex v is, brings v its distance.
  bool attains(WindowId window, VertexId v) const noexcept;
  /// Whether the straight edge from `via` brings v its distance.
  bool attains_along_edge(VertexId via, VertexId v) const noexcept;
  /// Whether the image in a window's strip is, by algebra, as far from the apex as v is from its root, whether the window sees it or not.
  /// Pre: v is the apex of the window's face and not its root. Remembered.
  bool is_as_far(WindowId window, VertexId v) const;
  bool is_source(VertexId v) const noexcept { return source_of_vertex_[v] != kNone; }
  /// Whether a wave of its own sources starts at v and nothing reaches v sooner.
  bool is_live_source(VertexId v) const noexcept { return attains_along_edge(v, v); }

  const robust::Ball<robust::DoubleDouble>& distance(VertexId v) const noexcept { return distance_[v]; }
  robust::Ball<robust::Mpfr> distance(VertexId v, int bits) const;
  /// Empty if the paths cross faces of too many square classes, or bend too often.
  std::optional<robust::Exact> exact_distance(VertexId v) const;
  /// True is a proof, false says nothing.
  bool have_equal_distances(VertexId a, VertexId b) const;

  /// A window in exact numbers; null if its strip crosses faces of too many square classes.
  std::shared_ptr<const predicates::RootUnfolding> exact_unfolding(WindowId window) const;

  /// A half-edge along the edge between two vertices, in either direction; kNone if no edge joins them.
  HalfedgeId edge_between(VertexId a, VertexId b) const;

  const Frames& frames() const noexcept { return frames_; }
  const DistanceField& field() const noexcept { return field_; }
  const std::vector<SourceVertex>& sources() const noexcept { return sources_; }
  const LabelSets& sets() const noexcept { return sets_; }

 private:
  std::vector<WindowId> windows_of_candidates() const;
  /// Vertices that wait for one another: each may lie behind another one, as far as doubles can tell.
  using Cluster = std::vector<VertexId>;
  void resolve_vertex(VertexId v, predicates::Decisions& decisions);
  bool is_awaited(const Candidate& c, VertexId v) const;
  bool waits(VertexId v) const;
  VertexId first_of(const Cluster& cluster, predicates::Decisions& decisions);
  Cluster cluster_of(VertexId v) const;
  template <class Lengths>
  std::optional<VertexId> first_by(const Cluster& cluster, const Lengths& lengths) const;
  std::vector<std::uint32_t> nearest_of(const std::vector<std::uint32_t>& list, VertexId v, predicates::Decisions& decisions);
  /// Empty if the exact lengths are not to be had.
  std::optional<std::vector<std::uint32_t>> nearest_exactly(const std::vector<std::uint32_t>& list, VertexId v) const;
  robust::Ball<robust::DoubleDouble> length(const Candidate& c, VertexId v);
  robust::Ball<robust::Mpfr> length(const Candidate& c, VertexId v, int bits) const;
  template <class FrameOf, class ImageOf>
  auto straight_leg(const Candidate& c, VertexId v, double unit, const FrameOf& frame_of, const ImageOf& image_of) const;
  /// Of the last, straight part of the path; from the source itself, its weight.
  robust::Ball<robust::DoubleDouble> leg(const Candidate& c, VertexId v);
  robust::Ball<robust::Mpfr> leg(const Candidate& c, VertexId v, int bits) const;
  /// A path to v: the weight of the source, and its straight legs from v backwards.
  struct Leg {
    WindowId window;  ///< kNone: along an edge
    VertexId from, to;
    std::optional<robust::RootSum> squared;  ///< length; empty if that is too long a sum
  };
  struct Path {
    mpq_class weight;
    std::vector<Leg> legs;
  };
  std::optional<Path> exact_path(const Candidate& c, VertexId v) const;
  template <class Winner>
  std::optional<Path> exact_path(const Candidate& c, VertexId v, const Winner& winner) const;
  std::optional<robust::RootSum> squared_leg(const Candidate& c, VertexId v) const;
  bool has_long_image(WindowId window) const;
  bool proves_as_far(WindowId window, VertexId v) const;
  robust::Ball<robust::DoubleDouble> enclosed_leg(const Candidate& c, VertexId v) const;
  bool are_equal(const Leg& a, const Leg& b) const;
  bool show_end_alike(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b) const;
  robust::MaybeSign compare(const Path& a, const Path& b) const;

  const Frames& frames_;
  DistanceField& field_;
  const std::vector<SourceVertex>& sources_;
  LabelSets& sets_;
  std::vector<std::uint32_t> source_of_vertex_;
  std::vector<LabelSetId> labels_;
  std::vector<std::uint8_t> proved_;
  struct Straightest {
    std::uint32_t candidate = kNone;
    std::uint32_t legs = 0;
  };
  std::vector<Straightest> straightest_;  ///< per vertex, of the paths that tie there
  std::vector<robust::Ball<robust::DoubleDouble>> distance_;
  std::unique_ptr<WindowImages> images_;
  std::unique_ptr<ExactUnfoldings> exact_;
  mutable std::once_flag allocate_as_far_;
  mutable std::vector<std::atomic<std::uint8_t>> as_far_;  // per window: what `is_as_far` found
};

/// The double nearest to D(v) in mesh units, by stages; counted under `rounding`. Thread-safe.
double rounded_distance(const Resolution& resolution, VertexId v, predicates::Decisions& decisions);

}  // namespace gvd::kernel
