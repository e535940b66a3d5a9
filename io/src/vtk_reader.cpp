#include <fmt/format.h>

#include <optional>
#include <vector>

#include "binary_scalar.hpp"
#include "file_cursor.hpp"
#include "mesh_formats.hpp"

/// VTK legacy polydata ("VTK File Formats", Kitware): versions to 4.x with POLYGONS n size, and 5.x with OFFSETS and CONNECTIVITY.
/// VERTICES, LINES, FIELD and METADATA are passed over; what follows POINT_DATA or CELL_DATA is not looked at.
namespace gvd::io {
namespace {

using kernel::MeshArrays;

constexpr std::endian kVtkOrder = std::endian::big;

std::optional<ScalarType> scalar_type(std::string_view word) {
  const std::string name = lower_case(word.substr(0, 20));
  if (name == "float") return ScalarType::float32;
  if (name == "double") return ScalarType::float64;
  if (name == "char" || name == "signed_char") return ScalarType::int8;
  if (name == "unsigned_char") return ScalarType::uint8;
  if (name == "short") return ScalarType::int16;
  if (name == "unsigned_short") return ScalarType::uint16;
  if (name == "int" || name == "vtktypeint32") return ScalarType::int32;
  if (name == "unsigned_int" || name == "vtktypeuint32") return ScalarType::uint32;
  if (name == "long" || name == "vtktypeint64") return ScalarType::int64;
  if (name == "unsigned_long" || name == "vtktypeuint64") return ScalarType::uint64;
  // vtkIdType is written as a 32-bit integer, whatever the program that writes uses.
  if (name == "vtkidtype") return ScalarType::int32;
  return std::nullopt;
}

class VtkReader {
 public:
  VtkReader(std::string_view bytes, const std::string& name) : in_(bytes, name) {}

