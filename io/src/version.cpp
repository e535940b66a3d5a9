#include "gvd/io/version.hpp"

namespace gvd::io {

const char* version() noexcept { return GVD_VERSION; }

}  // namespace gvd::io
