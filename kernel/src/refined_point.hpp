#pragma once

#include <array>
#include <utility>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/robust/gmp.hpp"

namespace gvd::kernel {

/// The faces of a refined mesh that are parts of a face of the input, found by its id. Memory: the split faces only.
class FaceParts {
 public:
  FaceParts() = default;
  FaceParts(const Mesh& input, const Mesh& refined);

  /// Calls visit(part) for each part of the input face, until it returns true. One part keeps the id of the face.
  template <class Visit>
  void for_each(FaceId input_face, Visit&& visit) const {
    if (visit(input_face)) return;
    for (auto part = first(input_face); part != parts_.end() && part->first == input_face; ++part)
      if (visit(part->second)) return;
  }
  bool is_split(FaceId input_face) const {
    const auto part = first(input_face);
    return part != parts_.end() && part->first == input_face;
  }

 private:
  using List = std::vector<std::pair<FaceId, FaceId>>;  // (face of the input, another part than the one of the same id), sorted
  List::const_iterator first(FaceId input_face) const;

  List parts_;
};

/// A surface point of the input as a point of the refined mesh, exactly.
struct RefinedPoint {
  VertexId vertex = kNone;        ///< of the refined mesh, set if the point is that vertex; then face and bary may be missing
  FaceId face = kNone;            ///< of the refined mesh
  std::array<mpq_class, 3> bary;  ///< in that face
};

/// Throws InputError if `at` is not a point of the input. Cost: proportional to the parts of its face.
RefinedPoint find_in_refined(const Mesh& input, const Mesh& refined, const FaceParts& parts, const SurfacePoint& at);

}  // namespace gvd::kernel
