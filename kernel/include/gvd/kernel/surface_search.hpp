#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gvd/kernel/ids.hpp"
#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/robust/gmp.hpp"

namespace gvd::kernel {

/// The surface point nearest to a point in space.
struct NearestPoint {
  SurfacePoint at;
  mpq_class squared_distance;  ///< exactly
  double distance = 0;         ///< its root, correctly rounded
};

/// Finds surface points from positions in space: exactly, whatever the input. Doubles only rule out faces that are certainly too
/// far. Const functions may be called from several threads at once.
class SurfaceSearch {
 public:
  /// Builds a tree of boxes over the faces. The mesh must outlive it. Pre: the mesh is not refined. Cost: O(n log n).
  explicit SurfaceSearch(const Mesh& mesh);

  /// The exact nearest point of the surface, rational as it is. A tie gives the face with the lowest id. Throws InputError if a
  /// coordinate is not finite. Cost: usually O(log n), plus exact arithmetic on each face that may be as near as the nearest one
  /// (all of them for the centre of a sphere).
  NearestPoint nearest(const Point& p) const;

  /// The only surface point on the vertical line (x, y). It may belong to several faces, on a common edge or vertex.
  /// Throws InputError, with the faces, if the line misses the surface, meets it at several points, or runs along a vertical face
  /// or edge; and if a coordinate is not finite. Cost: usually O(log n).
  SurfacePoint drop(double x, double y) const;

 private:
  struct Box {
    Point low, high;
  };
  /// The left child of an inner node follows it. A leaf holds the faces order_[begin, end).
  struct Node {
    Box box;
    std::uint32_t right = kNone;
    std::uint32_t begin = 0, end = 0;
  };
  struct Item {
    Point middle;  ///< of the box of the face
    FaceId face;
  };
  struct Best;

  static Box around(const Box& a, const Box& b);
  static std::size_t longest_axis(std::span<const Item> items);
  Box face_box(FaceId f) const;
  void build(std::span<Item> items, std::uint32_t begin);
  void search(std::uint32_t node, const Point& p, Best& best) const;
  void collect(std::uint32_t node, double x, double y, std::vector<FaceId>& faces) const;

  const Mesh& mesh_;
  std::vector<FaceId> order_;
  std::vector<Node> nodes_;  // the first one is the root
};

}  // namespace gvd::kernel
