// Unfolding strips again, face by face: what a decision beyond plain doubles costs. Time is per face crossed.
#include <benchmark/benchmark.h>

#include "gvd/kernel/distance_field.hpp"
#include "gvd/kernel/random_sources.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/kernel/unfolding.hpp"
#include "gvd/kernel/vertex_kind.hpp"
#include "workload.hpp"

namespace gvd::bench {
namespace {

using benchmark::State;

/// The strips by which the waves of one source come to the vertices of the mesh.
struct Strips {
  kernel::RefinedSources where;
  kernel::Mesh mesh = kernel::refine(st_helens(), kernel::random_surface_sources(st_helens(), 1, 1), where);
  kernel::Frames frames{mesh};
  std::vector<predicates::Strip> strips;
  std::size_t faces = 0;

  Strips() {
    predicates::Decisions decisions;
    kernel::DistanceField field;
    const std::vector<kernel::WaveStart> start{{where.vertex.front(), 0}};
    kernel::propagate(frames, start, kernel::classify_vertices(mesh, decisions), field, decisions);
    for (const std::uint32_t c : field.first_candidate) {
      if (c == kernel::kNone || field.candidates[c].window == kernel::kNone) continue;
      strips.push_back(kernel::strip_of(mesh, field, field.candidates[c].window));
      faces += strips.back().steps.size();
    }
  }
};
const Strips& strips_of_st_helens() {
  static const Strips strips;
  return strips;
}

template <class T, class FrameOf>
void replay(State& state, const FrameOf& frame_of) {
  const Strips& all = strips_of_st_helens();
  const auto frame = frame_of(all.frames);
  for (auto _ : state)
    for (const predicates::Strip& strip : all.strips) benchmark::DoNotOptimize(predicates::unfold<T, false>(strip, frame).image.radius);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.faces));
  state.counters["time_per_face"] = benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(all.faces),
                                                       benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["faces_per_strip"] = static_cast<double>(all.faces) / static_cast<double>(all.strips.size());
}

void in_double(State& state) {
  replay<double>(state, [](const kernel::Frames& frames) {
    return [&frames](kernel::HalfedgeId h) -> const predicates::EdgeFrame<double>& { return frames(h); };
  });
}
/// The frames in double-double are made by the first use of a face, which is off the clock.
void in_double_double(State& state) {
  const Strips& all = strips_of_st_helens();
  for (kernel::HalfedgeId h = 0; h < 3 * all.mesh.face_count(); ++h) benchmark::DoNotOptimize(all.frames.in_double_double(h).y.hi);
  replay<robust::DoubleDouble>(state, [](const kernel::Frames& frames) {
    return [&frames](kernel::HalfedgeId h) -> const predicates::EdgeFrame<robust::DoubleDouble>& { return frames.in_double_double(h); };
  });
}

BENCHMARK(in_double)->Name("replay/double")->Unit(benchmark::kMillisecond);
BENCHMARK(in_double_double)->Name("replay/double_double")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gvd::bench
