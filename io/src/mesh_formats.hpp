#pragma once

#include <string_view>
#include <string>

#include "gvd/kernel/mesh.hpp"

/// One reader a format. `name` is what messages call the file. All throw InputError (see mesh_reader.hpp).
namespace gvd::io {

kernel::MeshArrays read_vtk(std::string_view bytes, const std::string& name);
kernel::MeshArrays read_ply(std::string_view bytes, const std::string& name);
kernel::MeshArrays read_off(std::string_view bytes, const std::string& name);
kernel::MeshArrays read_obj(std::string_view bytes, const std::string& name);
kernel::MeshArrays read_grid(std::string_view bytes, const std::string& name);

}  // namespace gvd::io
