#include <gmp.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

// In this program the numbers of GMP and MPFR take their memory from lists of freed blocks, one list a size and thread: exact numbers are a few words
// long and live for some hundred instructions, so that malloc would cost as much as their arithmetic. It is the program's business: GMP has one
// allocator a process, which a library must leave alone. Not under the address sanitizer, which is to see each block.
#if defined(__SANITIZE_ADDRESS__)
#define GVD_SEES_EACH_BLOCK
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GVD_SEES_EACH_BLOCK
#endif
#endif
#ifndef GVD_SEES_EACH_BLOCK

namespace gvd::cli {
namespace {

constexpr std::size_t kUnit = 32, kKinds = 32;  // in bytes: blocks of 32, 64, ... 1024
constexpr unsigned kMostBlocks = 1024;          // a list, so that a thread which only frees does not hoard

struct Block {
  Block* next;
};
struct FreeList {
  Block* first = nullptr;
  unsigned size = 0;
};
// Trivially destructible: numbers of static lifetime are freed after the variables of the thread are gone.
constinit thread_local std::array<FreeList, kKinds + 1> free_lists{};

constexpr std::size_t kind_of(std::size_t bytes) noexcept { return (bytes + kUnit - 1) / kUnit; }

void* from_system(void* old, std::size_t bytes) noexcept {
  void* block = std::realloc(old, std::max(bytes, sizeof(Block)));
  if (block == nullptr) {  // GMP expects no return without memory
    std::fputs("gvd: out of memory\n", stderr);
    std::abort();
  }
  return block;
}

void* allocate(std::size_t bytes) noexcept {
  const std::size_t kind = kind_of(bytes);
  if (kind > kKinds) return from_system(nullptr, bytes);
  FreeList& list = free_lists[kind];
  if (list.first == nullptr) return from_system(nullptr, kind * kUnit);
  Block* const block = list.first;
  list.first = block->next;
  --list.size;
  return block;
}

void release(void* memory, std::size_t bytes) noexcept {
  const std::size_t kind = kind_of(bytes);
  if (kind > kKinds || free_lists[kind].size == kMostBlocks) return std::free(memory);
  FreeList& list = free_lists[kind];
  list.first = new (memory) Block{list.first};
  ++list.size;
}

void* reallocate(void* memory, std::size_t bytes, std::size_t wanted) noexcept {
  const std::size_t kind = kind_of(bytes), wanted_kind = kind_of(wanted);
  if (kind == wanted_kind && kind <= kKinds) return memory;
  if (kind > kKinds && wanted_kind > kKinds) return from_system(memory, wanted);
  void* const block = allocate(wanted);
  std::memcpy(block, memory, std::min(bytes, wanted));
  release(memory, bytes);
  return block;
}

// Before any number of static lifetime is made: a block is released to where it came from.
[[gnu::constructor(101)]] void take_over() { mp_set_memory_functions(allocate, reallocate, release); }

}  // namespace
}  // namespace gvd::cli

#endif
