// The innermost loop of the propagation exists twice, for all processors and for those with AVX. Both must do the same to the last bit.
#include <gtest/gtest.h>

#include <bit>
#include <functional>

#include "../../kernel/src/propagation.hpp"
#include "gvd/kernel/random_sources.hpp"
#include "gvd/kernel/source.hpp"
#include "gvd/kernel/vertex_kind.hpp"
#include "support/meshes.hpp"

namespace gvd::test {
namespace {

using kernel::Candidate;
using kernel::DistanceField;
using kernel::Instructions;
using kernel::Mesh;
using kernel::WindowRecord;

struct Run {
  DistanceField field;
  predicates::Decisions decisions;
};

Run propagated(const kernel::Frames& frames, const std::vector<kernel::WaveStart>& starts, Instructions instructions) {
  Run run;
  const auto kinds = kernel::classify_vertices(frames.mesh(), run.decisions);
  EXPECT_TRUE(kernel::Propagation(frames, kinds, run.field, run.decisions, instructions).run(starts, nullptr, nullptr));
  return run;
}

std::vector<std::uint64_t> bits_of(const std::vector<double>& numbers) {
  std::vector<std::uint64_t> bits;
  for (const double x : numbers) bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}
std::vector<std::uint64_t> bits_of(const std::vector<WindowRecord>& windows) {
  std::vector<std::uint64_t> bits;
  for (const WindowRecord& w : windows) bits.insert(bits.end(), {w.parent, w.packed, w.root, w.next});
  return bits;
}
std::vector<std::uint64_t> bits_of(const std::vector<Candidate>& candidates) {
  std::vector<std::uint64_t> bits;
  for (const Candidate& c : candidates) {
    bits.insert(bits.end(), {c.window, c.via, c.next});
    for (const double x : {c.distance, c.error, c.image.x, c.image.y}) bits.push_back(std::bit_cast<std::uint64_t>(x));
  }
  return bits;
}

void expect_same_bits(const MeshArrays& arrays, std::uint32_t source_count, std::uint64_t seed) {
  const Mesh input(arrays);
  kernel::RefinedSources where;
  const Mesh mesh = kernel::refine(input, kernel::random_surface_sources(input, source_count, seed), where);
  const kernel::Frames frames(mesh);
  std::vector<kernel::WaveStart> starts;
  for (const kernel::VertexId v : where.vertex) starts.push_back({v, 0.125 * static_cast<double>(v % 3)});
  const Run any = propagated(frames, starts, Instructions::any), least = propagated(frames, starts, Instructions::least);
  EXPECT_GT(any.field.windows.size(), mesh.face_count());
  EXPECT_EQ(bits_of(any.field.windows), bits_of(least.field.windows));
  EXPECT_EQ(bits_of(any.field.candidates), bits_of(least.field.candidates));
  EXPECT_EQ(any.field.first_window, least.field.first_window);
  EXPECT_EQ(any.field.first_candidate, least.field.first_candidate);
  EXPECT_EQ(bits_of(any.field.distance), bits_of(least.field.distance));
  EXPECT_EQ(bits_of(any.field.error), bits_of(least.field.error));
  EXPECT_EQ(any.field.windows_propagated, least.field.windows_propagated);
  for (std::size_t stage = 0; stage < robust::kStageCount; ++stage)
    EXPECT_EQ(any.decisions.total(static_cast<robust::Stage>(stage)), least.decisions.total(static_cast<robust::Stage>(stage)));
}

MeshArrays changed(MeshArrays mesh, const std::function<void(Point&)>& change) {
  for (Point& p : mesh.points) change(p);
  return mesh;
}

TEST(Instructions, AvxChangesNoBit) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx2") == 0) GTEST_SKIP() << "this processor has no AVX";
#endif
  const MeshArrays terrain = fractal_terrain(6, 3, 0.6, 5);
  expect_same_bits(terrain, 1, 1);
  expect_same_bits(terrain, 20, 2);
  expect_same_bits(flat_grid(12, 12), 3, 3);  // ties and flat vertices
  const MeshArrays small = fractal_terrain(4, 3, 0.6, 6);
  expect_same_bits(changed(small, [](Point& p) { p[1] *= 1e-3, p[2] *= 1e-3; }), 2, 4);      // slivers
  expect_same_bits(changed(small, [](Point& p) { p[0] = std::exp2(p[0] * 4); }), 4, 5);      // all sizes
}

}  // namespace
}  // namespace gvd::test
