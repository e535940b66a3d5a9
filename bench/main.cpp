// Benchmarks of the distance field and of the whole diagram, and CGAL's distance field beside them. scripts/bench runs them.
#include <benchmark/benchmark.h>

#include <memory>

#include "gvd/kernel/distance_field.hpp"
#include "gvd/kernel/frames.hpp"
#include "gvd/kernel/random_sources.hpp"
#include "gvd/kernel/solver.hpp"
#include "gvd/kernel/vertex_kind.hpp"
#include "workload.hpp"
#include "yardstick.hpp"

namespace gvd::bench {
namespace {

using benchmark::State;

constexpr std::uint64_t kSeed = 1;

std::uint32_t source_count(const State& state) { return static_cast<std::uint32_t>(state.range(0)); }

/// CGAL's distance field; the mesh is set up and taken down off the clock.
void cgal_distance_field(State& state) {
  const auto sources = kernel::random_surface_sources(st_helens(), source_count(state), kSeed);
  for (auto _ : state) {
    state.PauseTiming();
    auto yardstick = std::make_unique<Yardstick>(st_helens(), sources);
    state.ResumeTiming();
    yardstick->propagate();
    state.PauseTiming();
    yardstick.reset();
    state.ResumeTiming();
  }
}

/// Ours: all windows and candidates; sources inserted off the clock, as there.
void distance_field(State& state) {
  kernel::RefinedSources where;
  const kernel::Mesh mesh =
      kernel::refine(st_helens(), kernel::random_surface_sources(st_helens(), source_count(state), kSeed), where);
  std::vector<kernel::WaveStart> starts;
  for (const kernel::VertexId v : where.vertex) starts.push_back({v, 0});
  for (auto _ : state) {
    predicates::Decisions decisions;
    auto field = std::make_unique<kernel::DistanceField>();
    const kernel::Frames frames(mesh);
    const auto kinds = kernel::classify_vertices(mesh, decisions);
    kernel::propagate(frames, starts, kinds, *field, decisions);
    state.counters["windows"] = static_cast<double>(field->windows_propagated);
    state.PauseTiming();
    field.reset();
    state.ResumeTiming();
  }
}

/// The share of decisions that neither identity nor the double filter made, rounding not counted, in parts per million.
double beyond_filter_ppm(const predicates::Decisions& decisions) {
  double all = 0, beyond = 0;
  for (std::size_t p = 0; p < predicates::kPredicateCount; ++p) {
    if (p == static_cast<std::size_t>(predicates::Predicate::rounding)) continue;
    for (std::size_t s = 0; s < robust::kStageCount; ++s) {
      const auto stage = static_cast<robust::Stage>(s);
      const auto count = static_cast<double>(decisions(p, stage));
      all += count;
      if (stage != robust::Stage::identity && stage != robust::Stage::filter) beyond += count;
    }
  }
  return all == 0 ? 0 : 1e6 * beyond / all;
}

/// Each solution is that of a new mesh, set up off the clock: a mesh keeps what is found out about it once.
void solve_and_report(State& state, const kernel::MeshArrays& arrays, std::uint32_t source_count, const kernel::SolveOptions& options) {
  const auto sources = kernel::random_surface_sources(kernel::Mesh(arrays), source_count, kSeed);
  for (auto _ : state) {
    state.PauseTiming();
    const kernel::Mesh mesh(arrays);
    state.ResumeTiming();
    const kernel::Solution solution = kernel::solve(mesh, sources, options);
    state.SetLabel(kernel::status_name(solution.status()));
    double seconds = 0;
    for (const auto& phase : solution.summary().seconds) {
      state.counters["ms_" + phase.name] = 1000 * phase.seconds;
      seconds += phase.seconds;
    }
    state.counters["us_per_face"] = 1e6 * seconds / mesh.face_count();
    state.counters["beyond_filter_ppm"] = beyond_filter_ppm(solution.decisions());
    state.counters["peak_mb"] = solution.summary().peak_memory_mb;
  }
}

/// The distance field with every distance correctly rounded and every label set proved.
void distances(State& state) {
  kernel::SolveOptions options;
  options.diagram = false;
  solve_and_report(state, st_helens_arrays(), source_count(state), options);
}

/// All of it: distances, tessellated facets, extracted diagram.
void diagram(State& state) {
  solve_and_report(state, st_helens_arrays(), source_count(state), {});
}

/// The same on two threads, which all phases but the propagation use.
void diagram_two_threads(State& state) {
  kernel::SolveOptions options;
  options.threads = 2;
  solve_and_report(state, st_helens_arrays(), source_count(state), options);
}

/// Arguments: triangles, sources, threads.
void diagram_of_generated_terrain(State& state) {
  kernel::SolveOptions options;
  options.threads = static_cast<unsigned>(state.range(2));
  solve_and_report(state, terrain(static_cast<std::uint32_t>(state.range(0))), static_cast<std::uint32_t>(state.range(1)), options);
}

void numbers_of_sources(benchmark::internal::Benchmark* b) {
  b->Arg(1)->Arg(30)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
}

BENCHMARK(cgal_distance_field)->Apply(numbers_of_sources);
BENCHMARK(distance_field)->Apply(numbers_of_sources);
BENCHMARK(distances)->Apply(numbers_of_sources);
BENCHMARK(diagram)->Apply(numbers_of_sources);
BENCHMARK(diagram_two_threads)->Apply(numbers_of_sources)->UseRealTime();
BENCHMARK(diagram_of_generated_terrain)
    ->Args({20000, 20, 1})
    ->Args({20000, 20, 2})
    ->Args({1000000, 1000, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace gvd::bench

int main(int argc, char** argv) {
  benchmark::AddCustomContext("mesh", gvd::bench::st_helens_name());
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
