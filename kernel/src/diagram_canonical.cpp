#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "gvd/kernel/extract.hpp"

namespace gvd::kernel {
namespace {

std::string number(double x) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%a", x);
  return text.data();
}

std::string point_text(const Point& p) { return "(" + number(p[0]) + " " + number(p[1]) + " " + number(p[2]) + ")"; }

class Canonical {
 public:
  Canonical(const Diagram& d, const CanonicalNames& names) : d_(d), names_(names) {
    is_break_.assign(d.points.size(), 0);
    for (const BreakPoint& point : d.break_points) is_break_[point.point] = 1;
  }

  std::string run() {
    std::string text;
    section(text, "cells", d_.cells, [&](const Cell& c) { return cell(c); });
    section(text, "vertices", d_.vertices, [&](const GvdVertex& v) { return vertex(v); });
    section(text, "edges", d_.edges, [&](const GvdEdge& e) { return edge(e); });
    section(text, "dual", d_.dual, [&](const DualEdge& e) {
      return sources({e.sources[0], e.sources[1]}) + " edges " + std::to_string(e.edges.size());
    });
    section(text, "shared", d_.shared, [&](const SharedRegion& r) { return sources(d_.label_sets[r.labels]); });
    return text;
  }

 private:
  template <class T, class Line>
  void section(std::string& text, const char* title, const std::vector<T>& items, Line&& line) const {
    std::vector<std::string> lines;
    for (const T& item : items) lines.push_back(line(item));
    std::sort(lines.begin(), lines.end());
    text += std::string(title) + " " + std::to_string(lines.size()) + "\n";
    for (const std::string& l : lines) text += "  " + l + "\n";
  }

  std::string sources(std::vector<SourceId> ids) const {
    if (!names_.source.empty())
      for (SourceId& id : ids) id = names_.source[id];
    std::sort(ids.begin(), ids.end());
    std::string text = "{";
    for (const SourceId id : ids) text += (text.size() > 1 ? "," : "") + std::to_string(id);
    return text + "}";
  }

  std::string cell(const Cell& c) const {
    return sources({c.source}) + (c.hidden ? " hidden" : "") + " neighbours " + sources(c.neighbours) + " euler " +
           std::to_string(c.euler);
  }
  std::string vertex(const GvdVertex& v) const {
    return point_text(d_.points[v.point].position) + " " + sources(v.sources) + " degree " + std::to_string(v.edges.size()) +
           (v.on_boundary ? " boundary" : "");
  }

  /// Ends and break points in order, with the label sets on the left and right; read in the direction that comes first in the
  /// alphabet.
  std::string edge(const GvdEdge& e) const {
    std::vector<std::string> stops;
    for (std::size_t i = 0; i < e.arcs.size(); ++i) {
      const std::uint32_t point = d_.arcs[e.arcs[i]].node[0];
      const bool end = i == 0 && !e.closed;
      if (end || is_break_[point] != 0) stops.push_back(stop(point));
    }
    if (!e.closed) stops.push_back(stop(e.end[1]));
    const std::string left = sources(d_.label_sets[e.labels[0]]), right = sources(d_.label_sets[e.labels[1]]);
    const std::string forward = directed(stops, left, right);
    std::reverse(stops.begin(), stops.end());
    if (e.closed && !stops.empty()) std::rotate(stops.begin(), stops.end() - 1, stops.end());
    return (e.closed ? "closed " : "open ") + std::min(forward, directed(stops, right, left));
  }
  std::string stop(std::uint32_t point) const { return point_text(d_.points[point].position); }
  static std::string directed(const std::vector<std::string>& stops, const std::string& left, const std::string& right) {
    std::string text = left + "|" + right;
    for (const std::string& s : stops) text += " " + s;
    return text;
  }

  const Diagram& d_;
  const CanonicalNames& names_;
  std::vector<std::uint8_t> is_break_;
};

}  // namespace

std::string canonical(const Diagram& diagram, const CanonicalNames& names) { return Canonical(diagram, names).run(); }

}  // namespace gvd::kernel
