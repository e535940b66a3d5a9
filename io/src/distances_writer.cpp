#include "gvd/io/distances_writer.hpp"

#include <charconv>
#include <cmath>
#include <iterator>
#include <ostream>
#include <string>

namespace gvd::io {

namespace {

constexpr std::size_t kFlushAt = 1 << 16;

template <class Number>
void append(std::string& text, Number value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, std::end(digits), value).ptr);
}

void append_sources(std::string& text, std::span<const kernel::SourceId> sources) {
  if (sources.empty()) text += "-1";
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (i != 0) text += ';';
    append(text, sources[i]);
  }
}

}  // namespace

void write_distances(std::ostream& out, const VertexResults& vertices) {
  std::string text = "vertex,distance,source\n";
  for (std::size_t v = 0; v < vertices.distance.size(); ++v) {
    append(text, v);
    text += ',';
    append(text, vertices.distance[v]);  // infinity is written as "inf"
    text += ',';
    append_sources(text, vertices.nearest(static_cast<kernel::VertexId>(v)));
    text += '\n';
    if (text.size() > kFlushAt) {
      out << text;
      text.clear();
    }
  }
  out << text;
}

}  // namespace gvd::io
