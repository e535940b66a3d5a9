#pragma once

#include <iosfwd>

#include "gvd/io/result_view.hpp"

namespace gvd::io {

/// CSV with the columns `vertex,distance,source`, one line a vertex in the order of the file (docs/formats.md#distancescsv). Distances in
/// shortest round-trip form; `inf` and -1 where unreachable; all nearest sources of a tie, as `3;17`. Cost: O(vertices).
void write_distances(std::ostream& out, const VertexResults& vertices);

}  // namespace gvd::io
