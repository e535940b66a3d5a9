#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gvd/kernel/mesh.hpp"
#include "gvd/kernel/source.hpp"

namespace gvd::fuzz {

/// A source as a line `f FACE B0 B1 B2 w=W` of a source file says it: an exact point of a face of the input, its corners in the
/// order of the input. Two weights zero: a vertex; one zero: a point of an edge.
struct Place {
  kernel::FaceId face = 0;
  std::array<double, 3> corner_weights{1, 0, 0};
  double weight = 0;
};

/// One problem: a mesh as a file has it, and its sources.
struct Case {
  kernel::MeshArrays mesh;
  std::vector<Place> sources;
  std::string family;
};

/// The source that a place names. Throws InputError if it is none.
kernel::Source source_at(const kernel::Mesh& mesh, const Place& place);
std::vector<kernel::Source> sources_of(const kernel::Mesh& mesh, const std::vector<Place>& places);

/// Whether the mesh and all sources are accepted.
bool is_valid(const Case& c);

/// The mesh as OFF and the sources as a source file; every number in shortest round-trip form, so that reading them gives the same
/// case.
std::string mesh_text(const kernel::MeshArrays& mesh);
std::string source_text(const std::vector<Place>& sources);
/// One file with both: `# ...` lines, the sources as comments of the OFF file, and `read_case` reads it again.
std::string case_text(const Case& c, const std::vector<std::string>& remarks);
Case parse_case(const std::string& text, const std::string& name);
Case read_case(const std::string& file);

}  // namespace gvd::fuzz