  MeshArrays read() {
    read_header();
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word()) {
      const std::string keyword = lower_case(word.substr(0, 40));
      if (keyword == "point_data" || keyword == "cell_data") break;
      read_section(keyword, word);
    }
    if (!have_points_) in_.refuse("the file has no POINTS");
    if (!have_polygons_) in_.refuse("the file has no POLYGONS");
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      for (const auto v : mesh_.faces[f]) {
        if (v >= mesh_.points.size()) {
          in_.refuse(fmt::format("polygon {}: vertex {} does not exist (there are {} vertices)", f, v, mesh_.points.size()));
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  void read_header() {
    const std::string first = lower_case(in_.line().substr(0, 200));
    if (!first.starts_with("# vtk datafile version ")) in_.refuse("'# vtk DataFile Version' is expected");
    major_version_ = first[23] >= '5' && first[23] <= '9' ? 5 : 4;
    in_.line();  // the title: any text
    const std::string encoding = lower_case(in_.word("ASCII or BINARY").substr(0, 20));
    if (encoding != "ascii" && encoding != "binary") in_.refuse("ASCII or BINARY is expected");
    binary_ = encoding == "binary";
    for (std::string_view word = in_.word("DATASET");; word = in_.word("DATASET")) {
      const std::string keyword = lower_case(word.substr(0, 20));
      if (keyword == "dataset") break;
      if (keyword != "field" && keyword != "metadata") in_.refuse(fmt::format("DATASET is expected, not {}", quoted(word)));
      read_section(keyword, word);
    }
    const std::string_view kind = in_.word("the kind of data set");
    if (lower_case(kind.substr(0, 20)) != "polydata")
      in_.refuse(fmt::format("data set {} is not read, only POLYDATA", quoted(kind)));
  }

  void read_section(const std::string& keyword, std::string_view word) {
    if (keyword == "points") {
      read_points();
    } else if (keyword == "polygons") {
      if (have_polygons_) in_.refuse("a second POLYGONS section");
      have_polygons_ = true;
      major_version_ >= 5 ? read_cells_5(true) : read_cells_4(true);
    } else if (keyword == "vertices" || keyword == "lines") {
      major_version_ >= 5 ? read_cells_5(false) : read_cells_4(false);
    } else if (keyword == "triangle_strips") {
      in_.refuse("TRIANGLE_STRIPS are not read (save separate triangles)");
    } else if (keyword == "field") {
      skip_field();
    } else if (keyword == "metadata") {
      skip_metadata();
    } else {
      in_.refuse(fmt::format("unknown section {}", quoted(word)));
    }
  }

  /// Binary data begin after the end of the line that announces them.
  void end_announcement() {
    if (!binary_) return;
    const std::string_view rest = in_.word_on_line();
    if (!rest.empty()) in_.refuse(fmt::format("unexpected {} before binary data", quoted(rest)));
    in_.line();
  }

  ScalarType type(std::string_view word) const {
    const auto found = scalar_type(word);
    if (!found) in_.refuse(fmt::format("unknown data type {}", quoted(word)));
    return *found;
  }

  std::size_t least_bytes(ScalarType scalar) const { return binary_ ? size_of(scalar) : 2; }

  void read_points() {
    if (have_points_) in_.refuse("a second POINTS section");
    have_points_ = true;
    const std::string_view number = in_.word("the number of points");
    const std::uint32_t points = in_.count(number, "number of points", 0);
    const ScalarType scalar = type(in_.word("the type of the points"));
    end_announcement();
    in_.expect_room(points, 3 * least_bytes(scalar), "number of points");
    mesh_.points.resize(points);
    for (auto& point : mesh_.points) {
      for (double& x : point)
        x = binary_ ? read_coordinate(in_, scalar, kVtkOrder) : in_.real(in_.word("a coordinate"), "coordinate");
    }
  }

  std::int64_t cell_number(ScalarType scalar, const char* what) {
    if (binary_) return read_integer(in_, scalar, kVtkOrder, what);
    return in_.integer(in_.word(what), what, std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
  }

  [[noreturn]] void refuse_here(const std::string& what) const { binary_ ? in_.refuse_byte(what) : in_.refuse(what); }

  void check_corners(std::int64_t cell, std::int64_t corners) const {
    if (corners != 3) refuse_here(fmt::format("polygon {} has {} corners; only triangles are read", cell, corners));
  }

  std::uint32_t corner(std::int64_t cell, ScalarType scalar) {
    const std::int64_t v = cell_number(scalar, "a vertex of a polygon");
    if (v < 0 || v >= std::int64_t{kernel::kNone}) refuse_here(fmt::format("polygon {}: vertex {} does not exist", cell, v));
    return static_cast<std::uint32_t>(v);
  }

  /// n cells in `size` integers: the number of corners, then the corners.
  void read_cells_4(bool keep) {
    const std::string_view number = in_.word("the number of cells");
    const std::uint32_t cells = in_.count(number, "number of cells", 0);
    const std::string_view size_word = in_.word("the size of the cells");
    const std::uint32_t size = in_.count(size_word, "size of the cells", 0);
    end_announcement();
    in_.expect_room(size, least_bytes(ScalarType::int32), "size of the cells");
    if (cells > size) in_.refuse(fmt::format("{} cells cannot be in {} numbers", cells, size));
    if (!keep) return skip_numbers(size, ScalarType::int32);
    mesh_.faces.reserve(size / 4);
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
      check_corners(cell, cell_number(ScalarType::int32, "the number of corners of a polygon"));
      if (4 * (std::uint64_t{cell} + 1) > size)
        refuse_here(fmt::format("polygon {} is not inside the {} numbers declared", cell, size));
      auto& face = mesh_.faces.emplace_back();
      for (auto& v : face) v = corner(cell, ScalarType::int32);
    }
    if (4 * std::uint64_t{cells} != size) refuse_here(fmt::format("{} triangles take {} numbers, but {} are declared", cells,
                                                                 4 * std::uint64_t{cells}, size));
  }

  /// Two arrays: offsets (one more than cells) into the array of corners.
  void read_cells_5(bool keep) {
    const std::uint32_t offsets = in_.count(in_.word("the number of offsets"), "number of offsets", 0);
    const std::uint32_t corners = in_.count(in_.word("the number of corners"), "number of corners", 0);
    const ScalarType offset_type = begin_array("offsets", offsets, "number of offsets");
    if (!keep) {
      skip_numbers(offsets, offset_type);
    } else {
      for (std::int64_t i = 0; i < offsets; ++i) check_offset(i, cell_number(offset_type, "an offset"));
    }
    const ScalarType corner_type = begin_array("connectivity", corners, "number of corners");
    if (!keep) return skip_numbers(corners, corner_type);
    const std::uint32_t cells = offsets == 0 ? 0 : offsets - 1;
    if (3 * std::uint64_t{cells} != corners) refuse_here(fmt::format("{} triangles take {} corners, but {} are declared", cells,
                                                                    3 * std::uint64_t{cells}, corners));
    mesh_.faces.resize(cells);
    for (std::size_t f = 0; f < cells; ++f) {
      for (auto& v : mesh_.faces[f]) v = corner(static_cast<std::int64_t>(f), corner_type);
    }
  }

  void check_offset(std::int64_t index, std::int64_t offset) const {
    if (index == 0 && offset != 0) refuse_here(fmt::format("the first offset is {}, not 0", offset));
    if (offset < 0) refuse_here(fmt::format("offset {} is negative", offset));
    if (index > 0) check_corners(index - 1, offset - 3 * (index - 1));
  }

  ScalarType begin_array(const std::string& keyword, std::uint32_t size, std::string_view what) {
    const std::string_view word = in_.word(keyword);
    if (lower_case(word.substr(0, 20)) != keyword) in_.refuse(fmt::format("{} is expected, not {}", keyword, quoted(word)));
    const ScalarType scalar = type(in_.word("the type of an array"));
    if (!is_integer(scalar)) in_.refuse(fmt::format("{} are not of an integer type", keyword));
    end_announcement();
    in_.expect_room(size, least_bytes(scalar), what);
    return scalar;
  }

  void skip_numbers(std::uint64_t count, ScalarType scalar) {
    if (binary_) {
      in_.expect_room(count, size_of(scalar), "size of a skipped array");
      in_.take(count * size_of(scalar), "a skipped array");
    } else {
      for (std::uint64_t i = 0; i < count; ++i) in_.word("a number");
    }
  }

  /// FIELD name arrays, then for each: name components tuples type, and its data.
  void skip_field() {
    in_.word("the name of a field");
    const std::uint32_t arrays = in_.count(in_.word("the number of arrays"), "number of arrays", 2);
    for (std::uint32_t a = 0; a < arrays; ++a) {
      std::string_view name = in_.word("the name of an array");
      if (lower_case(name.substr(0, 20)) == "metadata") {
        skip_metadata();
        name = in_.word("the name of an array");
      }
      const std::uint64_t components = in_.count(in_.word("the number of components"), "number of components", 0);
      const std::uint64_t tuples = in_.count(in_.word("the number of tuples"), "number of tuples", 0);
      const std::string_view type_word = in_.word("the type of an array");
      const auto scalar = scalar_type(type_word);
      if (!scalar) in_.refuse(fmt::format("field array {} of type {} is not read", quoted(name), quoted(type_word)));
      end_announcement();
      in_.expect_room(components * tuples, least_bytes(*scalar), "size of a field array");
      skip_numbers(components * tuples, *scalar);
    }
  }

  /// Up to the next empty line.
  void skip_metadata() {
    in_.line();
    while (in_.remaining() > 0 && in_.line().find_first_not_of(" \t\r") != std::string_view::npos) {
    }
  }

  FileCursor in_;
  MeshArrays mesh_;
  int major_version_ = 4;
  bool binary_ = false, have_points_ = false, have_polygons_ = false;
};

}  // namespace

MeshArrays read_vtk(std::string_view bytes, const std::string& name) { return VtkReader(bytes, name).read(); }

}  // namespace gvd::io
