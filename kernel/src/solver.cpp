#include "gvd/kernel/solver.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "gvd/kernel/error.hpp"
#include "edge_images.hpp"
#include "solution_impl.hpp"

namespace gvd::kernel {
namespace {

using Clock = std::chrono::steady_clock;

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Resident memory now; 0 where the system does not tell.
std::uint64_t resident_bytes() {
  std::uint64_t pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    unsigned long long size = 0, resident = 0;
    if (std::fscanf(file, "%llu %llu", &size, &resident) == 2) pages = resident;
    std::fclose(file);
  }
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// One run of `solve`: the phases in order, limits, and the clock.
class Solver {
 public:
  Solver(Solution::Impl& state, const std::vector<Source>& sources, const SolveOptions& options)
      : s_(state), sources_(sources), options_(options), start_(Clock::now()) {}

  void run() {
    if (!phase("refine", &Solver::refine_mesh) || !phase("propagation", &Solver::propagate_waves) ||
        !phase("resolution", &Solver::resolve_vertices) || !phase("rounding", &Solver::round_distances))
      return finish();
    if (options_.diagram && (!phase("tessellation", &Solver::tessellate_facets) || !phase("extraction", &Solver::extract_diagram)))
      return finish();
    s_.status = s_.decisions.total(robust::Stage::undecided) == 0 ? Status::certified : Status::undecided;
    finish();
  }

 private:
  bool phase(const char* name, bool (Solver::*work)()) {
    phase_ = name;
    const auto begin = Clock::now();
    const bool go_on = (this->*work)() && poll(1, 1);
    s_.summary.seconds.push_back({name, std::chrono::duration<double>(Clock::now() - begin).count()});
    return go_on;
  }

  bool poll(double done, double total) {
    if (options_.time_limit_seconds > 0 &&
        std::chrono::duration<double>(Clock::now() - start_).count() > options_.time_limit_seconds) {
      s_.status = Status::time_limit;
      return false;
    }
    if (options_.max_memory_bytes > 0 && resident_bytes() > options_.max_memory_bytes) {
      s_.status = Status::memory_limit;
      return false;
    }
    if (options_.progress && !options_.progress({phase_, done, total})) {
      s_.status = Status::cancelled;
      return false;
    }
    return true;
  }

  bool refine_mesh() {
    s_.refined = refine(s_.input, sources_, s_.where);
    s_.parts = FaceParts(s_.input, s_.refined);
    tbb::task_arena(threads_to_use()).execute([&] {
      // Vertices as in the input, whose corners have shorter numbers; what is inserted lies inside a face or an edge.
      tbb::parallel_invoke([&] { s_.frames = std::make_unique<Frames>(s_.refined); }, [&] { kept_vertex_kinds(s_.input); });
    });
    s_.kinds = kept_vertex_kinds(s_.input).of;
    s_.decisions.merge(kept_vertex_kinds(s_.input).decisions);
    s_.kinds.resize(s_.refined.vertex_count(), VertexKind::flat);
    s_.decisions.count(static_cast<std::size_t>(predicates::Predicate::saddle), robust::Stage::identity, s_.refined.vertex_count() - s_.input.vertex_count());
    if (s_.frames->has_underflow())
      predicates::undecided(s_.decisions, predicates::Predicate::window_orientation,
                            "an edge is shorter than 2^-200 of the longest, or longer than the greatest double: beyond the range of the error bounds");
    for (SourceId i = 0; i < sources_.size(); ++i) {
      const double weight = s_.where.weight[i];
      if (std::ldexp(std::ldexp(weight, -s_.frames->scale()), s_.frames->scale()) != weight)
        throw InputError("source " + std::to_string(i) + ": its weight is out of all proportion to the mesh");
    }
    // Sources at one vertex: those of least weight start the wave.
    std::vector<SourceId> order(sources_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](SourceId a, SourceId b) {
      const auto key = [&](SourceId i) { return std::tuple(s_.where.vertex[i], s_.where.weight[i], i); };
      return key(a) < key(b);
    });
    for (std::size_t i = 0; i < order.size();) {
      const VertexId v = s_.where.vertex[order[i]];
      const double weight = s_.where.weight[order[i]];
      std::vector<SourceId> set;
      for (; i < order.size() && s_.where.vertex[order[i]] == v; ++i)
        if (s_.where.weight[order[i]] == weight) set.push_back(order[i]);
      s_.source_vertices.push_back({v, weight, s_.label_sets.intern(std::move(set))});
    }
    return true;
  }

  bool propagate_waves() {
    std::vector<WaveStart> starts;
    for (const SourceVertex& v : s_.source_vertices) starts.push_back({v.vertex, std::ldexp(v.weight, -s_.frames->scale())});
    const auto go_on = [](void* self, std::uint64_t settled, std::uint64_t) {
      auto& solver = *static_cast<Solver*>(self);
      constexpr std::size_t kMostWindows = kNone / 2;  // their numbers have 32 bits, and more come before the next poll
      if (solver.s_.field.windows.size() > kMostWindows || solver.s_.field.candidates.size() > kMostWindows) {
        solver.s_.status = Status::memory_limit;
        return false;
      }
      return solver.poll(static_cast<double>(settled), static_cast<double>(solver.s_.refined.vertex_count()));
    };
    return propagate(*s_.frames, starts, s_.kinds, s_.field, s_.decisions, go_on, this);
  }

