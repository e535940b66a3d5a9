#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gvd/predicates/ladder.hpp"
#include "gvd/predicates/strip.hpp"
#include "gvd/robust/gmp.hpp"

/// Strips of faces for callers with a mesh, windows and a propagation of their own. Nothing here needs the kernel.
///
/// Coordinates are the caller's doubles, taken as exact real numbers; sizes from 1e-300 to 1e300 are fine. What is wrong with the input is
/// told by std::invalid_argument, before anything is changed. Distinct strips, also copies of one another, may be used by distinct threads.
namespace gvd::predicates {

/// A point of space: three finite doubles.
using SpacePoint = std::array<double, 3>;
using FaceCorners = std::array<SpacePoint, 3>;
/// A face by indices into the caller's vertices.
using FaceIndices = std::array<std::uint32_t, 3>;

/// A point of a face: (w0 V0 + w1 V1 + w2 V2) / (w0 + w1 + w2), the V in the order in which the face was given. Weights are rationals >= 0,
/// not all zero; two zeros make a vertex, one zero a point of an edge.
struct FacePoint {
  std::array<mpq_class, 3> weight;

  static FacePoint corner(std::size_t k);
  /// V_k + t (V_k+1 - V_k), 0 <= t <= 1.
  static FacePoint on_side(std::size_t k, const mpq_class& t);
};

class FaceShape;

/// A source in a first face, and the faces that its straight lines cross from there on. The strip knows nothing of other faces: the same
/// face may occur again, and a strip may wander as it likes (whether its source sees anything through it is asked by `cone_of`).
///
/// Vertices of a strip have numbers: 0, 1, 2 are the corners of the first face as given; crossing a face adds its new corner as the next one.
/// The first face is taken to be counter-clockwise as given; that fixes what is left and right. The others may be given either way round.
class FaceStrip {
 public:
  FaceStrip(const FaceCorners& first, const FacePoint& source);
  FaceStrip(std::span<const SpacePoint> vertices, const FaceIndices& first, const FacePoint& source);

  /// Goes on into a neighbour: a face that shares with the last face one edge, other than the one by which the strip came in, and not one
  /// that contains the source.
  void cross(const FaceCorners& face);
  void cross(std::span<const SpacePoint> vertices, const FaceIndices& face);

  std::size_t crossings() const noexcept { return faces_.size() - 1; }
  std::size_t vertex_count() const noexcept { return vertices_.size(); }
  const SpacePoint& vertex(std::size_t v) const { return vertices_.at(v); }
  /// The last face, its corners in the order given.
  const FaceCorners& last_face() const noexcept { return last_; }

  /// Whether both are the same description: equal coordinates and equal source.
  friend bool operator==(const FaceStrip& a, const FaceStrip& b);

 private:
  friend class StripAccess;
  FaceCorners last_;
  std::array<std::uint8_t, 3> place_{0, 1, 2};  ///< per corner of last_: 0 at the origin, 1 at the target of the entry edge, 2 its apex
  std::array<mpq_class, 3> source_;             ///< barycentric, sum 1
  std::vector<SpacePoint> vertices_;
  /// The faces as crossed, each with its entry edge as first side; the first one is cut down to the triangle of its exit edge and the source.
  std::vector<std::shared_ptr<const FaceShape>> faces_;
  Strip strip_;  ///< half-edge 3 k + j: side j of faces_[k]
  std::uint8_t exit_ = 0;  ///< side of the first face by which the strip leaves it
};

/// On which side of the ray from the source's image through vertex `through` of the strip vertex `v` lies, unfolded: positive iff on the
/// left, zero iff all three are in line. Laws: swapping `through` and `v` negates (turns of less than pi, as all are that matter);
/// invariant under a common similarity; extending the strip changes nothing.
/// Pre: both are ends of the first edge crossed or were added later, or are the source itself (then zero); for strips without crossing all
/// three corners will do. Throws std::invalid_argument otherwise. Cost: O(crossings) a stage.
Decision ray_side(const FaceStrip& strip, std::size_t through, std::size_t v);
robust::MaybeSign ray_side_at(const Rung& rung, const FaceStrip& strip, std::size_t through, std::size_t v);

/// What the source sees through the strip.
struct ConeDecision {
  enum class Sight { interval, nothing, undecided };
  Sight sight = Sight::undecided;
  /// The vertices whose rays bound the cone, left and right; meaningful for `interval` only.
  std::array<std::size_t, 2> bound{0, 0};
  /// The latest stage that took part.
  robust::Stage stage = robust::Stage::undecided;
};
/// Whether straight lines from the source through the strip reach more than one point of its last edge crossed, and what bounds them.
/// Pre: at least one crossing. Cost: O(crossings^2), as each new corner is compared with both bounds.
ConeDecision cone_of(const FaceStrip& strip);

}  // namespace gvd::predicates
