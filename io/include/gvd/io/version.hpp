#pragma once

namespace gvd::io {

/// Version of the library and the program, as in CMakeLists.txt.
const char* version() noexcept;

}  // namespace gvd::io
