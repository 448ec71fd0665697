// How much memory this process may still have (`ulimit -v`), asked before it is given to libraries
// that crash, or blame something else, when they are refused it.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>

namespace gnbv {

/// Whether so many more bytes of address space can be had.
inline bool has_address_space(std::size_t bytes) {
  void* const memory = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return false;
  ::munmap(memory, bytes);
  return true;
}

/// Throws std::bad_alloc when they cannot.
inline void need_address_space(std::size_t bytes) {
  if (!has_address_space(bytes)) throw std::bad_alloc();
}

}  // namespace gnbv
