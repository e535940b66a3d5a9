#pragma once

#include <iosfwd>

#include "gvd/io/result_view.hpp"

namespace gvd::io {

/// Default chord deviation of drawn arcs, as a fraction of the longest side of their face. It decides nothing: the diagram has the arcs themselves.
inline constexpr double kDefaultDeviation = 1e-4;
/// The finest: some 32,000 chords for an arc across a face, since halving a chord quarters its deviation.
inline constexpr double kLeastDeviation = 1e-9;

/// GVD edges as polylines in VTK XML PolyData (docs/formats.md#diagramvtp-and-cellsvtp). The chords deviate from the arcs by at most `deviation` times the
/// longest side of the face; the fraction and the largest absolute value are in the field data.
void write_diagram_vtp(std::ostream& out, const ResultView& view, double deviation = kDefaultDeviation);

/// The surface, cut along the GVD edges into triangles of one label set each, in VTK XML PolyData (docs/formats.md#diagramvtp-and-cellsvtp).
void write_cells_vtp(std::ostream& out, const ResultView& view, double deviation = kDefaultDeviation);

}  // namespace gvd::io
