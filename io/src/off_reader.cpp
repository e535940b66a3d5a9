#include <fmt/format.h>

#include "file_cursor.hpp"
#include "mesh_formats.hpp"

/// OFF (Geomview), ascii: the optional keyword [ST][C][N]OFF, the numbers of vertices, faces and (optional, ignored) edges, one
/// vertex a line, one face a line. '#' begins a comment. Texture coordinates, colours and normals behind the coordinates of STOFF,
/// COFF, NOFF and behind the corners of faces are ignored. 4OFF, nOFF and binary files are refused.
namespace gvd::io {
namespace {

using kernel::MeshArrays;

/// Reads the keyword if there is one. Says whether vertex lines have more than three numbers.
bool read_keyword(FileCursor& in, std::string_view& first) {
  const std::string keyword = lower_case(first.substr(0, 20));
  if (!keyword.ends_with("off")) return false;
  std::string_view prefix = std::string_view(keyword).substr(0, keyword.size() - 3);
  bool more = false;
  for (const std::string_view part : {"st", "c", "n"}) {
    if (!prefix.starts_with(part)) continue;
    if (part == "n" && first[keyword.size() - 4] == 'n') break;  // nOFF: n-dimensional points
    prefix.remove_prefix(part.size());
    more = true;
  }
  if (!prefix.empty()) in.refuse(fmt::format("OFF with {} is not read (only OFF, COFF, NOFF, CNOFF and STOFF)", quoted(first)));
  first = in.word("the number of vertices");
  if (lower_case(first.substr(0, 20)) == "binary") in.refuse("binary OFF is not read (save it as ascii or as binary PLY)");
  return more;
}

void end_line(FileCursor& in, std::string_view what) {
  const std::string_view rest = in.word_on_line();
  if (!rest.empty()) in.refuse(fmt::format("{} on the line of {}", quoted(rest), what));
}

void read_vertex(FileCursor& in, std::size_t v, bool more, kernel::Point& point) {
  if (!in.seek_word()) in.refuse(fmt::format("the file ends where vertex {} is expected", v));
  for (double& x : point) {
    const std::string_view word = in.word_on_line();
    if (word.empty()) in.refuse(fmt::format("vertex {} has less than three coordinates", v));
    x = in.real(word, "coordinate");
  }
  if (!more) return end_line(in, fmt::format("vertex {} after its coordinates", v));
  in.line();
}

void read_face(FileCursor& in, std::size_t f, std::uint32_t vertices, std::array<std::uint32_t, 3>& face) {
  const std::string_view corners = in.word(fmt::format("face {}", f));
  if (in.integer(corners, "number of corners", 0, kernel::kNone) != 3) {
    in.refuse(fmt::format("face {} has {} corners; only triangles are read", f, corners));
  }
  for (auto& v : face) {
    const std::string_view word = in.word_on_line();
    if (word.empty()) in.refuse(fmt::format("face {} has less than three corners", f));
    v = in.vertex_index(word, vertices);
  }
  in.line();
}

}  // namespace

MeshArrays read_off(std::string_view bytes, const std::string& name) {
  FileCursor in(bytes, name, '#');
  std::string_view first = in.word("OFF");
  const bool more = read_keyword(in, first);
  MeshArrays mesh;
  const std::uint32_t vertices = in.count(first, "number of vertices", 6);
  const std::uint32_t faces = in.count(in.word("the number of faces"), "number of faces", 8);
  if (const std::string_view edges = in.word_on_line(); !edges.empty()) in.count(edges, "number of edges", 0);
  end_line(in, "the numbers of vertices, faces and edges");
  mesh.points.resize(vertices);
  for (std::size_t v = 0; v < vertices; ++v) read_vertex(in, v, more, mesh.points[v]);
  mesh.faces.resize(faces);
  for (std::size_t f = 0; f < faces; ++f) read_face(in, f, vertices, mesh.faces[f]);
  if (in.seek_word()) in.refuse(fmt::format("there is more after the last of the {} faces declared", faces));
  return mesh;
}

}  // namespace gvd::io
