#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>

/// The entry point that libFuzzer calls.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace gvd::fuzz {

/// Reads values off the bytes of a fuzz input; zeros when they are used up.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const noexcept { return at_ == size_; }
  std::uint8_t byte() noexcept { return empty() ? std::uint8_t{0} : data_[at_++]; }
  /// In [0, n), n at most 256.
  std::uint32_t below(std::uint32_t n) noexcept { return byte() % n; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

/// Ends the process with the sentence if the property does not hold: that is what a fuzzer looks for.
inline void require(bool holds, const char* property) {
  if (holds) return;
  std::cerr << "violated: " << property << '\n';
  std::abort();
}

}  // namespace gvd::fuzz
