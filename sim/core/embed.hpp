#pragma once

#include <cstddef>
#include <string_view>

/// GNBV_EMBED(name, FILE) defines `std::string_view name()`: the contents of FILE (a string
/// literal) as part of the program. The assembler puts the file between two labels. CMake needs
/// FILE in the OBJECT_DEPENDS of the source that embeds it, since no compiler sees the dependence.
/// The labels are hidden, or the linker for Arm gives both one address, and the file no bytes.
#define GNBV_EMBED(name, file)                                                                    \
  asm(".pushsection .rodata\ngnbv_embedded_" #name "_begin:\n.incbin \"" file                     \
      "\"\ngnbv_embedded_" #name "_end:\n.popsection\n");                                         \
  extern "C" [[gnu::visibility("hidden")]] const char gnbv_embedded_##name##_begin[];             \
  extern "C" [[gnu::visibility("hidden")]] const char gnbv_embedded_##name##_end[];               \
  std::string_view name() {                                                                       \
    return {gnbv_embedded_##name##_begin,                                                         \
            static_cast<std::size_t>(gnbv_embedded_##name##_end - gnbv_embedded_##name##_begin)}; \
  }                                                                                               \
  static_assert(true)
