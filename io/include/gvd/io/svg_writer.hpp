#pragma once

#include <iosfwd>

#include "gvd/io/result_view.hpp"

namespace gvd::io {

/// A hill-shaded map in plan view (x to the right, y upwards) with the cells, GVD edges, GVD vertices, break points and sources.
/// Faces that look down are not drawn. The hill shade is an embedded image, so that the size depends on the diagram, not on the mesh.
void write_diagram_svg(std::ostream& out, const ResultView& view);

}  // namespace gvd::io
