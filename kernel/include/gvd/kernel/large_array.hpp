#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace gvd::kernel {

/// Memory that begins on a huge page and asks the operating system for such pages: what is visited all over a terrain finds its addresses
/// in the processor's table of pages then. Whether it gets them changes nothing but the time. Smaller arrays have ordinary memory.
template <class T>
struct HugePages {
  using value_type = T;
  static constexpr std::size_t kPage = std::size_t{1} << 21;  // of x86-64 and most of AArch64

  HugePages() = default;
  template <class U>
  HugePages(const HugePages<U>&) noexcept {}

  T* allocate(std::size_t n) {
    if (is_small(n)) return std::allocator<T>().allocate(n);
    if (n > (std::size_t(-1) - kPage) / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = (n * sizeof(T) + kPage - 1) / kPage * kPage;
    void* const memory = ::operator new(bytes, std::align_val_t{kPage});
#if defined(__linux__)
    madvise(memory, bytes, MADV_HUGEPAGE);  // advice: what it answers does not matter
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t n) noexcept {
    if (is_small(n)) return std::allocator<T>().deallocate(memory, n);
    ::operator delete(memory, std::align_val_t{kPage});
  }
  /// Not worth a page of its own: less than half of one.
  static constexpr bool is_small(std::size_t n) noexcept { return n < kPage / 2 / sizeof(T); }
  friend bool operator==(const HugePages&, const HugePages&) { return true; }
};

/// An array with an element for each face, edge or window.
template <class T>
using LargeArray = std::vector<T, HugePages<T>>;

}  // namespace gvd::kernel
