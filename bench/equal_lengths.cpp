// Proving that two strips of the same faces are equally long: the span test, and CGAL's kernel with square roots (CORE) beside it.
#include <CGAL/Exact_predicates_exact_constructions_kernel_with_sqrt.h>
#include <benchmark/benchmark.h>

#include "support/random_strip.hpp"

namespace gvd::bench {
namespace {

using benchmark::State;
using CoreNumber = CGAL::Exact_predicates_exact_constructions_kernel_with_sqrt::FT;

/// Coordinates of 53 random bits: every face is of a square class of its own.
test::LooseStrip random_strip(std::size_t faces) {
  robust::test::RandomNumbers random(faces);
  return test::loose_strip(faces, random, [&] {
    test::Corner c;
    for (auto& x : c) x = mpq_class(random.between(0, 1));
    return c;
  });
}

void span_test(State& state) {
  const test::LooseStrip strip = random_strip(static_cast<std::size_t>(state.range(0))), back = test::turned_round(strip);
  for (auto _ : state) {
    const bool equal = robust::are_proved_equal(strip.squared_length(), back.squared_length());
    if (!equal) state.SkipWithError("not proved");
  }
}

CoreNumber core_number(const mpq_class& q) {
  return CoreNumber(CORE::BigRat(CORE::BigInt(q.get_num().get_str()), CORE::BigInt(q.get_den().get_str())));
}

CoreNumber core_squared_length(const test::LooseStrip& strip) {
  const auto frame = [&](std::uint32_t h) -> predicates::EdgeFrame<CoreNumber> {
    const predicates::ExactFace& face = strip.faces[h / 3].face;
    const CoreNumber squared = core_number(face.squared[h % 3]);
    return {core_number(face.dot[h % 3]) / squared, core_number(face.dot[(h + 1) % 3]) / squared, sqrt(core_number(face.radicand)) / squared, CoreNumber(0)};
  };
  predicates::Complex<CoreNumber> z = predicates::apex_from_behind(frame(strip.strip.opposite));
  for (const auto& step : strip.strip.steps) z = step.left ? cross_left(z, frame(step.side)) : cross_right(z, frame(step.side));
  const auto last = frame(strip.last);
  const CoreNumber x = z.x - last.u, y = z.y - last.y;
  return (x * x + y * y) * core_number(strip.faces[strip.last / 3].face.squared[strip.last % 3]);
}

void core(State& state) {
  const test::LooseStrip strip = random_strip(static_cast<std::size_t>(state.range(0))), back = test::turned_round(strip);
  for (auto _ : state) {
    if (core_squared_length(strip) != core_squared_length(back)) state.SkipWithError("not equal");
  }
}

BENCHMARK(span_test)->Name("equal_lengths/span_test")->Arg(2)->Arg(3)->Arg(4)->Arg(20)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(core)->Name("equal_lengths/core")->Arg(2)->Arg(3)->Arg(4)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gvd::bench
