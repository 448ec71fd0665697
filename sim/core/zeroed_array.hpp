// Large arrays that begin as zeros and take no memory before they are written.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <vector>

namespace gnbv {

/// Allocates by calloc, whose fresh pages the kernel fills at the first write. For types whose
/// value 0 is all-zero bytes.
template <typename T>
struct ZeroedMemory {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  using value_type = T;

  ZeroedMemory() = default;
  template <typename U>
  ZeroedMemory(const ZeroedMemory<U>&) {}
  bool operator==(const ZeroedMemory&) const = default;

  T* allocate(std::size_t count) {
    auto* const data = static_cast<T*>(std::calloc(count, sizeof(T)));
    if (data == nullptr) throw std::bad_alloc();
    ask_for_large_pages(reinterpret_cast<std::uintptr_t>(data), count * sizeof(T));
    return data;
  }
  void deallocate(T* data, std::size_t) { std::free(data); }
  /// A new element has its value: writing it would take the page.
  template <typename U>
  void construct(U*) {}

 private:
  /// Neighbours in space lie pages apart: pages of 2 MB save address cache misses. Most of the
  /// largest arrays is never written, so that they keep small pages.
  static void ask_for_large_pages(std::uintptr_t data, std::size_t bytes) {
    if (bytes < std::size_t{4} << 20 || bytes > std::size_t{256} << 20) return;
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto begin = (data + page - 1) / page * page;
    const auto end = (data + bytes) / page * page;
    // a hint: a kernel without such pages refuses it, and nothing is lost
    static_cast<void>(madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE));
  }
};

/// Give its size when it is made or assigned; growing would copy, and take memory.
template <typename T>
using ZeroedArray = std::vector<T, ZeroedMemory<T>>;

}  // namespace gnbv
