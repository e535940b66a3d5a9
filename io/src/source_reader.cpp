#include "gvd/io/source_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>
#include <system_error>
#include <utility>

#include "file_bytes.hpp"
#include "file_cursor.hpp"
#include "gvd/kernel/error.hpp"
#include "gvd/kernel/random_sources.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "gvd/kernel/surface_search.hpp"

namespace gvd::io {
namespace {

using kernel::SurfacePoint;

/// Reads the lines of one source file.
class SourceLines {
 public:
  SourceLines(std::string_view text, const std::string& name, const kernel::Mesh& mesh, SourceReport& report)
      : cursor_(text, name, '#'), mesh_(mesh), report_(report) {}

  std::vector<kernel::Source> read() {
    while (cursor_.seek_word()) sources_.push_back(line());
    return std::move(sources_);
  }

 private:
  /// Adds the file and the line to what the kernel refuses.
  template <class Make>
  auto place(Make&& make) const {
    try {
      return make();
    } catch (const InputError& error) {
      cursor_.refuse(error.what());
    }
  }

  kernel::Source line() {
    kernel::Source source;
    source.at = point();
    std::string_view word = cursor_.word_on_line();
    if (word.starts_with("w=")) {
      source.weight = cursor_.real(word.substr(2), "the weight");
      if (source.weight < 0) cursor_.refuse(fmt::format("the weight is negative: {}", quoted(word)));
      word = cursor_.word_on_line();
    }
    if (!word.empty()) cursor_.refuse(fmt::format("{} does not belong to the source", quoted(word)));
    return source;
  }

  SurfacePoint point() {
    const std::string_view kind = cursor_.word_on_line();
    if (kind == "v") return vertex_point();
    if (kind == "e") return edge_point();
    if (kind == "f") return face_point();
    if (kind == "p") return nearest_point();
    if (kind == "xy") return dropped_point();
    cursor_.refuse(fmt::format("a source begins with v, e, f, p or xy, not with {}", quoted(kind)));
  }

  /// The next word of the line; `form` is how the line should look.
  std::string_view word(std::string_view form) {
    const std::string_view found = cursor_.word_on_line();
    if (found.empty() || found.starts_with("w=")) cursor_.refuse(fmt::format("the source is incomplete: expected '{}'", form));
    return found;
  }

  SurfacePoint vertex_point() {
    const kernel::VertexId v = cursor_.vertex_index(word("v INDEX"), mesh_.vertex_count());
    return place([&] { return kernel::point_at_vertex(mesh_, v); });
  }

  SurfacePoint edge_point() {
    constexpr std::string_view kForm = "e A B T";
    const kernel::VertexId a = cursor_.vertex_index(word(kForm), mesh_.vertex_count());
    const kernel::VertexId b = cursor_.vertex_index(word(kForm), mesh_.vertex_count());
    const double t = cursor_.real(word(kForm), "T");
    return place([&] { return kernel::point_on_edge(mesh_, a, b, mpq_class(t)); });
  }

  SurfacePoint face_point() {
    constexpr std::string_view kForm = "f FACE B0 B1 B2";
    const auto face = static_cast<kernel::FaceId>(cursor_.integer(word(kForm), "face index", 0, std::int64_t{kernel::kNone} - 1));
    std::array<mpq_class, 3> weights;
    for (mpq_class& weight : weights) weight = cursor_.real(word(kForm), "a weight of the corners");
    return place([&] { return kernel::point_in_face(mesh_, face, weights); });
  }

  SurfacePoint nearest_point() {
    constexpr std::string_view kForm = "p X Y Z";
    kernel::Point p;
    for (double& coordinate : p) coordinate = cursor_.real(word(kForm), "a coordinate");
    kernel::NearestPoint found = place([&] { return search().nearest(p); });
    report_.projected.push_back({static_cast<kernel::SourceId>(sources_.size()), found.squared_distance, found.distance});
    return std::move(found.at);
  }

  SurfacePoint dropped_point() {
    constexpr std::string_view kForm = "xy X Y";
    const double x = cursor_.real(word(kForm), "a coordinate");
    const double y = cursor_.real(word(kForm), "a coordinate");
    return place([&] { return search().drop(x, y); });
  }

  const kernel::SurfaceSearch& search() {
    if (!search_) search_.emplace(mesh_);
    return *search_;
  }

  FileCursor cursor_;
  const kernel::Mesh& mesh_;
  SourceReport& report_;
  std::vector<kernel::Source> sources_;
  std::optional<kernel::SurfaceSearch> search_;  // made by the first line that needs it
};

std::uint64_t source_count(std::string_view spec, std::string_view number) {
  std::uint64_t count = 0;
  const char* const end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, count);
  if (error != std::errc{} || stop != end) throw InputError(fmt::format("sources {}: not a number of sources", quoted(spec)));
  return count;
}

}  // namespace

std::vector<kernel::Source> parse_sources(std::string_view text, const std::string& name, const kernel::Mesh& mesh,
                                          SourceReport& report) {
  report = {};
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // the byte order mark of some editors
  std::vector<kernel::Source> sources = SourceLines(text, name, mesh, report).read();
  if (sources.empty()) throw InputError(fmt::format("{}: there are no sources in the file", name));
  return sources;
}

std::vector<kernel::Source> read_sources(const std::filesystem::path& file, const kernel::Mesh& mesh, SourceReport& report) {
  return parse_sources(read_bytes(file, "a file of sources"), file.string(), mesh, report);
}

std::vector<kernel::Source> parse_source_spec(const std::string& spec, std::uint64_t seed, const kernel::Mesh& mesh,
                                              SourceReport& report) {
  report = {};
  const std::string_view text = spec;
  constexpr std::string_view kRandom = "random:", kVertices = "vertices:";
  if (text.starts_with(kRandom)) return kernel::random_surface_sources(mesh, source_count(text, text.substr(kRandom.size())), seed);
  if (text.starts_with(kVertices))
    return kernel::random_vertex_sources(mesh, source_count(text, text.substr(kVertices.size())), seed);
  return read_sources(spec, mesh, report);
}

}  // namespace gvd::io
