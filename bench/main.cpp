// Benchmarks of the distance field and of the whole diagram. scripts/bench runs them.
#include <benchmark/benchmark.h>

#include "workload.hpp"
#include "yardstick.hpp"

namespace gvd::bench {
namespace {

constexpr std::uint64_t kSeed = 1;

void cgal_distance_field(benchmark::State& state) {
  const auto points = random_points(st_helens(), static_cast<std::uint32_t>(state.range(0)), kSeed);
  for (auto _ : state) {
    state.PauseTiming();
    auto yardstick = std::make_unique<Yardstick>(st_helens(), points);
    state.ResumeTiming();
    yardstick->propagate();
    state.PauseTiming();
    yardstick.reset();
    state.ResumeTiming();
  }
}
BENCHMARK(cgal_distance_field)->Arg(1)->Arg(30)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gvd::bench

int main(int argc, char** argv) {
  benchmark::AddCustomContext("mesh", gvd::bench::st_helens_name());
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
