#pragma once

#include <functional>
#include <limits>
#include <queue>

#include "gvd/kernel/distance_field.hpp"
#include "gvd/robust/double_pair.hpp"
#include "exact_unfoldings.hpp"
#include "shadow.hpp"
#include "window_interval.hpp"

namespace gvd::kernel {

/// What the machine code of the innermost loop may use; the numbers are the same.
enum class Instructions : std::uint8_t { any, least };

/// The state of one run of `propagate`. Error constants: docs/error-bounds.md#propagation.
class Propagation {
 public:
  Propagation(const Frames& frames, const std::vector<VertexKind>& kinds, DistanceField& field, predicates::Decisions& decisions,
              Instructions instructions = Instructions::any);
  bool run(std::span<const WaveStart> starts, PropagationPoll poll, void* user);

 private:
  using Image = predicates::Complex<double>;
  using Frame = predicates::EdgeFrame<double>;

  /// A window while it waits to cross the face: its numbers in the frame of its half-edge.
  struct alignas(128) Wave : WindowInterval {
    robust::DoublePair cone_x, cone_y;     // the vertices that bound the cone
    std::uint32_t begin_turns, end_turns;  // faces crossed in a row about the origin and the target of the half-edge
    std::uint32_t steps;                   // faces crossed
    HalfedgeId mark;                       // an edge that was crossed: the last one at a number of faces that is a power of two
    WindowId window;
    VertexId root;
    std::uint32_t next;
  };
  /// The best proved sight of the apex over a half-edge: windows beside that ray and longer cannot cross it.
  struct ApexSight {
    double upper = std::numeric_limits<double>::infinity();  // certain upper bound of the distance
    double low = 0, high = 0;                                // where the ray crosses the half-edge
  };
  struct List {
    std::uint32_t first = kNone, last = kNone, size = 0;
    bool queued = false;
  };
  /// What waits at a half-edge.
  struct Side {
    ApexSight sight;
    List waiting;
  };
  /// Where the apex lies: seen, or beside the cone.
  enum class Sight : std::uint8_t { inside, on_ray_0, on_ray_1, beyond_0, beyond_1 };
  struct Listed {
    double begin;
    std::uint32_t wave;
  };
  struct Exit;
  struct Apex;

  void settle(VertexId v);
  void relax(VertexId v, const Candidate& candidate);
  void improve_settled(VertexId v, double low, const Candidate& candidate);
  void send_again(VertexId v);
  void send_waves(VertexId v, bool only_path);
  double least_length(VertexId v, const Candidate& c) const;
  void set_weight(VertexId v, double share);
  void relax_neighbours(VertexId v);
  void relax_over(VertexId v, VertexId to, double length);
  bool is_only_from(VertexId neighbour, std::uint32_t candidates) const;
  bool is_source(VertexId v) const;
  void emit(VertexId v, HalfedgeId outgoing, const Shadow* shadow);
  void emit_shadow(VertexId v, const Candidate& arrival, bool only_path);
  bool cut_at_shadow(const Shadow& shadow, HalfedgeId outgoing, Wave& wave);
  void push_lists_at(VertexId v);
  void push(HalfedgeId h);
  void prefetch(HalfedgeId h);
  void prefetch_ahead();
  bool drain();
  bool may_go_on();
  void cross_face(HalfedgeId h);
  void cross_face_by_avx(HalfedgeId h);
  void cross_face_here(HalfedgeId h);
  void trim_list(HalfedgeId h);
  std::size_t sort_waiting(HalfedgeId h);
  Sight see_apex(std::uint32_t wave, HalfedgeId h, const Apex& apex);
  static double apex_distance(const Wave& wave, const Frame& frame);
  static bool is_longer_to_apex(const Wave& wave, const Frame& frame, const ApexSight& best);
  Sight locate_apex(const Wave& wave, HalfedgeId h, const Apex& apex, double disc);
  Sight decide_apex(const Wave& wave, HalfedgeId h);
  Exit exit_over(HalfedgeId side, VertexId third, double parent_length, bool left) const;
  template <bool kLeft>
  void make_child(const Wave& wave, bool at_apex, Exit& exit);
  template <bool kLeft>
  static bool is_certainly_longer(const Image& image, const robust::DoublePair& ends, double rest, const Exit& exit);
  void splice(const Exit& exit);
  void make_room(std::size_t waves);
  void recycle(std::uint32_t wave) {
    waves_[wave].next = free_wave_;
    free_wave_ = wave;
    ++free_waves_;
  }

  const Mesh& mesh_;
  const Frames& all_frames_;
  const std::vector<Frame>& frames_;
  const std::vector<VertexKind>& kinds_;
  DistanceField& field_;
  ExactUnfoldings exact_;
  predicates::Decisions& decisions_;
  const bool by_avx_;

  std::vector<Wave> waves_;
  std::uint32_t free_wave_ = kNone;
  std::size_t free_waves_ = 0;
  std::vector<Side> sides_;
  std::vector<HalfedgeId> fifo_;
  std::size_t fifo_head_ = 0;
  std::uint32_t ahead_ = kNone;               // a wave of the list that is crossed next, fetched
  std::vector<double> upper_;                 // per vertex: certain upper bound of D
  std::vector<std::uint8_t> settled_;
  std::vector<std::uint32_t> degree_;         // faces at a vertex
  std::vector<double> emitted_weight_, emitted_error_;  // per settled vertex: what its windows carry
  std::vector<double> emitted_low_;                     // and how near it can be before they are sent again
  std::vector<WindowId> emitted_;             // per outgoing half-edge: the first window sent over the opposite side
  std::vector<std::uint8_t> cut_at_shadow_;   // per relay: what it sent is only what the one path to it leaves
  std::vector<std::uint8_t> sends_again_;     // settled vertices that are waiting to send their waves again
  std::vector<VertexId> to_send_again_;
  Shadow shadow_;
  std::vector<Listed> list_;                  // waves of the half-edge at hand: the first kept_ are left
  std::vector<Sight> sights_of_list_;         // of these
  std::size_t kept_ = 0;
  struct Entry {
    double distance;
    VertexId vertex;
    bool operator>(const Entry& other) const noexcept {
      return distance != other.distance ? distance > other.distance : vertex > other.vertex;
    }
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
  PropagationPoll poll_ = nullptr;
  void* user_ = nullptr;
  /// Work is counted in windows; one that the ladder has to place may cost as much as this many.
  static constexpr std::uint64_t kWorkBetweenPolls = 1 << 14, kWorkOfLadder = 256;
  std::uint64_t settled_count_ = 0, work_ = 0, next_poll_ = kWorkBetweenPolls;
  std::uint64_t filtered_orientations_ = 0, filtered_prunings_ = 0;
};

}  // namespace gvd::kernel
