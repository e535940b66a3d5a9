#include "gvd/io/mesh_reader.hpp"

#include <fmt/format.h>

#include <string>

#include "file_bytes.hpp"
#include "file_cursor.hpp"
#include "gvd/kernel/error.hpp"
#include "mesh_formats.hpp"

namespace gvd::io {
namespace {

enum class Format { vtk, ply, off, obj, grid, stl, xml, unknown };

/// What the first word (in lower case) gives away.
Format format_of_start(std::string_view bytes) {
  if (lower_case(bytes.substr(0, 14)) == "# vtk datafile") return Format::vtk;
  FileCursor cursor(bytes, "", '#');
  const std::string first = lower_case(cursor.word().substr(0, 40));
  if (first == "ply") return Format::ply;
  if (first.starts_with("<?xml") || first.starts_with("<vtkfile")) return Format::xml;
  if (first.size() <= 8 && first.ends_with("off")) return Format::off;
  if (first == "ncols" || first == "nrows" || first == "xllcorner" || first == "xllcenter") return Format::grid;
  if (first == "solid") return Format::stl;
  return Format::unknown;
}

Format format_of_extension(const std::filesystem::path& file) {
  const std::string extension = lower_case(file.extension().string());
  if (extension == ".vtk") return Format::vtk;
  if (extension == ".ply") return Format::ply;
  if (extension == ".off") return Format::off;
  if (extension == ".obj") return Format::obj;
  if (extension == ".asc") return Format::grid;
  if (extension == ".stl") return Format::stl;
  if (extension == ".vtp" || extension == ".vtu") return Format::xml;
  return Format::unknown;
}

kernel::MeshArrays parse_any(std::string_view bytes, const std::filesystem::path& path, const std::string& name) {
  if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty", name));
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);  // the byte order mark of some editors
  Format format = format_of_start(bytes);
  if (format == Format::unknown) format = format_of_extension(path);
  switch (format) {
    case Format::vtk: return read_vtk(bytes, name);
    case Format::ply: return read_ply(bytes, name);
    case Format::off: return read_off(bytes, name);
    case Format::obj: return read_obj(bytes, name);
    case Format::grid: return read_grid(bytes, name);
    case Format::stl:
      throw InputError(fmt::format("{}: STL is not read, because it does not say which corners of triangles are the same vertex "
                                   "(convert the file to PLY, OFF or OBJ and merge equal vertices)", name));
    case Format::xml: throw InputError(fmt::format("{}: XML files are not read (save it as legacy .vtk or as .ply)", name));
    default:
      throw InputError(fmt::format("{}: neither the first bytes nor the extension belong to a format that is read "
                                   "(VTK legacy polydata, PLY, OFF, OBJ, ESRI ASCII grid)", name));
  }
}

}  // namespace

kernel::MeshArrays parse_mesh(std::string_view bytes, const std::filesystem::path& path) {
  const std::string name = path.string();
  kernel::MeshArrays mesh = parse_any(bytes, path, name);
  if (mesh.faces.empty()) throw InputError(fmt::format("{}: the mesh has no triangles", name));
  return mesh;
}

kernel::MeshArrays read_mesh(const std::filesystem::path& file) { return parse_mesh(read_bytes(file, "a mesh file"), file); }

}  // namespace gvd::io
