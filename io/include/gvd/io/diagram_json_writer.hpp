#pragma once

#include <iosfwd>

#include "gvd/io/result_view.hpp"

namespace gvd::io {

/// The whole diagram as JSON (docs/formats.md#diagramjson, docs/diagram-schema.json): every arc analytically, with enclosures. One element a
/// line. Holds no times and no memory figures: equal results give equal bytes. Cost: linear in the size of the diagram.
void write_diagram_json(std::ostream& out, const ResultView& view);

}  // namespace gvd::io
