#include "gvd/io/svg_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "base64.hpp"
#include "cell_regions.hpp"
#include "drawn_source.hpp"
#include "gvd/io/vtp_writer.hpp"
#include "hill_shade.hpp"
#include "plan_view.hpp"
#include "png.hpp"
#include "sampled_outlines.hpp"

namespace gvd::io {

namespace {

// Sizes in pixels.
constexpr double kMap = 1200, kMargin = 36, kHeader = 84, kFooter = 96, kLeastWidth = 960;
constexpr std::size_t kMostNumberedSources = 60;
constexpr std::array<const char*, 10> kPalette = {"#3f97d8", "#f59f2c", "#56bd62", "#e5616c", "#9573dc",
                                                  "#ecd63a", "#35c4b3", "#e07fc0", "#b5824a", "#8fd14f"};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (static_cast<unsigned char>(c) >= ' ') out += c;
  }
  return out;
}

/// A count with thin grouping: 17222 -> "17,222".
std::string grouped(std::uint64_t n) {
  std::string digits = fmt::format("{}", n);
  for (auto i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > 0; i -= 3) digits.insert(static_cast<std::size_t>(i), ",");
  return digits;
}

std::string counted(std::uint64_t n, const char* one, const char* many) { return fmt::format("{} {}", grouped(n), n == 1 ? one : many); }

/// The longest of 1, 2, 5 times a power of ten that is at most x.
double round_length(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= x) return factor * power;
  return power;
}

class Map {
 public:
  Map(std::ostream& out, const ResultView& view)
      : out_(out), view_(view), plan_(view.mesh, kMap), outlines_(view.mesh, view.diagram, kDefaultDeviation) {}

