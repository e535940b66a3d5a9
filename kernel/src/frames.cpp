#include "gvd/kernel/frames.hpp"

#include "gvd/predicates/root_strip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "gvd/robust/ball.hpp"
#include "gvd/robust/rational.hpp"
#include "inserted_positions.hpp"

namespace gvd::kernel {
namespace {

using robust::DoubleDouble;
using robust::Mpfr;

/// What the doubles of inserted vertices leave out of their positions.
class InsertedPoints {
 public:
  explicit InsertedPoints(const Mesh& mesh) : mesh_(mesh) {
    for (VertexId v = mesh.input_vertex_count(); v < mesh.vertex_count(); ++v) {
      const ExactPoint exact = mesh.exact_point(v);
      Point rest;
      for (std::size_t i = 0; i < 3; ++i) rest[i] = rounded(exact[i] - robust::exact_rational(mesh.point(v)[i]));
      rest_.push_back(rest);
    }
  }
  /// b - a, each coordinate to u (1 + 2^-12) of itself. False if it might be off by more (docs/error-bounds.md#frames).
  bool difference(VertexId a, VertexId b, Point& result) const {
    const Point p = rest(a), q = rest(b);
    for (std::size_t i = 0; i < 3; ++i) {
      const DoubleDouble d = robust::two_sum(mesh_.point(b)[i], -mesh_.point(a)[i]);
      result[i] = d.hi + (d.lo + (q[i] - p[i]));
      if (!(8 * (std::fabs(d.lo) + std::fabs(p[i]) + std::fabs(q[i])) <= 0x1p-12 * std::fabs(result[i]))) return false;
    }
    return true;
  }

 private:
  /// To a relative 2u; not a number where that takes more than a double, below 2^-1022.
  static double rounded(const mpq_class& x) {
    const double d = x.get_d();
    return sgn(x) == 0 || std::fabs(d) >= std::numeric_limits<double>::min() ? d : std::numeric_limits<double>::quiet_NaN();
  }
  Point rest(VertexId v) const { return mesh_.is_representable(v) ? Point{0, 0, 0} : rest_[v - mesh_.input_vertex_count()]; }
  const Mesh& mesh_;
  std::vector<Point> rest_;
};

constexpr int kMostPlainScale = 1000;  // 2 to this power and its inverse are normal doubles

mpq_class scaled(mpq_class x, int k) { return robust::shifted(std::move(x), k); }

}  // namespace

template <class T>
std::array<T, 3> Frames::side(FaceId f, int k, int bits) const {
  const VertexId a = mesh_.origin(3 * f + static_cast<unsigned>(k)), b = mesh_.target(3 * f + static_cast<unsigned>(k));
  std::array<T, 3> result;
  if (mesh_.is_representable(a) && mesh_.is_representable(b)) {
    const Point &p = mesh_.point(a), &q = mesh_.point(b);
    for (std::size_t i = 0; i < 3; ++i) {
      if constexpr (std::is_same_v<T, double>) {
        result[i] = robust::times_power_of_two(q[i] - p[i], -scale_);
      } else if constexpr (std::is_same_v<T, DoubleDouble>) {
        const DoubleDouble d = robust::two_sum(q[i], -p[i]);
        result[i] = {robust::times_power_of_two(d.hi, -scale_), robust::times_power_of_two(d.lo, -scale_)};
      } else {
        result[i] = (Mpfr(q[i], bits) - Mpfr(p[i], bits)).scaled(-scale_);
      }
    }
    return result;
  }
  if constexpr (std::is_same_v<T, DoubleDouble>)
    if (const auto difference = inserted_->difference(a, b, -scale_)) return *difference;
  const ExactPoint p = mesh_.exact_point(a), q = mesh_.exact_point(b);
  for (std::size_t i = 0; i < 3; ++i) result[i] = robust::from<robust::Ball<T>>(scaled(q[i] - p[i], -scale_), bits).mid();
  return result;
}

template <class T>
std::array<predicates::EdgeFrame<T>, 3> Frames::make(FaceId f, int bits) const {
  return predicates::face_frames(side<T>(f, 0, bits), side<T>(f, 1, bits), side<T>(f, 2, bits));
}

std::array<predicates::EdgeFrame<DoubleDouble>, 3> Frames::make_double_double(FaceId f) const {
  const VertexId a = mesh_.origin(3 * f), b = mesh_.origin(3 * f + 1), c = mesh_.origin(3 * f + 2);
  const bool are_points = mesh_.is_representable(a) && mesh_.is_representable(b) && mesh_.is_representable(c);
  if (!are_points || std::abs(scale_) > kMostPlainScale) return make<DoubleDouble>(f, 106);
  return predicates::face_frames(mesh_.point(a), mesh_.point(b), mesh_.point(c), std::ldexp(1.0, -scale_));
}

Frames::Frames(const Mesh& mesh) : mesh_(mesh) {
  double largest = 0;
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h)
    for (std::size_t i = 0; i < 3; ++i)
      largest = std::max(largest, std::fabs(mesh.point(mesh.target(h))[i] - mesh.point(mesh.origin(h))[i]));
  scale_ = largest > 0 && std::isfinite(largest) ? std::ilogb(largest) : 0;
  const double factor_a = std::ldexp(1.0, -scale_ / 2), factor_b = std::ldexp(1.0, -scale_ - (-scale_ / 2));
  double_.resize(mesh.halfedge_count());
  const InsertedPoints inserted(mesh);
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    std::array<std::array<double, 3>, 3> sides;
    for (unsigned k = 0; k < 3; ++k) {
      const VertexId a = mesh.origin(3 * f + k), b = mesh.target(3 * f + k);
      const Point &p = mesh.point(a), &q = mesh.point(b);
      Point difference{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
      if ((mesh.is_representable(a) && mesh.is_representable(b)) || inserted.difference(a, b, difference)) {
        for (std::size_t i = 0; i < 3; ++i) sides[k][i] = difference[i] * factor_a * factor_b;
      } else {
        sides[k] = side<double>(f, static_cast<int>(k), 53);
      }
    }
    const auto frames = predicates::face_frames(sides[0], sides[1], sides[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      double_[3 * f + k] = frames[k];
      if (!(frames[k].length > predicates::kLeastSide && frames[k].length < predicates::kMostSide)) underflow_ = true;
    }
  }
}

void Frames::make_in_double_double(FaceId f) const {
  std::call_once(allocate_, [&] {
    state_ = std::make_unique<std::atomic<std::uint8_t>[]>(mesh_.face_count());
    inserted_ = std::make_shared<const InsertedPositions>(mesh_);
    double_double_ = std::make_unique_for_overwrite<CacheLine[]>(mesh_.halfedge_count());
    states_.store(state_.get(), std::memory_order_release);
  });
  std::uint8_t state = kEmpty;
  if (state_[f].compare_exchange_strong(state, kBeingMade, std::memory_order_acq_rel)) {
    const auto frames = make_double_double(f);
    for (std::size_t k = 0; k < 3; ++k) std::construct_at(&double_double_[3 * f + k].frame, frames[k]);
    state_[f].store(kReady, std::memory_order_release);
  }
  while (state_[f].load(std::memory_order_acquire) != kReady) std::this_thread::yield();
}

std::array<predicates::EdgeFrame<Mpfr>, 3> Frames::in_mpfr(FaceId f, int bits) const { return make<Mpfr>(f, bits + 8); }

ExactFace Frames::make_exact(FaceId f) const {
  std::array<ExactPoint, 3> corner, side;
  for (unsigned k = 0; k < 3; ++k) corner[k] = mesh_.exact_point(mesh_.origin(3 * f + k));
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) side[k][i] = scaled(corner[(k + 1) % 3][i] - corner[k][i], -scale_);
  return predicates::exact_face(side);
}

