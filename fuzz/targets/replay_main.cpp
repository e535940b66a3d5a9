#include <chrono>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <vector>

#include "fuzz_input.hpp"

namespace {

/// As many as there is time for: the inputs are cheap for readers and dear for the kernel.
constexpr int kMadeUpInputs = 3000;
constexpr auto kLongest = std::chrono::seconds(30);

void run(const std::vector<std::uint8_t>& bytes) { LLVMFuzzerTestOneInput(bytes.data(), bytes.size()); }

/// Inputs of up to some hundred bytes; half of them use few different values, which makes repeated indices and equal coordinates
/// common.
void run_made_up() {
  std::mt19937_64 random(1);
  const auto start = std::chrono::steady_clock::now();
  int i = 0;
  for (; i < kMadeUpInputs && std::chrono::steady_clock::now() - start < kLongest; ++i) {
    std::vector<std::uint8_t> bytes(random() % 400);
    const std::uint64_t values = random() % 2 == 0 ? 256 : 2 + random() % 8;
    for (auto& b : bytes) b = static_cast<std::uint8_t>(random() % values);
    run(bytes);
  }
  std::cout << i << " made-up inputs passed\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1) run_made_up();
  for (int i = 1; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    if (!file) {
      std::cerr << argv[i] << ": cannot be read\n";
      return 2;
    }
    run(std::vector<std::uint8_t>(std::istreambuf_iterator<char>(file), {}));
    std::cout << argv[i] << ": passed\n";
  }
  return 0;
}
