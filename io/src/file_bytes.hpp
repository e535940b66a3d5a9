#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gvd::io {

/// All bytes of a file. Throws InputError, naming the file, if it does not exist, is a directory (then `what` says what it should
/// have been, as in "a mesh file"), or cannot be read.
std::string read_bytes(const std::filesystem::path& file, std::string_view what);

}  // namespace gvd::io