std::shared_ptr<const Frames::Exactly> Frames::exactly(FaceId f) const {
  std::call_once(allocate_exact_, [&] { exact_ = std::vector<ExactSlot>(std::min<std::size_t>(kMostExactSlots, mesh_.face_count())); });
  ExactSlot& slot = exact_[f % exact_.size()];
  const std::scoped_lock lock(slot.mutex);
  if (slot.face != f) {
    auto made = std::make_shared<Exactly>();
    const ExactFace& face = made->program.face = make_exact(f);
    {
      const std::scoped_lock classes(classes_.mutex);
      made->program.doubled_area = classes_.list.root(face.radicand);
    }
    for (std::size_t k = 0; k < 3; ++k) made->frames[k] = predicates::root_frame(face, k, made->program.doubled_area);
    slot.numbers = std::move(made);
    slot.face = f;
  }
  return slot.numbers;
}

std::shared_ptr<const ExactFace> Frames::exact(FaceId f) const {
  auto numbers = exactly(f);
  return {numbers, &numbers->program.face};
}

std::shared_ptr<const predicates::ProgramFace> Frames::for_program(FaceId f) const {
  auto numbers = exactly(f);
  return {numbers, &numbers->program};
}

std::shared_ptr<const Frames::RootFrames> Frames::in_roots(FaceId f) const {
  auto numbers = exactly(f);
  return {numbers, &numbers->frames};
}

std::uint32_t Frames::square_class(FaceId f) const {
  const std::scoped_lock lock(classes_.mutex);
  if (classes_.of_face.empty()) classes_.of_face.assign(mesh_.face_count(), kNone);
  if (classes_.of_face[f] == kNone) classes_.of_face[f] = classes_.list(make_exact(f).radicand);
  return classes_.of_face[f];
}

}  // namespace gvd::kernel