  void write() {
    const double width = std::max(plan_.width(), kLeastWidth) + 2 * kMargin, height = kHeader + plan_.height() + kFooter;
    out_ << fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"Helvetica, Arial, sans-serif\">\n",
        width, height);
    out_ << "<rect width=\"100%\" height=\"100%\" fill=\"#fbfaf7\"/>\n";
    header();
    out_ << fmt::format("<g transform=\"translate({:.1f} {:.1f})\">\n", (width - plan_.width()) / 2, kHeader);
    shade();
    cells();
    mesh_boundary();
    edges();
    break_points();
    gvd_vertices();
    sources();
    out_ << "</g>\n";
    footer(width, kHeader + plan_.height());
    out_ << "</svg>\n";
  }

 private:
  void header() {
    std::string name = escaped(view_.mesh_name);
    std::replace(name.begin(), name.end(), '_', ' ');
    out_ << fmt::format("<title>Geodesic Voronoi diagram of {}</title>\n", name);
    out_ << fmt::format("<text x=\"{}\" y=\"40\" font-size=\"25\" font-weight=\"bold\" fill=\"#22303a\">Geodesic Voronoi diagram of {}</text>\n",
                        kMargin, name);
    const auto& summary = view_.summary;
    out_ << fmt::format("<text x=\"{}\" y=\"65\" font-size=\"15\" fill=\"#5a6872\">{} &#183; {} &#183; {} &#183; {} &#183; {} &#183; {}</text>\n", kMargin,
                        counted(view_.mesh.face_count(), "triangle", "triangles"), counted(summary.sources, "source", "sources"),
                        counted(summary.gvd_edges, "Voronoi edge", "Voronoi edges"),
                        counted(summary.gvd_vertices, "Voronoi vertex", "Voronoi vertices"),
                        counted(summary.break_points, "break point", "break points"), kernel::status_name(summary.status));
  }

  void shade() {
    const auto image = hill_shade(view_.mesh, plan_);
    const auto data = base64(encode_png(image.pixels, image.width, image.height));
    out_ << fmt::format(
        "<image width=\"{:.2f}\" height=\"{:.2f}\" preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,{}\"/>\n",
        std::max(1.0, plan_.width()), std::max(1.0, plan_.height()), data);
  }

  std::string pixel(const kernel::Point& p) const {
    const auto q = plan_.to_pixels(p);
    return fmt::format("{:.2f} {:.2f}", q[0], q[1]);
  }
  /// One more corner of a path: a move for the first, else a line.
  void extend(std::string& path, bool first, const kernel::Point& p) const {
    path += first ? 'M' : 'L';
    path += pixel(p);
  }
  const kernel::Point& listed(std::int64_t point) const { return outlines_.points()[static_cast<std::size_t>(point)]; }

  /// Opaque cells in a group that is translucent as a whole: seams between the pieces of a cell do not show.
  void cells() {
    const auto& diagram = view_.diagram;
    const auto loops = whole_face_loops(view_.mesh, diagram, plan_);
    std::vector<std::string> paths(diagram.cells.size());
    for (std::size_t c = 0; c < loops.size(); ++c)
      for (const auto& loop : loops[c]) {
        for (std::size_t i = 0; i < loop.size(); ++i) extend(paths[c], i == 0, view_.mesh.point(loop[i]));
        paths[c] += 'Z';
      }
    for (const auto& piece : diagram.pieces) {
      const auto source = drawn_source(diagram, piece.labels);
      if (source < 0 || !plan_.is_seen(piece.face)) continue;
      auto& path = paths[static_cast<std::size_t>(source)];
      for (const auto& ring : outlines_.rings(piece)) {
        for (std::size_t i = 0; i < ring.size(); ++i) extend(path, i == 0, listed(ring[i]));
        path += 'Z';
      }
    }
    const auto colour = colour_cells(diagram, kPalette.size());
    out_ << "<g opacity=\"0.45\" stroke-width=\"0.6\" stroke-linejoin=\"round\">\n";
    for (std::size_t c = 0; c < paths.size(); ++c)
      if (!paths[c].empty()) out_ << fmt::format("<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>\n", kPalette[colour[c]], paths[c]);
    out_ << "</g>\n";
  }

  void mesh_boundary() {
    const auto& mesh = view_.mesh;
    std::string path;
    for (kernel::HalfedgeId h = 0; h < mesh.halfedge_count(); ++h)
      if (mesh.twin(h) == kernel::kNone) path += fmt::format("M{}L{}", pixel(mesh.point(mesh.origin(h))), pixel(mesh.point(mesh.target(h))));
    if (path.empty()) return;
    out_ << fmt::format("<path fill=\"none\" stroke=\"#22303a\" stroke-width=\"1.1\" stroke-linecap=\"round\" d=\"{}\"/>\n", path);
  }

  void edges() {
    std::string path;
    for (const auto& edge : view_.diagram.edges) {
      kernel::FaceId drawn = kernel::kNone;  // of the arc drawn last, if the line goes on from it
      for (const auto index : edge.arcs) {
        const auto face = view_.diagram.arcs[index].face;
        if (!plan_.is_seen(face)) {
          drawn = kernel::kNone;
          continue;
        }
        const auto chain = outlines_.arc(index);
        if (drawn == kernel::kNone) extend(path, true, listed(chain.front()));
        for (std::size_t i = 1; i < chain.size(); ++i) extend(path, false, listed(chain[i]));
        drawn = face;
      }
    }
    if (path.empty()) return;
    out_ << fmt::format("<path fill=\"none\" stroke=\"#fff\" stroke-opacity=\"0.55\" stroke-width=\"3.4\" stroke-linejoin=\"round\" d=\"{0}\"/>\n"
                        "<path fill=\"none\" stroke=\"#10222e\" stroke-width=\"1.6\" stroke-linejoin=\"round\" d=\"{0}\"/>\n",
                        path);
  }

  /// Dots in one path: lines of no length with round caps.
  template <class Points>
  void dots(const Points& points, const char* colour, double size) {
    std::string path;
    for (const auto& x : points) {
      const auto& point = view_.diagram.points[x.point];
      if (point.face == kernel::kNone || plan_.is_seen(point.face)) path += fmt::format("M{}h0", pixel(point.position));
    }
    if (path.empty()) return;
    out_ << fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\" d=\"{}\"/>\n", colour, size, path);
  }
  void break_points() { dots(view_.diagram.break_points, "#c2255c", 3.4); }
  void gvd_vertices() {
    dots(view_.diagram.vertices, "#10222e", 7.5);
    dots(view_.diagram.vertices, "#ffffff", 4.2);
  }

  kernel::Point position(const kernel::SurfacePoint& at) const {
    if (at.vertex != kernel::kNone) return view_.mesh.point(at.vertex);
    kernel::Point p{};
    for (unsigned corner = 0; corner < 3; ++corner)
      for (unsigned k = 0; k < 3; ++k) p[k] += at.bary[corner].get_d() * view_.mesh.point(view_.mesh.origin(3 * at.face + corner))[k];
    return p;
  }

  void sources() {
    const bool numbered = view_.sources.size() <= kMostNumberedSources;
    const double radius = numbered ? 5 : 3.2;
    out_ << "<g fill=\"#e03131\" stroke=\"#fff\" stroke-width=\"1.3\">\n";
    for (const auto& source : view_.sources) {
      const auto q = plan_.to_pixels(position(source.at));
      out_ << fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\"/>\n", q[0], q[1], radius);
    }
    out_ << "</g>\n";
    if (!numbered) return;
    out_ << "<g font-size=\"13\" font-weight=\"bold\" fill=\"#10222e\" stroke=\"#fff\" stroke-width=\"3\" stroke-linejoin=\"round\" "
            "paint-order=\"stroke\">\n";
    for (std::size_t s = 0; s < view_.sources.size(); ++s) {
      const auto q = plan_.to_pixels(position(view_.sources[s].at));
      const bool left = q[0] > plan_.width() - 28;  // no room on the right
      out_ << fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\"{}>{}</text>\n", left ? q[0] - 7 : q[0] + 7, std::max(q[1] - 6, 12.0),
                          left ? " text-anchor=\"end\"" : "", s);
    }
    out_ << "</g>\n";
  }

  void footer(double width, double top) {
    scale_bar(kMargin, top + 52);
    double x = width - kMargin - 590;
    const double y = top + 48;
    out_ << "<g font-size=\"14\" fill=\"#22303a\">\n";
    out_ << fmt::format("<circle cx=\"{0}\" cy=\"{1}\" r=\"5\" fill=\"#e03131\" stroke=\"#fff\" stroke-width=\"1.3\"/>", x, y);
    out_ << fmt::format("<text x=\"{}\" y=\"{}\">source</text>\n", x + 12, y + 5);
    x += 85;
    out_ << fmt::format("<path d=\"M{0} {1}h26\" stroke=\"#10222e\" stroke-width=\"1.8\"/>", x, y);
    out_ << fmt::format("<text x=\"{}\" y=\"{}\">Voronoi edge</text>\n", x + 34, y + 5);
    x += 150;
    out_ << fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"3\" fill=\"#fff\" stroke=\"#10222e\" stroke-width=\"1.7\"/>", x, y);
    out_ << fmt::format("<text x=\"{}\" y=\"{}\">Voronoi vertex</text>\n", x + 12, y + 5);
    x += 145;
    out_ << fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"2.2\" fill=\"#c2255c\"/>", x, y);
    out_ << fmt::format("<text x=\"{}\" y=\"{}\">break point (conic changes)</text>\n</g>\n", x + 10, y + 5);
  }

  void scale_bar(double x, double y) {
    const double length = round_length(180 / plan_.pixels_per_unit()), pixels = length * plan_.pixels_per_unit();
    out_ << fmt::format("<g fill=\"#22303a\" font-size=\"14\">\n<rect x=\"{0}\" y=\"{1}\" width=\"{2:.2f}\" height=\"7\" fill=\"#fff\" "
                        "stroke=\"#22303a\"/><rect x=\"{0}\" y=\"{1}\" width=\"{3:.2f}\" height=\"7\"/>\n",
                        x, y - 12, pixels, pixels / 2);
    out_ << fmt::format("<text x=\"{:.2f}\" y=\"{}\">{:g} {}</text>\n</g>\n", x + pixels + 10, y - 3, length, escaped(view_.units));
  }

  std::ostream& out_;
  const ResultView& view_;
  PlanView plan_;
  SampledOutlines outlines_;
};

}  // namespace

void write_diagram_svg(std::ostream& out, const ResultView& view) { Map(out, view).write(); }

}  // namespace gvd::io
