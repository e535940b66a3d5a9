#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "binary_scalar.hpp"
#include "file_cursor.hpp"
#include "mesh_formats.hpp"

/// PLY 1.0 (Turk 1994): ascii, binary_little_endian and binary_big_endian. Vertices need scalar properties x, y, z, faces a list
/// named vertex_indices or vertex_index; other properties and elements are passed over.
namespace gvd::io {
namespace {

using kernel::MeshArrays;

struct Property {
  std::string name;
  ScalarType type;
  std::optional<ScalarType> count_type;  ///< of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

std::optional<ScalarType> scalar_type(std::string_view name) {
  if (name == "char" || name == "int8") return ScalarType::int8;
  if (name == "uchar" || name == "uint8") return ScalarType::uint8;
  if (name == "short" || name == "int16") return ScalarType::int16;
  if (name == "ushort" || name == "uint16") return ScalarType::uint16;
  if (name == "int" || name == "int32") return ScalarType::int32;
  if (name == "uint" || name == "uint32") return ScalarType::uint32;
  if (name == "int64") return ScalarType::int64;
  if (name == "uint64") return ScalarType::uint64;
  if (name == "float" || name == "float32") return ScalarType::float32;
  if (name == "double" || name == "float64") return ScalarType::float64;
  return std::nullopt;
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name) : in_(bytes, name) {}

  MeshArrays read() {
    read_header();
    for (const Element& element : elements_) {
      in_.expect_room(element.count, least_bytes(element), fmt::format("number of '{}' elements", element.name));
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "tristrips" && element.count > 0) {
        in_.refuse("triangle strips are not read (save separate triangles)");
      } else if (!element.properties.empty()) {
        for (std::uint64_t i = 0; i < element.count; ++i) skip(element.properties);
      }
    }
    check_end();
    check_indices();
    return std::move(mesh_);
  }

 private:
  ScalarType type(std::string_view word) const {
    const auto found = scalar_type(word);
    if (!found) in_.refuse(fmt::format("unknown property type {}", quoted(word)));
    return *found;
  }

  std::string_view header_word(std::string_view what) {
    const std::string_view word = in_.word_on_line();
    if (word.empty()) in_.refuse(fmt::format("{} is missing in the header", what));
    return word;
  }

  void read_format() {
    const std::string_view format = header_word("the format");
    binary_ = format != "ascii";
    if (binary_ && format != "binary_little_endian" && format != "binary_big_endian") {
      in_.refuse(fmt::format("unknown PLY format {}", quoted(format)));
    }
    order_ = format == "binary_big_endian" ? std::endian::big : std::endian::little;
    const std::string_view version = header_word("the version of the format");
    if (version != "1.0") in_.refuse(fmt::format("unknown PLY version {}", quoted(version)));
  }

  void read_element() {
    const std::string_view name = header_word("the name of an element");
    for (const Element& element : elements_) {
      if (element.name == name) in_.refuse(fmt::format("a second element {}", quoted(name)));
    }
    Element element{std::string(name), 0, {}};
    element.count = in_.count(header_word("the number of elements"), "number of elements", 0);
    elements_.push_back(std::move(element));
  }

  void read_property() {
    if (elements_.empty()) in_.refuse("a property before the first element");
    Property property{{}, ScalarType::float64, std::nullopt};
    std::string_view word = header_word("the type of a property");
    if (word == "list") {
      property.count_type = type(header_word("the type of the length of a list"));
      if (!is_integer(*property.count_type)) in_.refuse("the length of a list is not of an integer type");
      word = header_word("the type of a list");
    }
    property.type = type(word);
    property.name = std::string(header_word("the name of a property"));
    elements_.back().properties.push_back(std::move(property));
  }

  void read_header() {
    bool have_format = false;
    in_.line();  // "ply"
    for (;;) {
      const std::string_view word = in_.word("end_header");
      if (word == "format") {
        read_format();
        have_format = true;
      } else if (word == "element") {
        read_element();
      } else if (word == "property") {
        read_property();
      } else if (word == "end_header") {
        break;
      } else if (word != "comment" && word != "obj_info") {
        in_.refuse(fmt::format("unknown header line {}", quoted(word)));
      }
      in_.line();
    }
    in_.line();
    if (!have_format) in_.refuse("the header has no format");
    if (!find("vertex")) in_.refuse("the header has no element 'vertex'");
    if (!find("face")) in_.refuse("the header has no element 'face'");
  }

