#pragma once

#include <array>
#include <cstddef>
#include <forward_list>
#include <map>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "gvd/kernel/distance_field.hpp"
#include "gvd/kernel/facet.hpp"
#include "gvd/kernel/resolution.hpp"
#include "gvd/kernel/unfolding.hpp"
#include "strip_parting.hpp"
#include "unfolded_windows.hpp"
#include "window_interval.hpp"

namespace gvd::kernel {

/// The wave set of a facet, taken from the distance field. Numbers are made on demand and kept; used by one thread at a time.
class FieldWaves final : public FacetWaves {
 public:
  /// `unfolded`: windows that are known already; it may lack any.
  FieldWaves(const Resolution& resolution, const std::vector<VertexKind>& kinds, FaceId f, const UnfoldedWindows* unfolded = nullptr);

  const predicates::FacetFrame<F>& frame(F) override { return frame_; }
  const predicates::Site<F>& site(std::size_t i, F) override { return sites_[i]; }
  const predicates::FacetFrame<DD>& frame(DD) override;
  const predicates::Site<DD>& site(std::size_t i, DD) override;
  predicates::FacetFrame<DD> precise_frame() override;
  predicates::PreciseWave precise_wave(std::size_t i) override;
  const predicates::FacetFrame<M>& frame(M, int bits) override;
  const predicates::Site<M>& site(std::size_t i, M, int bits) override;
  const predicates::FacetFrame<robust::Exact>* exact_frame() override;
  const predicates::Site<robust::Exact>* exact_site(std::size_t i) override;

  bool exact_is_cheap() override;
  std::vector<predicates::Site<robust::Exact>> where_they_part(std::span<const std::uint32_t> which) override;
  // Who is asked for its cone or its image is a window; only relays and mirror images may be corners.
  bool is_own_relay(std::size_t parent, std::size_t relay) override;
  bool is_at_cone_vertex(std::size_t parent, std::size_t relay) override { return has_relay_on_strip(parent, relay); }
  bool have_one_image(std::size_t left, std::size_t right) override;
  bool share_cone_vertex(std::size_t a, std::size_t end_a, std::size_t b, std::size_t end_b) override;
  bool is_relay_on_ray(std::size_t parent, std::size_t end, std::size_t relay) override;
  bool are_proved_one_wave(std::size_t a, std::size_t b) override;
  bool are_mirror_images(std::size_t entering, std::size_t other) override;
  bool is_mirrored_at_cone_vertex(std::size_t parent, std::size_t end, std::size_t other, std::uint8_t side) override;
  bool is_mirrored_on_strip(std::size_t parent, std::size_t other, std::uint8_t side) override;
  bool are_as_far_from_corner(std::size_t a, std::size_t b, std::uint8_t k) override;
  /// Gives back what only the MPFR stage needs.
  void forget_frames();

  /// The label set that all sites share; kNone if there are several.
  LabelSetId only_label() const noexcept;

