#pragma once

#include <mutex>
#include <optional>

#include "gvd/predicates/face_frames.hpp"
#include "gvd/predicates/face_strip.hpp"
#include "gvd/predicates/root_strip.hpp"
#include "gvd/predicates/strip_program.hpp"
#include "gvd/robust/square_classes.hpp"

namespace gvd::predicates {

using ExactPoint = std::array<mpq_class, 3>;
ExactPoint exact_point(const SpacePoint& p);

/// A triangle with its frames in every number type, in units of 2^exponent: a power of two of its own, so that its largest coordinate
/// difference lies in [1, 2). Immutable for its users; what is costly is made on demand, once.
class FaceShape {
 public:
  /// Throws std::invalid_argument if a coordinate is not finite, differences overflow, or the area is zero.
  explicit FaceShape(const FaceCorners& corners);
  /// With an apex (corner 2) that may be no doubles.
  FaceShape(const SpacePoint& a, const SpacePoint& b, const ExactPoint& apex);

  int exponent() const noexcept { return exponent_; }
  /// Whether the error bounds of double and double-double hold.
  bool is_in_range() const noexcept { return in_range_; }
  /// The apex, rounded if it was given in rationals.
  const FaceCorners& corners() const noexcept { return corners_; }
  const ExactPoint exact_corner(std::size_t k) const;

  const std::array<EdgeFrame<double>, 3>& in_double() const noexcept { return double_; }
  const std::array<EdgeFrame<robust::DoubleDouble>, 3>& in_double_double() const;
  /// Not kept.
  std::array<EdgeFrame<robust::Mpfr>, 3> in_mpfr(int bits) const;
  const ExactFace& exact() const;
  /// Without the lengths.
  const std::array<EdgeFrame<robust::RootSum>, 3>& in_roots() const;
  /// In the caller's units, its root over the integer of its class. Not kept.
  ProgramFace for_program(robust::SquareClasses& classes) const;

 private:
  void prepare();
  std::array<Vector<mpq_class>, 3> exact_sides() const;
  template <class T>
  std::array<Vector<T>, 3> sides(int bits) const;

  FaceCorners corners_;
  std::optional<ExactPoint> apex_;
  int exponent_ = 0;
  bool in_range_ = false;
  std::array<EdgeFrame<double>, 3> double_;
  mutable std::once_flag double_double_once_, exact_once_, roots_once_;
  mutable std::array<EdgeFrame<robust::DoubleDouble>, 3> double_double_;
  mutable ExactFace exact_;
  mutable std::array<EdgeFrame<robust::RootSum>, 3> roots_;
};

}  // namespace gvd::predicates
