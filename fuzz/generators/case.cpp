#include "fuzz/generators/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "gvd/io/mesh_reader.hpp"
#include "gvd/kernel/error.hpp"
#include "gvd/kernel/surface_point.hpp"

namespace gvd::fuzz {

kernel::Source source_at(const kernel::Mesh& mesh, const Place& place) {
  const auto& w = place.corner_weights;
  return {kernel::point_in_face(mesh, place.face, {mpq_class(w[0]), mpq_class(w[1]), mpq_class(w[2])}), place.weight};
}

std::vector<kernel::Source> sources_of(const kernel::Mesh& mesh, const std::vector<Place>& places) {
  std::vector<kernel::Source> sources;
  sources.reserve(places.size());
  for (const Place& place : places) sources.push_back(source_at(mesh, place));
  return sources;
}

bool is_valid(const Case& c) {
  try {
    const kernel::Mesh mesh(c.mesh);
    return !sources_of(mesh, c.sources).empty();
  } catch (const InputError&) {
    return false;
  }
}

std::string mesh_text(const kernel::MeshArrays& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.points.size(), mesh.faces.size());
  for (const auto& p : mesh.points) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  for (const auto& f : mesh.faces) text += fmt::format("3 {} {} {}\n", f[0], f[1], f[2]);
  return text;
}

namespace {
std::string source_line(const Place& s) {
  std::string line = fmt::format("f {} {} {} {}", s.face, s.corner_weights[0], s.corner_weights[1], s.corner_weights[2]);
  return s.weight == 0 ? line : line + fmt::format(" w={}", s.weight);
}
constexpr const char* kSourceMark = "# source ";

double number(const std::string& text, const std::string& name) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    throw InputError(name + ": not a number: " + text);
  return value;
}
}  // namespace

std::string source_text(const std::vector<Place>& sources) {
  std::string text;
  for (const Place& s : sources) text += source_line(s) + "\n";
  return text;
}

std::string case_text(const Case& c, const std::vector<std::string>& remarks) {
  std::string text = mesh_text(c.mesh);
  for (std::string remark : remarks) {
    std::replace(remark.begin(), remark.end(), '\n', ' ');
    text += "# " + remark + "\n";
  }
  for (const Place& s : c.sources) text += kSourceMark + source_line(s) + "\n";
  return text;
}

Case parse_case(const std::string& text, const std::string& name) {
  Case c;
  c.mesh = io::parse_mesh(text, name);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(kSourceMark, 0) != 0) continue;
    Place place;
    auto& w = place.corner_weights;
    std::istringstream words(line.substr(std::string(kSourceMark).size()));
    std::string kind, weight;
    std::array<std::string, 3> numbers;
    words >> kind >> place.face >> numbers[0] >> numbers[1] >> numbers[2] >> weight;
    if (kind != "f" || numbers[2].empty()) throw InputError(name + ": not a source: " + line);
    for (std::size_t k = 0; k < 3; ++k) w[k] = number(numbers[k], name);
    if (weight.rfind("w=", 0) == 0) place.weight = number(weight.substr(2), name);
    c.sources.push_back(place);
  }
  return c;
}

Case read_case(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file + ": cannot be read");
  return parse_case(std::string(std::istreambuf_iterator<char>(in), {}), file);
}

}  // namespace gvd::fuzz