 private:
  /// A window that may be nearest somewhere in the facet, while they are sorted out.
  struct Arrival : WindowInterval {
    WindowId window;
    const UnfoldedWindows::Entry* unfolded;
  };
  /// While they are sorted out: room that the three sides share.
  struct Arrivals {
    std::array<std::byte, 1 << 12> first_room;
    std::pmr::monotonic_buffer_resource room{first_room.data(), first_room.size()};
    std::pmr::vector<Arrival> all{&room}, kept{&room};
    std::array<double, 2> upper{};  ///< bounds of the distances of the present side's ends
    std::forward_list<UnfoldedWindows::Entry> unfolded;  ///< those that nobody knew
  };
  std::size_t most_sites() const;
  void add_side(std::uint8_t side, Arrivals& arrivals);
  bool arrive(WindowId window, std::uint8_t side, Arrivals& arrivals, Arrival& arrival) const;
  void add_window(const Arrival& arrival, std::uint8_t side);
  void add_corner(std::uint8_t k);
  using Sides = std::vector<HalfedgeId>;
  bool enclose_only_flat(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b) const;
  template <class T, class FrameOf>
  predicates::Disc<T> image_of(std::span<const HalfedgeId> sides, const FrameOf& frame_of, double unit) const;
  template <class T, class FrameOf>
  bool have_images_apart(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b, const FrameOf& frame_of, double unit) const;
  bool have_images_apart(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b);
  bool show_one_image(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b) const;
  bool show_last_common_side_alike(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b) const;
  bool have_one_image_by_algebra(std::span<const HalfedgeId> a, std::span<const HalfedgeId> b);
  std::uint8_t side_entered(std::span<const HalfedgeId> sides) const;
  predicates::StripProgram program_beyond(std::uint8_t side, std::span<const HalfedgeId> sides) const;
  bool show_mirror_images(std::uint8_t side, std::span<const HalfedgeId> entering, std::span<const HalfedgeId> other) const;
  WindowId last_turn(WindowId strip, VertexId v) const;
  std::optional<Sides> sides_since(WindowId strip, VertexId v) const;
  bool goes_on_as(WindowId strip, WindowId since, WindowId other) const;
  WindowId arrival(WindowId strip, VertexId v) const;
  bool has_relay_on_strip(std::size_t parent, std::size_t relay);
  bool comes_nearest_to(WindowId strip, VertexId v) const;
  bool bounds_cone(WindowId strip, std::size_t end, VertexId v) const;
  bool comes_straight_through(VertexId nearer, VertexId farther, WindowId strip) const;
  bool is_image_of_root(const Sides& way, std::size_t relay);
  bool has_relay_on_other_way(std::size_t parent, std::size_t relay);
  std::optional<Sides> turn_about(HalfedgeId first, bool left, FaceId end) const;
  std::optional<Sides> way_about(const Candidate& way, VertexId v, bool left, FaceId end) const;
  void note_cone(FacetSite& site, const UnfoldedWindows::Entry& unfolded) const;
  const predicates::Strip& strip(std::size_t i) const;
  template <class T>
  predicates::Site<robust::Ball<T>> make_site(const FacetSite& site, const predicates::Unfolding<T>& at, const robust::Ball<T>& weight,
                                              const predicates::EdgeFrame<T>& first, double unit) const;
  template <class T>
  predicates::FacetFrame<robust::Ball<T>> make_frame(const predicates::EdgeFrame<T>& first, double unit) const;
  void make_exact();
  HalfedgeId common_side(std::span<const WindowId> windows, std::span<const VertexId> roots) const;
  bool step_back(std::vector<WindowId>& windows) const;
  bool step_over_detours(std::vector<WindowId>& windows);
  std::optional<Parting> parting_of_strips(std::vector<WindowId> back, std::span<const VertexId> roots);
  std::vector<predicates::Site<robust::Exact>> sites_at(const Parting& parting, std::span<const VertexId> roots);
  robust::Exact exact_weight(VertexId root, const robust::Exact& unit) const;
  predicates::Site<robust::Exact> make_exact_site(const FacetSite& site) const;

  const Resolution& resolution_;
  const DistanceField& field_;
  const std::vector<VertexKind>& kinds_;
  predicates::FacetFrame<F> frame_;
  std::vector<predicates::Site<F>> sites_;
  mutable std::vector<predicates::Strip> strips_;  ///< made on demand
  const UnfoldedWindows* unfolded_;

  /// What only few facets need.
  struct Precise {
    std::unique_ptr<predicates::FacetFrame<DD>> dd_frame;
    std::vector<std::unique_ptr<predicates::Site<DD>>> dd_sites;
    struct AtBits {
      std::unique_ptr<predicates::FacetFrame<M>> frame;
      std::vector<std::unique_ptr<predicates::Site<M>>> sites;
      MpfrFrames frames;
    };
    std::map<int, AtBits> at_bits;
    std::optional<bool> one_class;
    std::unique_ptr<predicates::FacetFrame<robust::Exact>> exact_frame;
    robust::Exact exact_unit;  ///< the length of the first side in scaled units
    std::vector<std::unique_ptr<predicates::Site<robust::Exact>>> exact_sites;
  };
  Precise& precise();
  Precise::AtBits& at_bits(int bits);
  std::unique_ptr<Precise> precise_;
};

}  // namespace gvd::kernel
