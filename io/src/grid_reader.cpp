#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "file_cursor.hpp"
#include "mesh_formats.hpp"

/// ESRI ASCII grid: ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize or dx and dy, optionally NODATA_value
/// (default -9999), in any order and case, then the heights row by row from the north. Each height belongs to the centre of its
/// cell: with xllcorner column c lies at xllcorner + (c + 1/2) dx, with xllcenter at xllcenter + c dx (each rounded once), and
/// likewise for rows, from the south.
///
/// Vertices: one for each height, in the order of the file, without those that belong to no triangle. Faces: squares in the order
/// of the file (by their north-west corner), counter-clockwise seen from above. A square with four heights is cut by the diagonal
/// whose ends differ less in height (differences rounded to doubles), on a draw by that from south-west to north-east; a square
/// with three heights is one triangle. Where the faces at a vertex would form two fans that meet nowhere else near it, the vertex
/// is doubled, so the surface is not connected there: the fan that comes first keeps the vertex, the other gets a copy; copies
/// come after all other vertices.
namespace gvd::io {
namespace {

using kernel::kNone;
using kernel::MeshArrays;

struct Axis {
  double first = 0;    ///< of the lowest centre, or of the lowest border
  double offset = 0;   ///< of the lowest centre from `first`, in steps
  double step = 0;
  double at(std::uint32_t index) const { return std::fma(index + offset, step, first); }
};

struct GridHeader {
  std::uint32_t columns = 0, rows = 0;
  Axis x, y;
  double nodata = -9999;
};

class GridReader {
 public:
  GridReader(std::string_view bytes, const std::string& name) : in_(bytes, name) {}

  GridHeader read_header() {
    static constexpr std::string_view kKeys[] = {"ncols", "nrows", "xllcorner", "yllcorner", "xllcenter", "yllcenter",
                                                 "cellsize", "dx", "dy", "nodata_value", "nodata"};
    while (in_.seek_word()) {
      const std::size_t line_start = in_.position();
      const std::string_view word = in_.word();
      std::string key = lower_case(word.substr(0, 40));
      if (std::find(std::begin(kKeys), std::end(kKeys), key) == std::end(kKeys)) {
        const bool number = key.find_first_not_of("0123456789+-.") != 0 || key.starts_with("nan");
        if (!number) in_.refuse(fmt::format("unknown header line {}", quoted(word)));
        in_.seek(line_start);
        break;
      }
      if (key == "nodata") key = "nodata_value";
      const std::string_view value = in_.word_on_line();
      if (value.empty()) in_.refuse(fmt::format("{} has no value", key));
      if (!values_.emplace(key, number(key, value)).second) in_.refuse(fmt::format("a second {}", key));
    }
    GridHeader header;
    header.columns = static_cast<std::uint32_t>(value("ncols"));
    header.rows = static_cast<std::uint32_t>(value("nrows"));
    header.x = axis("xll", "dx");
    header.y = axis("yll", "dy");
    if (const auto at = values_.find("nodata_value"); at != values_.end()) header.nodata = at->second;
    in_.expect_room(std::uint64_t{header.columns} * header.rows, 2, "the number of heights");
    if (std::uint64_t{header.columns} * header.rows >= kNone / 2) in_.refuse("the grid has too many heights");
    return header;
  }

  /// All heights; NaN where there is none.
  std::vector<double> read_heights(const GridHeader& header) {
    std::vector<double> heights(std::size_t{header.columns} * header.rows);
    const bool nodata_is_nan = std::isnan(header.nodata);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const std::string_view word = in_.word();
      if (word.empty()) {
        in_.refuse(fmt::format("the file ends where the height of row {}, column {} is expected ({} rows of {} columns, from 1)",
                               i / header.columns + 1, i % header.columns + 1, header.rows, header.columns));
      }
      heights[i] = height(word, "height", nodata_is_nan);
      if (heights[i] == header.nodata) heights[i] = std::numeric_limits<double>::quiet_NaN();
    }
    if (in_.seek_word()) in_.refuse(fmt::format("there is more after {} rows of {} heights", header.rows, header.columns));
    return heights;
  }

 private:
  double height(std::string_view word, std::string_view what, bool may_be_nan) const {
    if (may_be_nan && lower_case(word.substr(0, 4)) == "nan") return std::numeric_limits<double>::quiet_NaN();
    return in_.real(word, what);
  }

  double number(const std::string& key, std::string_view word) const {
    if (key == "ncols" || key == "nrows") return static_cast<double>(in_.integer(word, key, 1, std::int64_t{kNone} - 1));
    return key == "nodata_value" ? height(word, key, true) : in_.real(word, key);
  }

  double value(const std::string& key) const {
    const auto at = values_.find(key);
    if (at == values_.end()) in_.refuse(fmt::format("the header has no {}", key));
    return at->second;
  }

  Axis axis(const std::string& origin, const std::string& step) const {
    Axis axis;
    const bool corner = values_.count(origin + "corner") != 0;
    if (corner && values_.count(origin + "center") != 0) in_.refuse(fmt::format("both {0}corner and {0}center", origin));
    if (!corner && values_.count(origin + "center") == 0)
      in_.refuse(fmt::format("the header has neither {0}corner nor {0}center", origin));
    axis.first = value(origin + (corner ? "corner" : "center"));
    axis.offset = corner ? 0.5 : 0;
    const std::string step_key = values_.count(step) != 0 ? step : "cellsize";
    if (step_key == step && values_.count("cellsize") != 0) in_.refuse(fmt::format("both cellsize and {}", step));
    axis.step = value(step_key);
    if (!(axis.step > 0)) in_.refuse(fmt::format("{} is not positive", step_key));
    return axis;
  }

