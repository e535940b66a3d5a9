#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/generators/case.hpp"
#include "fuzz/generators/draw.hpp"
#include "gvd/kernel/solver.hpp"

namespace gvd::fuzz {

/// What a campaign counts about the cases it has seen, so that an empty class shows.
enum class Tag : std::uint8_t {
  saddles,        ///< a vertex relays a wave
  ties,           ///< a vertex of the input has two nearest sources
  shared_region,  ///< a whole region has
  crowded_facet,  ///< four or more waves have a region in one facet
  gvd_vertex,
  break_point,
  weighted,
  hidden_source,
  duplicate_source,
  source_on_edge,
  source_in_facet,
  several_in_facet,
  boundary,
  closed,
  unreachable,
  flat_vertices,
  stage_identity,
  stage_filter,
  stage_double_double,
  stage_mpfr,
  stage_algebra,
  stage_undecided,
};
inline constexpr std::size_t kTagCount = 22;
const char* tag_name(Tag tag);

/// A set of tags.
class Tags {
 public:
  void add(Tag tag) { bits_ |= bit(tag); }
  bool has(Tag tag) const { return (bits_ & bit(tag)) != 0; }

 private:
  static std::uint32_t bit(Tag tag) { return std::uint32_t{1} << static_cast<unsigned>(tag); }
  std::uint32_t bits_ = 0;
};

/// A run that took longer than `Trial::kSeconds`: neither right nor wrong.
class TookTooLong : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One case while its properties are looked at: solutions are made on demand and shared. Throws InputError if the case is not
/// valid.
class Trial {
 public:
  Trial(Case c, std::uint64_t seed);
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  const Case& problem() const noexcept { return case_; }
  const kernel::Mesh& mesh() const noexcept { return mesh_; }
  const std::vector<kernel::Source>& sources() const noexcept { return sources_; }
  bool weighted() const noexcept;

  /// All sources, with the diagram.
  const kernel::Solution& solution();
  /// All sources, the distance field only: that of `solution` if it is there.
  const kernel::Solution& field();
  bool certified() { return solution().status() == kernel::Status::certified; }
  /// One source alone, the distance field only.
  const kernel::Solution& alone(kernel::SourceId s);

  /// Draws for one property: they depend on the seed of the case and the name only.
  Draw draw(const std::string& property) const;
  Tags tags();

  /// Solves with the limit of time. Throws TookTooLong.
  static kernel::Solution solve(const kernel::Mesh& mesh, const std::vector<kernel::Source>& sources, bool diagram,
                                unsigned threads = 1);
  static constexpr double kSeconds = 30;

 private:
  Case case_;
  std::uint64_t seed_;
  kernel::Mesh mesh_;
  std::vector<kernel::Source> sources_;
  std::optional<kernel::Solution> solution_, field_;
  std::map<kernel::SourceId, kernel::Solution> alone_;
};

}  // namespace gvd::fuzz