  bool resolve_vertices() {
    if (threads_to_use() > 1) make_frames_in_double_double();
    s_.resolution = std::make_unique<Resolution>(*s_.frames, s_.field, s_.source_vertices, s_.label_sets);
    s_.resolution->resolve(s_.decisions);
    if (!options_.diagram) s_.resolution->forget_images();
    for (SourceId i = 0; i < sources_.size(); ++i) {
      const VertexId v = s_.where.vertex[i];
      const auto& set = s_.label_sets[s_.resolution->labels(v)];
      if (!std::binary_search(set.begin(), set.end(), i)) s_.hidden.push_back(i);
    }
    return true;
  }

  /// No more than run at once on this machine.
  int threads_to_use() const {
    const auto most = static_cast<unsigned>(std::max(1, tbb::info::default_concurrency()));
    return static_cast<int>(std::clamp(options_.threads, 1u, most));
  }

  /// Runs work(i, decisions) for all i < n in blocks, so that neither results nor lists depend on the number of threads.
  template <class Work>
  bool in_parallel(std::size_t n, const Work& work) {
    constexpr std::size_t kBlock = 16;
    const std::size_t blocks = (n + kBlock - 1) / kBlock;
    std::vector<predicates::Decisions> decisions(blocks);
    const int threads = threads_to_use();
    const std::size_t stride = std::size_t{8} * static_cast<std::size_t>(threads);
    tbb::task_arena arena(threads);
    for (std::size_t first = 0; first < blocks; first += stride) {
      const std::size_t last = std::min(blocks, first + stride);
      arena.execute([&] {
        tbb::parallel_for(first, last, [&](std::size_t b) {
          for (std::size_t i = b * kBlock; i < std::min(n, (b + 1) * kBlock); ++i) work(i, decisions[b]);
        });
      });
      if (!poll(static_cast<double>(last), static_cast<double>(blocks))) return false;
    }
    for (const auto& d : decisions) s_.decisions.merge(d);
    return true;
  }

  /// Nearly all faces lie in a strip that is unfolded again; one thread alone makes their frames when it comes to them.
  void make_frames_in_double_double() {
    tbb::task_arena(threads_to_use()).execute([&] {
      tbb::parallel_for(FaceId{0}, static_cast<FaceId>(s_.refined.face_count()), [&](FaceId f) { s_.frames->in_double_double(3 * f); });
    });
  }

  bool round_distances() {
    const std::size_t n = s_.input.vertex_count();
    s_.distance.assign(n, std::numeric_limits<double>::infinity());
    return in_parallel(n, [&](std::size_t v, predicates::Decisions& decisions) {
      const auto id = static_cast<VertexId>(v);
      if (s_.resolution->is_reached(id)) s_.distance[v] = rounded_distance(*s_.resolution, id, decisions);
    });
  }

  /// The label set that all windows, corners and sources of a facet share; kNone if there are several or none.
  LabelSetId common_label(FaceId f) const {
    const Resolution& r = *s_.resolution;
    const LabelSetId label = r.labels(s_.refined.origin(3 * f));
    for (HalfedgeId h = 3 * f; h < 3 * f + 3; ++h) {
      if (r.labels(s_.refined.origin(h)) != label) return kNone;
      for (WindowId w = s_.field.first_window[h]; w != kNone; w = s_.field.windows[w].next)
        if (r.labels(s_.field.windows[w].root) != label) return kNone;
    }
    return label;
  }

  /// Where several sources share a region, its border may run along edges; so facets with such a label set are examined, too.
  bool is_one_source(LabelSetId labels) const { return labels != kNone && s_.label_sets[labels].size() == 1; }

  /// Neighbouring facets share most of their strips.
  UnfoldedWindows unfold_windows(const std::vector<FaceId>& faces) const {
    std::vector<WindowId> wanted;
    for (const FaceId f : faces)
      for (HalfedgeId h = 3 * f; h < 3 * f + 3; ++h)
        for (WindowId w = s_.field.first_window[h]; w != kNone; w = s_.field.windows[w].next)
          if (!s_.field.windows[w].dominated()) wanted.push_back(w);
    return UnfoldedWindows(*s_.frames, s_.field, wanted);
  }

  /// Beside GVD arcs, whose points are wanted correctly rounded.
  std::vector<WindowId> windows_beside_arcs() const {
    std::vector<WindowId> wanted;
    for (const BoundaryFacet& facet : facets_) {
      const auto& sites = facet.waves->sites;
      for (const auto& arc : facet.tessellation->arcs) {
        if (sites[arc.left].labels == sites[arc.right].labels) continue;
        for (const std::uint32_t site : {arc.left, arc.right})
          if (sites[site].window != kNone) wanted.push_back(sites[site].window);
      }
    }
    return wanted;
  }

