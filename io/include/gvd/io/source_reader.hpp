#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/robust/gmp.hpp"

namespace gvd::io {

/// A source that was given as a point in space and moved to the nearest surface point.
struct ProjectedSource {
  kernel::SourceId source = kernel::kNone;
  mpq_class squared_distance;  ///< from the surface, exactly
  double distance = 0;         ///< its root, correctly rounded
};

/// What there is to say about sources beside where they are.
struct SourceReport {
  std::vector<ProjectedSource> projected;  ///< every `p` line, also those whose point lies on the surface
};

/// Reads sources, one a line, in the order of their ids (docs/sources.md):
///
///     v INDEX          a vertex
///     e A B T          the point A + T (B - A) of the edge between vertices A and B, 0 <= T <= 1
///     f FACE B0 B1 B2  the point (B0 V0 + B1 V1 + B2 V2) / (B0 + B1 + B2), B_i >= 0, corners in the order of the mesh file
///     p X Y Z          the surface point nearest to this one; the face with the lowest index in a tie
///     xy X Y           the point of the surface on this vertical line; refused unless there is exactly one
///
/// each with an optional additive weight `w=W` at its end (mesh units, finite, >= 0). Indices count from 0. `#` begins a comment;
/// empty lines and CRLF are fine. Numbers are read to the nearest double, whatever the locale, and that double is then taken as
/// exact: `0.5` is one half, `0.1` is the double nearest to one tenth.
///
/// Throws InputError "FILE, line N: ..." for whatever is wrong, also if there is no source at all.
/// Pre: the mesh is not refined. Cost: linear, plus a search tree over the faces if there are `p` or `xy` lines.
std::vector<kernel::Source> read_sources(const std::filesystem::path& file, const kernel::Mesh& mesh, SourceReport& report);

/// The same for text in memory; messages show `name`.
std::vector<kernel::Source> parse_sources(std::string_view text, const std::string& name, const kernel::Mesh& mesh,
                                          SourceReport& report);

/// Sources as the command line names them: `random:N` (kernel::random_surface_sources), `vertices:N`
/// (kernel::random_vertex_sources), or a file (read_sources). The seed is for the first two. Throws InputError.
std::vector<kernel::Source> parse_source_spec(const std::string& spec, std::uint64_t seed, const kernel::Mesh& mesh,
                                              SourceReport& report);

}  // namespace gvd::io