  FileCursor in_;
  std::map<std::string, double> values_;
};

/// The squares of a grid with their triangles. Vertices are numbered as the heights.
class GridTriangulation {
 public:
  GridTriangulation(const GridHeader& header, const std::vector<double>& heights) : header_(header), z_(heights) {}

  MeshArrays triangulate() {
    for (std::uint32_t row = 0; row + 1 < header_.rows; ++row) {
      for (std::uint32_t column = 0; column + 1 < header_.columns; ++column) add_square(row, column);
    }
    compact();
    return std::move(mesh_);
  }

 private:
  std::uint32_t id(std::uint32_t row, std::uint32_t column) const { return row * header_.columns + column; }
  bool has(std::uint32_t v) const { return !std::isnan(z_[v]); }

  void add_square(std::uint32_t row, std::uint32_t column) {
    const std::uint32_t nw = id(row, column), ne = nw + 1, sw = id(row + 1, column), se = sw + 1;
    const int heights = has(nw) + has(ne) + has(sw) + has(se);
    if (heights < 3) return;
    if (!has(nw)) return add_face(row, column, {sw, se, ne});
    if (!has(ne)) return add_face(row, column, {nw, sw, se});
    if (!has(sw)) return add_face(row, column, {nw, se, ne});
    if (!has(se)) return add_face(row, column, {sw, ne, nw});
    if (std::abs(z_[nw] - z_[se]) < std::abs(z_[sw] - z_[ne])) {
      add_face(row, column, {nw, sw, se});
      add_face(row, column, {nw, se, ne});
    } else {
      add_face(row, column, {sw, se, ne});
      add_face(row, column, {sw, ne, nw});
    }
  }

  void add_face(std::uint32_t row, std::uint32_t column, std::array<std::uint32_t, 3> face) {
    for (auto& v : face) v = fan_vertex(v, row, column);
    mesh_.faces.push_back(face);
  }

  /// Whether the square with this north-west corner has three or four heights.
  bool is_used(std::uint32_t row, std::uint32_t column) const {
    if (row >= header_.rows - 1 || column >= header_.columns - 1) return false;  // so also for -1, which wraps round
    const std::uint32_t nw = id(row, column), sw = nw + header_.columns;
    return has(nw) + has(nw + 1) + has(sw) + has(sw + 1) >= 3;
  }

  /// v, or its copy if the faces at v form two fans and this square is not in the fan of the first square at v.
  /// The four squares at v, in a circle, hang together over the heights north, east, south and west of v.
  std::uint32_t fan_vertex(std::uint32_t v, std::uint32_t row, std::uint32_t column) {
    const std::uint32_t r = v / header_.columns, c = v % header_.columns;
    const std::array<std::array<std::uint32_t, 2>, 4> square = {
        {{r - 1, c - 1}, {r - 1, c}, {r, c}, {r, c - 1}}};  // nw, ne, se, sw
    std::array<bool, 4> used{}, joined{};  // joined: square k with the next one
    for (std::size_t k = 0; k < 4; ++k) used[k] = is_used(square[k][0], square[k][1]);
    joined[0] = used[0] && used[1] && has(v - header_.columns);
    joined[1] = used[1] && used[2] && has(v + 1);
    joined[2] = used[2] && used[3] && has(v + header_.columns);
    joined[3] = used[3] && used[0] && has(v - 1);
    // Squares in the order of the file: nw, ne, sw, se.
    const std::size_t first = used[0] ? 0 : used[1] ? 1 : used[3] ? 3 : 2;
    std::array<bool, 4> reached{};
    for (std::size_t k = first, n = 0; n < 4; k = (k + 1) % 4, ++n) {
      reached[k] = true;
      if (!joined[k]) break;
    }
    for (std::size_t k = first, n = 0; n < 4; ++n) {
      reached[k] = true;
      k = (k + 3) % 4;
      if (!joined[k]) break;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      if (square[k] == std::array{row, column} && !reached[k]) return kCopy | v;
    }
    return v;
  }

  /// Numbers the vertices that are used, and then the copies.
  void compact() {
    constexpr std::uint32_t kUsed = 0;
    std::vector<std::uint32_t> number(z_.size(), kNone);
    std::map<std::uint32_t, std::uint32_t> copies;
    for (const auto& face : mesh_.faces) {
      for (const auto v : face) {
        if ((v & kCopy) != 0) {
          copies.emplace(v & ~kCopy, 0);
        } else {
          number[v] = kUsed;
        }
      }
    }
    for (std::uint32_t v = 0; v < number.size(); ++v) {
      if (number[v] == kUsed) number[v] = add_point(v);
    }
    for (auto& [v, copy] : copies) copy = add_point(v);
    for (auto& face : mesh_.faces) {
      for (auto& v : face) v = (v & kCopy) != 0 ? copies[v & ~kCopy] : number[v];
    }
  }

  std::uint32_t add_point(std::uint32_t v) {
    const std::uint32_t row = v / header_.columns, column = v % header_.columns;
    mesh_.points.push_back({header_.x.at(column), header_.y.at(header_.rows - 1 - row), z_[v]});
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
  }

  static constexpr std::uint32_t kCopy = 0x80000000u;

  const GridHeader& header_;
  const std::vector<double>& z_;
  MeshArrays mesh_;
};

}  // namespace

MeshArrays read_grid(std::string_view bytes, const std::string& name) {
  GridReader reader(bytes, name);
  const GridHeader header = reader.read_header();
  const std::vector<double> heights = reader.read_heights(header);
  return GridTriangulation(header, heights).triangulate();
}

}  // namespace gvd::io