  const Element* find(std::string_view name) const {
    const auto at = std::find_if(elements_.begin(), elements_.end(), [&](const Element& e) { return e.name == name; });
    return at == elements_.end() ? nullptr : &*at;
  }

  std::size_t least_bytes(const Element& element) const {
    std::size_t bytes = 0;
    for (const Property& p : element.properties) bytes += binary_ ? size_of(p.count_type.value_or(p.type)) : 2;
    return bytes;
  }

  std::int64_t integer(ScalarType scalar, std::string_view what) {
    if (binary_) return read_integer(in_, scalar, order_, what);
    return in_.integer(in_.word(what), what, std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
  }

  [[noreturn]] void refuse_here(const std::string& what) const { binary_ ? in_.refuse_byte(what) : in_.refuse(what); }

  void skip(const Property& property) {
    std::uint64_t values = 1;
    if (property.count_type) {
      const std::int64_t length = integer(*property.count_type, "the length of a list");
      if (length < 0) refuse_here(fmt::format("a list '{}' of {} values", property.name, length));
      values = static_cast<std::uint64_t>(length);
    }
    if (!binary_) {
      for (std::uint64_t i = 0; i < values; ++i) in_.word("a value");
      return;
    }
    if (values > in_.remaining() / size_of(property.type))
      refuse_here(fmt::format("the file ends inside a list '{}'", property.name));
    in_.take(values * size_of(property.type), "a property");
  }

  void skip(const std::vector<Property>& properties) {
    for (const Property& property : properties) skip(property);
  }

  void read_vertices(const Element& element) {
    constexpr std::size_t kNotACoordinate = 3;
    std::vector<std::size_t> axis;  // of each property
    std::array<int, 3> found{};
    for (const Property& p : element.properties) {
      const bool coordinate = !p.count_type && p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z';
      axis.push_back(coordinate ? static_cast<std::size_t>(p.name[0] - 'x') : kNotACoordinate);
      if (coordinate) ++found[axis.back()];
    }
    if (found != std::array{1, 1, 1}) in_.refuse("the element 'vertex' needs the scalar properties x, y and z, once each");
    mesh_.points.resize(element.count);
    for (auto& point : mesh_.points) {
      for (std::size_t i = 0; i < axis.size(); ++i) {
        const Property& p = element.properties[i];
        if (axis[i] == kNotACoordinate) {
          skip(p);
        } else {
          point[axis[i]] = binary_ ? read_coordinate(in_, p.type, order_) : in_.real(in_.word("a coordinate"), "coordinate");
        }
      }
    }
  }

  void read_faces(const Element& element) {
    const auto is_corners = [](const Property& p) {
      return p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    if (std::count_if(element.properties.begin(), element.properties.end(), is_corners) != 1) {
      in_.refuse("the element 'face' needs one list property vertex_indices (or vertex_index)");
    }
    mesh_.faces.resize(element.count);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      for (const Property& p : element.properties) {
        if (is_corners(p)) {
          read_corners(f, p);
        } else {
          skip(p);
        }
      }
    }
  }

  void read_corners(std::size_t f, const Property& property) {
    const std::int64_t corners = integer(*property.count_type, "the number of corners of a face");
    if (corners != 3) refuse_here(fmt::format("face {} has {} corners; only triangles are read", f, corners));
    for (auto& v : mesh_.faces[f]) {
      const std::int64_t index = integer(property.type, "a vertex of a face");
      if (index < 0 || index >= std::int64_t{kernel::kNone})
        refuse_here(fmt::format("face {}: vertex {} does not exist", f, index));
      v = static_cast<std::uint32_t>(index);
    }
  }

  /// White space may follow the last element, nothing else.
  void check_end() {
    if (in_.seek_word()) refuse_here("there is more after the last element that the header declares");
  }

  void check_indices() const {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      for (const auto v : mesh_.faces[f]) {
        if (v >= mesh_.points.size()) {
          refuse_here(fmt::format("face {}: vertex {} does not exist (there are {} vertices)", f, v, mesh_.points.size()));
        }
      }
    }
  }

  FileCursor in_;
  MeshArrays mesh_;
  std::vector<Element> elements_;
  bool binary_ = false;
  std::endian order_ = std::endian::little;
};

}  // namespace

MeshArrays read_ply(std::string_view bytes, const std::string& name) { return PlyReader(bytes, name).read(); }

}  // namespace gvd::io