  bool tessellate_facets() {
    const FaceId n = s_.refined.face_count();
    face_labels_.assign(n, kNone);
    std::vector<FaceId> several;
    for (FaceId f = 0; f < n; ++f) {
      if (!s_.resolution->is_reached(s_.refined.origin(3 * f))) continue;
      face_labels_[f] = common_label(f);
      if (!is_one_source(face_labels_[f])) several.push_back(f);
    }
    waves_.resize(several.size());
    tessellations_.resize(several.size());
    const UnfoldedWindows unfolded = unfold_windows(several);
    const bool go_on = in_parallel(several.size(), [&](std::size_t i, predicates::Decisions& decisions) {
      auto waves = std::make_unique<FieldWaves>(*s_.resolution, s_.kinds, several[i], &unfolded);
      face_labels_[several[i]] = waves->only_label();
      if (is_one_source(face_labels_[several[i]])) return;
      tessellations_[i] = tessellate_borders(*waves, decisions);
      if (tessellations_[i].has_one_label()) {
        const LabelSetId label = waves->sites[tessellations_[i].outline[0].site].labels;
        if (is_one_source(label)) {
          face_labels_[several[i]] = label;
          return;
        }
      }
      waves->forget_frames();
      waves_[i] = std::move(waves);
    });
    if (!go_on) return false;
    for (std::size_t i = 0; i < several.size(); ++i)
      if (waves_[i]) facets_.push_back({several[i], waves_[i].get(), &tessellations_[i]});
    return true;
  }

  bool extract_diagram() {
    std::vector<DiagramSource> sources(sources_.size());
    for (SourceId i = 0; i < sources.size(); ++i)
      sources[i] = {s_.where.vertex[i], s_.where.weight[i], std::binary_search(s_.hidden.begin(), s_.hidden.end(), i)};
    const auto origin = [&](WindowId w) { return WindowOrigin{s_.field.windows[w].parent, s_.field.windows[w].halfedge()}; };
    const auto as_far_along = [&](HalfedgeId h, const FacetSite& left, const FacetSite& right) {
      return are_as_far_along(*s_.resolution, h, left, right);
    };
    const auto prepare_points = [&] { s_.resolution->add_images(windows_beside_arcs()); };
    tbb::task_arena arena(threads_to_use());
    arena.execute([&] {
      s_.diagram = extract({s_.input, s_.refined, sources, s_.label_sets.all(), s_.resolution->labels(), face_labels_, facets_, origin, as_far_along, prepare_points},
                           s_.decisions);
    });
    s_.resolution->forget_images();
    return true;
  }

  void finish() {
    Summary& summary = s_.summary;
    summary.status = s_.status;
    summary.sources = static_cast<std::uint32_t>(sources_.size());
    summary.windows_propagated = s_.field.windows.size();
    summary.components = count_components();
    if (is_complete(s_.status)) {
      for (VertexId v = 0; v < s_.input.vertex_count(); ++v) {
        if (!s_.resolution->is_reached(v))
          ++summary.unreachable_vertices;
        else if (s_.label_sets[s_.resolution->labels(v)].size() > 1)
          ++summary.ties;
      }
      for (const WindowRecord& window : s_.field.windows) summary.windows_kept += window.dominated() || window.dead() ? 0 : 1;
    }
    if (is_complete(s_.status) && options_.diagram) {
      const Diagram& d = s_.diagram;
      const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
      summary.boundary_facets = d.boundary_facets;
      summary.cells = static_cast<std::uint32_t>(sources_.size() - s_.hidden.size());
      summary.gvd_edges = size(d.edges);
      summary.gvd_vertices = size(d.vertices);
      summary.break_points = size(d.break_points);
      summary.dual_edges = size(d.dual);
    }
    summary.peak_memory_mb = peak_memory_mb();
  }

  std::uint32_t count_components() const {
    std::vector<VertexId> parent(s_.input.vertex_count());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](VertexId v) {
      while (parent[v] != v) v = parent[v] = parent[parent[v]];
      return v;
    };
    for (HalfedgeId h = 0; h < s_.input.halfedge_count(); ++h) parent[root(s_.input.origin(h))] = root(s_.input.target(h));
    std::uint32_t count = 0;
    for (VertexId v = 0; v < parent.size(); ++v)
      if (parent[v] == v && !s_.input.is_isolated(v)) ++count;
    return count;
  }

  Solution::Impl& s_;
  const std::vector<Source>& sources_;
  const SolveOptions& options_;
  Clock::time_point start_;
  const char* phase_ = "";
  std::vector<LabelSetId> face_labels_;
  std::vector<std::unique_ptr<FieldWaves>> waves_;
  std::vector<FacetTessellation> tessellations_;
  std::vector<BoundaryFacet> facets_;
};

}  // namespace

Solution solve(const Mesh& mesh, const std::vector<Source>& sources, const SolveOptions& options) {
  if (sources.empty()) throw InputError("there is no source");
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (!std::isfinite(sources[i].weight) || sources[i].weight < 0)
      throw InputError("source " + std::to_string(i) + ": its weight is negative or not finite");
  auto state = std::make_unique<Solution::Impl>(mesh);
  Solver(*state, sources, options).run();
  return Solution(std::move(state));
}

}  // namespace gvd::kernel
