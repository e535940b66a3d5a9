#pragma once

#include <array>
#include <string>
#include <vector>

#include "gvd/io/arc_sampler.hpp"
#include "gvd/kernel/mesh.hpp"

namespace gvd::io {

/// The similarity from plan coordinates (x, y) to the pixels of a map (y downwards), and which faces are seen from above.
class PlanView {
 public:
  /// The longer side of the extent becomes `longest` pixels.
  PlanView(const kernel::Mesh& mesh, double longest);

  double width() const noexcept { return width_; }
  double height() const noexcept { return height_; }
  double pixels_per_unit() const noexcept { return scale_; }
  PlanePoint to_pixels(const kernel::Point& p) const { return {(p[0] - low_[0]) * scale_, height_ - (p[1] - low_[1]) * scale_}; }
  /// Whether the face looks up, when the mesh is turned so that most of its plan area does.
  bool is_seen(kernel::FaceId face) const { return seen_[face] != 0; }
  /// The normal of a face, upwards when seen, with the length of twice the area.
  kernel::Point normal(kernel::FaceId face) const;

 private:
  const kernel::Mesh& mesh_;
  std::array<double, 2> low_{};
  double scale_ = 1, width_ = 0, height_ = 0, up_ = 1;
  std::vector<char> seen_;
};

}  // namespace gvd::io
