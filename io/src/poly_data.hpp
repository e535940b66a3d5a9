#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "gvd/kernel/mesh.hpp"

namespace gvd::io {

/// What a VTK XML PolyData file of ours can hold.
struct PolyData {
  template <class Number>
  struct Array {
    std::string name;
    std::vector<Number> values;
  };
  /// Cells of one kind: cell i has the points connectivity[offsets[i-1] .. offsets[i]).
  struct Cells {
    std::vector<std::int64_t> connectivity, offsets;
    void add(const std::vector<std::int64_t>& points);
  };

  std::vector<kernel::Point> points;
  Cells verts, lines, polys;
  std::vector<Array<double>> point_numbers;
  std::vector<Array<std::int32_t>> point_ids;
  std::vector<Array<std::int32_t>> cell_ids;  ///< verts first, then lines, then polys
  std::vector<Array<double>> field;
};

/// Arrays are written as base64 of little-endian values behind a UInt64 byte count, uncompressed.
void write_poly_data(std::ostream& out, const PolyData& data);

}  // namespace gvd::io
