#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/predicates/face_frames.hpp"
#include "gvd/predicates/strip_program.hpp"
#include "gvd/robust/double_double.hpp"
#include "gvd/robust/gmp.hpp"
#include "gvd/robust/mpfr_float.hpp"
#include "gvd/robust/root_sum.hpp"
#include "gvd/robust/square_classes.hpp"

namespace gvd::kernel {

using predicates::ExactFace;
class InsertedPositions;

/// The frames of all half-edges of a mesh in every number type. All lengths are in *scaled units*: mesh units times 2^-scale(), chosen so that
/// the largest coordinate difference lies in [1, 2). Thread-safe; what is costly is made on demand.
class Frames {
 public:
  explicit Frames(const Mesh& mesh);

  int scale() const noexcept { return scale_; }
  /// Errors of all number types: docs/error-bounds.md#frames.
  const std::vector<predicates::EdgeFrame<double>>& in_double() const noexcept { return double_; }
  const predicates::EdgeFrame<double>& operator()(HalfedgeId h) const noexcept { return double_[h]; }
  /// Cached: the reference stays.
  const predicates::EdgeFrame<robust::DoubleDouble>& in_double_double(HalfedgeId h) const {
    const std::atomic<std::uint8_t>* const states = states_.load(std::memory_order_acquire);
    if (states == nullptr || states[Mesh::face(h)].load(std::memory_order_acquire) != kReady) make_in_double_double(Mesh::face(h));
    return double_double_[h].frame;
  }
  /// Cost: some hundred MPFR operations; not cached.
  std::array<predicates::EdgeFrame<robust::Mpfr>, 3> in_mpfr(FaceId f, int bits) const;
  /// In scaled units. Here and in the next two, the last ones made are cached.
  std::shared_ptr<const ExactFace> exact(FaceId f) const;
  /// The face as a layer of a strip's program.
  std::shared_ptr<const predicates::ProgramFace> for_program(FaceId f) const;
  /// The frames of the face's half-edges in exact numbers, without the lengths.
  using RootFrames = std::array<predicates::EdgeFrame<robust::RootSum>, 3>;
  std::shared_ptr<const RootFrames> in_roots(FaceId f) const;
  /// The square class of the face's radicand: equal numbers if and only if the radicands differ by a rational square. Cached.
  std::uint32_t square_class(FaceId f) const;
  const Mesh& mesh() const noexcept { return mesh_; }
  /// Whether a side is below 2^-200 of the longest, or too long for doubles: then the error bounds of the frames do not hold.
  bool has_underflow() const noexcept { return underflow_; }

 private:
  template <class T>
  std::array<predicates::EdgeFrame<T>, 3> make(FaceId f, int bits) const;
  template <class T>
  std::array<T, 3> side(FaceId f, int k, int bits) const;
  std::array<predicates::EdgeFrame<robust::DoubleDouble>, 3> make_double_double(FaceId f) const;

  const Mesh& mesh_;
  int scale_ = 0;
  bool underflow_ = false;
  std::vector<predicates::EdgeFrame<double>> double_;
  struct alignas(64) CacheLine {
    CacheLine() {}  // empty until the frame is made
    union {
      predicates::EdgeFrame<robust::DoubleDouble> frame;
    };
  };
  enum State : std::uint8_t { kEmpty, kBeingMade, kReady };
  void make_in_double_double(FaceId f) const;
  mutable std::unique_ptr<CacheLine[]> double_double_;  // per half-edge
  mutable std::shared_ptr<const InsertedPositions> inserted_;
  mutable std::unique_ptr<std::atomic<std::uint8_t>[]> state_;        // per face
  mutable std::atomic<const std::atomic<std::uint8_t>*> states_{nullptr};  // the same, once they are there
  mutable std::once_flag allocate_;
  ExactFace make_exact(FaceId f) const;
  struct Exactly {
    predicates::ProgramFace program;
    RootFrames frames;
  };
  std::shared_ptr<const Exactly> exactly(FaceId f) const;
  struct ExactSlot {
    std::mutex mutex;
    FaceId face = kNone;
    std::shared_ptr<const Exactly> numbers;
  };
  static constexpr std::size_t kMostExactSlots = 1 << 14;  // some 50 MB when full
  mutable std::once_flag allocate_exact_;
  mutable std::vector<ExactSlot> exact_;
  struct Classes {
    std::mutex mutex;
    robust::SquareClasses list;
    std::vector<std::uint32_t> of_face;
  };
  mutable Classes classes_;
};

}  // namespace gvd::kernel
