#pragma once

#include <array>
#include <optional>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/robust/double_double.hpp"
#include "gvd/robust/mpfr_float.hpp"

namespace gvd::kernel {

/// The positions of the vertices that sources inserted, in MPFR: their differences cost a fraction of those of rationals.
class InsertedPositions {
 public:
  explicit InsertedPositions(const Mesh& mesh);
  /// (b - a) 2^scale, each coordinate to half a unit in the last place but one, as of the exact difference. Empty where too much cancels
  /// (docs/error-bounds.md#frames).
  std::optional<std::array<robust::DoubleDouble, 3>> difference(VertexId a, VertexId b, int scale) const;

 private:
  robust::Mpfr coordinate(VertexId v, std::size_t i) const;

  const Mesh& mesh_;
  std::vector<std::array<robust::Mpfr, 3>> positions_;  // of vertex input_vertex_count() + i
};

}  // namespace gvd::kernel
