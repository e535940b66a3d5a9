#include "gvd/io/svg_writer.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <sstream>

#include "support/meshes.hpp"
#include "support/square_diagram.hpp"
#include "support/xml_file.hpp"

using namespace gvd;
using test::Xml;

namespace {

std::string written(const io::ResultView& view) {
  std::ostringstream out;
  io::write_diagram_svg(out, view);
  return out.str();
}

/// All elements of that tag, at any depth.
void collect(const Xml& tree, const std::string& tag, std::vector<Xml>& found) {
  for (const auto& [name, child] : tree) {
    if (name == tag) found.push_back(child);
    collect(child, tag, found);
  }
}
std::vector<Xml> elements(const std::string& svg, const std::string& tag) {
  std::vector<Xml> found;
  collect(test::parse_xml(svg), tag, found);
  return found;
}

std::uint32_t big_endian(const std::vector<unsigned char>& bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 | std::uint32_t{bytes[at + 2]} << 8 | bytes[at + 3];
}

/// The embedded picture: size and the alpha of each pixel. Checks the check sums.
struct Picture {
  std::uint32_t width, height;
  std::vector<unsigned char> grey, alpha;

  explicit Picture(const std::string& svg) {
    const std::string link = elements(svg, "image").at(0).get<std::string>("<xmlattr>.xlink:href");
    const std::string prefix = "data:image/png;base64,";
    EXPECT_TRUE(link.starts_with(prefix));
    const auto png = test::decode_base64(link.substr(prefix.size()));
    std::vector<unsigned char> packed;
    for (std::size_t at = 8; at < png.size();) {
      const auto size = big_endian(png, at);
      const std::string type(png.begin() + static_cast<std::ptrdiff_t>(at) + 4, png.begin() + static_cast<std::ptrdiff_t>(at) + 8);
      EXPECT_EQ(crc32(0, &png[at + 4], size + 4), big_endian(png, at + 8 + size)) << type;
      if (type == "IHDR") width = big_endian(png, at + 8), height = big_endian(png, at + 12);
      if (type == "IDAT") packed.assign(&png[at + 8], &png[at + 8] + size);
      at += 12 + size;
    }
    unpack(packed);
  }

 private:
  void unpack(const std::vector<unsigned char>& packed) {
    const std::size_t row = 2 * std::size_t{width} + 1;
    std::vector<unsigned char> raw(row * height);
    uLongf size = raw.size();
    EXPECT_EQ(uncompress(raw.data(), &size, packed.data(), packed.size()), Z_OK);
    EXPECT_EQ(size, raw.size());
    for (std::size_t y = 1; y < height; ++y)
      for (std::size_t x = 1; x < row; ++x) raw[y * row + x] = static_cast<unsigned char>(raw[y * row + x] + raw[(y - 1) * row + x]);
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x) {
        grey.push_back(raw[y * row + 1 + 2 * x]);
        alpha.push_back(raw[y * row + 2 + 2 * x]);
      }
  }
};

TEST(SvgWriter, IsWellFormedAndShowsTheParts) {
  const test::SquareDiagram square;
  const std::string svg = written(square.view());
  EXPECT_EQ(elements(svg, "title").at(0).data(), "Geodesic Voronoi diagram of square <&>");
  EXPECT_EQ(elements(svg, "circle").size(), 2u + 2u + 1u) << "two sources, and source, vertex and break point in the legend";
  EXPECT_NE(svg.find(">2 triangles &#183; 2 sources &#183; 1 Voronoi edge &#183; 0 Voronoi vertices &#183; 0 break points &#183; certified<"),
            std::string::npos);
  EXPECT_NE(svg.find(">0.5 mesh units<"), std::string::npos);
}

TEST(SvgWriter, HillShadeCoversASquareWholly) {
  const test::SquareDiagram square;
  const Picture picture(written(square.view()));
  EXPECT_EQ(picture.width, 1200u);
  EXPECT_EQ(picture.height, 1200u);
  EXPECT_EQ(std::count(picture.alpha.begin(), picture.alpha.end(), 255), 1200 * 1200);
}

/// A roof whose two sides look to the north-west and the south-east.
TEST(SvgWriter, LightComesFromTheNorthWest) {
  test::SquareDiagram square(0);
  square.mesh = kernel::Mesh({{{0, 0, 1}, {4, 0, 0}, {4, 4, 1}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}});
  const Picture picture(written(square.view()));
  const auto pixel = [&](std::size_t x, std::size_t y) { return picture.grey[y * picture.width + x]; };
  EXPECT_GT(pixel(100, 100), pixel(1100, 1100) + 100);
}

TEST(SvgWriter, LeavesHolesOpen) {
  test::SquareDiagram square;
  square.mesh = kernel::Mesh(test::plane_with_hole(4, 4, 1, 3, 1, 3));
  square.diagram = {};
  square.diagram.label_sets = {{0}, {1}};
  square.diagram.cells.resize(2);
  square.diagram.face_label.assign(square.mesh.face_count(), 0);
  auto view = square.view();
  view.vertices.distance.assign(square.mesh.vertex_count(), 1);
  const std::string svg = written(view);
  const Picture picture(svg);
  EXPECT_EQ(picture.alpha[600 * 1200 + 600], 0);
  EXPECT_EQ(picture.alpha[100 * 1200 + 100], 255);
  for (const auto& path : elements(svg, "path")) {
    const std::string d = path.get<std::string>("<xmlattr>.d");
    if (path.get<std::string>("<xmlattr>.fill", "none") == "none") continue;
    if (d.find('Z') == std::string::npos) continue;
    EXPECT_EQ(std::count(d.begin(), d.end(), 'Z'), 2) << "the cell is one region with an outer and an inner loop";
  }
}

TEST(SvgWriter, NeighboursHaveDifferentColours) {
  const test::SquareDiagram square;
  std::vector<std::string> fills;
  for (const auto& path : elements(written(square.view()), "path"))
    if (path.get<std::string>("<xmlattr>.fill", "none") != "none") fills.push_back(path.get<std::string>("<xmlattr>.fill"));
  ASSERT_EQ(fills.size(), 2u);
  EXPECT_NE(fills[0], fills[1]);
}

TEST(SvgWriter, DrawsAVerticalSurfaceWithoutTrouble) {
  test::SquareDiagram square;
  square.mesh = kernel::Mesh({{{0, 0, 0}, {4, 0, 0}, {4, 0, 4}, {0, 0, 4}}, {{0, 1, 2}, {0, 2, 3}}});
  EXPECT_NO_THROW(test::parse_xml(written(square.view())));
}

}  // namespace
