#pragma once

#include <memory>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/source.hpp"

namespace gvd::bench {

/// The public yardstick: CGAL's Surface_mesh_shortest_path (the algorithm of Xin and Wang) with double coordinates and inexact
/// constructions. This part of CGAL is under the GPL: it is compiled into the benchmark only.
class Yardstick {
 public:
  /// Pre: no source is a vertex, none has a weight, and barycentric coordinates are doubles (those of `random_surface_sources`
  /// are).
  Yardstick(const kernel::Mesh& mesh, const std::vector<kernel::Source>& sources);
  ~Yardstick();
  /// Builds the sequence tree, which is CGAL's distance field. To be called once.
  void propagate();
  /// Distance of every vertex; infinity where there is none.
  std::vector<double> distances();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gvd::bench
