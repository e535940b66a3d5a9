#include "poly_data.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <ostream>
#include <span>

#include "base64.hpp"

namespace gvd::io {

static_assert(std::endian::native == std::endian::little, "the files declare little-endian arrays");

namespace {

template <class Number>
constexpr const char* kTypeName = nullptr;
template <>
constexpr const char* kTypeName<double> = "Float64";
template <>
constexpr const char* kTypeName<std::int32_t> = "Int32";
template <>
constexpr const char* kTypeName<std::int64_t> = "Int64";

template <class Number>
std::string encoded(std::span<const Number> values) {
  const std::uint64_t size = values.size_bytes();
  std::vector<std::byte> bytes(sizeof size + size);
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size != 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return base64(bytes);
}

template <class Number>
void write_array(std::ostream& out, const std::string& name, std::span<const Number> values, int components = 1) {
  out << fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                     kTypeName<Number>, name, components, encoded(values));
}

template <class Number>
void write_arrays(std::ostream& out, const std::vector<PolyData::Array<Number>>& arrays) {
  for (const auto& array : arrays) write_array(out, array.name, std::span(array.values));
}

void write_cells(std::ostream& out, const char* element, const PolyData::Cells& cells) {
  out << '<' << element << ">\n";
  write_array(out, "connectivity", std::span(cells.connectivity));
  write_array(out, "offsets", std::span(cells.offsets));
  out << "</" << element << ">\n";
}

void write_field(std::ostream& out, const std::vector<PolyData::Array<double>>& field) {
  out << "<FieldData>\n";
  for (const auto& array : field)
    out << fmt::format("<DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"binary\">{}</DataArray>\n", array.name,
                       array.values.size(), encoded(std::span<const double>(array.values)));
  out << "</FieldData>\n";
}

}  // namespace

void PolyData::Cells::add(const std::vector<std::int64_t>& cell) {
  connectivity.insert(connectivity.end(), cell.begin(), cell.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
}

void write_poly_data(std::ostream& out, const PolyData& data) {
  out << "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n";
  write_field(out, data.field);
  out << fmt::format(
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
      data.points.size(), data.verts.offsets.size(), data.lines.offsets.size(), data.polys.offsets.size());
  out << "<PointData>\n";
  write_arrays(out, data.point_numbers);
  write_arrays(out, data.point_ids);
  out << "</PointData>\n<CellData>\n";
  write_arrays(out, data.cell_ids);
  out << "</CellData>\n<Points>\n";
  const double* coordinates = data.points.empty() ? nullptr : data.points.front().data();
  write_array(out, "Points", std::span(coordinates, 3 * data.points.size()), 3);
  out << "</Points>\n";
  write_cells(out, "Verts", data.verts);
  write_cells(out, "Lines", data.lines);
  write_cells(out, "Polys", data.polys);
  out << "</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace gvd::io
