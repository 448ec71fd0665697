// Whether this process may have more memory (`ulimit -v`). We ask before we call libraries that
// crash, or blame something else, when they get none.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>

namespace gnbv {

/// Throws std::bad_alloc when this process cannot have so many more bytes of address space.
inline void need_address_space(std::size_t bytes) {
  void* const memory = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  ::munmap(memory, bytes);
}

}  // namespace gnbv
