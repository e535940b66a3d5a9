#include <fmt/format.h>

#include <limits>
#include <vector>

#include "file_cursor.hpp"
#include "mesh_formats.hpp"

/// Wavefront OBJ: lines `v x y z` (what follows is ignored) and `f` with corners v, v/vt, v//vn or v/vt/vn; indices count from 1,
/// or back from the last vertex if negative. All other lines are ignored; '#' begins a comment; '\' at the end of a line continues
/// it. Vertex and face ids elsewhere in this library count from 0.
namespace gvd::io {
namespace {

using kernel::MeshArrays;

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name) : in_(bytes, name, '#') {}

  MeshArrays read() {
    while (in_.seek_word()) {
      const std::string_view keyword = in_.word_on_line();
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "f") {
        read_face();
      }
      skip_line();
    }
    check_forward_references();
    return std::move(mesh_);
  }

 private:
  /// The next word of this logical line; empty at its end.
  std::string_view word() {
    for (;;) {
      std::string_view found = in_.word_on_line();
      if (!found.ends_with('\\')) return found;
      found.remove_suffix(1);
      in_.line();
      if (!found.empty()) return found;
    }
  }

  void skip_line() {
    while (!word().empty()) {
    }
    in_.line();
  }

  void read_vertex() {
    if (mesh_.points.size() >= kernel::kNone - 1) in_.refuse("too many vertices");
    kernel::Point point;
    for (double& x : point) {
      const std::string_view found = word();
      if (found.empty()) in_.refuse(fmt::format("vertex {} has less than three coordinates", mesh_.points.size() + 1));
      x = in_.real(found, "coordinate");
    }
    mesh_.points.push_back(point);
  }

  void read_face() {
    std::array<std::uint32_t, 3> face{};
    std::size_t corners = 0;
    for (std::string_view found = word(); !found.empty(); found = word()) {
      const std::uint32_t v = corner(found);
      if (corners < 3) face[corners] = v;
      ++corners;
    }
    if (corners != 3) in_.refuse(fmt::format("face {} has {} corners; only triangles are read", mesh_.faces.size(), corners));
    for (const auto v : face) {
      if (v >= mesh_.points.size() && v >= highest_.vertex) highest_ = {v, mesh_.faces.size()};
    }
    mesh_.faces.push_back(face);
  }

  /// The vertex (from 0) that v, v/vt, v//vn or v/vt/vn names.
  std::uint32_t corner(std::string_view text) const {
    const std::string_view index = text.substr(0, text.find('/'));
    if (text.size() > index.size()) check_tail(text, text.substr(index.size() + 1));
    const auto value = in_.integer(index, "vertex index", -std::int64_t{kernel::kNone}, std::int64_t{kernel::kNone} - 1);
    const auto known = static_cast<std::int64_t>(mesh_.points.size());
    if (value == 0 || value < -known) {
      in_.refuse(fmt::format("face {}: vertex {} does not exist (indices begin with 1; {} vertices so far)", mesh_.faces.size(),
                             value, known));
    }
    return static_cast<std::uint32_t>(value > 0 ? value - 1 : known + value);
  }

  /// Texture and normal indices are not used, but they have to be numbers.
  void check_tail(std::string_view text, std::string_view tail) const {
    const std::size_t slash = tail.find('/');
    const std::string_view texture = tail.substr(0, slash),
                           normal = slash == tail.npos ? std::string_view() : tail.substr(slash + 1);
    const auto is_index = [](std::string_view word) {
      if (word.starts_with('-')) word.remove_prefix(1);
      return !word.empty() && word.find_first_not_of("0123456789") == word.npos;
    };
    const bool good = slash == tail.npos ? is_index(texture) : is_index(normal) && (texture.empty() || is_index(texture));
    if (!good) in_.refuse(fmt::format("a corner of a face is not v, v/vt, v//vn or v/vt/vn: {}", quoted(text)));
  }

  /// A face may name a vertex that comes later in the file, but it has to come.
  void check_forward_references() const {
    if (mesh_.faces.empty() || highest_.vertex < mesh_.points.size()) return;
    in_.refuse(fmt::format("face {}: vertex {} does not exist (indices begin with 1; {} vertices in all)", highest_.face,
                           std::uint64_t{highest_.vertex} + 1, mesh_.points.size()));
  }

  struct Reference {
    std::uint32_t vertex = 0;
    std::size_t face = 0;
  };

  FileCursor in_;
  MeshArrays mesh_;
  Reference highest_;  ///< the last of the faces that named the highest vertex not known when they came
};

}  // namespace

MeshArrays read_obj(std::string_view bytes, const std::string& name) { return ObjReader(bytes, name).read(); }

}  // namespace gvd::io
