// Damaged files: cut off at each byte, with bytes changed, removed and repeated. Each is refused with InputError or read; nothing else
// may happen (run under the sanitizers by the preset asan-ubsan).
#include <gtest/gtest.h>

#include "gvd/kernel/mesh.hpp"
#include "io/refusal.hpp"
#include "io/sample_meshes.hpp"
#include "support/meshes.hpp"

namespace gvd::io {
namespace {

std::map<std::string, std::string> samples() {
  auto all = test::square_samples();
  all["grid.asc"] = "ncols 3\nnrows 3\nxllcorner 0.5\nyllcenter -1\ncellsize 10\nNODATA_value -9999\n1 2 3\n4 -9999 6\n7 8.5 9e0\n";
  return all;
}

struct Tally {
  int read = 0, refused = 0;
};

/// Reads, and builds the mesh of what was read. A refusal by a reader names the file.
void attempt(const std::string& bytes, const std::string& name, Tally& tally) {
  kernel::MeshArrays arrays;
  try {
    arrays = parse_mesh(bytes, name);
  } catch (const InputError& error) {
    ++tally.refused;
    ASSERT_TRUE(std::string_view(error.what()).starts_with(name)) << error.what();
    return;
  }
  ++tally.read;
  try {
    kernel::Mesh mesh(std::move(arrays));
  } catch (const InputError&) {
  }
}

TEST(DamagedFiles, CutOffAtEachByte) {
  for (const auto& [name, bytes] : samples()) {
    Tally tally;
    for (std::size_t size = 0; size < bytes.size(); ++size) attempt(bytes.substr(0, size), name, tally);
    EXPECT_GT(tally.refused, 30) << name;
    EXPECT_LT(tally.read, 16) << name;  // the last line break, digits of the last number, a triangle of an OBJ
  }
}

TEST(DamagedFiles, BytesChanged) {
  test::Random random(99);
  for (const auto& [name, bytes] : samples()) {
    Tally tally;
    for (int round = 0; round < 3000; ++round) {
      std::string damaged = bytes;
      for (std::uint32_t i = 0; i <= random.below(3); ++i) {
        const std::size_t at = random.below(static_cast<std::uint32_t>(damaged.size()));
        switch (random.below(4)) {
          case 0: damaged[at] = static_cast<char>(random.below(256)); break;
          case 1: damaged[at] = "0123456789-+.eE \n#/"[random.below(19)]; break;
          case 2: damaged.erase(at, 1 + random.below(4)); break;
          default: damaged.insert(at, damaged.substr(at, 1 + random.below(9)));
        }
        if (damaged.empty()) damaged = " ";
      }
      attempt(damaged, name, tally);
    }
    EXPECT_GT(tally.refused, 100) << name;
    EXPECT_GT(tally.read, 10) << name;
  }
}

/// The reader of each format on files of the others, chosen by the extension where the first word is spoilt.
TEST(DamagedFiles, WrongFormat) {
  for (const auto& [name, bytes] : samples()) {
    for (const std::string extension : {".vtk", ".ply", ".off", ".obj", ".asc"}) {
      Tally tally;
      std::string spoilt = bytes;
      spoilt[0] = '?';
      attempt(spoilt, "a" + extension, tally);
      attempt(bytes, "a" + extension, tally);
    }
  }
}

}  // namespace
}  // namespace gvd::io
