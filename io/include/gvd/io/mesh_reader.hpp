#pragma once

#include <filesystem>
#include <string_view>

#include "gvd/kernel/mesh.hpp"

namespace gvd::io {

/// Reads a triangle mesh: VTK legacy polydata (3.x to 5.x, ascii and binary), PLY (ascii, binary of both byte orders), OFF, OBJ, or
/// an ESRI ASCII grid. Known first bytes decide the format, else the file name's extension. STL and XML VTK are refused with the
/// reason.
///
/// Vertices and faces keep the order of the file and are numbered from 0 (OBJ numbers from 1 in the file; for grids see
/// grid_reader.cpp: row by row from the north-west, data values that belong to no triangle left out). Vertices of no face are
/// kept, except for grids. Numbers are read to the nearest double, ties to even, whatever the locale and whatever single precision
/// type a text file declares. Coordinates are finite and indices in range; all else about the mesh is for `kernel::Mesh` to check.
///
/// Throws InputError with one sentence that names the file and the line (text) or byte (binary), and the element. Never allocates
/// for a declared count before the file is known to be long enough for it. Cost: linear; the whole file is held in memory.
kernel::MeshArrays read_mesh(const std::filesystem::path& file);

/// The same for bytes in memory. `name` stands for the file: its extension takes part in the choice of the format, and messages
/// show it.
kernel::MeshArrays parse_mesh(std::string_view bytes, const std::filesystem::path& name);

}  // namespace gvd::io
