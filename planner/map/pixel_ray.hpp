// What a pixel of a depth frame says. Plain, for the vector loops too.
#pragma once

#include <cstdint>

namespace gnbv {

/// The rules are the released code's, see FIDELITY.md.
enum class PixelRay : std::uint8_t {
  none = 0,    // kInvalidRange, or nearer than range_min_m: says nothing
  clears = 1,  // no return, or beyond range_max_m (a plane), or below the floor: free up to the end
  hits = 2     // free up to the end, which is surface
};

}  // namespace gnbv
